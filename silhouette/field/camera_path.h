#pragma once

// A closed, smooth way of the camera around a model, through given places (thesis 4.5.5).
//
// Bézier curves through viewpoints in a shell around the model leave the shell on the inside: between
// random places well apart, two times out of three. So direction and distance go apart,
//
//     p(t) = center + ρ(t) * B(t) / |B(t)|
//
//   B  is a cubic Bézier curve between the unit directions a and b of each two consecutive nodes, with
//      the control points a + h u and b - h v, where u and v are the tangents of the nodes: unit, along
//      the sphere, and the same on both sides of a node. With θ the angle between a and b,
//      h = min(4/3 tan(θ/4), 0.9 cos(θ/2)): that of a circle's arc, unless it is too long. As h < cos(θ/2)
//      all four control points, and with them all of B, lie on one side of the plane through the center
//      that is perpendicular to a + b: |B| is never 0.
//   ρ  goes from distance to distance as 3t^2 - 2t^3: never beyond either, and level at the nodes. So the
//      path is nowhere nearer to the center than its nearest node.
//
// The nodes are passed exactly. Position is asked for by the share of the length: the speed is constant,
// so that a tangent that both sides of a node share makes the motion C1.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline {

class CameraPath {
public:
    /// The greatest angle between consecutive nodes as seen from the center.
    static constexpr double k_max_turn_deg = 170.0;
    /// And the least.
    static constexpr double k_min_turn_deg = 1e-3;

    /// Three nodes or more, not at the center, consecutive ones (the last and the first too) between the
    /// two angles apart (RIMLINE_CHECK). O(nodes).
    CameraPath(const glm::dvec3& center, std::span<const glm::dvec3> nodes);

    /// The place at this share of the way; periodic: 0 and 1 are the first node. O(log nodes).
    glm::dvec3 position(double share) const noexcept;
    /// Where on the way a node is passed, in [0, 1).
    double share_of_node(std::size_t node) const noexcept;
    /// In the unit of the nodes.
    double length() const noexcept { return lengths_.back(); }
    std::span<const glm::dvec3> nodes() const noexcept { return nodes_; }

private:
    // From a node to the next.
    struct Leg {
        glm::dvec3 control[4];
        double from_distance, to_distance;
    };

    glm::dvec3 offset(const Leg& leg, double t) const noexcept;  // From the center.

    glm::dvec3 center_;
    std::vector<glm::dvec3> nodes_;
    std::vector<Leg> legs_;
    std::vector<double> lengths_;  // Up to step i of all legs together; steps + 1.
};

}  // namespace rimline
