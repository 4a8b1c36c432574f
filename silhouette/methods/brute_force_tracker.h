#pragma once

// Follows a moving point without an index: the baseline for updates.
//
//     every face's bit     old bits XOR new bits     the faces that flipped     their edges
//
// The bits cost O(faces) for every move (windowed_brute_force.h; faces are stored in its order). The rest of the work
// is that of the tracker with an index (silhouette_tracker.h), by the same rules: an edge of a flipped face changes
// when its other face did not flip; where examining those edges costs more than a pass over all edges, the silhouette
// is extracted afresh and compared. Both trackers write the same change set (silhouette_record.h).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/face_links.h"
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
    SilhouetteRecord make_record(const HomogeneousPoint& point);
    std::span<const FlippedBlock> find_flips() noexcept;

    const Mesh* mesh_;
    WindowedBruteForce brute_force_;
    std::vector<FaceId> faces_;        // By place; whole blocks.
    std::vector<FaceLinks> links_;     // By place.
    std::vector<std::uint16_t> bits_;  // From the point before.
    // By block: the bits of its faces, and from bit 16 on which of them differ from those before.
    std::vector<std::uint32_t> states_;
    std::vector<FlippedBlock> flipped_blocks_;
    std::vector<std::uint32_t> positions_;  // Of the faces that flipped.
    std::vector<EdgeId> extracted_;
    SilhouetteRecord record_;
    bool was_extracted_ = false;
};

}  // namespace rimline
