#pragma once

// The output of a SilhouetteService: change sets and whole states that own their data.
//
// A tracker's change set is invalid after the next move, and in a service another thread moves the
// tracker. So the service publishes copies. They reuse their memory: pass the same object to the next
// take() or snapshot(), and after some frames no call allocates.

#include <chrono>
#include <cstdint>
#include <vector>

#include "silhouette/hough/change_set.h"

namespace rimline {

class SilhouetteTracker;

/// A tracker in a service. Ids are not reused: the id of a removed tracker stays invalid.
enum class TrackerId : std::uint64_t {};

/// The id of no tracker, for a variable that has none yet. The service takes only ids that add() returned, before or
/// after remove(): this one stops the program.
constexpr TrackerId k_no_tracker{0};

/// The result of SilhouetteService::take().
enum class Taken {
    nothing,  ///< Nothing is pending.
    change,   ///< The next change set.
    gap,      ///< The next change set was lost. The consumer must call snapshot().
    removed,  ///< The tracker was removed.
};

class PublishedChange {
public:
    using Clock = std::chrono::steady_clock;

    /// A view of this object's data. Its spans are valid until this object is assigned, passed to
    /// take() or destroyed.
    ChangeSet view() const noexcept;

    Clock::time_point posted() const noexcept { return posted_; }
    Clock::time_point published() const noexcept { return published_; }

    /// Copies `changes`. Allocates only if a size exceeds its previous maximum, and then 50% more
    /// than needed. Throws std::bad_alloc; the contents are then undefined.
    void assign(const ChangeSet& changes, Clock::time_point posted);
    /// Sets the time of publication to now.
    void stamp() noexcept { published_ = Clock::now(); }

private:
    ChangeSet changes_;  // Its spans are unused.
    std::vector<FaceId> flipped_;
    std::vector<EdgeId> added_;
    std::vector<EdgeId> removed_;
    std::vector<SlotWrite> slots_;
    std::vector<WordWrite> words_;
    Clock::time_point posted_{};
    Clock::time_point published_{};
};

/// The whole state of one tracker after the change set of `sequence`. The change set of sequence + 1
/// can be applied to it.
struct SilhouetteSnapshot {
    HomogeneousPoint point{};
    std::uint64_t sequence = 0;
    std::vector<EdgeId> slots;
    std::vector<std::uint32_t> words;

    /// Copies the tracker's state. Throws std::bad_alloc.
    void assign(const SilhouetteTracker& tracker);
};

}  // namespace rimline
