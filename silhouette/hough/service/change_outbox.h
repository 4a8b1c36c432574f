#pragma once

// The change sets of one tracker between the worker that makes them and the consumer that takes them:
// bounded, in order, and never one missing in between.
//
//     worker --publish--> [ 7 | 8 | 9 |   ] --take--> consumer        (numbers are sequences)
//                           ^ first       ^ next, the worker's to fill
//
// When the consumer falls behind and all places are taken, the worker does not move the tracker until
// there is room again. Newer points replace each other meanwhile, so the tracker then makes one large
// move in the place of many: the silhouette comes late, and every change set still follows on the one
// before. (To drop change sets instead would force a whole state on a consumer that was only slow, and
// that is when it can least afford one.)
//
// What is taken is exchanged, not copied: the consumer's old buffers become the place's new ones.
//
// One change set can be lost for want of memory. Then those before it can still be taken, those after
// it are not kept, and the consumer is told of the gap until it has taken a snapshot.

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <vector>

#include "silhouette/hough/service/published_change.h"

namespace rimline {

/// What SilhouetteService::take() came back with.
enum class Taken {
    nothing,  ///< The consumer has it all.
    change,   ///< The next change set.
    gap,      ///< The next change set was lost. Only snapshot() leads on.
    removed,  ///< There is no such tracker any more.
};

/// take(), wait() and end_waits() are for any thread. The rest is for whoever has the tracker at the
/// moment, one thread at a time.
class ChangeOutbox {
public:
    explicit ChangeOutbox(std::uint32_t capacity) : places_(capacity) {}

    /// Empties the box for a new tracker; the old one's consumers are told that it is gone.
    void open(TrackerId owner) noexcept;
    void close() noexcept { open(k_no_tracker); }
    /// After close(), with which nobody looks at the places any more: a large model's buffers do not stay
    /// with a small one's tracker. Takes no lock, so that nobody waits for memory to be freed.
    void free_buffers() noexcept;
    /// Ends all waits, now and later.
    void end_waits() noexcept;

    bool has_room() const noexcept;
    /// Copies `changes`; there must be room. False when the change set is lost.
    bool publish(const ChangeSet& changes, PublishedChange::Clock::time_point posted) noexcept;
    /// Drops all that is pending, and the gap: the consumer gets the whole state. True when there was
    /// no room before.
    bool drop_pending() noexcept;

    struct TakeResult {
        Taken taken;
        bool made_room;  ///< There was none before.
    };
    TakeResult take(TrackerId owner, PublishedChange& change) noexcept;
    /// Waits until take() would return something else than `nothing`. False when it will not: `owner`
    /// is gone, or waits were ended.
    bool wait(TrackerId owner) noexcept;

private:
    bool is_full() const noexcept { return count_ == places_.size(); }

    mutable std::mutex mutex_;  // For moments: nothing is copied, allocated or freed under it.
    std::condition_variable published_;
    std::vector<PublishedChange> places_;
    std::size_t next_ = 0;   // Where to publish. The worker's alone; the places in use end there.
    std::size_t count_ = 0;  // Places in use.
    TrackerId owner_ = k_no_tracker;
    bool lost_ = false;
    bool waits_ended_ = false;
};

}  // namespace rimline
