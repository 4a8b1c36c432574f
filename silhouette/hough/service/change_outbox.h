#pragma once

// A bounded queue of the change sets of one tracker, from the worker that makes them to the consumer that
// takes them. They are in order, and none is missing.
//
//     worker --publish--> [ 7 | 8 | 9 |   ] --take--> consumer        (numbers are sequences)
//                           ^ first       ^ next, which the worker fills
//
// If the consumer is slow and all places are full, the worker does not move the tracker until a place is
// free. Meanwhile newer points replace older ones, so the tracker then makes one large move instead of
// many. The silhouette is late, but every change set still follows its predecessor. (The alternative is
// to drop change sets. A slow consumer would then have to process a whole state, which costs even more.)
//
// take() swaps buffers and does not copy: the consumer's old buffers go to the place.
//
// A change set is lost if memory runs out. Earlier ones can still be taken, and later ones are dropped.
// take() then reports the gap until the consumer takes a snapshot.

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <vector>

#include "silhouette/hough/service/published_change.h"

namespace rimline {

/// Any thread may call take(), wait() and end_waits(). Only the thread that owns the tracker at the
/// moment may call the other functions.
class ChangeOutbox {
public:
    explicit ChangeOutbox(std::uint32_t capacity) : places_(capacity) {}

    /// Empties the queue for a new tracker. Consumers of the old one learn that it was removed.
    void open(TrackerId owner) noexcept;
    void close() noexcept { open(k_no_tracker); }
    /// Frees the buffers, so that the buffers of a large model do not remain for a tracker of a small
    /// one. Call it after close(), when no thread uses the places. It takes no lock, so no thread waits
    /// while memory is freed.
    void free_buffers() noexcept;
    /// Ends all present and future waits.
    void end_waits() noexcept;

    bool has_room() const noexcept;
    /// Copies `changes`. Requires has_room(). Returns false if the change set is lost.
    bool publish(const ChangeSet& changes, PublishedChange::Clock::time_point posted) noexcept;
    /// Drops all pending change sets and the gap, because the consumer gets the whole state. Returns true
    /// if all places were full.
    bool drop_pending() noexcept;

    struct TakeResult {
        Taken taken;
        bool made_room;  ///< All places were full before.
    };
    TakeResult take(TrackerId owner, PublishedChange& change) noexcept;
    /// Waits until take() would not return `nothing`. Returns false if `owner` was removed or waits were
    /// ended.
    bool wait(TrackerId owner) noexcept;

private:
    bool is_full() const noexcept { return count_ == places_.size(); }

    mutable std::mutex mutex_;  // Held briefly: no copy, allocation or free under it.
    std::condition_variable published_;
    std::vector<PublishedChange> places_;
    std::size_t next_ = 0;   // Place to fill; used by the worker only. The used places end here.
    std::size_t count_ = 0;  // Used places.
    TrackerId owner_ = k_no_tracker;
    bool lost_ = false;
    bool waits_ended_ = false;
};

}  // namespace rimline
