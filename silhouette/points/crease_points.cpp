#include "silhouette/points/crease_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <numbers>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/points/each_point.h"
#include "silhouette/points/neighborhood.h"

namespace rimline {

namespace {

constexpr double k_min_turn = std::numbers::pi / 6.0;
// Of Sectors::spread, as a share of the turn. Below the second two sectors explain a star.
constexpr double k_max_spread = 0.25;
constexpr double k_good_spread = 0.15;
// How far the normals of the points inside a sector deviate from its own, as a share of the turn: 0 at a crease, 1/2
// where the surface turns evenly.
constexpr double k_max_turning_on = 0.3;
// 12 degrees, between a triangle and the star. Stars that bend less are not looked at.
constexpr double k_cosine_of_bent = 0.978;
constexpr std::size_t k_max_sectors = 3;
constexpr int k_rounds = 3;

// A closed ring in sectors: sector i from ring[begin[i]] to ring[end(i)]. The first is the widest.
struct Sectors {
    std::size_t count = 0;
    std::array<std::uint8_t, k_max_sectors> begin;
    std::array<glm::dvec3, k_max_sectors> normals;
    double turn = 0.0;  // The minimum between two that meet.
    double spread =
        0.0;  // The root mean square of how far a triangle deviates from its sector's normal.

    std::size_t end(std::size_t i) const { return begin[i + 1 == count ? 0 : i + 1]; }
};

// Divides a closed star into sectors with minimum spread. Let a and n be the angles and normals of a sector's
// triangles. The sum of a (1 - cos) of the angles between n and the mean normal is sum(a) - |sum(a n)|. So the lengths
// of these sums are to be as great as possible.
class Divider {
public:
    Divider(const Fan& fan, const Neighborhood::Triangles& triangles) : size_(fan.size) {
        sums_[0] = glm::dvec3(0.0);
        angles_[0] = 0.0;
        for (std::size_t j = 0; j < size_; ++j) {
            sums_[j + 1] = sums_[j] + triangles[j].angle * triangles[j].normal;
            angles_[j + 1] = angles_[j] + triangles[j].angle;
        }
    }

    Sectors in_two() const {
        std::array<std::size_t, 2> best{};
        double longest = 0.0;
        for (std::size_t i = 0; i < size_; ++i)
            for (std::size_t k = i + 1; k < size_; ++k) {
                const double length = glm::length(sum(i, k)) + glm::length(sum(k, i));
                if (length <= longest) continue;
                longest = length;
                best = {i, k};
            }
        return sectors(best, longest);
    }
    Sectors in_three() const {
        std::array<std::size_t, 3> best{};
        double longest = 0.0;
        for (std::size_t i = 0; i < size_; ++i)
            for (std::size_t k = i + 1; k < size_; ++k)
                for (std::size_t l = k + 1; l < size_; ++l) {
                    const double length =
                        glm::length(sum(i, k)) + glm::length(sum(k, l)) + glm::length(sum(l, i));
                    if (length <= longest) continue;
                    longest = length;
                    best = {i, k, l};
                }
        return sectors(best, longest);
    }

private:
    glm::dvec3 sum(std::size_t from, std::size_t to) const {
        return to > from ? sums_[to] - sums_[from] : sums_[size_] - sums_[from] + sums_[to];
    }
    double angle(std::size_t from, std::size_t to) const {
        return to > from ? angles_[to] - angles_[from]
                         : angles_[size_] - angles_[from] + angles_[to];
    }
    Sectors sectors(std::span<const std::size_t> begin, double length) const {
        const std::size_t count = begin.size();
        const auto end = [&](std::size_t i) { return begin[(i + 1) % count]; };
        std::size_t widest = 0;
        for (std::size_t i = 1; i < count; ++i)
            if (angle(begin[i], end(i)) > angle(begin[widest], end(widest))) widest = i;
        Sectors result;
        for (std::size_t n = 0; n < count; ++n) {
            const std::size_t i = (widest + n) % count;
            const glm::dvec3 total = sum(begin[i], end(i));
            if (!(glm::length(total) > 0.0)) return {};
            result.begin[n] = static_cast<std::uint8_t>(begin[i]);
            result.normals[n] = glm::normalize(total);
        }
        result.count = count;
        result.turn = std::numbers::pi;
        for (std::size_t n = 0; n < count; ++n)
            result.turn = std::min(
                result.turn, angle_between(result.normals[n], result.normals[(n + 1) % count]));
        const double all = angles_[size_];
        result.spread = std::sqrt(std::max(2.0 * (all - length) / all, 0.0));
        return result;
    }

    std::size_t size_;
    std::array<glm::dvec3, k_max_neighbors + 1> sums_;
    std::array<double, k_max_neighbors + 1> angles_;
};

bool is_divided(const Sectors& sectors) {
    return sectors.turn >= k_min_turn && sectors.spread <= k_max_spread * sectors.turn;
}

// Nothing where the star has no crease: no sectors.
Sectors divide(const Neighborhood& around, const Fan& fan, const glm::dvec3& normal) {
    Neighborhood::Triangles triangles;
    around.triangles(fan, triangles);
    bool is_bent = false;
    for (std::size_t j = 0; j < fan.size; ++j) {
        if (triangles[j].normal == glm::dvec3(0.0)) return {};
        is_bent |= glm::dot(triangles[j].normal, normal) < k_cosine_of_bent;
    }
    if (!is_bent || fan.size < 3) return {};
    Neighborhood::set_angles(fan, triangles);
    const Divider divider(fan, triangles);
    Sectors two = divider.in_two();
    if (is_divided(two) && two.spread <= k_good_spread * two.turn) return two;
    const Sectors three = divider.in_three();
    if (is_divided(three)) return three;
    return is_divided(two) ? two : Sectors{};
}

class Creases {
public:
    Creases(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
            const UmbrellaSet& found)
        : points_(points),
          neighbors_(neighbors),
          found_(found),
          is_crease_(points.size(), 0),
          candidate_of_(points.size(), k_none) {}

    void find_candidates(const CallPart& part) {
        std::mutex mutex;
        each_point(size(), part, [&](std::uint32_t first, std::uint32_t last) {
            Neighborhood around;
            std::vector<Candidate> here;
            for (std::uint32_t p = first; p < last; ++p) {
                if (found_.labels[p] != PointLabel::interior || found_.fans[p].gaps != 0) continue;
                around.assign(points_, p, neighbors_.of(p));
                const Sectors sectors = divide(around, found_.fans[p], found_.normals[p]);
                if (sectors.count > 0) here.push_back({p, sectors});
            }
            if (here.empty()) return;
            const std::scoped_lock lock(mutex);
            candidates_.insert(candidates_.end(), here.begin(), here.end());
        });
        std::ranges::sort(candidates_, {}, &Candidate::point);
        for (std::uint32_t c = 0; c < candidates_.size(); ++c)
            candidate_of_[candidates_[c].point] = c;
    }

    bool accept() {
        bool changes = false;
        std::vector<std::uint8_t> next = is_crease_;
        for (const Candidate& c : candidates_)
            if (!is_crease_[c.point] && is_flat_beside(c)) {
                next[c.point] = 1;
                changes = true;
            }
        is_crease_ = std::move(next);
        return changes;
    }

    // Points of creases of which no end is one.
    bool prune() {
        bool changes = false;
        for (const Candidate& c : candidates_) {
            if (!is_crease_[c.point]) continue;
            bool goes_on = false;
            for (std::size_t i = 0; i < c.sectors.count; ++i) {
                const std::uint32_t q = end(c, i);
                goes_on |= is_crease_[q] || found_.labels[q] == PointLabel::feature;
            }
            if (!goes_on) {
                is_crease_[c.point] = 0;
                changes = true;
            }
        }
        return changes;
    }

    template <typename Take>
    void take(Take&& take) const {
        for (const Candidate& c : candidates_)
            if (is_crease_[c.point]) take(c.point, c.sectors);
    }

private:
    struct Candidate {
        std::uint32_t point;
        Sectors sectors;
    };
    static constexpr std::uint32_t k_none = 0xffffffffu;

    std::uint32_t size() const { return static_cast<std::uint32_t>(points_.size()); }
    std::uint32_t ring_point(std::uint32_t p, std::size_t j) const {
        return neighbors_.of(p)[found_.fans[p].ring[j]];
    }
    std::uint32_t end(const Candidate& c, std::size_t i) const {
        return ring_point(c.point, c.sectors.begin[i]);
    }

    // The angle of the point's normal, or of that of its sectors that is nearest.
    double deviation(std::uint32_t q, const glm::dvec3& normal) const {
        double cosine = std::abs(glm::dot(found_.normals[q], normal));
        if (is_crease_[q]) {
            const Sectors& sectors = candidates_[candidate_of_[q]].sectors;
            cosine = 0.0;
            for (std::size_t i = 0; i < sectors.count; ++i)
                cosine = std::max(cosine, std::abs(glm::dot(sectors.normals[i], normal)));
        }
        return std::acos(std::min(cosine, 1.0));
    }

    // Whether the surface goes on beside the crease as the sectors say. A sector without points inside is that of a
    // crease if its ends are points of creases with this normal.
    bool is_flat_beside(const Candidate& c) const {
        const Fan& fan = found_.fans[c.point];
        for (std::size_t i = 0; i < c.sectors.count; ++i) {
            const std::size_t first = c.sectors.begin[i];
            const std::size_t last = c.sectors.end(i);
            const double limit = k_max_turning_on * c.sectors.turn;
            double sum = 0.0;
            int count = 0;
            for (std::size_t j = fan.next(first); j != last; j = fan.next(j)) {
                const std::uint32_t q = ring_point(c.point, j);
                if (found_.normals[q] == glm::dvec3(0.0)) continue;
                sum += deviation(q, c.sectors.normals[i]);
                ++count;
            }
            if (sum > limit * count) return false;
            if (count > 0) continue;
            for (const std::size_t j : {first, last}) {
                const std::uint32_t q = ring_point(c.point, j);
                if (!is_crease_[q] || deviation(q, c.sectors.normals[i]) > limit) return false;
            }
        }
        return true;
    }

    std::span<const glm::dvec3> points_;
    const NeighborLists& neighbors_;
    const UmbrellaSet& found_;
    std::vector<std::uint8_t> is_crease_;
    std::vector<std::uint32_t> candidate_of_;
    std::vector<Candidate> candidates_;
};

// The sector as a fan of its own, whose gap is the rest.
Fan sector_of(const Fan& fan, std::size_t first, std::size_t last) {
    Fan part;
    for (std::size_t j = first;; j = fan.next(j)) {
        part.ring[part.size++] = fan.ring[j];
        if (j == last) break;
    }
    part.open(part.size - 1u);
    return part;
}

}  // namespace

void split_at_creases(std::span<const glm::dvec3> points, const NeighborLists& neighbors,
                      UmbrellaSet& found, const LongCall& call) {
    Creases creases(points, neighbors, found);
    creases.find_candidates({call, 0.0, 0.8});
    for (int round = 0; round < k_rounds && creases.accept(); ++round) call.checkpoint(0.8);
    while (creases.prune()) call.checkpoint(0.9);
    creases.take([&](std::uint32_t p, const Sectors& sectors) {
        const Fan fan = found.fans[p];
        found.labels[p] = PointLabel::feature;
        for (std::size_t i = 0; i < sectors.count; ++i) {
            const Fan part = sector_of(fan, sectors.begin[i], sectors.end(i));
            if (i == 0) {
                found.fans[p] = part;
                found.normals[p] = sectors.normals[i];
            } else {
                found.supplements.push_back({p, part, sectors.normals[i]});
            }
        }
    });
    std::ranges::stable_sort(found.supplements, {}, &UmbrellaSet::Supplement::point);
    call.checkpoint(1.0);
}

}  // namespace rimline
