#include "silhouette/points/outliers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "silhouette/points/each_point.h"
#include "silhouette/points/point_tree.h"

namespace rimline {

namespace {

// Chosen on the wide and smooth models of docs/results/points.md with a hundredth and a twentieth of outliers. With 20
// points, and with half of a ring, more outliers stay; with 70% of a ring surfaces break. Beyond 4 scales a third fewer
// are found.
constexpr std::uint32_t k_min_largest = 50;
// Of strays, sets of 100 points and more agree by at most 2.6; surfaces by 3.5 and more, and by 2.9 with noise of half
// their spacing.
constexpr std::uint32_t k_min_surface = 100;
constexpr double k_min_agreement = 2.8;
// Of strays, smaller sets agree by up to 2.8; none of 20 was found to agree by 3.2. Islands are what is seen of a
// surface through a gap.
constexpr std::uint32_t k_min_island = 20;
constexpr double k_min_island_agreement = 3.4;
constexpr double k_min_naming = 0.6;
constexpr double k_max_scale_step = 2.0;
constexpr double k_max_scales_away = 2.75;
constexpr double k_max_share = 0.1;

// The points of rings, by number. An undecided point has a ring only where its border is not confirmed.
class Rings {
public:
    Rings(const NeighborLists& neighbors, const UmbrellaSet& umbrellas)
        : neighbors_(neighbors), umbrellas_(umbrellas) {}

    // Calls body(ring point) for each point of the rings of `point`, until it returns true. Returns whether it did.
    template <typename Body>
    bool find(std::uint32_t point, Body&& body) const {
        const std::span<const std::uint32_t> list = neighbors_.of(point);
        const auto find_in = [&](const Fan& fan) {
            return std::any_of(fan.ring.begin(), fan.ring.begin() + fan.size,
                               [&](std::uint8_t place) { return body(list[place]); });
        };
        if (find_in(umbrellas_.fans[point])) return true;
        const auto further = std::ranges::equal_range(umbrellas_.supplements, point, {},
                                                      &UmbrellaSet::Supplement::point);
        return std::ranges::any_of(
            further, [&](const UmbrellaSet::Supplement& s) { return find_in(s.fan); });
    }
    bool names(std::uint32_t point, std::uint32_t other) const {
        return find(point, [&](std::uint32_t named) { return named == other; });
    }
    // Calls body(ring point, whether it names the point) for each.
    template <typename Body>
    void each(std::uint32_t point, Body&& body) const {
        find(point, [&](std::uint32_t other) {
            body(other, names(other, point));
            return false;
        });
    }

private:
    const NeighborLists& neighbors_;
    const UmbrellaSet& umbrellas_;
};

// The connected sets of points: each has a root, which finds its set's size.
class Sets {
public:
    explicit Sets(std::uint32_t count) : parents_(count), sizes_(count, 1) {
        std::iota(parents_.begin(), parents_.end(), 0u);
    }
    std::uint32_t root(std::uint32_t point) {
        while (parents_[point] != point) point = parents_[point] = parents_[parents_[point]];
        return point;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        if (a == b) return;
        if (sizes_[a] < sizes_[b]) std::swap(a, b);
        parents_[b] = a;
        sizes_[a] += sizes_[b];
    }
    std::uint32_t size_of(std::uint32_t point) { return sizes_[root(point)]; }
    std::uint32_t largest_root() {
        return root(static_cast<std::uint32_t>(std::ranges::max_element(sizes_) - sizes_.begin()));
    }

private:
    std::vector<std::uint32_t> parents_;
    std::vector<std::uint32_t> sizes_;
};

// The nearest point; of points at equal distance the one with the greatest scale.
class Nearest {
public:
    using DistanceType = double;
    void sort() {}  // Nanoflann calls it from version 1.5 on.
    explicit Nearest(std::span<const double> scales) : scales_(scales) {}
    bool full() const { return true; }
    double worstDist() const { return search_radius(square_); }
    bool addPoint(double square, std::uint32_t number) {
        if (square < square_ || (square == square_ && scales_[number] > scale_)) {
            square_ = square;
            scale_ = scales_[number];
        }
        return true;
    }
    bool is_farther_than(double scales) const {
        return square_ > scales * scales * scale_ * scale_;
    }

private:
    std::span<const double> scales_;
    double square_ = std::numeric_limits<double>::max();
    double scale_ = 0.0;
};

// Whether more than k_min_naming of the ring of a point name it.
std::vector<std::uint8_t> named_points(const Rings& rings, std::uint32_t count,
                                       const LongCall& call) {
    std::vector<std::uint8_t> is_named(count, 0);
    each_point(count, {call}, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i) {
            std::uint32_t all = 0, naming = 0;
            rings.each(i, [&](std::uint32_t, bool is_returned) {
                ++all;
                naming += is_returned;
            });
            is_named[i] = naming > k_min_naming * all;
        }
    });
    return is_named;
}

// Of each root the agreement of its set (outliers.h).
std::vector<double> set_agreements(const Rings& rings, std::span<const glm::dvec3> normals,
                                   std::span<const std::uint8_t> is_named, Sets& sets) {
    std::vector<double> agreements(normals.size(), 0.0);
    for (std::uint32_t i = 0; i < normals.size(); ++i) {
        if (is_named[i] == 0) continue;
        const std::uint32_t root = sets.root(i);
        rings.each(i, [&](std::uint32_t other, bool is_returned) {
            if (is_returned && is_named[other] != 0 && sets.root(other) == root)
                agreements[root] += std::abs(glm::dot(normals[i], normals[other]));
        });
    }
    for (std::uint32_t i = 0; i < normals.size(); ++i)
        if (sets.root(i) == i) agreements[i] /= sets.size_of(i);
    return agreements;
}

bool is_surface(std::uint32_t size, double agreement) {
    return size >= k_min_surface ? agreement >= k_min_agreement
                                 : size >= k_min_island && agreement >= k_min_island_agreement;
}

std::vector<std::uint8_t> points_on_surfaces(const Rings& rings, const UmbrellaSet& umbrellas,
                                             const LongCall& call) {
    const std::span<const double> scales = umbrellas.scales;
    const auto count = static_cast<std::uint32_t>(scales.size());
    if (count == 0) return {};
    std::vector<std::uint8_t> is_named = named_points(rings, count, call.part(0.0, 0.4));
    Sets sets(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i % k_checkpoint_points == 0) call.checkpoint(0.4 + 0.2 * i / count);
        if (is_named[i] == 0) continue;
        rings.each(i, [&](std::uint32_t other, bool is_returned) {
            if (is_returned && is_named[other] != 0 &&
                scales[i] <= k_max_scale_step * scales[other] &&
                scales[other] <= k_max_scale_step * scales[i])
                sets.join(i, other);
        });
    }
    const std::vector<double> agreements = set_agreements(rings, umbrellas.normals, is_named, sets);
    call.checkpoint(0.7);
    const std::uint32_t largest = sets.largest_root();
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t root = sets.root(i), size = sets.size_of(i);
        is_named[i] =
            is_surface(size, agreements[root]) || (root == largest && size >= k_min_largest);
    }
    return is_named;
}

}  // namespace

std::vector<std::uint8_t> find_outliers(std::span<const glm::dvec3> points,
                                        const NeighborLists& neighbors,
                                        const UmbrellaSet& umbrellas, const LongCall& call) {
    const auto count = static_cast<std::uint32_t>(points.size());
    const std::vector<std::uint8_t> is_on_surface =
        points_on_surfaces(Rings(neighbors, umbrellas), umbrellas, call);
    std::vector<std::uint8_t> outliers(count, 0);
    std::vector<glm::dvec3> positions;
    std::vector<double> scales;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (is_on_surface[i] == 0) continue;
        positions.push_back(points[i]);
        scales.push_back(umbrellas.scales[i]);
    }
    if (positions.empty()) return outliers;
    const TreeBuildPoints source(positions, call.stop);
    const PointTree tree(3, source, point_tree_leaves());
    each_point(count, {call, 0.7, 1.0}, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i) {
            if (is_on_surface[i] != 0) continue;
            Nearest nearest(scales);
            tree.findNeighbors(nearest, &points[i].x, {});
            outliers[i] = nearest.is_farther_than(k_max_scales_away);
        }
    });
    const auto found = std::ranges::count(outliers, std::uint8_t{1});
    if (static_cast<double>(found) > k_max_share * count)
        std::ranges::fill(outliers, std::uint8_t{0});
    return outliers;
}

}  // namespace rimline
