#pragma once

// The index: a mesh's faces and edges in an octree over 3D Hough space (thesis 3.2, 3.3).
//
// (The header's opening idea is to be completed with the layout below it.)

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

struct HoughOctreeOptions {
    /// Where Hough space has its origin, in the mesh's coordinates; the mesh's center when not given.
    std::optional<glm::dvec3> origin;
    /// A node with no more faces than this is a leaf.
    std::uint32_t bucket_size = 16;
};

class HoughOctree {
public:
    /// `mesh` must outlive the octree.
    explicit HoughOctree(const Mesh& mesh, const HoughOctreeOptions& options = {});

    const Mesh& mesh() const noexcept { return *mesh_; }

    /// Static extraction: replaces `edges` by the silhouette from `point`, in no particular order.
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) const;

private:
    const Mesh* mesh_;
};

}  // namespace rimline
