// Any points: umbrellas of points that exist, and the silhouette of a moving point as a new one finds it.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "silhouette/points/point_cloud.h"
#include "silhouette/points/point_silhouette.h"
#include "silhouette/points/point_surface.h"
#include "silhouette/points/umbrella_index.h"
#include "tests/fuzz/fuzz_input.h"

using namespace rimline;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::FuzzInput input(data, size);
    PointSource source;
    const std::uint32_t count = 1 + input.below(200);
    for (std::uint32_t i = 0; i < count; ++i) source.positions.emplace_back(input.point());
    const PointCloud cloud(std::move(source));
    const PointSurface surface(cloud.positions());
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        const auto range = surface.umbrellas_of(PointId{i});
        fuzz::require(std::isfinite(surface.scale(PointId{i})), "a scale that is not finite");
        for (std::uint32_t u = range.first; u < range.last; ++u)
            for (const PointId neighbor : surface.umbrella(UmbrellaId{u}).ring)
                fuzz::require(index(neighbor) < surface.size() && index(neighbor) != i,
                              "a ring of other points");
    }
    const UmbrellaIndex umbrellas(surface);
    const auto any_point = [&] {
        const bool is_direction = input.byte() % 4 == 0;
        const glm::dvec3 at(input.point());
        return is_direction ? umbrellas.direction(at) : umbrellas.viewpoint(at);
    };
    PointSilhouette moved(umbrellas, any_point());
    for (int move = 0; move < 8; ++move) {
        const HomogeneousPoint point = any_point();
        moved.move_to(point);
        const PointSilhouette fresh(umbrellas, point);
        fuzz::require(moved.points() == fresh.points(), "the points after a move");
        fuzz::require(moved.consensus_edges() == fresh.consensus_edges(), "the edges after a move");
    }
    return 0;
}
