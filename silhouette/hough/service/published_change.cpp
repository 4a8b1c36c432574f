#include "silhouette/hough/service/published_change.h"

#include <span>

#include "silhouette/hough/silhouette_tracker.h"

namespace rimline {

namespace {

template <typename T>
void copy(std::span<const T> from, std::vector<T>& to) {
    // Sizes differ between frames. Without extra capacity, every new maximum would allocate.
    if (from.size() > to.capacity()) {
        to.clear();
        to.reserve(from.size() + from.size() / 2);
    }
    to.assign(from.begin(), from.end());
}

}  // namespace

ChangeSet PublishedChange::view() const noexcept {
    ChangeSet changes = changes_;
    changes.flipped = flipped_;
    changes.added = added_;
    changes.removed = removed_;
    changes.slots = slots_;
    changes.words = words_;
    return changes;
}

void PublishedChange::assign(const ChangeSet& changes, Clock::time_point posted) {
    copy(changes.flipped, flipped_);
    copy(changes.added, added_);
    copy(changes.removed, removed_);
    copy(changes.slots, slots_);
    copy(changes.words, words_);
    changes_.point = changes.point;
    changes_.sequence = changes.sequence;
    changes_.silhouette_size = changes.silhouette_size;
    changes_.counters = changes.counters;
    posted_ = posted;
}

void SilhouetteSnapshot::assign(const SilhouetteTracker& tracker) {
    copy(tracker.silhouette(), slots);
    copy(tracker.face_words(), words);
    point = tracker.point();
    sequence = tracker.sequence();
}

}  // namespace rimline
