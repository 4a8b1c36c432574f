#pragma once

// Brute force in wide registers: the reference of proofs and of the bench's checks. It shares nothing with the octree,
// and answers in the order of the file. (The baseline for times is windowed_brute_force.h, three times as fast.)
//
// It tests every face and every edge. Planes and the faces of edges are stored as structures of arrays. 32
// face bits are computed at a time, then 32 edges are examined at a time on the packed bits. The compiler
// vectorizes the plain C++ loops once for each instruction set below; the constructor chooses the version.
// The results equal those of brute_force.h bit for bit.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class PackedBruteForce {
public:
    /// `mesh` must outlive this object. Uses 16 bytes a face and 8 an edge.
    explicit PackedBruteForce(const Mesh& mesh);
    explicit PackedBruteForce(Mesh&&) = delete;  // It would dangle.

    /// Replaces `words` by the bits of all faces, packed as face_bits.h says. O(faces).
    void face_bits(const HomogeneousPoint& point, std::vector<std::uint32_t>& words) const;
    /// Replaces `edges` by the silhouette for the face bits `words`, ascending. O(edges).
    void silhouette(std::span<const std::uint32_t> words, std::vector<EdgeId>& edges) const;

private:
    // Planes n·x = d, padded to whole words with planes without a normal, which are always back.
    std::vector<float> nx_, ny_, nz_, d_;
    // The two faces of regular and inconsistent edges, padded with pairs of face 0, whose bits never differ.
    std::vector<std::uint32_t> face_a_, face_b_;
    const Mesh* mesh_;

    struct Planes {
        const float *nx, *ny, *nz, *d;
    };
    using FaceKernel = void (*)(const Planes&, const HomogeneousPoint&, std::span<std::uint32_t>);
    using EdgeKernel = std::uint32_t (*)(const std::uint32_t* face_a, const std::uint32_t* face_b,
                                         const std::uint32_t* words);
    struct Kernels;
    FaceKernel face_kernel_;
    EdgeKernel edge_kernel_;
};

}  // namespace rimline
