#include "silhouette/points/border_chains.h"

#include <algorithm>
#include <bit>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>

#include "silhouette/mesh/disjoint_sets.h"
#include "silhouette/points/border_bend.h"
#include "silhouette/points/supplement.h"

namespace rimline {

namespace {

// Minimum points of a border. Gaps of the sampling form chains of a few points.
constexpr std::size_t k_min_chain_count = 5;
// Maximum share of a border's points that have fewer than two links. A chain that does not close has two such
// points, so it needs twenty points.
constexpr double k_max_loose_share = 0.1;
// From this number of points on a chain may be a border although noise has broken it: where at least
// k_min_wide_share of its points open by more than k_min_wide_opening_rad. (A straight border opens by 180
// degrees.)
constexpr std::size_t k_min_broken_chain_count = 12;
constexpr double k_min_wide_share = 0.8;
constexpr double k_min_wide_opening_rad = glm::radians(150.0);
// Maximum turn at each of two loose ends that are joined.
constexpr double k_max_joint_turn_rad = glm::radians(40.0);
// Maximum share of a border's points that have a supplement. A closed chain is more likely a border.
constexpr double k_max_crease_share = 0.35;
constexpr double k_max_closed_crease_share = 0.7;
// So many linked points with supplements are a crease, whatever chain they are in.
constexpr std::size_t k_min_crease_count = 12;

constexpr std::uint32_t k_no_place = 0xffffffffu;

// Two loose ends that may be one border.
struct Joint {
    double bend;             // The sum of the squares of both turns.
    std::uint32_t from, to;  // Places.
    auto operator<=>(const Joint&) const = default;
};

// What the triangles of a fan leave of a full turn, in radians: all its gaps together.
double opening_rad(const Neighborhood& around, const Fan& fan) {
    double rest = 2.0 * std::numbers::pi;
    for (std::size_t j = 0; j < fan.size; ++j)
        if (!fan.is_gap(j)) rest -= around.angle(fan, j);
    return rest;
}

class BorderChains {
public:
    explicit BorderChains(BorderGaps& gaps) : gaps_(gaps), input_(gaps.input()) {}

    void join_ends() {
        std::vector<Joint> joints;
        joined_.assign(gaps_.size(), k_no_place);
        for (std::uint32_t n = 0; n < gaps_.size(); ++n) {
            const std::optional<std::uint32_t> behind = only_link(n);
            if (!behind) continue;
            const std::uint32_t point = gaps_.at(n).point, before = gaps_.at(*behind).point;
            for (const std::uint32_t other : input_.neighbors.of(point)) {
                if (!gaps_.is_open(other) || other == before) continue;
                const std::uint32_t m = gaps_.place_of(other);
                const std::optional<std::uint32_t> beyond = only_link(m);
                if (!beyond) continue;
                const std::uint32_t after = gaps_.at(*beyond).point;
                if (after == point || after == before ||
                    !(has_in_star(point, other) || has_in_star(other, point)))
                    continue;
                const double first = turn(input_.points, before, point, other);
                const double second = turn(input_.points, point, other, after);
                if (std::max(first, second) <= k_max_joint_turn_rad)
                    joints.push_back(
                        {first * first + second * second, std::min(n, m), std::max(n, m)});
            }
        }
        std::sort(joints.begin(), joints.end());
        for (const Joint& joint : joints)
            if (joined_[joint.from] == k_no_place && joined_[joint.to] == k_no_place) {
                joined_[joint.from] = joint.to;
                joined_[joint.to] = joint.from;
            }
    }

    // Sets how wide each point opens, and its two umbrellas as a crease.
    void find_sides(const CallPart& part) {
        openings_rad_.resize(gaps_.size());
        sides_.resize(gaps_.size());
        each_point(gaps_.size(), part, [&](std::uint32_t first, std::uint32_t last) {
            Neighborhood around;
            for (std::uint32_t n = first; n < last; ++n) {
                const OpenPoint& open = gaps_.at(n);
                around.assign(input_.points, open.point, input_.neighbors.of(open.point));
                openings_rad_[n] = opening_rad(around, open.fan);
                if (std::popcount(open.fan.gaps) != 1) continue;
                const auto split =
                    split_fold(around, open.point, open.fan, input_.stars, input_.gap_ratio);
                sides_[n] =
                    split ? *split
                          : SplitFan{open.fan, find_supplement(around, open.point, open.fan,
                                                               input_.stars, input_.gap_ratio)};
            }
        });
    }

    void judge() {
        const std::vector<std::uint8_t> is_in_crease = long_creases();
        const std::vector<std::uint32_t> chain_of =
            connected([&](std::uint32_t n) { return is_in_crease[n] == 0; });
        std::vector<Chain> chains(gaps_.size());
        for (std::uint32_t n = 0; n < gaps_.size(); ++n) {
            if (is_in_crease[n] != 0) continue;
            Chain& chain = chains[chain_of[n]];
            ++chain.size;
            chain.loose += links(n).count < 2;
            chain.joined += joined_[n] != k_no_place;
            chain.supplemented += has_supplement(n);
            chain.wide += openings_rad_[n] > k_min_wide_opening_rad;
        }
        using Verdict = OpenPoint::Verdict;
        // All points of a smaller set may be one border.
        const std::size_t min_count = std::min(k_min_chain_count, input_.points.size());
        for (std::uint32_t n = 0; n < gaps_.size(); ++n) {
            OpenPoint& open = gaps_.at(n);
            if (is_in_crease[n] == 0 && chains[chain_of[n]].is_border(min_count)) {
                open.verdict = Verdict::border;
            } else if (has_supplement(n)) {
                open.verdict = Verdict::crease;
                open.fan = sides_[n].fan;
                open.supplement = sides_[n].supplement;
            } else {
                open.verdict = Verdict::none;
            }
        }
    }

private:
    struct Chain {
        std::size_t size = 0, loose = 0, joined = 0, supplemented = 0, wide = 0;

        bool is_border(std::size_t min_count) const {
            const auto count = static_cast<double>(size);
            const double max_supplemented_share =
                loose + joined == 0 ? k_max_closed_crease_share : k_max_crease_share;
            const bool may_be_broken = size >= k_min_broken_chain_count &&
                                       static_cast<double>(wide) >= k_min_wide_share * count;
            const bool is_whole = static_cast<double>(loose) <= k_max_loose_share * count;
            return size >= min_count && (is_whole || may_be_broken) &&
                   static_cast<double>(supplemented) <= max_supplemented_share * count;
        }
    };

    bool has_supplement(std::uint32_t n) const { return sides_[n].supplement.is_umbrella(); }

    // Of each open point, whether it lies in a run of k_min_crease_count points with supplements. The borders
    // that such a run separates may end there.
    std::vector<std::uint8_t> long_creases() const {
        const std::vector<std::uint32_t> runs =
            connected([&](std::uint32_t n) { return has_supplement(n); });
        std::vector<std::size_t> run_size(gaps_.size(), 0);
        for (std::uint32_t n = 0; n < gaps_.size(); ++n) run_size[runs[n]] += has_supplement(n);
        std::vector<std::uint8_t> is_in_crease(gaps_.size());
        for (std::uint32_t n = 0; n < gaps_.size(); ++n)
            is_in_crease[n] = has_supplement(n) && run_size[runs[n]] >= k_min_crease_count;
        return is_in_crease;
    }

    // Calls body(place) for each open point that is linked to the one at place n, and for the one it is
    // joined with.
    template <typename Body>
    void each_link(std::uint32_t n, Body&& body) const {
        for (const std::uint32_t to : gaps_.named_by(n))
            if (gaps_.names(to, gaps_.at(n).point)) body(gaps_.place_of(to));
        if (joined_[n] != k_no_place) body(joined_[n]);
    }
    struct Links {
        std::uint32_t first = k_no_place;
        int count = 0;  // 2 for more.
    };
    Links links(std::uint32_t n) const {
        Links links;
        each_link(n, [&](std::uint32_t to) {
            if (links.count == 0)
                links = {to, 1};
            else if (to != links.first)
                links.count = 2;
        });
        return links;
    }
    std::optional<std::uint32_t> only_link(std::uint32_t n) const {
        const Links all = links(n);
        return all.count == 1 ? std::optional(all.first) : std::nullopt;
    }
    bool has_in_star(std::uint32_t point, std::uint32_t other) const {
        const Fan& star = input_.stars.fans[point];
        const auto list = input_.neighbors.of(point);
        return std::any_of(star.ring.begin(), star.ring.begin() + star.size,
                           [&](std::uint8_t place) { return list[place] == other; });
    }
    // Of each open point the representative of all it is connected to by links, among those for which
    // is_member holds.
    template <typename IsMember>
    std::vector<std::uint32_t> connected(IsMember&& is_member) const {
        DisjointSets sets(gaps_.size());
        for (std::uint32_t n = 0; n < gaps_.size(); ++n) {
            if (!is_member(n)) continue;
            each_link(n, [&](std::uint32_t to) {
                if (is_member(to)) sets.join(n, to);
            });
        }
        return sets.take_numbers();
    }

    BorderGaps& gaps_;
    const BorderInput& input_;
    // All by place.
    std::vector<std::uint32_t> joined_;  // The loose end that it is joined with, or k_no_place.
    std::vector<double> openings_rad_;
    std::vector<SplitFan> sides_;  // Of those with one gap: the two umbrellas of a crease.
};

}  // namespace

void judge_chains(BorderGaps& gaps, const CallPart& part) {
    BorderChains chains(gaps);
    chains.join_ends();
    chains.find_sides(part);
    chains.judge();
}

}  // namespace rimline
