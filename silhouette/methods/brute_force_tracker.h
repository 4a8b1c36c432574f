#pragma once

// Following a moving point without an index, as well as that can be done: the baseline for updates.
//
//     every face's bit, packed     old words XOR new words     the faces that flipped     their edges
//
// The bits cost O(faces) whatever moved, and nothing else does: from there on the work is what the
// tracker with an index does (silhouette_tracker.h), by the same rules. An edge of a flipped face changes
// when its other face did not flip; when looking at those edges would cost more than a pass over all,
// the silhouette is found afresh and compared. Both write the same change set (silhouette_record.h).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/silhouette_record.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/brute_force_packed.h"

namespace rimline {

class BruteForceTracker {
public:
    /// `mesh` must outlive the tracker and stay where it is. Reserves everything that moves will need.
    BruteForceTracker(const Mesh& mesh, const HomogeneousPoint& point);
    BruteForceTracker(Mesh&&, const HomogeneousPoint&) = delete;  // It would be gone.

    // A copy would have neither the reserve nor spans of its own.
    BruteForceTracker(BruteForceTracker&&) noexcept = default;
    BruteForceTracker& operator=(BruteForceTracker&&) noexcept = default;

    /// Moves to `point` and reports the difference. Never allocates. O(faces).
    const ChangeSet& move_to(const HomogeneousPoint& point) noexcept;

    /// The silhouette's edges: the slots in use. Valid until the tracker moves.
    std::span<const EdgeId> silhouette() const noexcept { return record_.slots(); }
    std::span<const std::uint32_t> face_words() const noexcept { return record_.face_words(); }
    /// Of the last move: whether the silhouette was found afresh.
    bool was_extracted() const noexcept { return was_extracted_; }

private:
    // Of a face: its edges with two faces and their other faces; k_no_edge and the face itself where an
    // edge has one face or more than two.
    struct Neighbors {
        std::array<EdgeId, 3> edges;
        std::array<FaceId, 3> faces;
    };

    SilhouetteRecord make_record(const HomogeneousPoint& point);
    void find_flips() noexcept;
    std::span<const EdgeId> changed_edges() noexcept;

    const Mesh* mesh_;
    PackedBruteForce brute_force_;
    std::vector<Neighbors> neighbors_;  // By face.
    std::vector<std::uint32_t> words_;  // Bits seen from the new point.
    std::vector<std::uint32_t> flips_;  // Those that differ from before.
    std::vector<FaceId> flipped_;
    std::vector<EdgeId> extracted_;
    std::vector<EdgeId> toggled_;  // One more than the most there can be.
    SilhouetteRecord record_;
    bool was_extracted_ = false;
};

}  // namespace rimline
