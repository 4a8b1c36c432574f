#include "silhouette/points/thesis_consistency.h"

#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/points/thesis_fan.h"

namespace rimline {

namespace {

constexpr std::uint64_t bit(std::size_t i) { return std::uint64_t{1} << i; }
bool has(std::uint64_t set, std::size_t i) { return (set >> i & 1u) != 0; }

// Whether an umbrella folds onto itself, so that its ring has no order around a normal.
bool folds(const Neighborhood& around, const Fan& fan) {
    return around.normal(fan) == glm::dvec3(0.0);
}

// The ring of the umbrella with more neighbors in it. Sectors of π and more are gaps: they have no triangle.
Fan with_places(const Neighborhood& around, const Fan& fan, std::uint64_t more) {
    const std::uint64_t all = ring_places(fan) | more;
    std::array<std::uint8_t, k_max_neighbors> places;
    std::size_t count = 0;
    for (std::uint32_t place = 0; place < around.size(); ++place)
        if (has(all, place)) places[count++] = static_cast<std::uint8_t>(place);
    return ordered_fan(around, std::span(places).first(count), around.normal(fan),
                       std::numbers::pi);
}

// The sectors of the ring from one place to another.
std::uint64_t sectors_between(const Fan& ring, std::uint8_t from, std::uint8_t to) {
    std::size_t j = 0;
    while (ring.ring[j] != from) ++j;
    std::uint64_t sectors = 0;
    for (; ring.ring[j] != to; j = ring.next(j)) sectors |= bit(j);
    return sectors;
}

// Sectors that follow each other, as the place for a gap.
struct Arc {
    std::size_t from = 0, to = 0;  // Indices in the ring.
    int reciprocal = 0, all = 0;   // The neighbors that a gap there removes.
    double width = 0.0;
    bool is_in_gap = false;

    bool is_better_than(const Arc& other) const {
        if (reciprocal != other.reciprocal) return reciprocal < other.reciprocal;
        if (all != other.all) return all < other.all;
        return width > other.width + k_tie;
    }
};

// The best place for one gap in a ring.
class GapChoice {
public:
    // Sectors `in_gap` were gaps. Only neighbors `of_fan` count as removed.
    GapChoice(const Neighborhood& around, const Fan& ring, std::uint64_t in_gap,
              std::uint64_t of_fan, std::uint64_t reciprocal)
        : around_(around), ring_(ring), in_gap_(in_gap), of_fan_(of_fan), reciprocal_(reciprocal) {}

    Arc arc(std::size_t from, std::size_t to) const {
        Arc arc{from, to};
        std::size_t j = from;
        do {
            const std::size_t next = ring_.next(j);
            arc.width += angle_between(around_.edge(ring_.ring[j]), around_.edge(ring_.ring[next]));
            arc.is_in_gap |= has(in_gap_, j);
            j = next;
            if (j == to || !has(of_fan_, ring_.ring[j])) continue;
            ++arc.all;
            arc.reciprocal += has(reciprocal_, ring_.ring[j]);
        } while (j != to);
        return arc;
    }
    // Calls body(arc) for each from one of the places to the next of them.
    template <typename Body>
    void between(std::uint64_t places, Body&& body) const {
        for (std::size_t j = 0; j < ring_.size; ++j) {
            if (!has(places, ring_.ring[j])) continue;
            std::size_t next = ring_.next(j);
            while (!has(places, ring_.ring[next])) next = ring_.next(next);
            body(arc(j, next));
        }
    }
    void offer(const Arc& arc) {
        if (!has_best_ || arc.is_better_than(best_)) best_ = arc;
        has_best_ = true;
    }
    // The ring with the best place for its gap.
    std::optional<Fan> opened() const {
        if (!has_best_) return std::nullopt;
        Fan fan = ring_;
        std::size_t j = best_.from;
        do {
            fan.open(j);
            j = fan.next(j);
        } while (j != best_.to);
        merge_gaps(fan);
        return fan.is_umbrella() ? std::optional(fan) : std::nullopt;
    }

private:
    const Neighborhood& around_;
    const Fan& ring_;
    std::uint64_t in_gap_, of_fan_, reciprocal_;
    Arc best_;
    bool has_best_ = false;
};

std::optional<Fan> opened(const Neighborhood& around, const Fan& whole,
                          const NeighborClaims& claims) {
    if (std::popcount(claims.opening) < 2 || folds(around, whole)) return std::nullopt;
    Fan ring = with_places(around, whole, claims.opening);
    ring.gaps = 0;
    GapChoice choice(around, ring, 0, ring_places(ring), claims.reciprocal);
    choice.between(claims.opening, [&](const Arc& arc) {
        if (arc.all > 0) choice.offer(arc);  // Else the sector is a triangle of the umbrella.
    });
    return choice.opened();
}

// An umbrella with an open boundary edge that is not returned.
class Correction {
public:
    Correction(const Neighborhood& around, const Fan& fan, std::uint64_t shared,
               std::uint64_t incoming, std::uint64_t reciprocal)
        : around_(around), fan_(fan), reciprocal_(reciprocal) {
        const std::uint64_t kept = shared | incoming;
        std::uint64_t staying_ends = 0;
        for (std::size_t j = 0; j < fan.size; ++j) {
            if (!fan.is_gap(j)) continue;
            const std::uint64_t ends = bit(fan.ring[j]) | bit(fan.ring[fan.next(j)]);
            if ((ends & ~kept) == 0) {
                staying_ends |= ends;
            } else {
                moving_ |= bit(j);
                old_ends_ |= ends;
            }
        }
        shared_ = shared & ~staying_ends;
        incoming_ = incoming & ~staying_ends;
        ring_ = with_places(around, fan, incoming_ | reciprocal_in_gaps());
        for (std::size_t j = 0; j < fan.size; ++j) {
            if (!fan.is_gap(j)) continue;
            const std::uint64_t sectors =
                sectors_between(ring_, fan.ring[j], fan.ring[fan.next(j)]);
            if (has(moving_, j))
                in_gaps_ |= sectors;
            else
                ring_.gaps |= sectors;
        }
    }

    std::optional<Fan> fan() const {
        if (incoming_ == 0) return filled();
        return std::popcount(shared_ | incoming_) == 1 ? contained() : moved();
    }

private:
    std::uint64_t reciprocal_in_gaps() const {
        const Fan full = with_places(around_, fan_, incoming_ | reciprocal_);
        std::uint64_t within = 0;
        for (std::size_t j = 0; j < fan_.size; ++j) {
            if (!has(moving_, j)) continue;
            const std::uint64_t sectors =
                sectors_between(full, fan_.ring[j], fan_.ring[fan_.next(j)]);
            for (std::size_t n = 0; n < full.size; ++n)
                if (has(sectors, n)) within |= bit(full.ring[n]);
        }
        return within & reciprocal_;
    }
    GapChoice choice() const { return {around_, ring_, in_gaps_, ring_places(fan_), reciprocal_}; }

    std::optional<Fan> moved() const {
        GapChoice choice = this->choice();
        choice.between(shared_ | incoming_, [&](const Arc& arc) {
            const bool is_at_shared =
                has(shared_, ring_.ring[arc.from]) || has(shared_, ring_.ring[arc.to]);
            if (arc.is_in_gap && (shared_ == 0 || is_at_shared)) choice.offer(arc);
        });
        return choice.opened();
    }

    std::optional<Fan> contained() const {
        if ((old_ends_ & incoming_) != 0) return std::nullopt;
        GapChoice choice = this->choice();
        std::size_t at = 0;
        while (!has(incoming_, ring_.ring[at])) ++at;
        for (std::size_t j = 0; j < ring_.size; ++j) {
            if (!has(old_ends_, ring_.ring[j])) continue;
            for (const Arc& arc : {choice.arc(j, at), choice.arc(at, j)})
                if (arc.is_in_gap) choice.offer(arc);
        }
        return choice.opened();
    }

    std::optional<Fan> filled() const {
        if (ring_.size == fan_.size) return std::nullopt;
        Fan fan = ring_;
        for (std::size_t j = 0; j < fan.size; ++j)
            if (has(in_gaps_, j) &&
                (has(shared_, fan.ring[j]) || has(shared_, fan.ring[fan.next(j)])))
                fan.open(j);
        merge_gaps(fan);
        return fan.is_umbrella() ? std::optional(fan) : std::nullopt;
    }

    const Neighborhood& around_;
    const Fan& fan_;
    std::uint64_t reciprocal_, incoming_ = 0;
    std::uint64_t shared_ = 0;    // Ends of moving gaps.
    std::uint64_t moving_ = 0;    // Sectors of the umbrella: gaps that do not stay.
    std::uint64_t old_ends_ = 0;  // Their ends.
    Fan ring_;                    // With incoming edges, and reciprocal ones in moving gaps.
    std::uint64_t in_gaps_ = 0;   // Sectors of the ring: within moving gaps.
};

// The neighbors that each umbrella may have.
std::array<std::uint64_t, PointFans::k_max_fans> divided(const Neighborhood& around,
                                                         const PointFans& fans) {
    std::array<std::uint64_t, PointFans::k_max_fans> own{};
    std::array<glm::dvec3, PointFans::k_max_fans> normals;
    std::uint64_t in_rings = 0;
    for (std::size_t f = 0; f < fans.count; ++f) {
        own[f] = ring_places(fans.fans[f]) | open_ends(fans);
        in_rings |= ring_places(fans.fans[f]);
        normals[f] = around.normal(fans.fans[f]);
    }
    for (std::uint32_t place = 0; place < around.size(); ++place) {
        if (has(in_rings, place)) continue;
        const auto height = [&](std::size_t f) {
            return std::abs(glm::dot(normals[f], around.edge(place)));
        };
        std::size_t nearest = 0;
        for (std::size_t f = 1; f < fans.count; ++f)
            if (height(f) < height(nearest)) nearest = f;
        own[nearest] |= bit(place);
    }
    return own;
}

// Drops umbrellas that got whole, or keeps one of them alone.
void settle_whole(PointFans& fans) {
    for (std::size_t f = 0; f < fans.count; ++f) {
        if (fans.fans[f].gaps != 0) continue;
        const Fan whole = fans.fans[f];
        PointFans others;
        for (std::size_t g = 0; g < fans.count; ++g)
            if (g != f) others.fans[others.count++] = fans.fans[g];
        if (!is_smallest(whole, others.all())) {
            fans.set(whole);
            return;
        }
        fans = others;
        --f;
    }
}

}  // namespace

void NeighborClaims::add(std::size_t place, const PointFans& of_neighbor, std::size_t at) noexcept {
    for (const Fan& fan : of_neighbor.all()) {
        if (has(ring_places(fan), at)) reciprocal |= bit(place);
        if (!has(gap_ends(fan), at)) continue;
        incoming |= bit(place);
        if (open_ends(of_neighbor) != 0) opening |= bit(place);
    }
}

std::optional<PointFans> made_consistent(const Neighborhood& around, const PointFans& fans,
                                         const NeighborClaims& claims) {
    if (fans.count == 0) return std::nullopt;
    PointFans result = fans;
    if (fans.is_whole()) {
        const auto fan = opened(around, fans.fans[0], claims);
        if (!fan) return std::nullopt;
        result.set(*fan);
        return result;
    }
    if ((open_ends(fans) & ~claims.incoming) == 0) return std::nullopt;
    const auto own = divided(around, fans);
    bool is_changed = false;
    for (std::size_t f = 0; f < fans.count; ++f) {
        const std::uint64_t open = open_ends(result);
        const std::uint64_t ends = gap_ends(fans.fans[f]), shared = ends & ~open;
        if ((ends & open & ~claims.incoming) == 0 || folds(around, fans.fans[f])) continue;
        const auto fan = Correction(around, fans.fans[f], shared,
                                    claims.incoming & own[f] & ~shared, claims.reciprocal & own[f])
                             .fan();
        if (!fan) continue;
        result.fans[f] = *fan;
        is_changed = true;
    }
    if (!is_changed) return std::nullopt;
    settle_whole(result);
    return result;
}

}  // namespace rimline
