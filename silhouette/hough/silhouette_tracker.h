#pragma once

// The silhouette of one mesh from one moving point.
//
// A face turns exactly when the point crosses its plane, so between two frames only the faces whose
// Hough points lie in the active region (thesis 3.4, the symmetric difference of two v-spheres) can
// turn. The tracker finds them in the octree, flips their bits, and re-examines their edges only.
//
// The silhouette lives in slots without gaps. Edges that join take the slots of those that left; what
// is still open below the new end is filled from the tail, so each slot is written at most once a move.
// Which slot an edge has depends on nothing but the points so far: the same on every machine.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/face_bits.h"

namespace rimline {

class SilhouetteTracker {
public:
    /// Extracts the silhouette from `point`. `octree` must outlive the tracker and stay where it is;
    /// many trackers may share one octree across threads. Reserves everything that moves will need: up
    /// to 28 bytes an edge and 5 a face, most of it untouched until a move of that size comes.
    SilhouetteTracker(const HoughOctree& octree, const HomogeneousPoint& point);
    SilhouetteTracker(HoughOctree&&, const HomogeneousPoint&) = delete;  // It would be gone.

    // A copy would have neither the reserve nor spans of its own.
    SilhouetteTracker(SilhouetteTracker&&) noexcept = default;
    SilhouetteTracker& operator=(SilhouetteTracker&&) noexcept = default;

    /// Moves to `point` and reports the difference. Equal, bit for bit, to extracting afresh.
    /// Never allocates. One thread at a time. O(faces near the active region + what changed).
    const ChangeSet& move_to(const HomogeneousPoint& point) noexcept;

    const Mesh& mesh() const noexcept { return octree_->mesh(); }
    const HomogeneousPoint& point() const noexcept { return changes_.point; }
    /// The sequence of the last change set; 0 before the first move.
    std::uint64_t sequence() const noexcept { return changes_.sequence; }
    /// The silhouette's edges: the slots in use. Valid until the tracker moves.
    std::span<const EdgeId> silhouette() const noexcept { return slots_; }
    std::span<const std::uint32_t> face_words() const noexcept { return face_words_; }
    bool is_front(FaceId face) const noexcept { return face_bit(face_words_, face); }
    /// Work of the extraction at construction.
    const TraversalCounters& construction_counters() const noexcept {
        return construction_counters_;
    }

private:
    void turn_faces() noexcept;
    void find_changed_edges() noexcept;
    void update_slots() noexcept;
    void write_slot(std::uint32_t slot, EdgeId edge) noexcept;

    const HoughOctree* octree_;
    TraversalCounters construction_counters_;
    ChangeSet changes_;

    std::vector<std::uint32_t> tree_words_;  // The octree's own order, for find_flips.
    std::vector<std::uint32_t> face_words_;
    std::vector<EdgeId> slots_;
    std::vector<std::uint32_t> slot_of_;  // By edge; k_no_slot when not on the silhouette.

    // What the change set's spans show, reserved for the greatest move there can be.
    std::vector<FaceId> flipped_;
    std::vector<EdgeId> added_;
    std::vector<EdgeId> removed_;
    std::vector<std::uint32_t> removed_slots_;  // Where removed_[i] was.
    std::vector<SlotWrite> slot_writes_;
    std::vector<WordWrite> word_writes_;
    std::vector<std::uint32_t> word_flips_;  // By word; all zero between moves.
};

}  // namespace rimline
