#pragma once

// A closed, smooth camera path around a model through given nodes (thesis 4.5.5).
//
// Bézier curves through viewpoints in a shell around the model often leave the shell on its inner side: in
// two of three cases between random, distant viewpoints. So direction and distance are interpolated
// separately,
//
//     p(t) = center + ρ(t) * B(t) / |B(t)|
//
//   B  is a cubic Bézier curve between the unit directions a and b of two consecutive nodes. Its control
//      points are a + h u and b - h v, where u and v are the tangents of the nodes: unit vectors along
//      the sphere, the same on both sides of a node. With θ the angle between a and b,
//      h = min(4/3 tan(θ/4), 0.9 cos(θ/2)): the value for a circular arc, with an upper limit. As
//      h < cos(θ/2), all four control points lie on one side of the plane through the center that is
//      perpendicular to a + b. All of B lies there, too, so |B| is never 0.
//   ρ  goes from one distance to the next as 3t^2 - 2t^3. It stays between the two and has slope 0 at the
//      nodes. So the path is nowhere nearer to the center than its nearest node.
//
// The path passes exactly through the nodes. Positions are parameterized by the share of the length, so
// the speed is constant. Tangents are the same on both sides of a node, so the motion is C1.

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rimline {

class CameraPath {
public:
    /// The maximum angle between consecutive nodes as seen from the center.
    static constexpr double k_max_turn_deg = 170.0;
    /// The minimum angle.
    static constexpr double k_min_turn_deg = 1e-3;

    /// Needs three or more nodes, none at the center. The angle between consecutive nodes, also between
    /// the last and the first, must be within the two limits (RIMLINE_CHECK). O(nodes).
    CameraPath(const glm::dvec3& center, std::span<const glm::dvec3> nodes);

    /// The position at this share of the length, which must be finite (RIMLINE_CHECK). Periodic: 0 and 1 are the first
    /// node. O(log nodes).
    glm::dvec3 position(double share) const noexcept;
    /// The share of the length at a node, in [0, 1).
    double share_of_node(std::size_t node) const noexcept;
    /// The path's length, in the unit of the nodes.
    double length() const noexcept { return lengths_.back(); }
    std::span<const glm::dvec3> nodes() const noexcept { return nodes_; }

private:
    // From one node to the next.
    struct Leg {
        glm::dvec3 control[4];
        double from_distance, to_distance;
    };

    glm::dvec3 offset(const Leg& leg, double t) const noexcept;  // Relative to the center.

    glm::dvec3 center_;
    std::vector<glm::dvec3> nodes_;
    std::vector<Leg> legs_;
    std::vector<double> lengths_;  // Path length up to step i over all legs; steps + 1 values.
};

}  // namespace rimline
