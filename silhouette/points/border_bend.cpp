#include "silhouette/points/border_bend.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/points/neighborhood.h"
#include "silhouette/points/open_point.h"

namespace rimline {

namespace {

constexpr double k_standing_back = 10.0;
// The square of eight degrees in radians: noise bends borders by so much.
constexpr double k_noise_bend = 0.0195;
// Of several neighbors that stand back, one is taken off in each round.
constexpr int k_bend_rounds = 3;

// Moves the end of the gap at `old_end` to `new_end` and adds the triangle between the two. Returns false,
// with the fan unchanged, where `new_end` is no neighbor or is in the ring already.
bool move_end(Fan& fan, std::span<const std::uint32_t> list, std::uint32_t old_end,
              std::uint32_t new_end) {
    const auto found = std::find(list.begin(), list.end(), new_end);
    if (found == list.end() || fan.size == k_max_neighbors) return false;
    const auto place = static_cast<std::uint8_t>(found - list.begin());
    const auto ring_end = fan.ring.begin() + fan.size;
    if (std::find(fan.ring.begin(), ring_end, place) != ring_end) return false;
    const auto gap = static_cast<std::size_t>(std::countr_zero(fan.gaps));
    const bool is_first = list[fan.ring[gap]] == old_end;
    // It is inserted between the gap's two ends. The sector on the side of the old end becomes a triangle.
    const std::size_t at = gap + 1;
    std::copy_backward(fan.ring.begin() + static_cast<std::ptrdiff_t>(at), ring_end, ring_end + 1);
    fan.ring[at] = place;
    ++fan.size;
    fan.gaps = std::uint64_t{1} << (is_first ? at : gap);
    return true;
}

class Straightening {
public:
    Straightening(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
                  std::vector<OpenPoint>& open)
        : points_(points), neighbors_(neighbors), open_(open) {}

    // Returns whether anything changed.
    bool round() {
        std::vector<double> bends(open_.size(), 0.0);
        for (std::size_t n = 0; n < open_.size(); ++n) bends[n] = bend_of(open_[n]);
        std::vector<std::size_t> farthest;  // No two of them are neighbors on the border.
        for (std::size_t n = 0; n < open_.size(); ++n) {
            if (bends[n] == 0.0) continue;
            const auto stands_less = [&](std::size_t other) {
                return bends[other] < bends[n] || (bends[other] == bends[n] && other > n);
            };
            const auto [a, b] = ends(open_[n]);
            if (stands_less(*place_of(a)) && stands_less(*place_of(b))) farthest.push_back(n);
        }
        for (const std::size_t n : farthest) {
            const auto [a, b] = ends(open_[n]);
            take_off(open_[n], open_[*place_of(a)], open_[*place_of(b)]);
        }
        return !farthest.empty();
    }

private:
    struct Ends {
        std::uint32_t first, last;
        bool has(std::uint32_t point) const { return first == point || last == point; }
        std::uint32_t other(std::uint32_t point) const { return first == point ? last : first; }
    };
    // The ends of the gap of a point with one gap.
    Ends ends(const OpenPoint& open) const {
        const auto gap = static_cast<std::size_t>(std::countr_zero(open.fan.gaps));
        const auto list = neighbors_.of(open.point);
        return {list[open.fan.ring[gap]], list[open.fan.ring[open.fan.next(gap)]]};
    }
    static bool is_simple(const OpenPoint& open) {
        return open.verdict == OpenPoint::Verdict::border && std::popcount(open.fan.gaps) == 1;
    }
    std::optional<std::size_t> place_of(std::uint32_t point) const {
        const auto found = std::ranges::lower_bound(open_, point, {}, &OpenPoint::point);
        if (found == open_.end() || found->point != point) return std::nullopt;
        return static_cast<std::size_t>(found - open_.begin());
    }

    // The bend through the point over that past it where it is above k_standing_back; else zero.
    double bend_of(const OpenPoint& open) {
        if (!is_simple(open)) return 0.0;
        const std::uint32_t e = open.point;
        const auto [a, b] = ends(open);
        const auto at_a = place_of(a), at_b = place_of(b);
        if (!at_a || !at_b || !is_simple(open_[*at_a]) || !is_simple(open_[*at_b])) return 0.0;
        const Ends of_a = ends(open_[*at_a]), of_b = ends(open_[*at_b]);
        if (!of_a.has(e) || !of_b.has(e) || of_a.has(b) || of_b.has(a)) return 0.0;
        // Only points behind the border, not before it.
        const auto gap = static_cast<std::size_t>(std::countr_zero(open.fan.gaps));
        around_.assign(points_, e, neighbors_.of(e));
        if (glm::dot(around_.cross(open.fan, gap), around_.normal(open.fan)) <= 0.0) return 0.0;
        const double bend =
            bend_through(points_, of_a.other(e), a, e, b, of_b.other(e), k_noise_bend);
        return bend > k_standing_back ? bend : 0.0;
    }

    void take_off(OpenPoint& open, OpenPoint& before, OpenPoint& after) const {
        Fan of_before = before.fan, of_after = after.fan;
        if (move_end(of_before, neighbors_.of(before.point), open.point, after.point) &&
            move_end(of_after, neighbors_.of(after.point), open.point, before.point)) {
            before.fan = of_before;
            after.fan = of_after;
        }
        open.fan.gaps = 0;
        open.verdict = OpenPoint::Verdict::none;
    }

    std::span<const glm::dvec3> points_;
    const NeighborLists& neighbors_;
    std::vector<OpenPoint>& open_;
    Neighborhood around_;
};

}  // namespace

double turn(std::span<const glm::dvec3> points, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    return angle_between(points[b] - points[a], points[c] - points[b]);
}

double bend_through(std::span<const glm::dvec3> points, std::optional<std::uint32_t> c,
                    std::uint32_t a, std::uint32_t e, std::uint32_t b,
                    std::optional<std::uint32_t> d, double min_bend) {
    const auto square = [](double angle) { return angle * angle; };
    double through = square(turn(points, a, e, b)), past = min_bend;
    if (c) past += square(turn(points, *c, a, b));
    if (d) past += square(turn(points, a, b, *d));
    if (c && *c != e) through += square(turn(points, *c, a, e));
    if (d && *d != e) through += square(turn(points, e, b, *d));
    return through / past;
}

void straighten_borders(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
                        std::vector<OpenPoint>& open) {
    Straightening straightening(points, neighbors, open);
    for (int round = 0; round < k_bend_rounds && straightening.round(); ++round) {
    }
}

}  // namespace rimline
