#pragma once

// Brute force as fast as today's machines do it: the baseline that an index has to beat.
//
// Every face and every edge again, but laid out for vector registers: planes and the faces of edges as
// structure of arrays, 32 face bits made at a time, then 32 edges examined at a time on the packed bits.
// The loops are plain C++ that the compiler vectorizes, compiled once for each instruction set below and
// chosen when the object is made. Equal, bit for bit, to brute_force.h.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class PackedBruteForce {
public:
    /// `mesh` must outlive it. Holds 16 bytes a face and 8 an edge.
    explicit PackedBruteForce(const Mesh& mesh);
    explicit PackedBruteForce(Mesh&&) = delete;  // It would be gone.

    /// Replaces `words` by every face's bit, packed as face_bits.h says. O(faces).
    void face_bits(const HomogeneousPoint& point, std::vector<std::uint32_t>& words) const;
    /// Replaces `edges` by the silhouette that `words` make, ascending. O(edges).
    void silhouette(std::span<const std::uint32_t> words, std::vector<EdgeId>& edges) const;

    /// What the loops were compiled for: "AVX-512", "AVX2" or "baseline".
    std::string_view instruction_set() const noexcept { return instruction_set_; }

private:
    // Planes n·x = d, padded with planes of no normal, whose bit is back, to whole words.
    std::vector<float> nx_, ny_, nz_, d_;
    // The faces of regular and inconsistent edges, padded with twice face 0, whose bits never differ.
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
    std::string_view instruction_set_;
};

}  // namespace rimline
