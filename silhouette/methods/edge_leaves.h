#pragma once

// Face bits and edges in blocks of sixteen: the leaves of all trees of this folder.
//
// Sixteen planes are a structure of arrays. Sixteen edges are two of them: the planes of their first faces
// and of their second faces. A leaf stores its own planes, so that no load is a gather; each plane is
// therefore stored with every edge of its face.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/instruction_set.h"
#include "silhouette/methods/packed_tree.h"

namespace rimline {

/// A plane that is not set has no normal and is always back.
struct alignas(64) SixteenPlanes {
    using Lanes = std::array<float, k_leaf_items>;
    Lanes nx{}, ny{}, nz{}, d{};

    void set(std::uint32_t lane, const Plane& plane) noexcept {
        nx[lane] = plane.nx;
        ny[lane] = plane.ny;
        nz[lane] = plane.nz;
        d[lane] = plane.d;
    }
};

/// The face bits of a block. Bit i belongs to lane i.
struct FrontOfSixteen {
    [[gnu::always_inline]] static inline std::uint32_t run(const SixteenPlanes& planes,
                                                           const HomogeneousPoint& p) {
        std::uint32_t bits = 0;
        for (std::uint32_t i = 0; i < k_leaf_items; ++i) {
            const bool front =
                (planes.nx[i] * p.x + planes.ny[i] * p.y) + planes.nz[i] * p.z > p.w * planes.d[i];
            bits |= front ? 1u << i : 0u;
        }
        return bits;
    }
};

/// The bits in which two blocks differ.
struct DifferenceOfSixteen {
    [[gnu::always_inline]] static inline std::uint32_t run(
        const std::array<SixteenPlanes, 2>& faces, const HomogeneousPoint& p) {
        return FrontOfSixteen::run(faces[0], p) ^ FrontOfSixteen::run(faces[1], p);
    }
};

/// All edges of a mesh but its borders: the edges of a tree in the tree's order, and the rest, which is
/// tested at every extraction.
class EdgeLeaves {
public:
    EdgeLeaves() = default;
    /// `treed` are regular edges in the tree's order, each once. `mesh` must outlive this object.
    EdgeLeaves(const Mesh& mesh, std::span<const EdgeId> treed);

    /// Appends those edges of a leaf that are on the silhouette.
    void test_leaf(std::uint32_t leaf, const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                   TraversalCounters& counters) const;
    /// Appends those edges outside the tree that are on the silhouette: regular edges that the tree leaves
    /// out, inconsistent edges and non-manifold edges.
    void test_rest(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                   TraversalCounters& counters) const;

    std::uint32_t rest_count() const noexcept { return rest_count_; }

private:
    struct Block {
        std::array<SixteenPlanes, 2> faces;
        std::array<EdgeId, k_leaf_items> edges;
    };

    void append(std::span<const EdgeId> edges);
    void test(const Block& block, std::uint32_t count, std::uint32_t inverted,
              const HomogeneousPoint& point, std::vector<EdgeId>& edges,
              TraversalCounters& counters) const;
    void test_run(std::size_t first_block, std::uint32_t count, std::uint32_t inverted,
                  const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                  TraversalCounters& counters) const;

    const Mesh* mesh_ = nullptr;
    KernelPointer<DifferenceOfSixteen> difference_ = best_version<DifferenceOfSixteen>();
    std::vector<Block>
        blocks_;  // Edges in the tree, regular edges outside it, inconsistent ones; each kind starts a block.
    std::uint32_t treed_count_ = 0;
    std::uint32_t untreed_count_ = 0;
    std::uint32_t rest_count_ = 0;
};

}  // namespace rimline
