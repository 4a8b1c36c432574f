#pragma once

// The index: a mesh's faces and edges in an octree over 3D Hough space (thesis 3.2, 3.3, 4.4).
//
// A face is a point there (hough_point.h), a silhouette point is a v-sphere, and the face's bit says on
// which side of the v-sphere it lies (v_sphere.h). So a box of Hough points that lies certainly inside
// or certainly outside settles the bits of all its faces at once, and only what is near the v-sphere
// needs to be looked at. Boxes settle bits, they never replace them: what is not certain is decided by
// is_front, and the results equal brute force bit for bit.
//
//   Moves. Faces lie in octree order, sixteen a block (plane_block.h), under a tree of boxes
//   (box_tree.h). Blocks that lie certainly on the same side of both v-spheres are skipped; certainly on
//   different sides (contained in the active region), all their faces flip untested.
//
//   Extraction. Call dO the signed distance of a face's plane from the origin O. An edge is SFO when it
//   is on the silhouette as seen from O: the dO of its faces differ in sign, or are equal in sign if its
//   faces run it the same way. An edge that is not SFO is on the silhouette exactly when one of its two
//   Hough points is inside the v-sphere and the other is not: whatever the signs are, the same side
//   means what O sees. Edges lie in octree order of the middles of their two Hough points, those with
//   the points far apart by themselves, sixteen a block, under a tree of boxes that hold *both* points
//   of each edge. When a box is certainly on one side, no edge in it is on the silhouette. (The thesis
//   skips nodes whose points are outside or whose edges' points are inside. That finds an edge only from
//   its inside face, and with several origins it loses edges.)
//
//   Several origins. Each face belongs to the origin that sees fewest of its edges as sharp SFO edges,
//   and of those to the one farthest from its plane (4.4.4). Each edge belongs to exactly one origin from
//   which it is not SFO, one of its faces' if there is such, and is tested there alone, with the other
//   face's Hough point as a ghost where that face belongs elsewhere.
//
//   What no box can tell is tested at every extraction, sixteen at a time: edges that are SFO from all
//   origins, edges of a face whose plane holds the origin (or may, within rounding) or that has no plane;
//   and, one by one, non-manifold edges.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "silhouette/hough/block_set.h"
#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

struct HoughOctreeOptions {
    /// Where Hough spaces have their origins, in the mesh's coordinates; empty: one, the mesh's center.
    /// Within k_max_coordinate.
    std::vector<glm::dvec3> origins;
};

/// How an octree came out, to compare options.
struct HoughOctreeStatistics {
    std::uint32_t nodes = 0;        ///< Of the trees over faces and over edges.
    std::uint32_t depth = 0;        ///< Of the deepest tree.
    std::uint32_t faces = 0;        ///< With a plane: those in the trees.
    std::uint32_t owned_edges = 0;  ///< Found through boxes.
    std::uint32_t ghost_edges = 0;  ///< Of those, with a face that belongs to another origin.
    // Tested at every extraction:
    std::uint32_t sfo_edges = 0;        ///< On the silhouette as seen from all origins.
    std::uint32_t undecided_edges = 0;  ///< With a face whose plane holds an origin, or is none.
    std::uint32_t nonmanifold_edges = 0;
    std::uint64_t size_bytes = 0;            ///< Of the index, without the mesh.
    std::vector<std::uint32_t> group_faces;  ///< For each origin, the faces that belong to it.
};

/// Immutable: any number of threads may use one, each with a scratch of its own.
class HoughOctree {
public:
    /// `mesh` must outlive the octree and stay where it is. O(faces log faces) on all threads that oneTBB
    /// gives; the same whatever their number. A cancelled `call` throws Error{cancelled}.
    explicit HoughOctree(const Mesh& mesh, const HoughOctreeOptions& options = {},
                         const LongCall& call = {});
    explicit HoughOctree(Mesh&&, const HoughOctreeOptions& = {},
                         const LongCall& = {}) = delete;  // It would be gone.

    const Mesh& mesh() const noexcept { return *mesh_; }
    std::span<const glm::dvec3> origins() const noexcept { return origins_; }
    const HoughOctreeStatistics& statistics() const noexcept { return statistics_; }
    /// For each face the number of its origin; k_no_group without a plane. O(faces).
    std::vector<std::uint32_t> face_groups() const;
    static constexpr std::uint32_t k_no_group = 0xffffffffu;

    /// Whole vectors are stored, also of the last edges.
    static constexpr std::uint32_t k_extraction_slack = k_block_size;

    /// Room to work in, for one thread at a time.
    BlockScratch make_scratch() const { return BlockScratch(max_blocks_); }

    /// Static extraction: replaces `edges` by the silhouette from `point`, in no particular order.
    /// Borders are not among them. `counters` is added to. With a scratch, allocates only where `edges`
    /// has not room for k_extraction_slack more than there are.
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters, BlockScratch& scratch) const;
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) const {
        BlockScratch scratch = make_scratch();
        extract(point, edges, counters, scratch);
    }

    /// Faces have positions: sixteen a block, block after block. Faces without a plane have none.
    std::uint32_t block_count() const noexcept {
        return static_cast<std::uint32_t>(faces_.size() / k_block_size);
    }
    /// What lies at a position, and its edges that have two faces.
    struct alignas(32) PlacedFace {
        /// k_no_face at a position that is not in use.
        FaceId face;
        /// k_no_edge for a border or a non-manifold edge.
        std::array<EdgeId, 3> edges;
        /// Of the other face of each edge. The own position beside k_no_edge; beside the edge to a face
        /// without a plane, block_count() * k_block_size.
        std::array<std::uint32_t, 3> neighbors;
    };
    const PlacedFace& face_at(std::uint32_t position) const noexcept { return faces_[position]; }

    /// Sets `bits`, one word for each block, to the bits seen from `point`.
    void evaluate_faces(const HomogeneousPoint& point, std::span<std::uint16_t> bits,
                        BlockScratch& scratch) const noexcept;
    /// The same bits by face, packed as silhouette/mesh/face_bits.h says. `bits` has one word for each block.
    std::vector<std::uint32_t> face_words(std::span<const std::uint16_t> bits) const;
    /// Writes to `flipped` the positions of the faces whose bits differ between the two points, each
    /// once, flips them in `bits`, which must hold the bits seen from `from`, and returns their number.
    /// `flipped` must have room for all positions. Does not allocate. `counters` is added to.
    std::size_t find_flips(const HomogeneousPoint& from, const HomogeneousPoint& to,
                           std::span<std::uint16_t> bits, std::span<std::uint32_t> flipped,
                           TraversalCounters& counters, BlockScratch& scratch) const noexcept;

    /// What the loops were compiled for, as Highway names it.
    static std::string_view instruction_set();

private:
    friend class HoughOctreeBuilder;

    void decide_edges(std::span<const EdgeId> edges, const HomogeneousPoint& point,
                      std::uint32_t count, BlockScratch& scratch) const noexcept;
    void decide_faces(const FaceBlocks& blocks, const HomogeneousPoint& point,
                      std::span<const std::uint16_t> bits, std::uint32_t count,
                      BlockScratch& scratch) const noexcept;
    void extract_blocks(const EdgeBlocks& blocks, const HomogeneousPoint& point,
                        std::vector<EdgeId>& edges, TraversalCounters& work,
                        BlockScratch& scratch) const;
    void extract_nonmanifold(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                             TraversalCounters& work) const;

    const Mesh* mesh_;
    std::vector<glm::dvec3> origins_;
    std::vector<FaceBlocks> face_blocks_;  // One an origin.
    std::vector<EdgeBlocks> edge_blocks_;  // One an origin, then one of the edges always tested.
    std::vector<PlacedFace> faces_;        // By position.
    std::uint32_t max_blocks_ = 0;         // Of a set.
    HoughOctreeStatistics statistics_;
};

}  // namespace rimline
