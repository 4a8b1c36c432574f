#pragma once

// The thesis's opponent in Figures 3.9 to 3.11: the same octree, one point a leaf, over dual points.
//
// About an origin O a plane n·x = d is the dual point D = n/dO with dO = d - n·O, the inverse of its
// Hough point in the unit sphere, and a silhouette point is the plane D·q = w with q = p - wO:
//
//     n·p - w*d = dO (D·q - w)
//
// A face turns when D lies in the double wedge between the planes of two frames (Pop et al. 2001). Here
// as in LiteralTracker's full traversal a node is skipped when its tightest box is certainly apart from
// the wedge, turned untested when certainly contained, and a leaf of one point has no box to ask; so
// what differs in the counts is the transform and nothing else. (silhouette/hough/baselines/dual_tree.h
// is the method as one would lay it out today.)

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/hough/literal/literal_counters.h"
#include "silhouette/hough/literal/point_octree.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

class DualOctree {
public:
    /// `mesh` must outlive it. A face whose plane holds the origin, or may within rounding, has no dual
    /// point and is tested at every move. O(faces * depth).
    DualOctree(const Mesh& mesh, const glm::dvec3& origin);

    /// Turns in `face_words`, which must hold the bits seen from `from`, what turns on the way to `to`.
    /// Equal, bit for bit, to testing every face. PBVs, face checks and contained faces are counted.
    LiteralCounters move(const HomogeneousPoint& from, const HomogeneousPoint& to,
                         std::span<std::uint32_t> face_words) const;

    std::span<const OctreeNode> nodes() const noexcept { return octree_.nodes; }
    /// In tree order.
    std::span<const glm::dvec3> points() const noexcept { return points_; }
    /// Faces with a plane and no dual point.
    std::size_t faces_at_infinity() const noexcept { return at_infinity_.size(); }

private:
    struct Box {
        glm::dvec3 low{1e300};
        glm::dvec3 high{-1e300};

        void include(const Box& other) noexcept;
    };
    class Move;

    const Mesh* mesh_;
    glm::dvec3 origin_;
    PointOctree octree_;
    std::vector<Box> boxes_;  // By node.

    // In tree order.
    std::vector<FaceId> faces_;
    std::vector<glm::dvec3> points_;
    std::vector<std::int8_t> sides_;  // The sign of dO.

    std::vector<FaceId> at_infinity_;
};

}  // namespace rimline::tools
