#include "silhouette/points/point_surface.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

#include "silhouette/points/each_point.h"
#include "silhouette/points/neighbor_lists.h"
#include "silhouette/points/outliers.h"
#include "silhouette/points/point_order.h"
#include "silhouette/points/robust_umbrellas.h"
#include "silhouette/points/thesis_umbrellas.h"

namespace rimline {

namespace {

// Marks a point that coincides with another.
constexpr std::uint32_t k_not_ordered = std::numeric_limits<std::uint32_t>::max();

constexpr std::uint32_t k_batch = 1u << 16;  // Points between two checkpoints.
constexpr std::size_t k_max_ring_points = std::numeric_limits<std::uint32_t>::max();

void check(const PointSurfaceOptions& options) {
    RIMLINE_CHECK(options.k >= 4 && options.k <= 32);
    RIMLINE_CHECK(options.gap_ratio > 1.0);
    RIMLINE_CHECK(options.omega > 0.0 && options.omega < std::numbers::pi / 2);
    RIMLINE_CHECK(options.omega_t >= 0.0 && options.omega_t <= options.omega);
    RIMLINE_CHECK(options.phi > 0.0 && options.phi <= std::numbers::pi);
    RIMLINE_CHECK(options.gamma > 1.0);
}

}  // namespace

PointSurface::PointSurface(std::span<const glm::dvec3> positions,
                           const PointSurfaceOptions& options, const LongCall& call)
    : positions_(positions.begin(), positions.end()) {
    check(options);
    if (positions.size() >= std::size_t{1} << 31)
        throw Error(ErrorCode::too_large, "2^31 points or more");
    if (!options.drops_outliers) {
        find_umbrellas(options, {}, call);
        return;
    }
    find_umbrellas(options, {}, call.part(0.0, 0.48));
    const std::vector<std::uint8_t> outliers = find_outliers(*this, call.part(0.48, 0.52));
    if (std::ranges::count(outliers, std::uint8_t{1}) > 0)
        find_umbrellas(options, outliers, call.part(0.52, 1.0));
}

void PointSurface::find_umbrellas(const PointSurfaceOptions& options,
                                  std::span<const std::uint8_t> dropped, const LongCall& call) {
    call.checkpoint(0.0);
    std::vector<glm::dvec3> kept;
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < dropped.size(); ++i) {
        if (dropped[i] != 0) continue;
        kept.push_back(positions_[i]);
        numbers.push_back(i);
    }
    const OrderedPoints ordered = order_points(dropped.empty() ? std::span(positions_) : kept);
    call.checkpoint(0.05);
    const NeighborLists neighbors(ordered.positions, options.k, call.part(0.1, 0.5));
    const auto find = options.method == PointSurfaceOptions::Method::thesis ? find_thesis_umbrellas
                                                                            : find_robust_umbrellas;
    const UmbrellaSet found = find(ordered.positions, neighbors, options, call.part(0.5, 0.95));
    // Of each point of the order its number, and of each point its place in the order.
    std::vector<std::uint32_t> place(positions_.size(), k_not_ordered);
    const auto number = [&](std::uint32_t i) {
        return numbers.empty() ? ordered.numbers[i] : numbers[ordered.numbers[i]];
    };
    for (std::uint32_t i = 0; i < ordered.numbers.size(); ++i) place[number(i)] = i;
    labels_.assign(size(), PointLabel::undecided);
    reasons_.assign(size(), UndecidedReason::coincident);
    for (std::uint32_t i = 0; i < dropped.size(); ++i)
        if (dropped[i] != 0) reasons_[i] = UndecidedReason::outlier;
    scales_.assign(size(), 0.0);
    counts_ = {};
    umbrella_begin_.assign(1, 0);
    ring_begin_.assign(1, 0);
    gaps_.clear();
    normals_.clear();
    rings_.clear();
    const auto add = [&](std::uint32_t i, const Fan& fan, const glm::dvec3& normal) {
        const auto list = neighbors.of(i);
        if (rings_.size() > k_max_ring_points - fan.size)
            throw Error(ErrorCode::too_large, "2^32 points of rings or more");
        for (std::size_t j = 0; j < fan.size; ++j)
            rings_.push_back(PointId{number(list[fan.ring[j]])});
        gaps_.push_back(fan.gaps);
        normals_.push_back(normal);
        ring_begin_.push_back(static_cast<std::uint32_t>(rings_.size()));
    };
    for (std::uint32_t point = 0; point < size(); ++point) {
        if (point % k_batch == 0) call.checkpoint(0.95 + 0.03 * point / size());
        if (const std::uint32_t i = place[point]; i != k_not_ordered) {
            labels_[point] = found.labels[i];
            reasons_[point] = found.reasons[i];
            if (found.fans[i].size > 0) {
                scales_[point] = found.scales[i] * ordered.unit;
                add(i, found.fans[i], found.normals[i]);
            }
            const auto further =
                std::ranges::equal_range(found.supplements, i, {}, &UmbrellaSet::Supplement::point);
            for (const auto& supplement : further) add(i, supplement.fan, supplement.normal);
        }
        ++counts_[static_cast<std::size_t>(labels_[point])];
        umbrella_begin_.push_back(static_cast<std::uint32_t>(gaps_.size()));
    }
    count_inconsistent_edges(call);
}

void PointSurface::count_inconsistent_edges(const LongCall& call) {
    const auto ends_of = [&](PointId point, std::vector<PointId>& ends) {
        ends.clear();
        const UmbrellaRange range = umbrellas_of(point);
        for (std::uint32_t u = range.first; u < range.last; ++u) {
            const Umbrella fan = umbrella(UmbrellaId{u});
            for (std::size_t j = 0; j < fan.ring.size(); ++j)
                if (fan.is_gap(j)) {
                    ends.push_back(fan.ring[j]);
                    ends.push_back(fan.ring[j + 1 == fan.ring.size() ? 0 : j + 1]);
                }
        }
        std::sort(ends.begin(), ends.end());
        ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    };
    std::atomic<std::uint32_t> count = 0;
    each_point(size(), {call, 0.98, 1.0}, [&](std::uint32_t first, std::uint32_t last) {
        std::vector<PointId> ends, back;
        for (std::uint32_t i = first; i < last; ++i) {
            ends_of(PointId{i}, ends);
            for (const PointId end : ends) {
                ends_of(end, back);
                if (!std::binary_search(back.begin(), back.end(), PointId{i})) ++count;
            }
        }
    });
    inconsistent_edges_ = count;
}

}  // namespace rimline
