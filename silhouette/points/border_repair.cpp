#include "silhouette/points/border_repair.h"

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/points/border_bend.h"

namespace rimline {

namespace {

// From here on a sector opens beside a point that names its own. Less than gap_ratio, for the neighbor's gap
// is evidence too.
constexpr double k_min_named_excess = 2.0;
// The same for its angle: noise leaves such triangles on borders, of a common size (docs/results/points.md, Noise).
constexpr double k_min_named_angle_rad = glm::radians(150.0);
// Two points that name a closed one lie on both sides of it, and not side by side.
constexpr double k_min_apart_rad = glm::radians(70.0);
// An ear is obtuse. So are many triangles of other points: the bend decides too.
constexpr double k_min_ear_angle_rad = glm::radians(130.0);
// The bend through the ear's point over that past it. Two to four at a concave corner, ten and more where the
// point stands back from the border (border_bend.h).
constexpr double k_max_ear_bend_ratio = 5.5;

// An open point that names another, which does not name it back.
struct Naming {
    std::uint32_t to, from;
    auto operator<=>(const Naming&) const = default;
};

// A closed point with a triangle on the edge between two open points.
struct Ear {
    std::uint32_t point, sector;
    std::uint32_t from, to;
    auto operator<=>(const Ear&) const = default;
};

// Where a point stands in the ring.
std::optional<std::size_t> place_in_ring(const Fan& fan, const Neighborhood& around,
                                         std::uint32_t point) {
    for (std::size_t j = 0; j < fan.size; ++j)
        if (around.number(fan.ring[j]) == point) return j;
    return std::nullopt;
}

class GapRepair {
public:
    explicit GapRepair(const BorderGaps& gaps) : gaps_(gaps), input_(gaps.input()) {}

    std::vector<std::pair<std::uint32_t, Fan>> changes() {
        collect();
        std::vector<std::pair<std::uint32_t, Fan>> changes;
        Neighborhood around;
        std::vector<std::uint32_t> cut;
        for (std::size_t begin = 0, end = 0; begin < ears_.size(); begin = end) {
            const std::uint32_t point = ears_[begin].point;
            while (end < ears_.size() && ears_[end].point == point) ++end;
            around.assign(input_.points, point, input_.neighbors.of(point));
            if (const auto fan = cut_ear(around, std::span(ears_).subspan(begin, end - begin))) {
                changes.emplace_back(point, *fan);
                cut.push_back(point);
            }
        }
        for (std::size_t begin = 0, end = 0; begin < namings_.size(); begin = end) {
            const std::uint32_t point = namings_[begin].to;
            while (end < namings_.size() && namings_[end].to == point) ++end;
            if (input_.stars.reasons[point] != UndecidedReason::none ||
                std::binary_search(cut.begin(), cut.end(), point))
                continue;
            around.assign(input_.points, point, input_.neighbors.of(point));
            if (const auto fan =
                    answered(point, around, std::span(namings_).subspan(begin, end - begin)))
                changes.emplace_back(point, *fan);
        }
        return changes;
    }

private:
    void collect() {
        for (std::uint32_t n = 0; n < gaps_.size(); ++n)
            for (const std::uint32_t to : gaps_.named_by(n)) {
                const std::uint32_t from = gaps_.at(n).point;
                if (!gaps_.names(to, from)) namings_.push_back({to, from});
                if (gaps_.is_open(to)) add_ears(from, to);
            }
        std::sort(namings_.begin(), namings_.end());
        namings_.erase(std::unique(namings_.begin(), namings_.end()), namings_.end());
        std::sort(ears_.begin(), ears_.end());
    }

    void add_ears(std::uint32_t a, std::uint32_t b) {
        for (const std::uint32_t point : input_.neighbors.of(a)) {
            if (gaps_.is_open(point) || input_.stars.reasons[point] != UndecidedReason::none)
                continue;
            const Fan& star = input_.stars.fans[point];
            const auto list = input_.neighbors.of(point);
            for (std::size_t j = 0; j < star.size; ++j) {
                const std::uint32_t x = list[star.ring[j]], y = list[star.ring[star.next(j)]];
                if ((x == a && y == b) || (x == b && y == a))
                    ears_.push_back({point, static_cast<std::uint32_t>(j), a, b});
            }
        }
    }

    // The star without the ear through which the border bends least.
    std::optional<Fan> cut_ear(const Neighborhood& around, std::span<const Ear> ears) const {
        const Fan& star = input_.stars.fans[ears[0].point];
        std::optional<std::size_t> best;
        double min_bend = k_max_ear_bend_ratio;
        for (const Ear& ear : ears) {
            Fan rest = star;
            rest.open(ear.sector);
            const double deviation = around.deviation(star, ear.sector, around.normal(rest));
            if (around.angle(star, ear.sector) * (1.0 + 2.0 / std::numbers::pi * deviation) <=
                k_min_ear_angle_rad)
                continue;
            const double bend =
                bend_through(input_.points, gaps_.other_end(ear.from, ear.to), ear.from, ear.point,
                             ear.to, gaps_.other_end(ear.to, ear.from));
            if (bend < min_bend) {
                min_bend = bend;
                best = ear.sector;
            }
        }
        if (!best) return std::nullopt;
        Fan fan = star;
        fan.open(*best);
        merge_gaps(fan);
        return fan.is_umbrella() ? std::optional(fan) : std::nullopt;
    }

    // The new fan of a point, after it has answered the open points that name it.
    std::optional<Fan> answered(std::uint32_t point, const Neighborhood& around,
                                std::span<const Naming> namings) const {
        if (!gaps_.is_open(point))
            if (const auto fan = opened_between(point, around, namings)) return fan;
        Fan fan =
            gaps_.is_open(point) ? gaps_.at(gaps_.place_of(point)).fan : input_.stars.fans[point];
        bool is_changed = false;
        for (const Naming& naming : namings) {
            const auto at = place_in_ring(fan, around, naming.from);
            if (!at) continue;
            const std::size_t after = *at, before = fan.previous(*at);
            if (gaps_.is_open(point) && !fan.is_gap(after) && !fan.is_gap(before)) {
                // One triangle short, and the end that it loses is next to the point that names it.
                const std::size_t next = fan.next(after);
                if (fan.is_gap(next) && gaps_.names(naming.from, around.number(fan.ring[next]))) {
                    fan.open(after);
                    is_changed = true;
                    continue;
                }
                if (fan.is_gap(fan.previous(before)) &&
                    gaps_.names(naming.from, around.number(fan.ring[before]))) {
                    fan.open(before);
                    is_changed = true;
                    continue;
                }
            }
            // Opens the sector with the greater measure, if that is above `min`.
            const auto open_greater = [&](double min, auto&& measure) {
                const double of_after = fan.is_gap(after) ? 0.0 : measure(after);
                const double of_before = fan.is_gap(before) ? 0.0 : measure(before);
                if (std::max(of_after, of_before) <= min) return false;
                fan.open(of_after > of_before ? after : before);
                return true;
            };
            const auto excess = [&](std::size_t j) {
                return input_.stars.excess(around, point, fan, j);
            };
            const auto angle = [&](std::size_t j) { return around.angle(fan, j); };
            is_changed |= open_greater(k_min_named_excess, excess) ||
                          open_greater(k_min_named_angle_rad, angle);
        }
        merge_gaps(fan);
        if (!is_changed || !fan.is_umbrella()) return std::nullopt;
        return fan;
    }

    // Between those two points of its ring that name it from farthest apart, on the side of the greater
    // excess.
    std::optional<Fan> opened_between(std::uint32_t point, const Neighborhood& around,
                                      std::span<const Naming> namings) const {
        const Fan& star = input_.stars.fans[point];
        std::size_t first = 0, last = 0;
        double max_apart = k_min_apart_rad;
        for (std::size_t x = 0; x < namings.size(); ++x)
            for (std::size_t y = x + 1; y < namings.size(); ++y) {
                const auto a = place_in_ring(star, around, namings[x].from);
                const auto b = place_in_ring(star, around, namings[y].from);
                if (!a || !b) continue;
                const double apart =
                    angle_between(around.edge(star.ring[*a]), around.edge(star.ring[*b]));
                if (apart > max_apart) {
                    max_apart = apart;
                    first = *a;
                    last = *b;
                }
            }
        if (first == last) return std::nullopt;
        const auto max_excess = [&](std::size_t from, std::size_t to) {
            double max = 0.0;
            for (std::size_t j = from; j != to; j = star.next(j))
                max = std::max(max, input_.stars.excess(around, point, star, j));
            return max;
        };
        if (max_excess(first, last) < max_excess(last, first)) std::swap(first, last);
        Fan fan = star;
        for (std::size_t j = first; j != last; j = star.next(j)) fan.open(j);
        merge_gaps(fan);
        return fan.is_umbrella() ? std::optional(fan) : std::nullopt;
    }

    const BorderGaps& gaps_;
    const BorderInput& input_;
    std::vector<Naming> namings_;  // By the point that is named.
    std::vector<Ear> ears_;        // By point.
};

}  // namespace

bool repair_gaps(BorderGaps& gaps) {
    const auto changes = GapRepair(gaps).changes();
    for (const auto& [point, fan] : changes) gaps.open(point, fan);
    return !changes.empty();
}

}  // namespace rimline
