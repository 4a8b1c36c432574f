#include "engine/frame/ray_bound.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace rimline {

namespace {

// Limits of the number of bins, a power of two that is at least the number of sides.
constexpr std::uint32_t k_min_bins = 256;
constexpr std::uint32_t k_max_bins = 1u << 14;

// Error of a vertex relative to the light in the shaders, relative to its length.
constexpr double k_float_rounding = 0x1p-22;

std::uint32_t bins_for(const VolumeSides& sides) {
    return std::clamp(std::bit_ceil(std::max(static_cast<std::uint32_t>(sides.size()), 1u)),
                      k_min_bins, k_max_bins);
}

// Bins of a circle; after the last one follows the first.
struct BinSpan {
    std::uint32_t first, count;
};

// Places and their error, in any unit.
struct Interval {
    double least, most;

    void include(double place, double error) {
        least = std::min(least, place - error);
        most = std::max(most, place + error);
    }
};

// The places of `bounds` in bins, none of which wraps. Places beyond are in the first and the last bin.
class BinnedInterval {
public:
    BinnedInterval(const Interval& all, std::uint32_t bins)
        : begin_(all.least),
          bins_per_place_(all.most > all.least ? bins / (all.most - all.least) : 0.0),
          bins_(bins) {}

    BinSpan span_of(const Interval& places) const {
        const std::uint32_t first = bin_of(places.least);
        return {first, bin_of(places.most) - first + 1};
    }

private:
    std::uint32_t bin_of(double place) const {
        return static_cast<std::uint32_t>(
            std::clamp((place - begin_) * bins_per_place_, 0.0, bins_ - 1.0));
    }

    double begin_, bins_per_place_;
    std::uint32_t bins_;
};

// Planes parallel to a directional light and an axis.
class ParallelPlanes {
public:
    ParallelPlanes(const Bounds& bounds, const HomogeneousPoint& light, int outer, int other,
                   std::uint32_t bins)
        : outer_(outer),
          other_(other),
          outer_weight_(-double{light.xyz()[other]}),
          other_weight_(light.xyz()[outer]),
          bins_(bins),
          binned_(places_of(bounds), bins) {}

    std::uint32_t bins() const { return bins_; }
    BinSpan span_of(const VolumeSide& side) const {
        Interval places{place_of(side.a), place_of(side.a)};
        places.include(place_of(side.b), 0.0);
        return binned_.span_of({places.least - error_, places.most + error_});
    }

private:
    double place_of(const glm::dvec3& p) const {
        return outer_weight_ * p[outer_] + other_weight_ * p[other_];
    }
    Interval places_of(const Bounds& bounds) {
        const glm::dvec3 low(bounds.low);
        const glm::dvec3 high(bounds.high);
        const glm::dvec3 extent = high - low;
        Interval places{place_of(low), place_of(low)};
        for (const double x : {low[outer_], high[outer_]})
            for (const double y : {low[other_], high[other_]})
                places.include(outer_weight_ * x + other_weight_ * y, 0.0);
        error_ = k_float_rounding * (std::abs(outer_weight_) * extent[outer_] +
                                     std::abs(other_weight_) * extent[other_]);
        return places;
    }

    int outer_, other_;
    double outer_weight_, other_weight_;
    double error_ = 0.0;
    std::uint32_t bins_;
    BinnedInterval binned_;
};

// Meridians of a point light outside. All are in the half plane where the outer coordinate points towards the
// bounds. There y / (x + |y|), with x along that coordinate, increases with the angle.
class OuterMeridians {
public:
    OuterMeridians(const Bounds& bounds, const HomogeneousPoint& light, int outer, int other,
                   std::uint32_t bins)
        : light_(light.xyz()),
          outer_(outer),
          other_(other),
          sign_(bounds.low[outer] > light.xyz()[outer] ? 1.0 : -1.0),
          bins_(bins),
          binned_(places_of(bounds), bins) {}

    std::uint32_t bins() const { return bins_; }
    BinSpan span_of(const VolumeSide& side) const {
        Interval places{1.0, -1.0};
        for (const glm::vec3& end : {side.a, side.b}) {
            const glm::dvec3 away = glm::dvec3(end) - light_;
            const double length = sum_across(away);
            // The place's gradient is as long as the vector across the axis, over the square of this length.
            const double across = glm::length(glm::dvec2(away[outer_], away[other_]));
            const double error = k_float_rounding * glm::length(away);
            places.include(place_of(away, length), error * across / (length * length));
        }
        return binned_.span_of(places);
    }

private:
    double sum_across(const glm::dvec3& away) const {
        return sign_ * away[outer_] + std::abs(away[other_]);
    }
    double place_of(const glm::dvec3& away, double length) const { return away[other_] / length; }
    Interval places_of(const Bounds& bounds) const {
        Interval places{1.0, -1.0};
        for (const float x : {bounds.low[outer_], bounds.high[outer_]})
            for (const float y : {bounds.low[other_], bounds.high[other_]}) {
                glm::dvec3 away(0.0);
                away[outer_] = x - light_[outer_];
                away[other_] = y - light_[other_];
                places.include(place_of(away, sum_across(away)), 0.0);
            }
        return places;
    }

    glm::dvec3 light_;
    int outer_, other_;
    double sign_;
    std::uint32_t bins_;
    BinnedInterval binned_;
};

// All meridians of a point light, around the axis.
class AllMeridians {
public:
    AllMeridians(const HomogeneousPoint& light, int axis, std::uint32_t bins)
        : light_(light.xyz()), axis_(axis), bins_(bins) {}

    std::uint32_t bins() const { return bins_; }
    BinSpan span_of(const VolumeSide& side) const {
        const End a = end_of(side.a);
        const End b = end_of(side.b);
        // From half a turn on, the direction is ambiguous. An end near the axis may have any meridian: then
        // its error is large, or not a number.
        double step = b.turn - a.turn;
        if (step > 2.0) step -= 4.0;
        if (step < -2.0) step += 4.0;
        if (!(std::abs(step) + a.error + b.error < 1.9)) return {0, bins_};
        // From one circle below 0 on, so that casts round down.
        const double bins_per_turn = bins_ / 4.0;
        const auto first = static_cast<std::uint32_t>(
            bins_per_turn * (a.turn + std::min(-a.error, step - b.error)) + bins_);
        const auto last = static_cast<std::uint32_t>(
            bins_per_turn * (a.turn + std::max(a.error, step + b.error)) + bins_);
        const std::uint32_t count = last - first + 1;
        if (count >= bins_) return {0, bins_};
        return {first % bins_, count};
    }

private:
    struct End {
        double turn;  // In [0, 4], increases with the angle, by one for each quarter turn.
        double error;
    };
    End end_of(const glm::vec3& place) const {
        const glm::dvec3 away = glm::dvec3(place) - light_;
        const double x = away[(axis_ + 1) % 3];
        const double y = away[(axis_ + 2) % 3];
        const glm::dvec3 size = glm::abs(away);
        const double per_length = 1.0 / (std::abs(x) + std::abs(y));
        const double along = x * per_length;
        // A sum in place of the length, because it is faster: far lights, where errors count, are outside.
        return {y >= 0.0 ? 1.0 - along : 3.0 + along,
                k_float_rounding * (size.x + size.y + size.z) * per_length};
    }

    glm::dvec3 light_;
    int axis_;
    std::uint32_t bins_;
};

std::uint32_t half(std::int64_t count) { return static_cast<std::uint32_t>(count / 2); }

}  // namespace

std::optional<int> outer_axis(const Bounds& bounds, const HomogeneousPoint& light) {
    const glm::dvec3 low(bounds.low);
    const glm::dvec3 high(bounds.high);
    const glm::dvec3 place(light.xyz());
    const glm::dvec3 gap =
        light.is_direction() ? glm::abs(place) : glm::max(low - place, place - high);
    int outer = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (gap[axis] > gap[outer]) outer = axis;
    if (!light.is_direction() && !(gap[outer] > 0x1p-20 * glm::length(high - low))) return {};
    return outer;
}

template <typename Meridians>
std::int64_t RayBound::most_on_meridian(const VolumeSides& sides, const Meridians& meridians) {
    const std::uint32_t bins = meridians.bins();
    steps_.assign(bins + 1, 0);
    sides.for_each([&](const VolumeSide& side) {
        const BinSpan span = meridians.span_of(side);
        const std::uint32_t end = span.first + span.count;
        steps_[span.first] += side.count;
        if (end <= bins) {
            steps_[end] -= side.count;
        } else {
            steps_[0] += side.count;
            steps_[end - bins] -= side.count;
        }
    });
    std::int64_t most = 0;
    std::int64_t spanning = 0;
    for (std::uint32_t bin = 0; bin < bins; ++bin) {
        spanning += steps_[bin];
        most = std::max(most, spanning);
    }
    return most;
}

std::uint32_t RayBound::from_outside(const VolumeSides& sides, const Bounds& bounds,
                                     const HomogeneousPoint& light, int outer,
                                     std::uint32_t enough) {
    const std::uint32_t bins = bins_for(sides);
    std::uint32_t least = ~0u;
    for (const int other : {(outer + 2) % 3, (outer + 1) % 3}) {
        const std::int64_t most =
            light.is_direction()
                ? most_on_meridian(sides, ParallelPlanes(bounds, light, outer, other, bins))
                : most_on_meridian(sides, OuterMeridians(bounds, light, outer, other, bins));
        least = std::min(least, half(most));
        if (least <= enough) break;
    }
    return least;
}

std::uint32_t RayBound::from_within(const VolumeSides& sides, const HomogeneousPoint& light,
                                    int axis, std::uint32_t faces_at_poles) {
    const AllMeridians meridians(light, axis, bins_for(sides));
    return half(most_on_meridian(sides, meridians) + faces_at_poles);
}

}  // namespace rimline
