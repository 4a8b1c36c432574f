#pragma once

// Brute force that is fast enough for a million comparisons, and is itself checked.
//
// The reference is PackedBruteForce. On every mesh its first results and one in k_check_every of the rest
// must equal those of brute_force.h, the definition.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/methods/brute_force_packed.h"

namespace rimline::tests {

class Oracle {
public:
    static constexpr std::uint32_t k_check_every = 32;

    /// `mesh` must outlive the oracle.
    explicit Oracle(const Mesh& mesh);

    /// Fails the running test case if brute force and its packed form do not agree.
    void look_from(const HomogeneousPoint& point);
    /// Whether `edges`, in any order, are the silhouette from this point, each once.
    bool agrees(std::span<const EdgeId> edges);
    /// Ascending.
    std::span<const EdgeId> silhouette() const { return edges_; }

    std::uint64_t checked_looks() const { return checked_looks_; }
    /// The number of faces, over all checked points, whose bit is not that of exact arithmetic: the point
    /// is so near to the plane that the rounding of the face bit decides.
    std::uint64_t rounded_bits() const { return rounded_bits_; }

private:
    void check(const HomogeneousPoint& point);

    const Mesh* mesh_;
    PackedBruteForce brute_force_;
    std::vector<std::uint32_t> words_;
    std::vector<EdgeId> edges_;
    // By edge: 2 * look for the silhouette's edges, and one more once agrees() has met it.
    std::vector<std::uint64_t> marks_;
    std::uint64_t look_ = 0;
    std::uint64_t checked_looks_ = 0;
    std::uint64_t rounded_bits_ = 0;
};

}  // namespace rimline::tests
