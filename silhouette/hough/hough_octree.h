#pragma once

// The index: a mesh's faces and edges in an octree over 3D Hough space (thesis 3.2, 3.3).
//
// A face is a point there (hough_point.h), a silhouette point is a v-sphere, and the face's bit says on
// which side of the v-sphere it lies (v_sphere.h). So a box of Hough points that lies certainly inside
// or certainly outside settles the bits of all its faces at once, and only what is near the v-sphere
// needs to be looked at. Boxes settle bits, they never replace them: what is not certain is decided by
// is_front, and the results equal brute force bit for bit.
//
//   Moves. A node whose faces lie certainly on the same side of both v-spheres is skipped; certainly on
//   different sides (contained in the active region), all its faces flip untested.
//
//   Extraction. Call dO the signed distance of a face's plane from the origin O. An edge is SFO when it
//   is on the silhouette as seen from O: the dO of its faces differ in sign, or are equal in sign if its
//   faces run it the same way. An edge that is not SFO is on the silhouette exactly when one of its two
//   Hough points is inside the v-sphere and the other is not: whatever the signs are, the same side
//   means what O sees. Every such edge is owned by one of its faces, and a node keeps a second box, of
//   *both* Hough points of all edges its faces own. When that box is certainly inside or certainly
//   outside, no edge of the subtree is on the silhouette. (The thesis skips nodes whose points are
//   outside or whose edges' points are inside. That finds an edge only from its inside face, which must
//   then hold all its edges, twice the records; and with several origins it loses edges.)
//
//   What no box can tell is tested at every extraction: SFO edges, edges of a face whose plane holds O
//   (or may, within rounding) or that has no plane, and non-manifold edges.
//
// Layout. Faces lie in tree order, a subtree's in one run: their planes, their ids, and the owned edges,
// again one run a subtree. Nodes lie in two arrays of the same shape (octree_order.h), one with boxes
// and ranges of faces for moves, one with boxes and ranges of edges for extraction, so that neither
// reads what the other needs. No pointers; a copy or a shared reference is all the same.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/v_sphere.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

struct HoughOctreeOptions {
    /// Where Hough space has its origin, in the mesh's coordinates; the mesh's center when not given.
    /// Within k_max_coordinate.
    std::optional<glm::dvec3> origin;
    /// A node with no more faces than this is a leaf. Not 0.
    std::uint32_t bucket_size = 16;
};

/// How an octree came out, to compare options.
struct HoughOctreeStatistics {
    std::uint32_t nodes = 0;
    std::uint32_t leaves = 0;
    std::uint32_t depth = 0;        ///< Of the deepest leaf; the root's is 0.
    std::uint32_t faces = 0;        ///< With a plane: those in the tree.
    std::uint32_t owned_edges = 0;  ///< Found through boxes.
    // Tested at every extraction:
    std::uint32_t sfo_edges = 0;        ///< On the silhouette as seen from the origin.
    std::uint32_t undecided_edges = 0;  ///< With a face whose plane holds the origin, or is none.
    std::uint32_t nonmanifold_edges = 0;
};

/// Immutable: any number of threads may use one.
class HoughOctree {
public:
    /// `mesh` must outlive the octree and stay where it is. O(faces log faces).
    explicit HoughOctree(const Mesh& mesh, const HoughOctreeOptions& options = {});
    explicit HoughOctree(Mesh&&, const HoughOctreeOptions& = {}) = delete;  // It would be gone.

    const Mesh& mesh() const noexcept { return *mesh_; }
    const glm::dvec3& origin() const noexcept { return origin_; }
    const HoughOctreeStatistics& statistics() const noexcept { return statistics_; }

    /// Static extraction: replaces `edges` by the silhouette from `point`, in no particular order.
    /// Borders are not among them. `counters` is added to.
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) const;

    /// The bits of the faces in tree order, for find_flips: 32 a word, and one word more than they
    /// fill, so that any 32 can be read at once. Faces without a plane are not among them.
    std::uint32_t tree_word_count() const noexcept { return statistics_.faces / 32 + 2; }
    /// Sets all of `tree_words`, of tree_word_count() words, to the bits seen from `point`.
    void evaluate_faces(const HomogeneousPoint& point,
                        std::span<std::uint32_t> tree_words) const noexcept;
    /// Appends to `flipped` the faces whose bits differ between the two points, each once, and flips
    /// them in `tree_words`, which must hold the bits seen from `from`. Does not allocate: `flipped` must
    /// have room for all faces in the tree. `counters` is added to.
    void find_flips(const HomogeneousPoint& from, const HomogeneousPoint& to,
                    std::span<std::uint32_t> tree_words, std::vector<FaceId>& flipped,
                    TraversalCounters& counters) const noexcept;

private:
    struct Node {
        HoughBox box;
        float reach;               // The box's.
        std::uint32_t begin, end;  // Faces in tree order, or owned edges.
        std::uint32_t first_child;
        std::uint32_t child_count;  // 0 in a leaf.
    };
    // The owner's plane lies near those of its neighbours in the tree, the other face's anywhere: a
    // copy of it here lets a leaf be tested by reading forwards only. (Gathering it from planes_ took
    // half as long again.)
    struct EdgeRecord {
        std::uint32_t owner;  // In tree order; statistics_.faces stands for any without a plane.
        EdgeId edge;
        Plane other;
    };

    template <typename Include>
    static void bound_nodes(std::vector<Node>& nodes, Include&& include);
    void build_edges(std::span<const HoughPoint> points);
    void measure();
    // Appends those of `records` that are on the silhouette.
    void test_edges(std::span<const EdgeRecord> records, const HomogeneousPoint& point,
                    std::vector<EdgeId>& edges) const;
    float greatest_reach() const noexcept {
        return face_nodes_.empty() ? 0.0f : face_nodes_.front().reach;
    }
    // Flips the faces of a run of up to 32 whose bits in `mask` are set.
    void flip(std::uint32_t begin, std::uint32_t mask, std::span<std::uint32_t> tree_words,
              std::vector<FaceId>& flipped) const noexcept;

    const Mesh* mesh_;
    glm::dvec3 origin_{};
    std::vector<Node> face_nodes_;
    std::vector<Node> edge_nodes_;
    std::vector<Plane> planes_;               // In tree order, then one without a normal.
    std::vector<FaceId> faces_;               // In tree order.
    std::vector<EdgeRecord> edges_;           // Owned, in the order of their owners.
    std::vector<EdgeRecord> explicit_edges_;  // SFO and undecided.
    HoughOctreeStatistics statistics_;
};

}  // namespace rimline
