#include "silhouette/points/border_tracing.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/points/border_bend.h"
#include "silhouette/points/each_point.h"
#include "silhouette/points/supplement.h"

namespace rimline {

namespace {

constexpr double k_weak_excess = 2.0;
constexpr double k_obtuse = glm::radians(150.0);
constexpr double k_min_apart = glm::radians(70.0);
constexpr double k_ear = glm::radians(130.0);
constexpr double k_max_bend = 5.5;
constexpr int k_max_rounds = 6;
constexpr std::size_t k_min_points = 5;
constexpr double k_loose_share = 0.1;
// Of a chain that noise may have broken.
constexpr std::size_t k_min_broken = 12;
constexpr double k_straight = glm::radians(150.0);
constexpr double k_straight_share = 0.8;
constexpr double k_joint_turn = glm::radians(40.0);
// Of a chain's points with a supplement: a crease above. A closed chain is more likely a border.
constexpr double k_crease_share = 0.35;
constexpr double k_closed_crease_share = 0.7;
constexpr std::size_t k_crease_run = 12;
constexpr std::uint32_t k_closed = std::numeric_limits<std::uint32_t>::max();

// The points where an open point's gaps end; those of its first four gaps.
struct Ends {
    std::array<std::uint32_t, 8> points;
    std::uint32_t count = 0;
    bool has(std::uint32_t point) const {
        return std::find(points.begin(), points.begin() + count, point) != points.begin() + count;
    }
};

struct Link {
    std::uint32_t to, from;
    auto operator<=>(const Link&) const = default;
};

// Two loose ends that may be one border.
struct Joint {
    double bend;             // The sum of the squares of both turns.
    std::uint32_t from, to;  // Places in open_.
    auto operator<=>(const Joint&) const = default;
};

// A closed point whose sector lies on a link of open ones.
struct Ear {
    std::uint32_t point, sector;
    std::uint32_t from, to;
    auto operator<=>(const Ear&) const = default;
};

class Tracing {
public:
    Tracing(std::span<const glm::dvec3> points, const NeighborLists& neighbors, const Stars& stars,
            double gap_ratio)
        : points_(points), neighbors_(neighbors), stars_(stars), gap_ratio_(gap_ratio) {}

    void find_gaps(const CallPart& part) {
        const auto count = static_cast<std::uint32_t>(points_.size());
        std::vector<std::uint64_t> gaps(count, 0);
        each_point(count, part, [&](std::uint32_t first, std::uint32_t last) {
            Neighborhood around;
            for (std::uint32_t i = first; i < last; ++i) {
                if (stars_.reasons[i] != UndecidedReason::none || stars_.is_clean[i]) continue;
                const Fan& star = stars_.fans[i];
                around.look_from(points_, i, neighbors_.of(i));
                for (std::size_t j = 0; j < star.size; ++j)
                    if (stars_.excess(around, i, star, j) > gap_ratio_)
                        gaps[i] |= std::uint64_t{1} << j;
            }
        });
        slot_.assign(count, k_closed);
        for (std::uint32_t i = 0; i < count; ++i) {
            if (gaps[i] == 0) continue;
            Fan fan = stars_.fans[i];
            fan.gaps = gaps[i];
            merge_gaps(fan);
            if (fan.is_umbrella()) set_open(i, fan);
        }
    }

    // Whether anything changed.
    bool round() {
        std::vector<Link> named;
        std::vector<Ear> ears;
        for (std::size_t n = 0; n < open_.size(); ++n)
            for (std::uint32_t e = 0; e < ends_[n].count; ++e) {
                const std::uint32_t from = open_[n].point, to = ends_[n].points[e];
                if (!(is_open(to) && ends_[slot_[to]].has(from))) named.push_back({to, from});
                if (is_open(to)) add_ears(from, to, ears);
            }
        std::sort(named.begin(), named.end());
        named.erase(std::unique(named.begin(), named.end()), named.end());
        std::sort(ears.begin(), ears.end());

        std::vector<std::pair<std::uint32_t, Fan>> changes;
        Neighborhood around;
        std::vector<std::uint32_t> cut;
        for (std::size_t begin = 0, end = 0; begin < ears.size(); begin = end) {
            const std::uint32_t point = ears[begin].point;
            while (end < ears.size() && ears[end].point == point) ++end;
            around.look_from(points_, point, neighbors_.of(point));
            if (const auto fan = cut_ear(around, std::span(ears).subspan(begin, end - begin))) {
                changes.emplace_back(point, *fan);
                cut.push_back(point);
            }
        }
        for (std::size_t begin = 0, end = 0; begin < named.size(); begin = end) {
            const std::uint32_t point = named[begin].to;
            while (end < named.size() && named[end].to == point) ++end;
            if (stars_.reasons[point] != UndecidedReason::none ||
                std::binary_search(cut.begin(), cut.end(), point))
                continue;
            around.look_from(points_, point, neighbors_.of(point));
            if (const auto fan = heed(point, around, std::span(named).subspan(begin, end - begin)))
                changes.emplace_back(point, *fan);
        }
        for (const auto& [point, fan] : changes) set_open(point, fan);
        return !changes.empty();
    }

    // Loose ends in whose stars the other is, and that run on in each other: the straightest pairs are linked.
    void join_ends() {
        std::vector<Joint> joints;
        joint_.assign(open_.size(), k_closed);
        for (std::uint32_t n = 0; n < open_.size(); ++n) {
            const std::optional<std::uint32_t> behind = only_link(n);
            if (!behind) continue;
            const std::uint32_t point = open_[n].point, before = open_[*behind].point;
            for (const std::uint32_t other : neighbors_.of(point)) {
                if (!is_open(other) || other == before) continue;
                const std::optional<std::uint32_t> beyond = only_link(slot_[other]);
                if (!beyond) continue;
                const std::uint32_t after = open_[*beyond].point;
                if (after == point || after == before ||
                    !(has_in_star(point, other) || has_in_star(other, point)))
                    continue;
                const double first = turn(points_, before, point, other);
                const double second = turn(points_, point, other, after);
                if (std::max(first, second) <= k_joint_turn)
                    joints.push_back({first * first + second * second, std::min(n, slot_[other]),
                                      std::max(n, slot_[other])});
            }
        }
        std::sort(joints.begin(), joints.end());
        for (const Joint& joint : joints)
            if (joint_[joint.from] == k_closed && joint_[joint.to] == k_closed) {
                joint_[joint.from] = joint.to;
                joint_[joint.to] = joint.from;
            }
    }

    // How wide each point opens, and what lies across its gap.
    void look_across(const CallPart& part) {
        openings_.resize(open_.size());
        sides_.resize(open_.size());
        each_point(
            static_cast<std::uint32_t>(open_.size()), part,
            [&](std::uint32_t first, std::uint32_t last) {
                Neighborhood around;
                for (std::uint32_t n = first; n < last; ++n) {
                    const OpenPoint& open = open_[n];
                    around.look_from(points_, open.point, neighbors_.of(open.point));
                    openings_[n] = opening(around, open.fan);
                    if (std::popcount(open.fan.gaps) != 1) continue;
                    const auto split = split_fold(around, open.point, open.fan, stars_, gap_ratio_);
                    sides_[n] =
                        split ? *split
                              : SplitFan{open.fan, find_supplement(around, open.point, open.fan,
                                                                   stars_, gap_ratio_)};
                }
            });
    }

    void judge_chains() {
        using Verdict = OpenPoint::Verdict;
        // Long runs of supplemented points are creases wherever they lie; what they part may end there.
        const auto is_crease = [&](std::uint32_t n) { return sides_[n].supplement.is_umbrella(); };
        const std::vector<std::uint32_t> runs = connected(is_crease);
        std::vector<std::size_t> run_size(open_.size(), 0);
        for (std::uint32_t n = 0; n < open_.size(); ++n) run_size[runs[n]] += is_crease(n);
        const auto is_in_run = [&](std::uint32_t n) {
            return is_crease(n) && run_size[runs[n]] >= k_crease_run;
        };

        const std::vector<std::uint32_t> chain_of =
            connected([&](std::uint32_t n) { return !is_in_run(n); });
        struct Chain {
            std::size_t size = 0, loose = 0, joined = 0, supplemented = 0, straight = 0;
        };
        std::vector<Chain> chains(open_.size());
        for (std::uint32_t n = 0; n < open_.size(); ++n) {
            if (is_in_run(n)) continue;
            Chain& chain = chains[chain_of[n]];
            ++chain.size;
            chain.loose += links(n).count < 2;
            chain.joined += joint_[n] != k_closed;
            chain.supplemented += is_crease(n);
            chain.straight += openings_[n] > k_straight;
        }
        const std::size_t least = std::min(k_min_points, points_.size());
        for (std::uint32_t n = 0; n < open_.size(); ++n) {
            const Chain& chain = chains[chain_of[n]];
            const auto size = static_cast<double>(chain.size);
            const double share =
                chain.loose + chain.joined == 0 ? k_closed_crease_share : k_crease_share;
            const bool may_be_broken =
                chain.size >= k_min_broken &&
                static_cast<double>(chain.straight) >= k_straight_share * size;
            const bool is_whole = static_cast<double>(chain.loose) <= k_loose_share * size;
            const bool is_border = !is_in_run(n) && chain.size >= least &&
                                   (is_whole || may_be_broken) &&
                                   static_cast<double>(chain.supplemented) <= share * size;
            open_[n].verdict = is_border      ? Verdict::border
                               : is_crease(n) ? Verdict::crease
                                              : Verdict::none;
            if (open_[n].verdict == Verdict::crease) {
                open_[n].fan = sides_[n].fan;
                open_[n].supplement = sides_[n].supplement;
            }
        }
    }

    std::vector<OpenPoint> take() {
        std::sort(open_.begin(), open_.end(),
                  [](const OpenPoint& a, const OpenPoint& b) { return a.point < b.point; });
        return std::move(open_);
    }

private:
    // Of all its gaps together, in radians: what its triangles leave of a full turn.
    static double opening(const Neighborhood& around, const Fan& fan) {
        double rest = 2.0 * std::numbers::pi;
        for (std::size_t j = 0; j < fan.size; ++j)
            if (!fan.is_gap(j)) rest -= around.angle(fan, j);
        return rest;
    }

    bool is_open(std::uint32_t point) const { return slot_[point] != k_closed; }

    void set_open(std::uint32_t point, const Fan& fan) {
        if (!is_open(point)) {
            slot_[point] = static_cast<std::uint32_t>(open_.size());
            open_.push_back({point, fan, {}});
            ends_.emplace_back();
        }
        open_[slot_[point]].fan = fan;
        Ends& ends = ends_[slot_[point]];
        ends.count = 0;
        const auto list = neighbors_.of(point);
        for (std::size_t j = 0; j < fan.size && ends.count < ends.points.size(); ++j)
            if (fan.is_gap(j)) {
                ends.points[ends.count++] = list[fan.ring[j]];
                ends.points[ends.count++] = list[fan.ring[fan.next(j)]];
            }
    }

    // Calls body(place in open_) for each open point that names it and that it names, and where it is joined.
    template <typename Body>
    void each_link(std::uint32_t n, Body&& body) const {
        for (std::uint32_t e = 0; e < ends_[n].count; ++e) {
            const std::uint32_t to = ends_[n].points[e];
            if (is_open(to) && ends_[slot_[to]].has(open_[n].point)) body(slot_[to]);
        }
        if (joint_[n] != k_closed) body(joint_[n]);
    }
    struct Links {
        std::uint32_t first = k_closed;
        int count = 0;  // 2 for more.
    };
    Links links(std::uint32_t n) const {
        Links found;
        each_link(n, [&](std::uint32_t to) {
            if (found.count == 0)
                found = {to, 1};
            else if (to != found.first)
                found.count = 2;
        });
        return found;
    }
    std::optional<std::uint32_t> only_link(std::uint32_t n) const {
        const Links found = links(n);
        return found.count == 1 ? std::optional(found.first) : std::nullopt;
    }
    bool has_in_star(std::uint32_t point, std::uint32_t other) const {
        const Fan& star = stars_.fans[point];
        const auto list = neighbors_.of(point);
        return std::any_of(star.ring.begin(), star.ring.begin() + star.size,
                           [&](std::uint8_t place) { return list[place] == other; });
    }
    // For each open point one that stands for all it is linked to, among those for which it is_member.
    template <typename IsMember>
    std::vector<std::uint32_t> connected(IsMember&& is_member) const {
        std::vector<std::uint32_t> up(open_.size());
        std::iota(up.begin(), up.end(), 0u);
        const auto root = [&](std::uint32_t n) {
            while (up[n] != n) n = up[n] = up[up[n]];
            return n;
        };
        for (std::uint32_t n = 0; n < open_.size(); ++n) {
            if (!is_member(n)) continue;
            each_link(n, [&](std::uint32_t to) {
                if (is_member(to)) up[root(n)] = root(to);
            });
        }
        for (std::uint32_t n = 0; n < open_.size(); ++n) up[n] = root(n);
        return up;
    }

    void add_ears(std::uint32_t a, std::uint32_t b, std::vector<Ear>& ears) const {
        for (const std::uint32_t point : neighbors_.of(a)) {
            if (is_open(point) || stars_.reasons[point] != UndecidedReason::none) continue;
            const Fan& star = stars_.fans[point];
            const auto list = neighbors_.of(point);
            for (std::size_t j = 0; j < star.size; ++j) {
                const std::uint32_t x = list[star.ring[j]], y = list[star.ring[star.next(j)]];
                if ((x == a && y == b) || (x == b && y == a))
                    ears.push_back({point, static_cast<std::uint32_t>(j), a, b});
            }
        }
    }

    std::optional<Fan> cut_ear(const Neighborhood& around, std::span<const Ear> ears) const {
        const Fan& star = stars_.fans[ears[0].point];
        std::optional<std::size_t> best;
        double least = k_max_bend;
        for (const Ear& ear : ears) {
            Fan rest = star;
            rest.open(ear.sector);
            const double deviation = around.deviation(star, ear.sector, around.normal(rest));
            if (around.angle(star, ear.sector) * (1.0 + 2.0 / std::numbers::pi * deviation) <=
                k_ear)
                continue;
            const double bend = bend_through(points_, beyond(ear.from, ear.to), ear.from, ear.point,
                                             ear.to, beyond(ear.to, ear.from));
            if (bend < least) {
                least = bend;
                best = ear.sector;
            }
        }
        if (!best) return std::nullopt;
        Fan fan = star;
        fan.open(*best);
        merge_gaps(fan);
        return fan.is_umbrella() ? std::optional(fan) : std::nullopt;
    }

    // The other end of the open point's gap that ends at `end`.
    std::optional<std::uint32_t> beyond(std::uint32_t point, std::uint32_t end) const {
        const Ends& ends = ends_[slot_[point]];
        for (std::uint32_t e = 0; e < ends.count; ++e)
            if (ends.points[e] == end) return ends.points[e ^ 1u];
        return std::nullopt;
    }

    static std::optional<std::size_t> place_in(const Fan& fan, const Neighborhood& around,
                                               std::uint32_t point) {
        for (std::size_t j = 0; j < fan.size; ++j)
            if (around.number(fan.ring[j]) == point) return j;
        return std::nullopt;
    }

    // What becomes of a point that open points name which it does not name back.
    std::optional<Fan> heed(std::uint32_t point, const Neighborhood& around,
                            std::span<const Link> named) const {
        if (!is_open(point))
            if (const auto fan = open_between(point, around, named)) return fan;
        Fan fan = is_open(point) ? open_[slot_[point]].fan : stars_.fans[point];
        bool is_changed = false;
        for (const Link& link : named) {
            const auto at = place_in(fan, around, link.from);
            if (!at) continue;
            const std::size_t after = *at, before = fan.previous(*at);
            if (is_open(point) && !fan.is_gap(after) && !fan.is_gap(before)) {
                // One triangle short, and the end that it loses is next to the one who names it.
                const Ends& ends = ends_[slot_[link.from]];
                const std::size_t next = fan.next(after);
                if (fan.is_gap(next) && ends.has(around.number(fan.ring[next]))) {
                    fan.open(after);
                    is_changed = true;
                    continue;
                }
                if (fan.is_gap(fan.previous(before)) && ends.has(around.number(fan.ring[before]))) {
                    fan.open(before);
                    is_changed = true;
                    continue;
                }
            }
            // Opens the one that has more of it, if that is more than `least`.
            const auto open_greater = [&](double least, auto&& measure) {
                const double of_after = fan.is_gap(after) ? 0.0 : measure(after);
                const double of_before = fan.is_gap(before) ? 0.0 : measure(before);
                if (std::max(of_after, of_before) <= least) return false;
                fan.open(of_after > of_before ? after : before);
                return true;
            };
            const auto excess = [&](std::size_t j) { return stars_.excess(around, point, fan, j); };
            const auto angle = [&](std::size_t j) { return around.angle(fan, j); };
            is_changed |= open_greater(k_weak_excess, excess) || open_greater(k_obtuse, angle);
        }
        merge_gaps(fan);
        if (!is_changed || !fan.is_umbrella()) return std::nullopt;
        return fan;
    }

    // Between those two of its ring that name it from farthest apart, on the side of the greater excess.
    std::optional<Fan> open_between(std::uint32_t point, const Neighborhood& around,
                                    std::span<const Link> named) const {
        const Fan& star = stars_.fans[point];
        std::size_t first = 0, last = 0;
        double farthest = k_min_apart;
        for (std::size_t x = 0; x < named.size(); ++x)
            for (std::size_t y = x + 1; y < named.size(); ++y) {
                const auto a = place_in(star, around, named[x].from);
                const auto b = place_in(star, around, named[y].from);
                if (!a || !b) continue;
                const double apart =
                    angle_between(around.edge(star.ring[*a]), around.edge(star.ring[*b]));
                if (apart > farthest) {
                    farthest = apart;
                    first = *a;
                    last = *b;
                }
            }
        if (first == last) return std::nullopt;
        const auto greatest_excess = [&](std::size_t from, std::size_t to) {
            double greatest = 0.0;
            for (std::size_t j = from; j != to; j = star.next(j))
                greatest = std::max(greatest, stars_.excess(around, point, star, j));
            return greatest;
        };
        if (greatest_excess(first, last) < greatest_excess(last, first)) std::swap(first, last);
        Fan fan = star;
        for (std::size_t j = first; j != last; j = star.next(j)) fan.open(j);
        merge_gaps(fan);
        return fan.is_umbrella() ? std::optional(fan) : std::nullopt;
    }

    std::span<const glm::dvec3> points_;
    const NeighborLists& neighbors_;
    const Stars& stars_;
    double gap_ratio_;
    std::vector<std::uint32_t> slot_;  // In open_, or k_closed.
    std::vector<OpenPoint> open_;
    std::vector<Ends> ends_;  // Of each.
    // Of each, the place of the loose end that it is joined with, or k_closed.
    std::vector<std::uint32_t> joint_;
    std::vector<double> openings_;
    std::vector<SplitFan> sides_;  // Of each with one gap: what it would be as a crease.
};

}  // namespace

std::vector<OpenPoint> trace_borders(std::span<const glm::dvec3> points,
                                     const NeighborLists& neighbors, const Stars& stars,
                                     double gap_ratio, const LongCall& call) {
    Tracing tracing(points, neighbors, stars, gap_ratio);
    tracing.find_gaps({call, 0.0, 0.5});
    for (int round = 0; round < k_max_rounds && tracing.round(); ++round)
        call.checkpoint(0.5 + 0.3 * (round + 1) / k_max_rounds);
    tracing.join_ends();
    tracing.look_across({call, 0.8, 1.0});
    tracing.judge_chains();
    std::vector<OpenPoint> open = tracing.take();
    straighten_borders(points, neighbors, open);
    return open;
}

}  // namespace rimline
