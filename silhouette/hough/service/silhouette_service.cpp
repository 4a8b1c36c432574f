#include "silhouette/hough/service/silhouette_service.h"

#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "silhouette/hough/service/change_outbox.h"
#include "silhouette/hough/service/latest_value.h"
#include "silhouette/hough/service/ready_queue.h"
#include "silhouette/hough/silhouette_tracker.h"

namespace rimline {

namespace {

std::uint32_t worker_count(std::uint32_t asked) noexcept {
    if (asked > 0) return asked;
    const std::uint32_t at_once = std::thread::hardware_concurrency();  // 0 when unknown.
    return at_once > 1 ? at_once - 1 : 1;
}

// The slot's number, and the number of its uses, from 1.
constexpr TrackerId make_id(std::uint32_t use, std::uint32_t index) noexcept {
    return TrackerId{std::uint64_t{use} << 32 | index};
}
constexpr std::uint32_t index_of(TrackerId id) noexcept { return static_cast<std::uint32_t>(id); }

}  // namespace

// A slot holds one tracker after another. The tracker may change after a thread finds the slot by an
// old id or pops it from the queue. Such a thread checks `owner` again under one of two locks, which
// protect:
//
//     posting   writing to the mailbox; never held by a worker
//     moving    the tracker, reading from the mailbox, writing to the outbox
//
// `owner` is written under both and read under either. `posting` and the outbox's lock are taken
// inside `moving`, never in the opposite order. Each slot has its own cache lines, to make post() fast.
struct alignas(64) SilhouetteService::Slot : ReadyQueue::Node {
    struct Posted {
        HomogeneousPoint point{};
        PublishedChange::Clock::time_point time{};
    };

    explicit Slot(std::uint32_t max_pending) : outbox(max_pending) {}

    std::mutex posting;
    LatestValue<Posted> latest;
    // Whether the slot is in the queue or at a worker. So at most one worker has it.
    std::atomic<bool> scheduled{false};

    std::mutex moving;
    std::optional<SilhouetteTracker> tracker;
    TrackerId owner = k_no_tracker;
    std::uint32_t uses = 0;
    ChangeOutbox outbox;
};

struct SilhouetteService::SlotBlock {
    explicit SlotBlock(std::uint32_t max_pending) {
        slots.reserve(k_slots_a_block);
        for (std::uint32_t i = 0; i < k_slots_a_block; ++i)
            slots.push_back(std::make_unique<Slot>(max_pending));
    }
    std::vector<std::unique_ptr<Slot>> slots;
};

SilhouetteService::SilhouetteService(const SilhouetteServiceOptions& options)
    : max_pending_(options.max_pending), ready_(std::make_unique<ReadyQueue>()) {
    RIMLINE_CHECK(options.max_pending > 0);
    const std::uint32_t wanted = rimline::worker_count(options.workers);
    workers_.reserve(wanted);
    try {
        while (workers_.size() < wanted) workers_.emplace_back([this] { work(); });
    } catch (const std::system_error& error) {
        if (workers_.empty())
            throw Error(ErrorCode::io,
                        std::string("cannot start a worker thread: ") + error.what());
    } catch (...) {
        stop();
        throw;
    }
    worker_count_ = static_cast<std::uint32_t>(workers_.size());
}

SilhouetteService::~SilhouetteService() {
    RIMLINE_CHECK(waiting_ == 0);
    stop();
    for (const std::atomic<SlotBlock*>& block : blocks_) delete block.load();
}

TrackerId SilhouetteService::add(const HoughOctree& octree, const HomogeneousPoint& point) {
    SilhouetteTracker tracker(octree, point);
    const std::uint32_t index = claim_slot();
    Slot& place = slot(index);
    const std::scoped_lock lock(place.moving, place.posting);
    place.tracker.emplace(std::move(tracker));
    place.owner = make_id(++place.uses, index);
    place.outbox.open(place.owner);
    return place.owner;
}

bool SilhouetteService::remove(TrackerId id) {
    Slot& place = slot(id);
    std::optional<SilhouetteTracker> tracker;
    {
        const std::lock_guard moving(place.moving);
        {
            const std::lock_guard posting(place.posting);
            if (place.owner != id) return false;
            place.owner = k_no_tracker;
            // Freeing its memory takes time, so it happens outside the locks.
            place.tracker.swap(tracker);
            Slot::Posted dropped;
            place.latest.take(dropped);  // The next tracker must not move there.
            place.outbox.close();
        }
        place.outbox.free_buffers();
    }
    // The slot may still be scheduled. The worker that pops it finds no tracker, or the next one. This
    // is harmless: the next one has no new point, or it is scheduled for that point anyway.
    const std::lock_guard lock(slots_mutex_);
    free_slots_.push_back(index_of(id));
    return true;
}

bool SilhouetteService::post(TrackerId id, const HomogeneousPoint& point) noexcept {
    RIMLINE_CHECK(point.is_valid());
    Slot& place = slot(id);
    const Slot::Posted posted{point, PublishedChange::Clock::now()};
    bool superseded = false;
    {
        const std::lock_guard posting(place.posting);
        if (place.owner != id || stopped_) return false;
        superseded = place.latest.store(posted);
    }
    schedule(place);
    posts_.fetch_add(1, std::memory_order_relaxed);
    if (superseded) superseded_.fetch_add(1, std::memory_order_relaxed);
    return true;
}

Taken SilhouetteService::take(TrackerId id, PublishedChange& change) noexcept {
    Slot& place = slot(id);
    const ChangeOutbox::TakeResult result = place.outbox.take(id, change);
    // A worker that found no room has skipped the tracker. A worker that takes the outbox's lock after
    // this call finds room.
    if (result.made_room && place.latest.has_unread()) schedule(place);
    return result.taken;
}

bool SilhouetteService::snapshot(TrackerId id, SilhouetteSnapshot& snapshot) {
    Slot& place = slot(id);
    bool made_room = false;
    {
        const std::lock_guard moving(place.moving);
        if (place.owner != id) return false;
        snapshot.assign(*place.tracker);
        made_room = place.outbox.drop_pending();
    }
    if (made_room && place.latest.has_unread()) schedule(place);
    return true;
}

std::uint64_t SilhouetteService::size_bytes(TrackerId id) noexcept {
    Slot& place = slot(id);
    const std::lock_guard moving(place.moving);
    return place.owner == id ? place.tracker->size_bytes() : 0;
}

bool SilhouetteService::wait_for_change(TrackerId id) noexcept {
    Slot& place = slot(id);
    ++waiting_;
    const bool has_change = place.outbox.wait(id);
    --waiting_;
    return has_change;
}

void SilhouetteService::wait_idle() noexcept {
    ++waiting_;
    {
        std::unique_lock lock(idle_mutex_);
        idle_.wait(lock, [this] { return scheduled_ == 0 || stopped_; });
    }
    --waiting_;
}

void SilhouetteService::stop() noexcept {
    const std::lock_guard lock(stop_mutex_);
    stopped_ = true;
    ready_->close();
    for (std::thread& worker : workers_) worker.join();
    workers_.clear();
    {
        // For the same reason as in count_unscheduled().
        const std::lock_guard idle(idle_mutex_);
    }
    idle_.notify_all();
    const std::lock_guard slots(slots_mutex_);
    for (std::uint32_t i = 0; i < slot_count_; ++i) slot(i).outbox.end_waits();
}

SilhouetteServiceCounters SilhouetteService::counters() const noexcept {
    return {posts_, superseded_, moves_, lost_};
}

SilhouetteService::Slot& SilhouetteService::slot(std::uint32_t index) noexcept {
    SlotBlock* block = blocks_[index / k_slots_a_block].load(std::memory_order_acquire);
    RIMLINE_CHECK(block != nullptr);
    return *block->slots[index % k_slots_a_block];
}

SilhouetteService::Slot& SilhouetteService::slot(TrackerId id) noexcept {
    RIMLINE_CHECK(id != k_no_tracker && index_of(id) < k_slots_a_block * k_max_blocks);
    return slot(index_of(id));
}

std::uint32_t SilhouetteService::claim_slot() {
    const std::lock_guard lock(slots_mutex_);
    // Tested under the lock, because stop() ends the waits of all slots claimed before.
    if (stopped_) throw Error(ErrorCode::cancelled, "the silhouette service has been stopped");
    if (!free_slots_.empty()) {
        const std::uint32_t index = free_slots_.back();
        free_slots_.pop_back();
        return index;
    }
    if (slot_count_ == k_slots_a_block * k_max_blocks)
        throw Error(ErrorCode::too_large, "a silhouette service holds " +
                                              std::to_string(slot_count_) + " trackers at most");
    if (slot_count_ % k_slots_a_block == 0) {
        free_slots_.reserve(slot_count_ + k_slots_a_block);  // remove() does not allocate.
        blocks_[slot_count_ / k_slots_a_block].store(new SlotBlock(max_pending_),
                                                     std::memory_order_release);
    }
    return slot_count_++;
}

void SilhouetteService::schedule(Slot& slot) noexcept {
    ++scheduled_;  // Before the exchange: a caller that finds the slot scheduled may next call wait_idle().
    if (slot.scheduled.exchange(true, std::memory_order_acq_rel))
        count_unscheduled();
    else
        ready_->push(slot);
}

void SilhouetteService::count_unscheduled() noexcept {
    if (--scheduled_ > 0) return;
    {
        // The empty critical section ensures that every waiter sees either the count or the
        // notification.
        const std::lock_guard lock(idle_mutex_);
    }
    idle_.notify_all();
}

void SilhouetteService::work() noexcept {
    while (ReadyQueue::Node* node = ready_->pop()) {
        Slot& slot = static_cast<Slot&>(*node);
        move(slot);
        give_back(slot);
    }
}

void SilhouetteService::move(Slot& slot) noexcept {
    // Never contended between workers. It excludes snapshot() and remove().
    const std::lock_guard moving(slot.moving);
    Slot::Posted posted;
    if (!slot.tracker || !slot.outbox.has_room() || !slot.latest.take(posted)) return;
    const ChangeSet& changes = slot.tracker->move_to(posted.point);
    moves_.fetch_add(1, std::memory_order_relaxed);
    if (!slot.outbox.publish(changes, posted.time)) lost_.fetch_add(1, std::memory_order_relaxed);
}

void SilhouetteService::give_back(Slot& slot) noexcept {
    // A thread that posted or made room while the slot was scheduled has not scheduled it again. Its
    // exchange in schedule() came before this one, so its earlier writes are visible below.
    slot.scheduled.exchange(false, std::memory_order_acq_rel);
    if (slot.latest.has_unread() && slot.outbox.has_room()) schedule(slot);
    count_unscheduled();
}

}  // namespace rimline
