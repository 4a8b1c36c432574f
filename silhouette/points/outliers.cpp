#include "silhouette/points/outliers.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "silhouette/points/each_point.h"
#include "silhouette/points/point_tree.h"

namespace rimline {

namespace {

// Chosen on the wide and smooth models of docs/results/points.md with a hundredth and a twentieth of outliers. With 20
// points, and with half of a ring, more outliers stay; with 70% of a ring surfaces break. Beyond 4 scales a third fewer
// are found.
constexpr std::uint32_t k_min_surface = 50;
constexpr double k_min_naming = 0.6;
constexpr double k_max_scale_step = 2.0;
constexpr double k_max_scales_away = 2.75;
constexpr double k_max_share = 0.1;

constexpr std::uint32_t k_batch = 1u << 16;  // Points between two checkpoints.

bool names(const PointSurface& surface, PointId point, PointId other) {
    const PointSurface::UmbrellaRange range = surface.umbrellas_of(point);
    for (std::uint32_t u = range.first; u < range.last; ++u) {
        const std::span<const PointId> ring = surface.umbrella(UmbrellaId{u}).ring;
        if (std::ranges::find(ring, other) != ring.end()) return true;
    }
    return false;
}

// Calls body(ring point, whether it names the point) for each point of the rings of `point`.
template <typename Body>
void each_of_rings(const PointSurface& surface, PointId point, Body&& body) {
    const PointSurface::UmbrellaRange range = surface.umbrellas_of(point);
    for (std::uint32_t u = range.first; u < range.last; ++u)
        for (const PointId other : surface.umbrella(UmbrellaId{u}).ring)
            body(other, names(surface, other, point));
}

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

private:
    std::vector<std::uint32_t> parents_;
    std::vector<std::uint32_t> sizes_;
};

// The nearest point; of points at equal distance the one with the greatest scale.
class Nearest {
public:
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

std::vector<std::uint8_t> points_on_surfaces(const PointSurface& surface, const LongCall& call) {
    std::vector<std::uint8_t> is_named(surface.size(), 0);
    each_point(surface.size(), {call, 0.0, 0.4}, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i) {
            std::uint32_t count = 0, naming = 0;
            each_of_rings(surface, PointId{i}, [&](PointId, bool is_returned) {
                ++count;
                naming += is_returned;
            });
            is_named[i] = naming > k_min_naming * count;
        }
    });
    Sets sets(surface.size());
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        if (i % k_batch == 0) call.checkpoint(0.4 + 0.3 * i / surface.size());
        if (is_named[i] == 0) continue;
        const double scale = surface.scale(PointId{i});
        each_of_rings(surface, PointId{i}, [&](PointId other, bool is_returned) {
            const double others = surface.scale(other);
            if (is_returned && is_named[index(other)] != 0 && scale <= k_max_scale_step * others &&
                others <= k_max_scale_step * scale)
                sets.join(i, index(other));
        });
    }
    for (std::uint32_t i = 0; i < surface.size(); ++i)
        is_named[i] = sets.size_of(i) >= k_min_surface;
    return is_named;
}

}  // namespace

std::vector<std::uint8_t> find_outliers(const PointSurface& surface, const LongCall& call) {
    const std::vector<std::uint8_t> is_on_surface = points_on_surfaces(surface, call);
    std::vector<std::uint8_t> outliers(surface.size(), 0);
    std::vector<glm::dvec3> positions;
    std::vector<double> scales;
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        if (is_on_surface[i] == 0) continue;
        positions.push_back(surface.positions()[i]);
        scales.push_back(surface.scale(PointId{i}));
    }
    if (positions.empty()) return outliers;
    const TreePoints source{positions};
    const PointTree tree(3, source, point_tree_leaves());
    each_point(surface.size(), {call, 0.7, 1.0}, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i) {
            if (is_on_surface[i] != 0) continue;
            Nearest nearest(scales);
            tree.findNeighbors(nearest, &surface.positions()[i].x, nanoflann::SearchParams());
            outliers[i] = nearest.is_farther_than(k_max_scales_away);
        }
    });
    const auto count = std::ranges::count(outliers, std::uint8_t{1});
    if (static_cast<double>(count) > k_max_share * surface.size())
        std::ranges::fill(outliers, std::uint8_t{0});
    return outliers;
}

}  // namespace rimline
