#include "silhouette/points/thesis_umbrellas.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "silhouette/points/each_point.h"
#include "silhouette/points/thesis_fan.h"

namespace rimline {

namespace {

constexpr std::size_t k_max_fans = 4;

struct PointFans {
    std::array<Fan, k_max_fans> fans;
    std::uint8_t count = 0;

    bool is_whole() const { return count == 1 && fans[0].gaps == 0; }
    void set(const Fan& fan) {
        fans[0] = fan;
        count = 1;
    }
};

// Bit i: place i.
std::uint64_t ring_places(const Fan& fan) {
    std::uint64_t places = 0;
    for (std::size_t j = 0; j < fan.size; ++j) places |= std::uint64_t{1} << fan.ring[j];
    return places;
}
std::uint64_t gap_ends(const Fan& fan) {
    std::uint64_t places = 0;
    for (std::size_t j = 0; j < fan.size; ++j)
        if (fan.is_gap(j))
            places |= std::uint64_t{1} << fan.ring[j] | std::uint64_t{1} << fan.ring[fan.next(j)];
    return places;
}
// The ends on the boundaries of an odd number of umbrellas: the surface ends there.
std::uint64_t open_ends(const PointFans& fans) {
    std::uint64_t places = 0;
    for (std::size_t f = 0; f < fans.count; ++f) places ^= gap_ends(fans.fans[f]);
    return places;
}

class Passes {
public:
    Passes(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
           const PointSurfaceOptions& options)
        : points_(points),
          neighbors_(neighbors),
          options_(options),
          k_(neighbors.nearest_count()),
          count_(static_cast<std::uint32_t>(points.size())),
          gabriel_(count_),
          fans_(count_),
          reasons_(count_, UndecidedReason::none) {}

    void first(const CallPart& part) {
        const double end_of_fans = part.begin + 0.9 * (part.end - part.begin);
        each({part.call, part.begin, end_of_fans}, [&](std::uint32_t i, Neighborhood& around) {
            if (!neighbors_.is_mutual(i)) {
                reasons_[i] = k_ == 0 ? UndecidedReason::alone : UndecidedReason::isolated;
                return;
            }
            gabriel_[i] = gabriel_triangle(around, k_, options_.omega);
            if (gabriel_[i].normal == glm::dvec3(0.0))
                reasons_[i] = UndecidedReason::collinear;
            else if (gabriel_[i].is_trusted)
                if (const auto fan = make(i, around, gabriel_[i].normal, all_places()))
                    fans_[i].set(*fan);
        });
        normals_.assign(count_, glm::dvec3(0.0));
        each({part.call, end_of_fans, part.end}, [&](std::uint32_t i, Neighborhood& around) {
            if (fans_[i].is_whole()) normals_[i] = around.normal(fans_[i].fans[0]);
        });
    }

    void second(const CallPart& part) {
        std::vector<PointFans> result = fans_;
        each(part, [&](std::uint32_t i, Neighborhood& around) {
            if (reasons_[i] == UndecidedReason::none && !fans_[i].is_whole())
                result[i] = supplemented(i, around);
        });
        fans_.swap(result);
    }

    void third(const CallPart& part) {
        std::vector<PointFans> result = fans_;
        each(part, [&](std::uint32_t i, Neighborhood& around) {
            if (reasons_[i] == UndecidedReason::none)
                if (const auto fan = made_consistent(i, around)) result[i].set(*fan);
        });
        fans_.swap(result);
    }

    UmbrellaSet found() {
        UmbrellaSet found;
        found.fans.resize(count_);
        found.normals.assign(count_, glm::dvec3(0.0));
        found.scales.assign(count_, 0.0);
        found.labels.assign(count_, PointLabel::undecided);
        Neighborhood around;
        for (std::uint32_t i = 0; i < count_; ++i) {
            PointFans& fans = fans_[i];
            around.assign(points_, i, neighbors_.of(i));
            // An umbrella that folds onto itself has no normal.
            const auto end = std::remove_if(
                fans.fans.begin(), fans.fans.begin() + fans.count,
                [&](const Fan& fan) { return around.normal(fan) == glm::dvec3(0.0); });
            fans.count = static_cast<std::uint8_t>(end - fans.fans.begin());
            if (reasons_[i] == UndecidedReason::none && fans.count == 0)
                reasons_[i] = UndecidedReason::no_normal;
            if (reasons_[i] != UndecidedReason::none) continue;
            found.labels[i] = fans.is_whole()        ? PointLabel::interior
                              : open_ends(fans) == 0 ? PointLabel::feature
                                                     : PointLabel::border;
            found.fans[i] = fans.fans[0];
            found.normals[i] = around.normal(fans.fans[0]);
            found.scales[i] = around.scale(fans.fans[0]);
            for (std::size_t f = 1; f < fans.count; ++f) {
                turn_like(fans.fans[0], fans.fans[f]);
                found.supplements.push_back({i, fans.fans[f], around.normal(fans.fans[f])});
            }
        }
        found.reasons = std::move(reasons_);
        return found;
    }

private:
    template <typename Body>
    void each(const CallPart& part, Body&& body) {
        each_point(count_, part, [&](std::uint32_t first, std::uint32_t last) {
            Neighborhood around;
            for (std::uint32_t i = first; i < last; ++i) {
                around.assign(points_, i, neighbors_.of(i));
                body(i, around);
            }
        });
    }
    std::uint64_t all_places() const { return (std::uint64_t{1} << k_) - 1; }

    // An umbrella of those places in `among` that are admissible about the normal.
    std::optional<Fan> make(std::uint32_t i, const Neighborhood& around, const glm::dvec3& normal,
                            std::uint64_t among) const {
        std::array<std::uint8_t, k_max_neighbors> places;
        std::size_t count = 0;
        for (std::uint32_t place = 0; place < k_; ++place)
            if ((among >> place & 1u) != 0 &&
                is_admissible(around, place, normal, gabriel_[i].radius, options_))
                places[count++] = static_cast<std::uint8_t>(place);
        if (count < 2) return std::nullopt;
        const Fan fan = thesis_fan(around, std::span(places).first(count), normal,
                                   gabriel_[i].radius, options_);
        return fan.is_umbrella() ? std::optional(fan) : std::nullopt;
    }

    PointFans supplemented(std::uint32_t i, const Neighborhood& around) const {
        PointFans fans = fans_[i];
        for (std::uint32_t place = 0; place < k_ && fans.count < k_max_fans; ++place) {
            if (fans.count > 0 && open_ends(fans) == 0) break;
            const glm::dvec3& normal = normals_[around.number(place)];
            if (normal == glm::dvec3(0.0)) continue;
            const std::uint64_t free_places = free_of(i, around, fans);
            if ((free_places >> place & 1u) == 0) continue;
            const auto fan = make(i, around, normal, free_places);
            if (!fan) continue;
            if (fan->gaps != 0) {
                fans.fans[fans.count++] = *fan;
                continue;
            }
            const bool is_smallest =
                fans.count > 0 &&
                std::all_of(fans.fans.begin(), fans.fans.begin() + fans.count,
                            [&](const Fan& other) { return other.size > fan->size; });
            if (is_smallest) continue;
            fans.set(*fan);
            break;
        }
        return fans;
    }

    // Places that a further umbrella may take.
    std::uint64_t free_of(std::uint32_t i, const Neighborhood& around,
                          const PointFans& fans) const {
        std::uint64_t taken = 0, once = 0, twice = 0;
        for (std::size_t f = 0; f < fans.count; ++f) {
            const Fan& fan = fans.fans[f];
            const std::uint64_t ends = gap_ends(fan);
            const glm::dvec3 normal = around.normal(fan);
            std::uint64_t admitted = ring_places(fan);
            for (std::uint32_t place = 0; place < k_; ++place)
                if (is_admissible(around, place, normal, gabriel_[i].radius, options_))
                    admitted |= std::uint64_t{1} << place;
            taken |= admitted & ~ends;
            twice |= once & ends;
            once |= ends;
        }
        return all_places() & ~taken & ~twice;
    }

    // Whether `of` has the point in the ring of an umbrella; with `at_gaps`, at the end of a gap.
    bool has(std::uint32_t of, std::uint32_t point, bool at_gaps) const {
        const auto list = neighbors_.of(of);
        for (std::size_t f = 0; f < fans_[of].count; ++f) {
            const Fan& fan = fans_[of].fans[f];
            for (std::size_t j = 0; j < fan.size; ++j)
                if (list[fan.ring[j]] == point &&
                    (!at_gaps || fan.is_gap(j) || fan.is_gap(fan.previous(j))))
                    return true;
        }
        return false;
    }

    std::optional<Fan> made_consistent(std::uint32_t i, const Neighborhood& around) const {
        const PointFans& fans = fans_[i];
        if (fans.count != 1) return std::nullopt;  // Partial umbrellas that meet, or none.
        const Fan& fan = fans.fans[0];
        std::uint64_t incoming = 0, reciprocal = 0;
        for (std::uint32_t place = 0; place < around.size(); ++place) {
            if (has(around.number(place), i, false)) reciprocal |= std::uint64_t{1} << place;
            if (has(around.number(place), i, true)) incoming |= std::uint64_t{1} << place;
        }
        if (fan.gaps == 0)
            return std::popcount(incoming) >= 2 ? opened(around, fan, incoming, reciprocal)
                                                : std::nullopt;
        const std::uint64_t ends = gap_ends(fan);
        if ((ends & ~incoming) == 0) return std::nullopt;
        return std::popcount(incoming) >= 2 ? opened(around, fan, incoming, reciprocal)
                                            : filled(around, fan, reciprocal);
    }

    Fan with_places(const Neighborhood& around, const Fan& fan, std::uint64_t more,
                    double phi) const {
        const std::uint64_t all = ring_places(fan) | more;
        std::array<std::uint8_t, k_max_neighbors> places;
        std::size_t count = 0;
        for (std::uint32_t place = 0; place < around.size(); ++place)
            if ((all >> place & 1u) != 0) places[count++] = static_cast<std::uint8_t>(place);
        return ordered_fan(around, std::span(places).first(count), around.normal(fan), phi);
    }

    // Opens a gap from one incoming boundary edge to the next: where the fewest ring points between have the
    // point in their umbrellas. The place of the old gap comes first.
    std::optional<Fan> opened(const Neighborhood& around, const Fan& fan, std::uint64_t incoming,
                              std::uint64_t reciprocal) const {
        Fan ring = with_places(around, fan, incoming, options_.phi);
        ring.gaps = 0;
        const std::uint64_t old_ends = gap_ends(fan);
        const auto is_incoming = [&](std::size_t j) {
            return (incoming >> ring.ring[j] & 1u) != 0;
        };
        std::optional<std::size_t> best;
        int min_cost = 0;
        for (std::size_t j = 0; j < ring.size; ++j) {
            if (!is_incoming(j)) continue;
            int cost = 0;
            std::size_t n = ring.next(j);
            int old = (old_ends >> ring.ring[j] & 1u) != 0;
            for (; !is_incoming(n); n = ring.next(n)) {
                cost += (reciprocal >> ring.ring[n] & 1u) != 0;
                old += (old_ends >> ring.ring[n] & 1u) != 0;
            }
            old += (old_ends >> ring.ring[n] & 1u) != 0;
            // Without ring points between, the sector is a triangle, unless the gap was there.
            if (ring.next(j) == n && old < 2) continue;
            cost -= old >= 2 ? k_max_neighbors : 0;
            if (best && cost >= min_cost) continue;
            best = j;
            min_cost = cost;
        }
        if (!best) return std::nullopt;
        std::size_t j = *best;
        do {
            ring.open(j);
            j = ring.next(j);
        } while (!is_incoming(j));
        merge_gaps(ring);
        return ring.is_umbrella() ? std::optional(ring) : std::nullopt;
    }

    // Fills the gap with neighbors that have the point in their umbrellas.
    std::optional<Fan> filled(const Neighborhood& around, const Fan& fan,
                              std::uint64_t reciprocal) const {
        const Fan full = with_places(around, fan, reciprocal, std::numbers::pi);
        // Only neighbors within the gaps join the ring.
        std::uint64_t within = 0;
        for (std::size_t j = 0; j < fan.size; ++j) {
            if (!fan.is_gap(j)) continue;
            std::size_t at = 0;
            while (full.ring[at] != fan.ring[j]) ++at;
            for (at = full.next(at); full.ring[at] != fan.ring[fan.next(j)]; at = full.next(at))
                within |= std::uint64_t{1} << full.ring[at];
        }
        if (within == 0) return std::nullopt;
        const Fan ring = with_places(around, fan, within, std::numbers::pi);
        return ring.is_umbrella() ? std::optional(ring) : std::nullopt;
    }

    // Reverses the second fan where a gap of it begins where one of the first begins: both then have one
    // sense.
    static void turn_like(const Fan& first, Fan& second) {
        for (std::size_t j = 0; j < first.size; ++j)
            for (std::size_t n = 0; n < second.size; ++n)
                if (first.is_gap(j) && second.is_gap(n) && first.ring[j] == second.ring[n]) {
                    reverse(second);
                    return;
                }
    }

    std::span<const glm::dvec3> points_;
    const NeighborLists& neighbors_;
    const PointSurfaceOptions& options_;
    std::uint32_t k_, count_;
    std::vector<GabrielTriangle> gabriel_;
    std::vector<PointFans> fans_;
    std::vector<glm::dvec3> normals_;  // Of points with one whole umbrella after pass 1; else zero.
    std::vector<UndecidedReason> reasons_;
};

}  // namespace

UmbrellaSet find_thesis_umbrellas(std::span<const glm::dvec3> points,
                                  const NeighborLists& neighbors,
                                  const PointSurfaceOptions& options, const LongCall& call) {
    Passes passes(points, neighbors, options);
    passes.first({call, 0.0, 0.4});
    passes.second({call, 0.4, 0.7});
    passes.third({call, 0.7, 1.0});
    return passes.found();
}

}  // namespace rimline
