#pragma once

// Many trackers, moved by worker threads.
//
//     post(id, point) --> latest point --> ready queue --> a worker: move_to --> outbox --> take(id)
//     camera, lights      latest_value.h   ready_queue.h                      change_outbox.h   renderer
//
// Post the current points, draw, and take the changes when the next frame begins. The service computes
// frame t + 1 while frame t is drawn. It guarantees:
//
//   Posting does not wait. The newest point replaces an older one unless a worker has started with it.
//   Workers hold no lock that post() needs: the point goes through a wait-free mailbox, the tracker
//   through a lock-free queue. Only threads that post to the *same* tracker at once wait, for one copy.
//
//   Change sets are in order, without gaps. One worker at a time moves a tracker. Change sets have
//   sequence numbers per tracker, and each follows its predecessor. For a slow consumer the number of
//   pending change sets is bounded: the tracker waits and later makes one larger move
//   (change_outbox.h). Only if memory runs out is there a gap, and take() reports it.
//
//   The whole state is available at any time. snapshot() returns the slots and face words of one
//   sequence and drops pending change sets up to it. A consumer starts with it, and restarts with it.
//
//   No tracker starves. Trackers with new points are moved in the order in which they became ready. A
//   tracker with a newer point goes to the end of the queue.
//
// Any thread may call any function at any time, also on the same tracker. All other calls must have
// returned before the destructor runs. stop() makes waiting calls return. A tracker must have only one
// consumer, because each change set can be taken only once.

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/service/published_change.h"

namespace rimline {

class ReadyQueue;

struct SilhouetteServiceOptions {
    /// Worker threads. 0: one less than the number of hardware threads, but at least one.
    std::uint32_t workers = 0;
    /// Maximum number of pending change sets per tracker. At this number the tracker waits. Not 0.
    std::uint32_t max_pending = 4;
};

/// Counts since the construction of the service. While it works, they may be inconsistent with each
/// other.
struct SilhouetteServiceCounters {
    std::uint64_t posts = 0;       ///< Points accepted.
    std::uint64_t superseded = 0;  ///< Points replaced by newer ones before a worker started.
    std::uint64_t moves = 0;
    std::uint64_t lost = 0;  ///< Moves whose change sets were lost because memory ran out.
};

class SilhouetteService {
public:
    /// Starts the workers, as many of them as the system can start. Throws Error{io} if it cannot start one.
    explicit SilhouetteService(const SilhouetteServiceOptions& options = {});
    /// Calls stop() and removes all trackers. No thread may be in a call or a wait.
    ~SilhouetteService();
    SilhouetteService(const SilhouetteService&) = delete;
    SilhouetteService& operator=(const SilhouetteService&) = delete;

    /// Creates a tracker on the calling thread. Throws what SilhouetteTracker's constructor throws,
    /// Error{too_large} beyond 16,384 trackers, and Error{cancelled} after stop(). `octree` must exist
    /// until the tracker is removed or the service destroyed. Trackers may share it. Call snapshot()
    /// first. Its sequence is 0 unless a point was posted before.
    TrackerId add(const HoughOctree& octree, const HomogeneousPoint& point);
    TrackerId add(HoughOctree&&, const HomogeneousPoint&) = delete;  // `octree` must outlive this.

    /// Waits if a worker is moving the tracker. Afterwards no thread uses the octree for it. Drops
    /// pending change sets. Returns false, without effect, if it was removed before.
    bool remove(TrackerId id);

    /// Requests a move of the tracker to `point`, which must be valid. O(1), see above. Returns false,
    /// without effect, if the tracker was removed or the service stopped.
    bool post(TrackerId id, const HomogeneousPoint& point) noexcept;

    /// Swaps the tracker's next change set into `change`. Does not wait for workers. Published change
    /// sets can still be taken after stop().
    Taken take(TrackerId id, PublishedChange& change) noexcept;

    /// Returns the tracker's whole state between two moves, and drops change sets up to its sequence.
    /// Waits if a worker is moving the tracker. Returns false, without effect, if the tracker was
    /// removed. Throws std::bad_alloc, and then drops nothing.
    bool snapshot(TrackerId id, SilhouetteSnapshot& snapshot);

    /// Memory reserved by the tracker (SilhouetteTracker::size_bytes()). Moves do not change it. Waits if
    /// a worker is moving the tracker. Returns 0 if it was removed.
    std::uint64_t size_bytes(TrackerId id) noexcept;

    /// Sleeps until take() would succeed. Returns false if the tracker was removed, or if the service was
    /// stopped and nothing is pending.
    bool wait_for_change(TrackerId id) noexcept;

    /// Sleeps until no worker has work, or until stop(). Each earlier point is then reached, superseded,
    /// or blocked by a consumer that does not take.
    void wait_idle() noexcept;

    /// Ends all waits, and each worker after its current move. Drops points that were not reached.
    /// Returns when all workers have ended. Further calls have no effect.
    void stop() noexcept;

    SilhouetteServiceCounters counters() const noexcept;
    std::uint32_t worker_count() const noexcept { return worker_count_; }

private:
    struct Slot;
    // Slots are allocated in blocks, which exist until destruction, so post() finds slots without a lock.
    struct SlotBlock;

    static constexpr std::uint32_t k_slots_a_block = 64;
    static constexpr std::uint32_t k_max_blocks = 256;

    Slot& slot(std::uint32_t index) noexcept;
    Slot& slot(TrackerId id) noexcept;
    std::uint32_t claim_slot();
    void schedule(Slot& slot) noexcept;
    void count_unscheduled() noexcept;
    void work() noexcept;
    void move(Slot& slot) noexcept;
    void give_back(Slot& slot) noexcept;

    const std::uint32_t max_pending_;
    std::uint32_t worker_count_ = 0;
    std::array<std::atomic<SlotBlock*>, k_max_blocks> blocks_{};
    const std::unique_ptr<ReadyQueue> ready_;
    std::atomic<bool> stopped_{false};

    std::mutex slots_mutex_;  // Protects the assignment of slots.
    std::uint32_t slot_count_ = 0;
    std::vector<std::uint32_t> free_slots_;

    std::mutex stop_mutex_;  // Taken by stop() only.
    std::vector<std::thread> workers_;

    std::atomic<std::uint32_t> scheduled_{0};  // Slots in the queue or at a worker.
    std::mutex idle_mutex_;
    std::condition_variable idle_;
    std::atomic<std::uint32_t> waiting_{0};  // Threads in wait_for_change() and wait_idle().

    std::atomic<std::uint64_t> posts_{0};
    std::atomic<std::uint64_t> superseded_{0};
    std::atomic<std::uint64_t> moves_{0};
    std::atomic<std::uint64_t> lost_{0};
};

}  // namespace rimline
