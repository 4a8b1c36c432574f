#include "silhouette/points/umbrella_index.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/hough/block_kernels.h"
#include "silhouette/hough/reserved_bytes.h"
#include "silhouette/is_finite.h"

namespace rimline {

namespace {

// From farther away the difference is below the resolution of float.
constexpr double k_farthest = 0x1p20;

HomogeneousPoint limited_direction(const glm::dvec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return HomogeneousPoint::direction(glm::vec3(largest > 0.0 ? v / largest : v));
}

}  // namespace

HomogeneousPoint UmbrellaIndex::viewpoint(const glm::dvec3& point) const noexcept {
    RIMLINE_CHECK(is_finite(point));
    const glm::dvec3 to = point - center_;
    const double largest = std::max({std::abs(to.x), std::abs(to.y), std::abs(to.z)});
    if (largest * scale_ <= k_farthest) return HomogeneousPoint::viewpoint(glm::vec3(to * scale_));
    return HomogeneousPoint::viewpoint(glm::vec3(to / largest * k_farthest));
}

HomogeneousPoint UmbrellaIndex::direction(const glm::dvec3& v) const noexcept {
    RIMLINE_CHECK(is_finite(v));
    return limited_direction(v);
}

std::uint64_t UmbrellaIndex::size_bytes() const noexcept {
    return reserved_bytes(positions_, patch_of_, patches_, shapes_, targets_, sides_, specials_,
                          special_planes_) +
           std::uint64_t{4} * patches_.back().first_plane * sizeof(float) + tree_->size_bytes();
}

std::uint32_t UmbrellaIndex::find_spoke(std::uint32_t from, std::uint32_t to) const noexcept {
    const auto [first, last] = spokes_of(from);
    for (std::uint32_t spoke = first; spoke < last; ++spoke)
        if (targets_[spoke] == to) return spoke;
    return k_none;
}

std::uint32_t UmbrellaIndex::find_changing(const HomogeneousPoint& from, const HomogeneousPoint& to,
                                           BlockScratch& scratch,
                                           TraversalCounters& counters) const noexcept {
    RIMLINE_CHECK(from.is_valid() && to.is_valid());
    if (from == to) return 0;
    std::uint64_t nodes = 0;
    std::uint32_t certain_count = 0;  // All bits of these blocks flip, so no spoke changes.
    const std::uint32_t count = kernels::find_changing(
        *tree_, BlockPoint(from, patch_center_, max_distance_),
        BlockPoint(to, patch_center_, max_distance_), scratch, certain_count, nodes);
    counters.box_checks += nodes * k_node_width;
    return count;
}

// The face bit of silhouette/mesh/plane.h, for arrays.
std::uint32_t UmbrellaIndex::evaluate(std::uint32_t block, const HomogeneousPoint& point,
                                      std::span<std::uint8_t> front) const noexcept {
    const auto [first_patch, last_patch] = patches_of(block);
    const std::uint32_t first = patches_[first_patch].first_plane;
    const std::uint32_t count = patches_[last_patch].first_plane - first;
    RIMLINE_CHECK(front.size() >= count);
    const float* const nx = planes_.get() + std::size_t{4} * first;
    const float* const ny = nx + count;
    const float* const nz = ny + count;
    const float* const d = nz + count;
    std::uint8_t* const out = front.data();
    for (std::uint32_t i = 0; i < count; ++i)
        out[i] = (nx[i] * point.x + ny[i] * point.y) + nz[i] * point.z > point.w * d[i];
    return count;
}

bool UmbrellaIndex::is_special_on(std::uint32_t spoke, const std::uint8_t* front) const noexcept {
    const auto special = std::ranges::lower_bound(specials_, spoke, {}, &Special::spoke);
    const std::uint32_t first = special->first_plane;
    const std::uint32_t last = std::next(special)->first_plane;
    bool differ = false;
    for (std::uint32_t i = first; i < last; ++i)
        differ = differ || front[special_planes_[i]] != front[special_planes_[first]];
    return last - first == 2 ? differ != special->turn_the_same : differ;
}

}  // namespace rimline
