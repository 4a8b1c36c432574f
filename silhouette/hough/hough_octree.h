#pragma once

// The index: a mesh's faces and edges in an octree over 3D Hough space (thesis 3.2, 3.3, 4.4).
//
// In Hough space a face is a point (hough_point.h) and a silhouette point is a v-sphere. The face's bit says
// on which side of the v-sphere it lies (v_sphere.h). Faces that are near to each other there have bits that
// mostly agree. Faces and edges lie in octree order of their points, sixteen in a block (plane_block.h), under
// a tree of boxes (block_tree.h). A box decides the bits of all its faces at once where it lies certainly on
// one side of the silhouette point, so only faces near the v-sphere are tested. Where a box is not certain,
// is_front decides. So the results equal brute force bit for bit.
//
//   Moves. Blocks that lie certainly on the same side of both points are skipped. Where a block lies certainly
//   on different sides (it is contained in the active region), all its faces flip without a test. Faces with
//   dO < 0, dO being the signed distance of a face's plane from the origin O, come after the others: their
//   Hough points are those of the planes turned around, which are far away as planes.
//
//   Extraction. Edges lie in octree order of the midpoints of their two Hough points. Edges whose planes are
//   far apart come after the others. A box holds *both* planes of each edge. When it is certainly on one
//   side, no edge in it is on the silhouette. (The thesis skips nodes whose points are outside or whose edges'
//   points are inside. That finds an edge only from its inside face, and with several origins it loses edges.
//   And it tests lists of edges one by one: those that are SFO, on the silhouette as seen from the origin, as
//   boxes of Hough points say nothing of them, and those with a plane that contains the origin. Boxes of
//   planes need no such lists.)
//
//   Several origins. Each face belongs to the origin from which the fewest of its edges are sharp SFO edges,
//   and of those to the one farthest from its plane (4.4.4). Each edge belongs to exactly one origin from
//   which it is not SFO, where there is one, preferably that of one of its faces, and is tested there alone.
//   Where a face belongs to another origin, its Hough point is a ghost.
//
//   A block with an edge of a face without a plane is always tested; non-manifold edges are tested one by one.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "silhouette/hough/block_scratch.h"
#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

struct EdgeBlocks;  // block_set.h
struct FaceBlocks;
struct FaceLinks;  // face_links.h

struct HoughOctreeOptions {
    /// The origins of the Hough spaces, in the mesh's coordinates, within k_max_coordinate. Empty: one, the
    /// mesh's center.
    std::vector<glm::dvec3> origins;
};

/// Sizes of an octree, to compare options.
struct HoughOctreeStatistics {
    std::uint32_t nodes = 0;        ///< Of all trees, over faces and over edges.
    std::uint32_t depth = 0;        ///< Of the deepest tree.
    std::uint32_t faces = 0;        ///< Faces in the trees: those with a plane.
    std::uint32_t owned_edges = 0;  ///< Not SFO from their origin.
    std::uint32_t ghost_edges = 0;  ///< Owned edges with a face that belongs to another origin.
    std::uint32_t sfo_edges = 0;    ///< On the silhouette as seen from all origins.
    std::uint32_t undecided_edges =
        0;  ///< With a face that has no plane, or whose plane contains an origin.
    std::uint32_t nonmanifold_edges = 0;     ///< Tested at every extraction.
    std::uint64_t size_bytes = 0;            ///< Of the index, without the mesh.
    std::vector<std::uint32_t> group_faces;  ///< For each origin, the faces that belong to it.
};

/// Immutable. Any number of threads may use one, each with its own scratch.
class HoughOctree {
public:
    /// `mesh` must outlive the octree and must not be moved. O(faces log faces) on all threads that oneTBB
    /// provides; the result does not depend on their number. A cancelled `call` throws Error{cancelled}.
    explicit HoughOctree(const Mesh& mesh, const HoughOctreeOptions& options = {},
                         const LongCall& call = {});
    explicit HoughOctree(Mesh&&, const HoughOctreeOptions& = {},
                         const LongCall& = {}) = delete;  // A temporary would dangle.
    ~HoughOctree();
    HoughOctree(HoughOctree&&) noexcept;
    HoughOctree& operator=(HoughOctree&&) noexcept;

    const Mesh& mesh() const noexcept { return *mesh_; }
    std::span<const glm::dvec3> origins() const noexcept { return origins_; }
    const HoughOctreeStatistics& statistics() const noexcept { return statistics_; }
    /// For each face the number of its origin; k_no_group for a face without a plane. O(faces).
    std::vector<std::uint32_t> face_groups() const;
    static constexpr std::uint32_t k_no_group = 0xffffffffu;

    /// Additional elements that extract() writes: whole vectors are stored, also for the last edges.
    static constexpr std::uint32_t k_extraction_slack = k_block_size;

    /// Working memory for one thread at a time.
    BlockScratch make_scratch() const { return BlockScratch(max_blocks_); }

    /// Static extraction: replaces `edges` by the silhouette from `point`, unordered and without borders.
    /// Adds to `counters`. With a scratch, allocates only where `edges` has no capacity for
    /// k_extraction_slack more than there are.
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters, BlockScratch& scratch) const;
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) const {
        BlockScratch scratch = make_scratch();
        extract(point, edges, counters, scratch);
    }

    /// Faces have positions: sixteen in each block, block after block. Faces without a plane have none.
    std::uint32_t block_count() const noexcept {
        return static_cast<std::uint32_t>(faces_.size() / k_block_size);
    }
    /// The face at a position; k_no_face where the position is not in use.
    FaceId face_at(std::uint32_t position) const noexcept { return faces_[position]; }
    std::span<const FaceId> faces() const noexcept { return faces_; }  ///< By position.
    /// The edges of each face, by position.
    std::span<const FaceLinks> links() const noexcept;

    /// Sets `bits`, one word for each block, to the face bits seen from `point`.
    void evaluate_faces(const HomogeneousPoint& point, std::span<std::uint16_t> bits,
                        BlockScratch& scratch) const noexcept;
    /// The same bits by face, packed as silhouette/mesh/face_bits.h says. `bits` has one word for each block.
    std::vector<std::uint32_t> face_words(std::span<const std::uint16_t> bits) const;
    /// Finds the faces whose bits differ between the two points. Writes their blocks to `flipped`, each once, and
    /// returns the number of blocks. The low halves of `states` must be the bits seen from `from`. `flipped` must
    /// have space for all blocks. Does not allocate. Adds to `counters`.
    std::size_t find_flips(const HomogeneousPoint& from, const HomogeneousPoint& to,
                           std::span<const std::uint32_t> states, std::span<FlippedBlock> flipped,
                           TraversalCounters& counters, BlockScratch& scratch) const noexcept;

    /// The instruction set in use, by Highway's name.
    static std::string_view instruction_set();

private:
    friend class HoughOctreeBuilder;

    std::size_t decide_edges(std::span<const EdgeId> edges, const HomogeneousPoint& point,
                             std::uint32_t count, BlockScratch& scratch) const noexcept;
    std::uint32_t front_doubts(const FaceBlocks& blocks, const HomogeneousPoint& point,
                               std::uint32_t found, const BlockScratch& scratch) const noexcept;
    void extract_blocks(const EdgeBlocks& blocks, const HomogeneousPoint& point,
                        std::vector<EdgeId>& edges, TraversalCounters& work,
                        BlockScratch& scratch) const;
    void extract_nonmanifold(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                             TraversalCounters& work) const;

    const Mesh* mesh_;
    std::vector<glm::dvec3> origins_;
    std::vector<FaceBlocks> face_blocks_;  // One for each origin.
    std::vector<EdgeBlocks> edge_blocks_;  // One for each origin.
    std::vector<FaceId> faces_;            // By position.
    std::vector<FaceLinks> links_;         // By position.
    std::uint32_t max_blocks_ = 0;         // The maximum of all sets.
    HoughOctreeStatistics statistics_;
};

}  // namespace rimline
