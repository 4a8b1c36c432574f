#pragma once

// Full traversals (thesis 3.4.2) of the same octree over two transforms of planes, as Figures 3.9 and 3.10
// compare them. Nothing else differs.
//
// About an origin O a plane n·x = d is, with dO = d - n·O,
//
//     in Hough space   H = n dO / |n|²    and a silhouette point the v-sphere w|H|² = H·q,
//     in dual space    D = n / dO         and a silhouette point the plane    D·q = w,      q = p - wO.
//
// The two are inverse to each other in the unit sphere. A face turns when its point lies between the
// v-spheres of two frames, or in the double wedge between their planes (Pop et al. 2001). A node is skipped
// when its box is certainly apart from that region, and turned untested when certainly contained. A leaf of
// one point has no box, as in LiteralTracker. The box is the tightest around the node's points, the
// thesis's PBV, or the whole octant. (silhouette/methods/dual_tree.h is the dual method for today's
// machines.)

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/hough/v_sphere.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/literal/literal_counters.h"
#include "silhouette/methods/literal/point_octree.h"

namespace rimline::tools {

enum class PlaneTransform : std::uint8_t { hough, dual };
enum class NodeBoxes : std::uint8_t { tight, octants };

class TransformOctree {
public:
    /// `mesh` must outlive this object. A face whose plane contains the origin, or may within rounding, has
    /// no dual point and is tested at every move. O(faces * depth).
    TransformOctree(const Mesh& mesh, const glm::dvec3& origin, PlaneTransform transform,
                    NodeBoxes node_boxes);

    /// Changes `face_words` from the bits of `from` to the bits of `to`. The result equals a test of every
    /// face bit for bit. Counts PBVs (or OBVs), face checks and contained faces.
    LiteralCounters move(const HomogeneousPoint& from, const HomogeneousPoint& to,
                         std::span<std::uint32_t> face_words) const;

    std::span<const OctreeNode> nodes() const noexcept { return octree_.nodes; }
    /// In tree order.
    std::span<const glm::dvec3> points() const noexcept { return points_; }
    /// Faces with a plane but no dual point.
    std::size_t faces_at_infinity() const noexcept { return at_infinity_.size(); }

private:
    struct Box {
        HoughBox box;
        float reach = 0.0f;
    };
    class Move;

    void bound_nodes(std::span<const HoughPoint> placed);
    void include_octants(std::uint32_t node, const Octant& octant);

    const Mesh* mesh_;
    glm::dvec3 origin_;
    PlaneTransform transform_;
    NodeBoxes node_boxes_;
    PointOctree octree_;
    std::vector<Box> boxes_;  // One a node.

    // In tree order.
    std::vector<FaceId> faces_;
    std::vector<glm::dvec3> points_;
    std::vector<std::int8_t> sides_;  // The sign of dO.

    std::vector<FaceId> at_infinity_;
};

}  // namespace rimline::tools
