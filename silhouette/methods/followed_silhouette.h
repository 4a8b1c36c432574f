#pragma once

// A silhouette kept up to date by the faces that turn: what every method that follows a moving point
// needs once it has found them.
//
// Each face that turned has its three edges examined again, on the packed face bits. The edges lie
// without gaps; one that leaves is replaced by the last.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class FollowedSilhouette {
public:
    /// `mesh` must outlive it.
    explicit FollowedSilhouette(const Mesh& mesh);

    /// From the bits of all faces, packed as face_bits.h says. O(faces + edges).
    void start(std::span<const std::uint32_t> face_words, TraversalCounters& counters);
    /// `flipped` names faces whose bits are now the other ones, each once. O(flipped).
    void turn(std::span<const FaceId> flipped, TraversalCounters& counters);

    bool has_started() const noexcept { return started_; }
    std::span<const std::uint32_t> face_words() const noexcept { return face_words_; }
    /// In no particular order, borders not among them.
    std::span<const EdgeId> edges() const noexcept { return edges_; }

private:
    static constexpr std::uint32_t k_no_slot = 0xffffffffu;

    void join(EdgeId edge);
    void leave(EdgeId edge);

    const Mesh* mesh_;
    bool started_ = false;
    std::vector<std::uint32_t> face_words_;
    std::vector<EdgeId> edges_;
    std::vector<std::uint32_t> slot_of_;  // By edge, borders excepted.
};

}  // namespace rimline
