#pragma once

// Who is to be worked on next: pushed from anywhere without a lock, popped by workers, which sleep
// while there is nothing.
//
//     push --> incoming, a stack without a lock --reversed, all at once--> first_, the workers' list
//
// Workers empty their list before they look at what came in, so whoever is pushed anew after every
// piece of work waits for all the others: nobody starves. Pushers never meet the workers' lock.
//
// Waking a thread is a system call of microseconds, more than a push by a hundred times, and a burst of
// pushes needs one, not one each: while a worker that was called has not arrived, nobody calls another.
// One that arrives and finds more than it takes calls the next.

#include <semaphore.h>

#include <atomic>
#include <cstdint>
#include <mutex>

namespace rimline {

/// POSIX's. libstdc++'s own loses wake-ups (its bugs 98033 and 104928): who read the count a moment ago may go
/// to sleep on one that is above zero.
class CountingSemaphore {
public:
    CountingSemaphore() noexcept;
    ~CountingSemaphore();
    CountingSemaphore(const CountingSemaphore&) = delete;
    CountingSemaphore& operator=(const CountingSemaphore&) = delete;

    void acquire() noexcept;
    void release() noexcept;

private:
    sem_t semaphore_;
};

class ReadyQueue {
public:
    /// What can be queued derives from this. It is in the queue at most once at a time, and stays
    /// where it is while there.
    struct Node {
        Node* next_ready = nullptr;
    };

    /// Any thread. Never waits; wakes a worker when one sleeps and none is on its way.
    void push(Node& node) noexcept;
    /// The longest in the queue. Sleeps while there is none. Null after close(), whatever is left.
    Node* pop() noexcept;
    /// Ends all calls of pop(), now and later.
    void close() noexcept;

private:
    Node* take() noexcept;
    bool is_empty() noexcept;
    bool withdraw() noexcept;
    void wake_one() noexcept;

    // The sleepers: their number, and whether a worker was called and has not arrived.
    static constexpr std::uint32_t k_on_its_way = 0x80000000u;

    std::atomic<Node*> incoming_{nullptr};
    std::atomic<std::uint32_t> sleepers_{0};
    std::atomic<bool> closed_{false};
    CountingSemaphore calls_;
    std::mutex mutex_;  // Among workers only.
    Node* first_ = nullptr;
};

}  // namespace rimline
