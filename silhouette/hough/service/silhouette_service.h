#pragma once

// Many trackers, moved by worker threads.
//
//     post(id, point) --> latest point --> ready queue --> a worker: move_to --> outbox --> take(id)
//     camera, lights      latest_value.h   ready_queue.h                      change_outbox.h   renderer
//
// Post where the points are now, draw, and take what changed when the next frame begins: the service
// computes frame t + 1 while frame t is drawn. Four promises:
//
//   Posting does not wait. The newest point replaces one that no worker has begun with. Workers hold
//   nothing that post() needs: the point goes through a wait-free mailbox, the tracker into a queue
//   without locks. Only threads that post to the *same* tracker at once take turns, for a copy.
//
//   In order, without gaps. A tracker is in the hands of one worker at a time, its change sets carry
//   its own sequence, and every one follows on the one before. A consumer that falls behind finds a
//   bounded number of them; the tracker then waits at its place and makes one larger move later
//   (change_outbox.h). The one exception is memory that runs out: that gap is told, not hidden.
//
//   A whole state at any time. snapshot() has the slots and face words of one sequence and drops what
//   is pending up to it: how a consumer begins, and begins anew.
//
//   Nobody starves. Trackers with new points are moved in the order in which they became ready, and
//   one that is posted to again queues behind all the others.
//
// All functions may be called from any thread at any time, those on one tracker too. The destructor
// must come after all other calls have returned; stop() makes those that wait return. A tracker has one
// consumer: of two that take from it each would miss what the other got.

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/service/change_outbox.h"
#include "silhouette/hough/service/published_change.h"
#include "silhouette/hough/service/ready_queue.h"

namespace rimline {

struct SilhouetteServiceOptions {
    /// Worker threads. 0: one less than the machine runs at once, and at least one.
    std::uint32_t workers = 0;
    /// Change sets a tracker that wait to be taken, before it waits itself. Not 0.
    std::uint32_t max_pending = 4;
};

/// What has been done since the service was made. Read while it works, the numbers need not fit
/// together.
struct SilhouetteServiceCounters {
    std::uint64_t posts = 0;       ///< Points accepted.
    std::uint64_t superseded = 0;  ///< Of these, replaced by newer ones before a worker began.
    std::uint64_t moves = 0;
    std::uint64_t lost = 0;  ///< Moves whose change sets were not published: memory ran out.
};

class SilhouetteService {
public:
    /// Starts the workers. Throws Error{io} when the system refuses a thread.
    explicit SilhouetteService(const SilhouetteServiceOptions& options = {});
    /// As stop(). Trackers still there are removed. Nobody may be in a call, nor in a wait.
    ~SilhouetteService();
    SilhouetteService(const SilhouetteService&) = delete;
    SilhouetteService& operator=(const SilhouetteService&) = delete;

    /// A new tracker, made on the calling thread: what SilhouetteTracker's constructor throws comes
    /// from here. `octree` must stay until the tracker is removed or the service destroyed; trackers
    /// may share it. Begin with snapshot(), whose sequence is 0 unless something was posted before.
    /// Throws Error{too_large} beyond 16,384 trackers, Error{cancelled} after stop().
    TrackerId add(const HoughOctree& octree, const HomogeneousPoint& point);
    TrackerId add(HoughOctree&&, const HomogeneousPoint&) = delete;  // It would be gone.

    /// Waits for the worker that moves the tracker, if one does; then nobody uses the octree for it any
    /// more. What is pending is dropped. False, and no effect, when it was removed before.
    bool remove(TrackerId id);

    /// The tracker is to go to `point`, which must be valid. O(1), see above. False, and no effect, when
    /// the tracker was removed or the service stopped.
    bool post(TrackerId id, const HomogeneousPoint& point) noexcept;

    /// The tracker's next change set, exchanged for what `change` held. Does not wait for workers. What
    /// was published can still be taken after stop().
    Taken take(TrackerId id, PublishedChange& change) noexcept;

    /// The tracker's whole state, between two moves; change sets up to its sequence are dropped. Waits
    /// for the worker that moves the tracker, if one does. False, and no effect, when the tracker was
    /// removed. Throws std::bad_alloc; nothing is dropped then.
    bool snapshot(TrackerId id, SilhouetteSnapshot& snapshot);

    /// Memory that the tracker has reserved (SilhouetteTracker::size_bytes()), which moves do not change.
    /// Waits for the worker that moves it, if one does. 0 when it was removed.
    std::uint64_t size_bytes(TrackerId id) noexcept;

    /// Sleeps until take() has something. False when it will not: the tracker was removed, or the
    /// service stopped and everything is taken.
    bool wait_for_change(TrackerId id) noexcept;

    /// Sleeps until no worker has anything to do: each point posted before was moved to, was
    /// superseded, or is held up by a consumer that does not take. Or until stop().
    void wait_idle() noexcept;

    /// Ends the workers, each after the move it is in, and all waits. Points not moved to are forgotten.
    /// Returns when the workers are gone; calling it again has no effect.
    void stop() noexcept;

    SilhouetteServiceCounters counters() const noexcept;
    std::uint32_t worker_count() const noexcept { return worker_count_; }

private:
    struct Slot;
    // Slots are made in blocks, which stay until the end: post() looks them up unlocked.
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
    const std::uint32_t worker_count_;
    std::array<std::atomic<SlotBlock*>, k_max_blocks> blocks_{};
    ReadyQueue ready_;
    std::atomic<bool> stopped_{false};

    std::mutex slots_mutex_;  // Who owns which slot.
    std::uint32_t slot_count_ = 0;
    std::vector<std::uint32_t> free_slots_;

    std::mutex stop_mutex_;  // Among callers of stop().
    std::vector<std::thread> workers_;

    std::atomic<std::uint32_t> scheduled_{0};  // Slots in the queue or in a worker's hands.
    std::mutex idle_mutex_;
    std::condition_variable idle_;
    std::atomic<std::uint32_t> waiting_{0};  // Threads in wait_for_change() and wait_idle().

    std::atomic<std::uint64_t> posts_{0};
    std::atomic<std::uint64_t> superseded_{0};
    std::atomic<std::uint64_t> moves_{0};
    std::atomic<std::uint64_t> lost_{0};
};

}  // namespace rimline
