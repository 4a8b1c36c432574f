#pragma once

// The k-d tree over points in which the nearest are searched, nanoflann's.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <nanoflann.hpp>
#include <span>
#include <stop_token>
#include <utility>

#include "silhouette/error.h"

namespace rimline {

/// The interface through which nanoflann reads points in a search.
struct TreePoints {
    std::span<const glm::dvec3> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][static_cast<glm::length_t>(axis)];
    }
    template <typename Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

/// The interface through which nanoflann reads points, on one thread, while it builds a tree, which it offers
/// no way to stop: reading throws Error{cancelled}.
class TreeBuildPoints : public TreePoints {
public:
    TreeBuildPoints(std::span<const glm::dvec3> all, std::stop_token stop)
        : TreePoints{all}, stop_(std::move(stop)) {}
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        if (++reads_ % (1u << 16) == 0) LongCall{stop_, {}}.checkpoint(0.0);
        return TreePoints::kdtree_get_pt(i, axis);
    }

private:
    std::stop_token stop_;
    mutable std::uint32_t reads_ = 0;
};

using PointTree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, TreePoints, double, std::uint32_t>, TreeBuildPoints, 3,
    std::uint32_t>;

inline nanoflann::KDTreeSingleIndexAdaptorParams point_tree_leaves() {
    return nanoflann::KDTreeSingleIndexAdaptorParams(12);
}

/// The search radius, squared, that surely includes all points no farther than `square`. The tree skips
/// branches by sums of squares that are rounded differently from those of points: by some units in the last
/// place for each level.
inline double search_radius(double square) { return square * (1.0 + 0x1p-30); }

}  // namespace rimline
