#pragma once

// One point's neighbors as seen from it, and what umbrellas are made from: planes through it, stars.
//
// A star is the point's one-ring in the Delaunay triangulation of its neighbors unrolled into a plane:
// each keeps its distance and takes the direction of its projection. By the inversion x -> x / |x|²,
// circles through the point become lines, and empty ones the edges of the convex hull of the images: the
// star is that hull, found in one turn around the point. An edge at distance h from the origin is a
// circle of radius 1 / (2 h); where the hull leaves the origin outside, the sector spans more than π.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "silhouette/points/fan.h"

namespace rimline {

/// Of angles and turns: what is nearer counts as equal, so that lattices fall one way.
inline constexpr double k_tie = 1e-9;

class Neighborhood {
public:
    /// Both must outlive it. list: NeighborLists::of(point).
    void assign(std::span<const glm::dvec3> points, std::uint32_t point,
                std::span<const std::uint32_t> list);

    std::uint32_t size() const noexcept { return size_; }
    std::uint32_t number(std::size_t place) const noexcept { return list_[place]; }
    const glm::dvec3& edge(std::size_t place) const noexcept { return edges_[place]; }
    double length(std::size_t place) const noexcept { return lengths_[place]; }

    /// All edges lie on one line.
    bool is_collinear() const noexcept;
    /// Of the plane that fits the point and its `count` nearest best. Of length 1, or zero.
    glm::dvec3 fitted_normal(std::uint32_t count) const noexcept;
    /// The star of those neighbors `among` the list (bit i: place i) whose edges make at most the angle with
    /// the plane; gaps are the sectors of π and more.
    Fan star(const glm::dvec3& normal, double sine_of_angle,
             std::uint64_t among = ~std::uint64_t{0}) const noexcept;

    /// With the ring's j-th point and the next.
    struct Triangle {
        glm::dvec3 normal;    ///< Of length 1, or zero where it has no area.
        double circumradius;  ///< Infinite where it has no area.
        /// Its circumradius, but at most its longest edge (so from an angle of 150 degrees on): how far apart
        /// the surface's points lie, of which a thin triangle between points in a row says nothing.
        double size;
        double sine, cosine;  ///< Of its angle at the point, times the lengths of both edges.
        double angle;         ///< In radians.

        /// Of its normal with another, of length 1, in radians.
        double deviation(const glm::dvec3& from) const noexcept;
    };
    /// All but its angle, which costs as much as the rest.
    Triangle triangle(const Fan& fan, std::size_t j) const noexcept;
    /// The triangles of a fan, but for those of its gaps.
    using Triangles = std::array<Triangle, k_max_neighbors>;
    void triangles(const Fan& fan, Triangles& result) const noexcept;
    static void set_angles(const Fan& fan, Triangles& triangles) noexcept;
    /// The mean of the triangles' normals by their angles. Of length 1, or zero.
    static glm::dvec3 normal(const Fan& fan, const Triangles& triangles) noexcept;
    /// The median size of the triangles, the lower one of two; 0 where there is none.
    static double scale(const Fan& fan, const Triangles& triangles) noexcept;

    // One at a time.
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
