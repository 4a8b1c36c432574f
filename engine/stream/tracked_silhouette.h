#pragma once

// The silhouette of one instance from one silhouette point, the camera or a light: a tracker in a
// service, and the GPU's copy of its state.
//
//     announce --> SilhouetteService: moves on worker threads      (while the GPU draws)
//     follow   --> change sets, or one whole state --> ChangeStream --> slots, face bits, arguments

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/silhouette_changes.h"
#include "engine/stream/change_stream.h"
#include "silhouette/hough/service/silhouette_follower.h"

namespace rimline {

class TrackedSilhouette {
public:
    /// The service, the octree and the budgets must outlive it. Throws what their parts do.
    TrackedSilhouette(const DeviceContext& context, SilhouetteService& service,
                      const HoughOctree& octree, const HomogeneousPoint& point,
                      std::uint32_t ring_slots, MemoryBudget& stream_budget,
                      MemoryBudget& tracker_budget, const std::string& model);

    /// Announces the point of the next follow(), so that the service begins to move there. Does not wait.
    void announce(const HomogeneousPoint& point) noexcept { follower_.announce(point); }

    /// Opens `ring_slot` of the stream and queues the changes that make it the silhouette from `point`.
    /// Waits for the service if it has not finished the move.
    void follow(const HomogeneousPoint& point, std::uint32_t ring_slot);

    /// Call if queued changes never ran: the next follow() sends the whole state.
    void invalidate() noexcept {
        follower_.invalidate();
        stream_.invalidate();
    }

    const ChangeStream& stream() const noexcept { return stream_; }
    /// For frames that still read it when this object goes, with its tracker. Nothing else may be called afterwards.
    ChangeStream take_stream() noexcept { return std::move(stream_); }
    /// The point of the last follow().
    const HomogeneousPoint& point() const noexcept { return follower_.point(); }
    /// The changes of the last follow().
    const SilhouetteChanges& changes() const noexcept { return changes_; }
    /// The GPU's state after the last follow(): the slots in use, and the face bits. Valid until the next
    /// follow().
    std::span<const EdgeId> silhouette() const noexcept { return slots_; }
    std::span<const std::uint32_t> face_words() const noexcept { return words_; }
    const Mesh& mesh() const noexcept { return *mesh_; }
    /// The number of its regular edges (EdgeClass). The stream has the number of all edges.
    std::uint32_t regular_count() const noexcept { return regular_count_; }

    /// The tracker's own state at the point of the last follow(). Nothing may have been announced since.
    void read_tracker(SilhouetteSnapshot& snapshot) { follower_.read_state(snapshot); }

private:
    // Receives the follower's changes: for the stream, and for the copy on the CPU.
    struct Consumer {
        TrackedSilhouette& silhouette;
        bool apply(const ChangeSet& changes);
        void resend(const SilhouetteSnapshot& snapshot);
    };

    std::uint32_t count_regular(std::span<const EdgeId> edges) const noexcept;

    const Mesh* mesh_;
    std::vector<EdgeId> slots_;
    std::vector<std::uint32_t> words_;
    SilhouetteChanges changes_;
    std::uint32_t regular_end_;  // Regular edges come first.
    std::uint32_t regular_count_ = 0;
    ChangeStream stream_;
    MemoryBudget::Share tracker_share_;
    SilhouetteFollower follower_;
};

}  // namespace rimline
