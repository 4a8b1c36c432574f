#pragma once

// A mailbox for one value, where a newer one replaces an older one that nobody has read.
//
// Three places: the writer owns one, the reader owns one, and the third lies between them. To store is
// to fill the writer's place and exchange it for the middle one, to take is to exchange the reader's
// place for the middle one, so both are wait-free: a writer that is stopped half way through holds up
// no reader, nor the other way round. (Under a lock for a copy of some bytes, a thread that loses its
// processor there holds up the other for a time slice; two places would let them meet.)
//
//     writer  [ back ] --store-->  [ middle | unread ]  --take--> [ front ]  reader
//
// One thread at a time stores, one thread at a time takes.

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace rimline {

template <typename Value>
class LatestValue {
    static_assert(std::is_nothrow_copy_assignable_v<Value>);

public:
    /// True when `value` replaces one that was never taken.
    bool store(const Value& value) noexcept {
        places_[back_] = value;
        const std::uint8_t old = middle_.exchange(static_cast<std::uint8_t>(back_ | k_unread),
                                                  std::memory_order_acq_rel);
        back_ = old & k_place;
        return (old & k_unread) != 0;
    }

    /// False, and `value` as it was, when nothing was stored since the last call.
    bool take(Value& value) noexcept {
        if (!has_unread()) return false;
        front_ = middle_.exchange(front_, std::memory_order_acq_rel) & k_place;
        value = places_[front_];
        return true;
    }

    /// Whether the reader would get something now. Any thread may ask.
    bool has_unread() const noexcept {
        return (middle_.load(std::memory_order_acquire) & k_unread) != 0;
    }

private:
    static constexpr std::uint8_t k_place = 3;
    static constexpr std::uint8_t k_unread = 4;

    std::array<Value, 3> places_{};
    std::uint8_t back_ = 0;                // The writer's.
    std::atomic<std::uint8_t> middle_{1};  // A place, and whether it is unread.
    std::uint8_t front_ = 2;               // The reader's.
};

}  // namespace rimline
