#include "tools/bench/line_views.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "silhouette/mesh/ground_axes.h"
#include "tools/options/line_camera.h"
#include "tools/options/line_page.h"
#include "tools/output/drawing_page.h"

namespace rimline::tools {

namespace {

constexpr std::uint64_t k_views_seed = 1;

// Every direction with the same probability. The library's own distributions differ between compilers.
glm::dvec3 spread_direction(std::mt19937_64& random) {
    const auto from_0_to_1 = [&] { return 0x1p-53 * static_cast<double>(random() >> 11); };
    const double z = 2.0 * from_0_to_1() - 1.0, angle = 2.0 * std::numbers::pi * from_0_to_1();
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

}  // namespace

BenchView bench_view(const Mesh& mesh, const glm::dvec3& eye) {
    const glm::dvec3 up = direction_of(mesh.up());
    const LineCamera camera{.name = "bench",
                            .view = LineView::perspective(eye, mesh.center(), up),
                            .eye = eye,
                            .target = mesh.center(),
                            .up = up,
                            .half_height = 1.0,
                            .is_framed = false};
    const LinePage paper;
    const ShownPart part = shown_part(camera, mesh, paper.aspect());
    const std::vector<ViewCell> cells{{part.low, part.high}};
    return {camera.view, place_views(paper, cells).views.front().mm_per_unit};
}

std::vector<BenchView> bench_views(const Mesh& mesh, std::uint32_t count) {
    std::mt19937_64 random(k_views_seed);
    const glm::dvec3 up = direction_of(mesh.up());
    std::vector<BenchView> views;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 towards =
            i == 0 ? glm::normalize(three_quarter_direction(up)) : spread_direction(random);
        views.push_back(bench_view(mesh, mesh.center() + k_eye_radii * mesh.radius() * towards));
    }
    return views;
}

}  // namespace rimline::tools
