#include "silhouette/points/umbrella_index.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/error.h"
#include "silhouette/points/umbrella_triangles.h"

namespace rimline {

namespace {

// From farther away a silhouette differs by less than float can say.
constexpr double k_farthest = 0x1p20;

HomogeneousPoint limited_direction(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return HomogeneousPoint::direction(glm::vec3(largest > 0.0 ? v / largest : v));
}

}  // namespace

UmbrellaIndex::UmbrellaIndex(const PointSurface& surface, const LongCall& call)
    : point_count_(surface.size()),
      mesh_(make_patches(surface), Welding::none),
      octree_(mesh_, {}, call) {
    find_twins();
}

MeshSource UmbrellaIndex::make_patches(const PointSurface& surface) {
    const std::span<const glm::dvec3> positions = surface.positions();
    if (!positions.empty()) {
        glm::dvec3 low = positions[0];
        glm::dvec3 high = positions[0];
        for (const glm::dvec3& p : positions) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        center_ = 0.5 * low + 0.5 * high;
        const glm::dvec3 half = 0.5 * high - 0.5 * low;
        const double size = std::max({half.x, half.y, half.z});
        int exponent = 0;
        std::frexp(size, &exponent);
        if (size > 0.0) scale_ = std::ldexp(1.0, std::min(-exponent, 1000));
    }
    MeshSource source;
    patch_begin_.reserve(surface.size() + 1);
    for (std::uint32_t p = 0; p < surface.size(); ++p) {
        const PointId point{p};
        const auto first = static_cast<std::uint32_t>(point_of_.size());
        patch_begin_.push_back(first);
        if (surface.umbrellas_of(point).size() == 0) continue;
        const auto vertex_of = [&](PointId q) {
            const auto found = std::find(point_of_.begin() + first, point_of_.end(), q);
            const auto vertex = static_cast<std::uint32_t>(found - point_of_.begin());
            if (found == point_of_.end()) {
                point_of_.push_back(q);
                owner_.push_back(point);
                is_middle_.push_back(q == point);
                source.positions.push_back(to_index(positions[index(q)]));
            }
            return vertex;
        };
        vertex_of(point);
        for_each_triangle(surface, point, [&](PointId from, PointId to, UmbrellaId) {
            const std::uint32_t first_corner = vertex_of(from);
            source.triangles.push_back({first, first_corner, vertex_of(to)});
        });
    }
    patch_begin_.push_back(static_cast<std::uint32_t>(point_of_.size()));
    return source;
}

void UmbrellaIndex::find_twins() {
    // Every vertex is a triangle's, so that the mesh's numbers are the patches'.
    RIMLINE_CHECK(mesh_.vertex_count() == point_of_.size());
    twin_.assign(point_of_.size(), k_no_spoke);
    for (std::uint32_t v = 0; v < point_of_.size(); ++v) {
        if (is_middle_[v]) continue;
        const std::uint32_t target = index(point_of_[v]);
        const auto begin = point_of_.begin() + patch_begin_[target];
        const auto end = point_of_.begin() + patch_begin_[target + 1];
        const auto found = std::find(begin, end, owner_[v]);
        if (found != end) twin_[v] = static_cast<std::uint32_t>(found - point_of_.begin());
    }
}

HomogeneousPoint UmbrellaIndex::viewpoint(const glm::dvec3& point) const noexcept {
    RIMLINE_CHECK(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z));
    const glm::dvec3 to = point - center_;
    const double largest = std::max({std::abs(to.x), std::abs(to.y), std::abs(to.z)});
    if (largest * scale_ <= k_farthest) return HomogeneousPoint::viewpoint(glm::vec3(to * scale_));
    return HomogeneousPoint::viewpoint(glm::vec3(to / largest * k_farthest));
}

HomogeneousPoint UmbrellaIndex::direction(const glm::dvec3& v) const noexcept {
    RIMLINE_CHECK(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
    return limited_direction(v);
}

}  // namespace rimline
