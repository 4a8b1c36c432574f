#include "silhouette/points/point_surface.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "silhouette/gradual_resize.h"
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

constexpr std::size_t k_max_ring_points = std::numeric_limits<std::uint32_t>::max();

void check(const PointSurfaceOptions& options) {
    RIMLINE_CHECK(options.k >= 4 && options.k <= 32);
    RIMLINE_CHECK(options.gap_ratio > 1.0);
    RIMLINE_CHECK(options.omega > 0.0 && options.omega < std::numbers::pi / 2);
    RIMLINE_CHECK(options.omega_t >= 0.0 && options.omega_t <= options.omega);
    RIMLINE_CHECK(options.phi > 0.0 && options.phi <= std::numbers::pi);
    RIMLINE_CHECK(options.gamma > 1.0);
}

struct Found {
    OrderedPoints ordered;
    NeighborLists neighbors;
    UmbrellaSet umbrellas;
};

Found find_umbrellas(std::span<const glm::dvec3> positions, const PointSurfaceOptions& options,
                     const LongCall& call) {
    call.checkpoint(0.0);
    OrderedPoints ordered = order_points(positions, call.stop);
    call.checkpoint(0.05);
    NeighborLists neighbors(ordered.positions, options.k, call.part(0.1, 0.55));
    const auto find = options.method == PointSurfaceOptions::Method::thesis ? find_thesis_umbrellas
                                                                            : find_robust_umbrellas;
    UmbrellaSet umbrellas = find(ordered.positions, neighbors, options, call.part(0.55, 1.0));
    return {std::move(ordered), std::move(neighbors), std::move(umbrellas)};
}

}  // namespace

PointSurface::PointSurface(std::span<const glm::dvec3> positions,
                           const PointSurfaceOptions& options, const LongCall& call)
    : positions_(positions.begin(), positions.end()) {
    check(options);
    if (positions.size() >= std::size_t{1} << 31)
        throw Error(ErrorCode::too_large, "2^31 points or more");
    labels_.assign(size(), PointLabel::undecided);
    reasons_.assign(size(), UndecidedReason::coincident);
    scales_.assign(size(), 0.0);
    const double share = options.drops_outliers ? 0.45 : 0.95;
    Found found = find_umbrellas(positions_, options, call.part(0.0, share));
    // Of each point in the order its number; of each point its place in the order.
    std::vector<std::uint32_t> numbers = found.ordered.numbers;
    if (options.drops_outliers) {
        const std::vector<std::uint8_t> outliers = find_outliers(
            found.ordered.positions, found.neighbors, found.umbrellas, call.part(share, 0.5));
        if (std::ranges::count(outliers, std::uint8_t{1}) > 0) {
            std::vector<glm::dvec3> kept;
            std::vector<std::uint32_t> kept_numbers;
            for (std::uint32_t i = 0; i < outliers.size(); ++i) {
                if (outliers[i] != 0) {
                    reasons_[numbers[i]] = UndecidedReason::outlier;
                } else {
                    kept.push_back(positions_[numbers[i]]);
                    kept_numbers.push_back(numbers[i]);
                }
            }
            found = find_umbrellas(kept, options, call.part(0.5, 0.95));
            numbers.clear();
            for (const std::uint32_t i : found.ordered.numbers) numbers.push_back(kept_numbers[i]);
        }
    }
    std::vector<std::uint32_t> place(positions.size(), k_not_ordered);
    for (std::uint32_t i = 0; i < numbers.size(); ++i) place[numbers[i]] = i;
    const UmbrellaSet& umbrellas = found.umbrellas;
    umbrella_begin_.push_back(0);
    ring_begin_.push_back(0);
    // Calls visit(fan, normal) for each umbrella of a point.
    const auto each_fan = [&](std::uint32_t i, auto&& visit) {
        if (umbrellas.fans[i].size > 0) visit(umbrellas.fans[i], umbrellas.normals[i]);
        for (const auto& supplement : std::ranges::equal_range(umbrellas.supplements, i, {},
                                                               &UmbrellaSet::Supplement::point))
            visit(supplement.fan, supplement.normal);
    };
    const std::size_t count = umbrellas.fans.size() + umbrellas.supplements.size();
    umbrella_begin_.reserve(std::size_t{size()} + 1);
    ring_begin_.reserve(count + 1);
    gaps_.reserve(count);
    normals_.reserve(count);
    for (std::uint32_t point = 0; point < size(); ++point) {
        if (point % k_checkpoint_points == 0) call.checkpoint(0.95 + 0.02 * point / size());
        if (const std::uint32_t i = place[point]; i != k_not_ordered) {
            labels_[point] = umbrellas.labels[i];
            reasons_[point] = umbrellas.reasons[i];
            if (umbrellas.fans[i].size > 0)
                scales_[point] = umbrellas.scales[i] * found.ordered.unit;
            each_fan(i, [&](const Fan& fan, const glm::dvec3& normal) {
                if (ring_begin_.back() > k_max_ring_points - fan.size)
                    throw Error(ErrorCode::too_large, "2^32 points of rings or more");
                gaps_.push_back(fan.gaps);
                normals_.push_back(normal);
                ring_begin_.push_back(ring_begin_.back() + fan.size);
            });
        }
        ++counts_[static_cast<std::size_t>(labels_[point])];
        umbrella_begin_.push_back(static_cast<std::uint32_t>(gaps_.size()));
    }
    resize_gradually(rings_, ring_begin_.back(), call.stop);
    each_point(size(), {call, 0.97, 0.98}, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t point = first; point < last; ++point) {
            const std::uint32_t i = place[point];
            if (i == k_not_ordered) continue;
            PointId* out = rings_.data() + ring_begin_[umbrella_begin_[point]];
            each_fan(i, [&](const Fan& fan, const glm::dvec3&) {
                for (std::size_t j = 0; j < fan.size; ++j)
                    *out++ = PointId{numbers[found.neighbors.of(i)[fan.ring[j]]]};
            });
        }
    });
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
