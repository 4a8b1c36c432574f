#pragma once

// A mailbox for one value. A newer value replaces an older one that was not read.
//
// It is a triple buffer: the writer owns one place, the reader owns one, and the third is the middle.
// store() fills the writer's place and exchanges it for the middle one. take() exchanges the reader's
// place for the middle one. Both are wait-free: an interrupted writer does not block the reader, and
// an interrupted reader does not block the writer. (With a lock, a thread that is preempted during the
// copy would block the other for a time slice. With two places, both could access the same place.)
//
//     writer  [ back ] --store-->  [ middle | unread ]  --take--> [ front ]  reader
//
// One thread at a time may store, and one thread at a time may take.

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace rimline {

template <typename Value>
class LatestValue {
    static_assert(std::is_nothrow_copy_assignable_v<Value>);

public:
    /// Returns true if `value` replaces one that was not taken.
    bool store(const Value& value) noexcept {
        places_[back_] = value;
        const std::uint8_t old = middle_.exchange(static_cast<std::uint8_t>(back_ | k_unread),
                                                  std::memory_order_acq_rel);
        back_ = old & k_place;
        return (old & k_unread) != 0;
    }

    /// Returns false and leaves `value` unchanged if nothing was stored since the last call.
    bool take(Value& value) noexcept {
        if (!has_unread()) return false;
        front_ = middle_.exchange(front_, std::memory_order_acq_rel) & k_place;
        value = places_[front_];
        return true;
    }

    /// Whether take() would succeed now. Any thread may call this.
    bool has_unread() const noexcept {
        return (middle_.load(std::memory_order_acquire) & k_unread) != 0;
    }

private:
    static constexpr std::uint8_t k_place = 3;
    static constexpr std::uint8_t k_unread = 4;

    std::array<Value, 3> places_{};
    std::uint8_t back_ = 0;                // The writer's place.
    std::atomic<std::uint8_t> middle_{1};  // Place number and unread bit.
    std::uint8_t front_ = 2;               // The reader's place.
};

}  // namespace rimline
