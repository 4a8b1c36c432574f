#pragma once

// The silhouette of one instance from one silhouette point, the camera or a light: a tracker in a
// service, and the GPU's copy of its state.
//
//     announce --> SilhouetteService: moves on worker threads      (while the GPU draws)
//     follow   --> change sets, or one whole state --> ChangeStream --> slots, face bits, arguments

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/stream/change_stream.h"
#include "silhouette/hough/service/silhouette_follower.h"

namespace rimline {

/// How silhouettes changed since the frame before; nothing for those in their first frame.
struct SilhouetteChanges {
    std::uint64_t edges = 0;     ///< On the silhouettes now, borders not among them.
    std::uint64_t flips = 0;     ///< Faces that turned.
    std::uint64_t added = 0;     ///< Edges that joined.
    std::uint64_t removed = 0;   ///< Edges that left.
    TraversalCounters counters;  ///< Work on the CPU: none for what the GPU finds by itself.
    /// Time that the frame spent on them on the CPU: little where the service was ahead.
    double update_us = 0.0;

    SilhouetteChanges& operator+=(const SilhouetteChanges& other) noexcept;
};

class TrackedSilhouette {
public:
    /// The service, the octree and the budgets must outlive it. Throws what their parts do.
    TrackedSilhouette(const DeviceContext& context, SilhouetteService& service,
                      const HoughOctree& octree, const HomogeneousPoint& point,
                      std::uint32_t ring_slots, MemoryBudget& stream_budget,
                      MemoryBudget& tracker_budget, const std::string& model);

    /// Says where the next follow() will probably lead: the service begins with it. Does not wait.
    void announce(const HomogeneousPoint& point) noexcept { follower_.announce(point); }

    /// Opens `ring_slot` of the stream and queues what makes it the silhouette from `point`. Waits for
    /// the service where it is not that far.
    void follow(const HomogeneousPoint& point, std::uint32_t ring_slot);

    /// What was queued never ran: the next follow() sends the whole state.
    void invalidate() noexcept {
        follower_.invalidate();
        stream_.invalidate();
    }

    const ChangeStream& stream() const noexcept { return stream_; }
    /// Where the last follow() led.
    const HomogeneousPoint& point() const noexcept { return follower_.point(); }
    /// What the last follow() did.
    const SilhouetteChanges& changes() const noexcept { return changes_; }
    /// What the GPU holds after the last follow(): the slots in use, and the face bits. Valid until the
    /// next one.
    std::span<const EdgeId> silhouette() const noexcept { return slots_; }
    std::span<const std::uint32_t> face_words() const noexcept { return words_; }
    const Mesh& mesh() const noexcept { return *mesh_; }
    /// How many of its edges are regular (EdgeClass); the stream has the number of all.
    std::uint32_t regular_count() const noexcept { return regular_count_; }

    /// The tracker's own state where the last follow() led; only while nothing was announced since.
    void read_tracker(SilhouetteSnapshot& snapshot) { follower_.read_state(snapshot); }

private:
    // What the follower leads: the stream, and the count beside it.
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
