#pragma once

// One point's neighbors relative to it, and what umbrellas are made from: planes through the point, and
// stars.
//
// A star is the point's one-ring in the Delaunay triangulation of its neighbors, unrolled into a plane: each
// neighbor keeps its distance and takes the direction of its projection. Under the inversion x -> x / |x|²,
// circles through the point become lines, and empty circles become the edges of the convex hull of the
// images. So the star is that hull. It is found in one pass around the point. An edge at distance h from the
// origin is a circle of radius 1 / (2 h). Where the origin lies outside the hull, a sector spans more than π.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "silhouette/points/fan.h"

namespace rimline {

/// Angles and turns that differ by less count as equal, so that rounding does not decide on lattices.
inline constexpr double k_tie = 1e-9;

class Neighborhood {
public:
    /// Sets the point and its neighbors: `list` is NeighborLists::of(point). Refers to `points` and `list`:
    /// both must outlive it.
    void assign(std::span<const glm::dvec3> points, std::uint32_t point,
                std::span<const std::uint32_t> list);

    std::uint32_t size() const noexcept { return size_; }
    std::uint32_t number(std::size_t place) const noexcept { return list_[place]; }
    const glm::dvec3& edge(std::size_t place) const noexcept { return edges_[place]; }
    double length(std::size_t place) const noexcept { return lengths_[place]; }

    /// Whether all edges lie on one line.
    bool is_collinear() const noexcept;
    /// The normal of the least-squares plane of the point and its `count` nearest. Of length 1, or zero.
    glm::dvec3 fitted_normal(std::uint32_t count) const noexcept;
    /// The star about the plane with this normal, of the neighbors `among` the list (bit i: place i) whose
    /// edges make at most the given angle with the plane. Its gaps are the sectors of π and more.
    Fan star(const glm::dvec3& normal, double sine_of_angle,
             std::uint64_t among = ~std::uint64_t{0}) const noexcept;

    /// The triangle of the point, the j-th point of the ring and the next.
    struct Triangle {
        glm::dvec3 normal;    ///< Of length 1, or zero where the area is zero.
        double circumradius;  ///< Infinite where the area is zero.
        /// Its circumradius, or its longest edge where that is shorter (from an angle of 150 degrees on). It
        /// measures how far apart the surface's points lie. The circumradius of a thin triangle between
        /// points in a row would not.
        double size;
        double sine, cosine;  ///< Of the angle at the point, times the lengths of both edges.
        double angle;         ///< In radians.

        /// The angle between its normal and `from`, which has length 1, in radians.
        double deviation(const glm::dvec3& from) const noexcept;
    };
    /// Without its angle, which costs as much as the rest.
    Triangle triangle(const Fan& fan, std::size_t j) const noexcept;
    /// The triangles of a fan; entries of gaps are not set.
    using Triangles = std::array<Triangle, k_max_neighbors>;
    void triangles(const Fan& fan, Triangles& result) const noexcept;
    static void set_angles(const Fan& fan, Triangles& triangles) noexcept;
    /// The mean of the triangles' normals, weighted by their angles. Of length 1, or zero.
    static glm::dvec3 normal(const Fan& fan, const Triangles& triangles) noexcept;
    /// Lower median of the triangles' sizes. 0 where there is none.
    static double scale(const Fan& fan, const Triangles& triangles) noexcept;

    // Of one triangle, or of all at once.
    glm::dvec3 cross(const Fan& fan, std::size_t j) const noexcept;
    double circumradius(const Fan& fan, std::size_t j) const noexcept;
    double angle(const Fan& fan, std::size_t j) const noexcept;
    double deviation(const Fan& fan, std::size_t j, const glm::dvec3& normal) const noexcept;
    glm::dvec3 normal(const Fan& fan) const noexcept;
    double scale(const Fan& fan) const noexcept;

private:
    std::span<const std::uint32_t> list_;
    std::uint32_t size_ = 0;
    std::array<glm::dvec3, k_max_neighbors> edges_;
    std::array<double, k_max_neighbors> lengths_;
};

}  // namespace rimline
