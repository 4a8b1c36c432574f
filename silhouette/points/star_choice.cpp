#include "silhouette/points/star_choice.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "silhouette/gradual_resize.h"
#include "silhouette/points/each_point.h"

namespace rimline {

namespace {

constexpr double k_degree = std::numbers::pi / 180.0;
constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr double k_max_deviation = 85.0 * k_degree;
// Maximum angle of a star's edges with its plane: 50 degrees.
constexpr double k_sine_of_candidates = 0.766;
// Maximum mean deviation of a star that needs no other.
constexpr double k_clean_deviation = 15.0 * k_degree;
constexpr double k_gap_cost = 1.0;
// A lower cost must be lower by this. Of mirror images the first is kept.
constexpr double k_cost_tie = 1e-9;
// How many neighbors planes are fitted to, at most spanning_count().
constexpr std::uint32_t k_fits[] = {k_max_neighbors, 8, 5};
// Of improve(), and of repair().
constexpr int k_rounds = 2;
// Nearest neighbors whose normals are tried.
constexpr std::uint32_t k_tried_neighbors = 8;
// 15 degrees. Normals nearer to one that was tried are skipped.
constexpr double k_cosine_of_same = 0.9659;
// 60 degrees, between a star's normal and those of its ring.
constexpr double k_cosine_of_crossing = 0.5;

double excess_of(double circumradius, double deviation, double scale) {
    if (deviation > k_max_deviation) return k_infinity;
    return circumradius * (1.0 + 2.0 / std::numbers::pi * deviation) / scale;
}

struct Choice {
    Fan fan;
    glm::dvec3 normal{0.0};
    double scale = 0.0;
    double cost = k_infinity;
    bool is_whole = false;  // Without gaps.
    bool is_clean = false;
};

// Chooses the stars of all points.
class Chooser {
public:
    Chooser(std::span<const glm::dvec3> points, const NeighborLists& neighbors, double gap_ratio,
            const std::stop_token& stop)
        : points_(points), neighbors_(neighbors), gap_ratio_(gap_ratio) {
        resize_gradually(stars_.fans, points.size(), stop);
        resize_gradually(stars_.normals, points.size(), stop, glm::dvec3(0.0));
        stars_.scales.assign(points.size(), 0.0);
        stars_.reasons.assign(points.size(), UndecidedReason::none);
        stars_.is_clean.assign(points.size(), 0);
        was_changed_.assign(points.size(), 1);
    }

    void fit(const CallPart& part) {
        each_point(static_cast<std::uint32_t>(points_.size()), part,
                   [&](std::uint32_t first, std::uint32_t last) {
                       Neighborhood around;
                       for (std::uint32_t i = first; i < last; ++i) fit(i, around);
                   });
    }

    // Tries the normals of neighbors. Skips points around which nothing has changed since the last round: the
    // result would be the same.
    void improve(const CallPart& part) {
        std::vector<std::uint32_t> unclean;
        for (std::uint32_t i = 0; i < points_.size(); ++i)
            if (!stars_.is_clean[i] && stars_.reasons[i] == UndecidedReason::none &&
                (was_changed_[i] || std::ranges::any_of(neighbors_.of(i), [&](std::uint32_t q) {
                     return was_changed_[q] != 0;
                 })))
                unclean.push_back(i);
        choose_again(unclean, Goal::min_cost, part);
    }

    // A star across two sheets may be clean, but its normal crosses those of its ring. Here the angle between
    // them is added to the cost. Only whole stars are accepted, so that no borders arise.
    void repair(const CallPart& part) {
        std::vector<std::uint8_t> is_crossing(points_.size());
        each_point(static_cast<std::uint32_t>(points_.size()), {part.call, part.begin, part.begin},
                   [&](std::uint32_t first, std::uint32_t last) {
                       for (std::uint32_t i = first; i < last; ++i)
                           is_crossing[i] =
                               cosine_with_ring(i, stars_.fans[i], stars_.normals[i]) <=
                               k_cosine_of_crossing;
                   });
        std::vector<std::uint32_t> crossing;
        for (std::uint32_t i = 0; i < points_.size(); ++i)
            if (is_crossing[i] != 0) crossing.push_back(i);
        choose_again(crossing, Goal::min_angle, part);
    }

    Stars stars() { return std::move(stars_); }

private:
    // scale(j, own): the maximum of the scales of sector j's corners, where `own` is the star's. Returns
    // early where the cost is surely `limit` or more.
    template <typename Scale>
    Choice judge(const Neighborhood& around, const Fan& fan, double limit, Scale&& scale) const {
        Choice choice{fan};
        if (!fan.is_umbrella()) return choice;
        Neighborhood::Triangles triangles;
        around.triangles(fan, triangles);
        choice.scale = Neighborhood::scale(fan, triangles);
        // The normal is without the sectors that are gaps whatever their deviation. Along a bending border
        // such a triangle may be perpendicular to the surface.
        Fan rest = fan;
        for (std::size_t j = 0; j < fan.size; ++j)
            if (!fan.is_gap(j) && triangles[j].circumradius > gap_ratio_ * scale(j, choice.scale))
                rest.open(j);
        if (k_gap_cost * std::popcount(rest.gaps) >= limit) return choice;
        Neighborhood::set_angles(fan, triangles);
        choice.normal = Neighborhood::normal(rest.is_umbrella() ? rest : fan, triangles);
        if (choice.normal == glm::dvec3(0.0)) return choice;
        double sum = 0.0;
        double total = 0.0;
        int gaps = 0;
        for (std::size_t j = 0; j < fan.size; ++j) {
            const double deviation = fan.is_gap(j) ? 0.0 : triangles[j].deviation(choice.normal);
            if (fan.is_gap(j) || excess_of(triangles[j].circumradius, deviation,
                                           scale(j, choice.scale)) > gap_ratio_) {
                ++gaps;
                continue;
            }
            sum += triangles[j].angle * deviation;
            total += triangles[j].angle;
        }
        if (!(total > 0.0)) return choice;
        choice.cost = sum / total;
        if (gaps > 0)
            choice.cost += k_gap_cost * std::max<double>(gaps, 2.0 - total / std::numbers::pi);
        choice.is_whole = gaps == 0;
        choice.is_clean = gaps == 0 && sum / total < k_clean_deviation;
        return choice;
    }

    // By the star's own scale, before its neighbors have scales.
    Choice judge_alone(const Neighborhood& around, const Fan& fan, double limit) const {
        return judge(around, fan, limit, [](std::size_t, double own) { return own; });
    }
    Choice judge_among(std::uint32_t point, const Neighborhood& around, const Fan& fan,
                       double limit) const {
        return judge(around, fan, limit,
                     [&](std::size_t j, double) { return stars_.scale_of(around, point, fan, j); });
    }

    void take(std::uint32_t point, const Choice& choice) {
        stars_.fans[point] = choice.fan;
        stars_.normals[point] = choice.normal;
        stars_.scales[point] = choice.scale;
    }

    void fit(std::uint32_t point, Neighborhood& around) {
        UndecidedReason& reason = stars_.reasons[point];
        const auto list = neighbors_.of(point);
        if (!neighbors_.is_mutual(point)) {
            reason = list.empty() ? UndecidedReason::alone : UndecidedReason::isolated;
            return;
        }
        around.assign(points_, point, list);
        Choice best;
        for (const std::uint32_t fit : k_fits) {
            const glm::dvec3 plane =
                around.fitted_normal(std::min(fit, neighbors_.spanning_count(point)));
            if (plane == glm::dvec3(0.0)) continue;
            const Choice choice =
                judge_alone(around, around.star(plane, k_sine_of_candidates), best.cost);
            if (choice.cost < best.cost - k_cost_tie) best = choice;
            if (best.is_clean) break;
        }
        stars_.is_clean[point] = best.is_clean;
        if (around.is_collinear())
            reason = UndecidedReason::collinear;
        else if (best.cost < k_infinity)
            take(point, best);
        else
            reason = UndecidedReason::no_normal;
    }

    // The cosine of the second smallest of the unoriented angles between a star's normal and the normals of
    // its ring's points. With three of them or fewer, of the smallest. 1 where no point has a normal.
    double cosine_with_ring(std::uint32_t point, const Fan& fan, const glm::dvec3& normal) const {
        const std::span<const std::uint32_t> list = neighbors_.of(point);
        std::array<double, k_max_neighbors> cosines;
        std::size_t count = 0;
        for (std::size_t j = 0; j < fan.size; ++j)
            if (const glm::dvec3& other = stars_.normals[list[fan.ring[j]]];
                other != glm::dvec3(0.0))
                cosines[count++] = std::abs(glm::dot(other, normal));
        if (count == 0) return 1.0;
        const auto found =
            cosines.begin() + static_cast<std::ptrdiff_t>(count - (count > 3 ? 2 : 1));
        std::nth_element(cosines.begin(), found,
                         cosines.begin() + static_cast<std::ptrdiff_t>(count));
        return *found;
    }

    // min_angle: the angle with the ring's normals is added to the cost of a star, and stars with gaps are
    // refused.
    enum class Goal : std::uint8_t { min_cost, min_angle };

    // Every point uses the normals and scales that its neighbors had before the call.
    void choose_again(std::span<const std::uint32_t> points, Goal goal, const CallPart& part) {
        std::vector<Choice> choices(points.size());
        each_point(static_cast<std::uint32_t>(points.size()), part,
                   [&](std::uint32_t first, std::uint32_t last) {
                       Neighborhood around;
                       for (std::uint32_t n = first; n < last; ++n)
                           choices[n] = best_of_neighbors(points[n], goal, around);
                   });
        was_changed_.assign(points_.size(), 0);
        for (std::size_t n = 0; n < points.size(); ++n) {
            const std::uint32_t point = points[n];
            was_changed_[point] = choices[n].normal != stars_.normals[point] ||
                                  choices[n].scale != stars_.scales[point];
            if (was_changed_[point] != 0) stars_.is_clean[point] = 0;
            take(point, choices[n]);
        }
    }

    Choice best_of_neighbors(std::uint32_t point, Goal goal, Neighborhood& around) const {
        around.assign(points_, point, neighbors_.of(point));
        std::array<glm::dvec3, k_tried_neighbors + 1> tried;
        std::size_t count = 0;
        Choice best = judge_among(point, around, stars_.fans[point], k_infinity);
        const bool counts_angle = goal == Goal::min_angle;
        const auto angle_with_ring = [&](const Choice& choice) {
            return std::acos(std::min(cosine_with_ring(point, choice.fan, choice.normal), 1.0));
        };
        if (counts_angle) best.cost += angle_with_ring(best);
        const auto try_plane = [&](const glm::dvec3& plane) {
            if (plane == glm::dvec3(0.0)) return;
            for (std::size_t t = 0; t < count; ++t)
                if (std::abs(glm::dot(tried[t], plane)) > k_cosine_of_same) return;
            tried[count++] = plane;
            Choice choice =
                judge_among(point, around, around.star(plane, k_sine_of_candidates), best.cost);
            if (counts_angle && !choice.is_whole) return;
            if (counts_angle && choice.cost < best.cost) choice.cost += angle_with_ring(choice);
            if (choice.cost < best.cost - k_cost_tie) best = choice;
        };
        try_plane(stars_.normals[point]);
        for (std::uint32_t n = 0; n < std::min(around.size(), k_tried_neighbors); ++n)
            try_plane(stars_.normals[around.number(n)]);
        return best;
    }

    std::span<const glm::dvec3> points_;
    const NeighborLists& neighbors_;
    double gap_ratio_;
    Stars stars_;
    std::vector<std::uint8_t> was_changed_;  // In the last round; by point.
};

}  // namespace

double Stars::excess(const Neighborhood& around, std::uint32_t point, const Fan& fan,
                     std::size_t sector) const {
    if (fan.is_gap(sector)) return k_infinity;
    const Neighborhood::Triangle triangle = around.triangle(fan, sector);
    return excess_of(triangle.circumradius, triangle.deviation(normals[point]),
                     scale_of(around, point, fan, sector));
}

Stars choose_stars(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
                   double gap_ratio, const LongCall& call) {
    Chooser chooser(points, neighbors, gap_ratio, call.stop);
    chooser.fit({call, 0.0, 0.6});
    for (int round = 0; round < k_rounds; ++round)
        chooser.improve({call, 0.6 + 0.35 * round / k_rounds, 0.6 + 0.35 * (round + 1) / k_rounds});
    for (int round = 0; round < k_rounds; ++round)
        chooser.repair(
            {call, 0.95 + 0.05 * round / k_rounds, 0.95 + 0.05 * (round + 1) / k_rounds});
    return chooser.stars();
}

}  // namespace rimline
