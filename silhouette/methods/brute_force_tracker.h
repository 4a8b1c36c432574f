#pragma once

// Follows a moving point without an index: the baseline for updates.
//
//     every face's bit     old bits XOR new bits     the faces that flipped     their edges
//
// The bits cost O(faces) for every move (windowed_brute_force.h; faces are stored in its order). The rest of the work is that of the tracker with an index
// (silhouette_tracker.h), by the same rules: an edge of a flipped face changes when its other face did not
// flip; where examining those edges costs more than a pass over all edges, the silhouette is extracted
// afresh and compared. Both trackers write the same change set (silhouette_record.h).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/silhouette_record.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/windowed_brute_force.h"

namespace rimline {

class BruteForceTracker {
public:
    /// `mesh` must outlive the tracker and stay where it is. Reserves all memory that moves need.
    BruteForceTracker(const Mesh& mesh, const HomogeneousPoint& point);
    BruteForceTracker(Mesh&&, const HomogeneousPoint&) = delete;  // It would dangle.

    // Not copyable: a copy would have neither the reserved memory nor spans of its own.
    BruteForceTracker(BruteForceTracker&&) noexcept = default;
    BruteForceTracker& operator=(BruteForceTracker&&) noexcept = default;

    /// Moves to `point` and reports the difference. Never allocates. O(faces).
    const ChangeSet& move_to(const HomogeneousPoint& point) noexcept;

    /// The edges of the silhouette in the order of their slots. Valid until the tracker moves.
    std::span<const EdgeId> silhouette() const noexcept { return record_.slots(); }
    std::span<const std::uint32_t> face_words() const noexcept { return record_.face_words(); }
    /// Whether the last move extracted the silhouette afresh.
    bool was_extracted() const noexcept { return was_extracted_; }

private:
    // The edges of a face and the places of their other faces. An edge that has not exactly two faces is stored
    // as k_no_edge and the face's own place.
    struct Neighbors {
        std::array<EdgeId, 3> edges;
        std::array<std::uint32_t, 3> places;
    };

    SilhouetteRecord make_record(const HomogeneousPoint& point);
    void find_flips() noexcept;
    std::span<const EdgeId> changed_edges() noexcept;

    const Mesh* mesh_;
    WindowedBruteForce brute_force_;
    std::vector<Neighbors> neighbors_;       // By place.
    std::vector<std::uint16_t> bits_;        // From the point before.
    std::vector<std::uint16_t> flips_;       // Bits that differ from before.
    std::vector<std::uint32_t> flipped_at_;  // Places of the faces that flipped.
    std::vector<FaceId> flipped_;
    std::vector<EdgeId> extracted_;
    std::vector<EdgeId> toggled_;  // One more than the greatest number of edges.
    SilhouetteRecord record_;
    bool was_extracted_ = false;
};

}  // namespace rimline
