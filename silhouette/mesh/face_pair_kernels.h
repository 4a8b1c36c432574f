#pragma once

// The inner loop of the search for pairs of faces (face_pairs.h), compiled for every instruction set that Highway
// knows for the target. All decide the same pairs, bit for bit.
//
// Each test takes the differences of coordinates first. So floats decide it wherever faces are not nearly coplanar.

#include <array>
#include <cstddef>
#include <cstdint>

#include "silhouette/mesh/face_tree.h"

namespace rimline::kernels {

/// A block of a FaceTree.
struct alignas(64) FaceBlock {
    static constexpr std::size_t k_faces = FaceTree::k_block_faces;
    /// A test has at most sixteen roundings, relative to the bound. And more than what is lost where numbers are
    /// subnormal.
    static constexpr float k_error = 0x1p-20f, k_least = 0x1p-120f;

    template <typename T>
    using Lanes = std::array<T, k_faces>;
    template <typename T>
    using Corners = std::array<Lanes<T>, 3>;

    Corners<float> x, y, z;
    Lanes<float> normal_x, normal_y, normal_z;  ///< (corner 1 - corner 0) x (corner 2 - corner 0).
    /// k_error times the product of the lengths of both differences, as sums along the axes.
    Lanes<float> bound;
    Corners<std::uint32_t> vertices;
};
static_assert(sizeof(FaceBlock) == 64 * FaceBlock::k_faces);

/// For each face of a block, a bit for each face of the other.
using NearFaces = FaceBlock::Lanes<std::uint16_t>;

/// Finds the pairs of one of the first `count_a` faces of `a` and one of the first `count_b` of `b` that may meet
/// outside of shared corners: whose boxes meet, and where neither has all its corners but the shared ones on one side
/// of the other's plane, certainly. Where `is_same`, each pair is found once. Returns the number of pairs whose boxes
/// meet. Sets the first `count_a` of `near`.
std::uint32_t find_near_faces(const FaceBlock& a, std::uint32_t count_a, const FaceBlock& b,
                              std::uint32_t count_b, bool is_same, NearFaces& near);

}  // namespace rimline::kernels
