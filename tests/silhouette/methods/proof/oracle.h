#pragma once

// Brute force that is fast enough to be asked a million times, and is itself checked on the way.
//
// The reference is PackedBruteForce. On every mesh its first answers and one in k_check_every of the rest
// must be what brute_force.h, the definition, says.

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
    /// Whether `edges`, in any order, are the silhouette from there, each once.
    bool agrees(std::span<const EdgeId> edges);
    /// Ascending.
    std::span<const EdgeId> silhouette() const { return edges_; }

    std::uint64_t checked_looks() const { return checked_looks_; }
    /// Over all checked looks, the faces whose bit is not that of their plane in exact arithmetic: where
    /// the point is so near to the plane that only the face bit's own rounding decides.
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
