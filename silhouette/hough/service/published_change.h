#pragma once

// What a SilhouetteService hands out: change sets and whole states that own what they show.
//
// A tracker's change set is gone when the tracker moves again, and here another thread moves it. So
// what is published is a copy. Its memory is kept and used again: give the same object to the next
// take() or snapshot(), and after some frames nothing is allocated any more.

#include <chrono>
#include <cstdint>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/hough/silhouette_tracker.h"

namespace rimline {

/// A tracker in a service. Ids are not used again: one of a tracker that was removed stays invalid.
enum class TrackerId : std::uint64_t {};

/// No tracker's.
constexpr TrackerId k_no_tracker{0};

class PublishedChange {
public:
    using Clock = std::chrono::steady_clock;

    /// Shows what this object holds; the spans live until it is assigned to, taken into or destroyed.
    ChangeSet view() const noexcept;

    Clock::time_point posted() const noexcept { return posted_; }
    Clock::time_point published() const noexcept { return published_; }

    /// Copies `changes`. Allocates only for more than was ever held before, and then half as much
    /// again. Throws std::bad_alloc; what is held is then neither the old nor the new.
    void assign(const ChangeSet& changes, Clock::time_point posted);
    /// Says that this is published now.
    void stamp() noexcept { published_ = Clock::now(); }

private:
    ChangeSet changes_;  // Without its spans.
    std::vector<FaceId> flipped_;
    std::vector<EdgeId> added_;
    std::vector<EdgeId> removed_;
    std::vector<SlotWrite> slots_;
    std::vector<WordWrite> words_;
    Clock::time_point posted_{};
    Clock::time_point published_{};
};

/// All that a consumer holds of one tracker: what the change set of `sequence` led to. The one of
/// sequence + 1 can be applied to it.
struct SilhouetteSnapshot {
    HomogeneousPoint point{};
    std::uint64_t sequence = 0;
    std::vector<EdgeId> slots;
    std::vector<std::uint32_t> words;

    /// Copies the tracker's state. Throws std::bad_alloc.
    void assign(const SilhouetteTracker& tracker);
};

}  // namespace rimline
