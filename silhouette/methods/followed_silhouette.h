#pragma once

// A silhouette that is updated from the faces that turn. Every method that follows a moving point uses it
// once it has found those faces.
//
// The three edges of each face that turned are examined again, on the packed face bits. The edges are stored
// without gaps: the last edge takes the place of one that leaves.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class FollowedSilhouette {
public:
    /// `mesh` must outlive this object.
    explicit FollowedSilhouette(const Mesh& mesh);

    /// Starts from the bits of all faces, packed as face_bits.h says. O(faces + edges).
    void start(std::span<const std::uint32_t> face_words, TraversalCounters& counters);
    /// The same where the silhouette of these bits is known: `edges`, without borders.
    void start(std::span<const std::uint32_t> face_words, std::span<const EdgeId> edges);

    /// `flipped` names the faces whose bits are now inverted, each once. O(flipped).
    void turn(std::span<const FaceId> flipped, TraversalCounters& counters);

    /// The two halves of turn(). Sets one bit; returns whether it has changed. update_edges() must follow
    /// before edges() is read.
    bool set_bit(FaceId face, bool is_front) noexcept;
    /// `turned` names the faces whose bits have changed, each once. Returns the number of edges examined.
    std::uint64_t update_edges(std::span<const FaceId> turned);

    bool has_started() const noexcept { return started_; }
    std::span<const std::uint32_t> face_words() const noexcept { return face_words_; }
    /// In no particular order, without borders.
    std::span<const EdgeId> edges() const noexcept { return edges_; }

private:
    static constexpr std::uint32_t k_no_slot = 0xffffffffu;

    void join(EdgeId edge);
    void leave(EdgeId edge);

    const Mesh* mesh_;
    bool started_ = false;
    std::vector<std::uint32_t> face_words_;
    std::vector<EdgeId> edges_;
    std::vector<std::uint32_t> slot_of_;        // The position in edges_ of each edge but borders.
    std::vector<std::uint64_t> last_examined_;  // By non-manifold edge: the number of the update.
    std::uint64_t updates_ = 0;
};

}  // namespace rimline
