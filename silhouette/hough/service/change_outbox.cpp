#include "silhouette/hough/service/change_outbox.h"

#include <new>
#include <utility>

namespace rimline {

void ChangeOutbox::open(TrackerId owner) noexcept {
    {
        const std::lock_guard lock(mutex_);
        next_ = 0;
        count_ = 0;
        owner_ = owner;
        lost_ = false;
    }
    published_.notify_all();
}

void ChangeOutbox::free_buffers() noexcept {
    for (PublishedChange& place : places_) place = PublishedChange();
}

void ChangeOutbox::end_waits() noexcept {
    {
        const std::lock_guard lock(mutex_);
        waits_ended_ = true;
    }
    published_.notify_all();
}

bool ChangeOutbox::has_room() const noexcept {
    const std::lock_guard lock(mutex_);
    return !is_full();
}

bool ChangeOutbox::publish(const ChangeSet& changes,
                           PublishedChange::Clock::time_point posted) noexcept {
    {
        const std::lock_guard lock(mutex_);
        if (lost_) return false;
    }
    // Needs no lock: take() reads only used places.
    bool copied = true;
    try {
        places_[next_].assign(changes, posted);
        places_[next_].stamp();
    } catch (const std::bad_alloc&) {
        copied = false;
    }
    {
        const std::lock_guard lock(mutex_);
        if (copied) {
            next_ = (next_ + 1) % places_.size();
            ++count_;
        } else {
            lost_ = true;
        }
    }
    published_.notify_all();
    return copied;
}

bool ChangeOutbox::drop_pending() noexcept {
    const std::lock_guard lock(mutex_);
    const bool was_full = is_full();
    count_ = 0;
    lost_ = false;
    return was_full;
}

ChangeOutbox::TakeResult ChangeOutbox::take(TrackerId owner, PublishedChange& change) noexcept {
    const std::lock_guard lock(mutex_);
    if (owner_ != owner) return {Taken::removed, false};
    if (count_ == 0) return {lost_ ? Taken::gap : Taken::nothing, false};
    const bool was_full = is_full();
    std::swap(change, places_[(next_ + places_.size() - count_) % places_.size()]);
    --count_;
    return {Taken::change, was_full};
}

bool ChangeOutbox::wait(TrackerId owner) noexcept {
    std::unique_lock lock(mutex_);
    published_.wait(lock, [&] { return owner_ != owner || count_ > 0 || lost_ || waits_ended_; });
    return owner_ == owner && (count_ > 0 || lost_);
}

}  // namespace rimline
