#pragma once

// A queue of nodes that have work. Any thread pushes without a lock. Workers pop, and sleep while the queue
// is empty.
//
//     push --> incoming_, a lock-free stack --reversed, all at once--> first_, the workers' list
//
// Workers empty their list before they read `incoming_`. A node that is pushed again after each piece of work
// therefore waits for all others, so no node starves. push() never takes the workers' lock.
//
// Waking a thread is a system call that takes microseconds, a hundred times more than a push. A burst of
// pushes needs only one. So no thread wakes a worker while another woken worker has not yet arrived. A worker
// that arrives and finds more than one node wakes the next worker.

#include <semaphore.h>

#include <atomic>
#include <cstdint>
#include <mutex>

namespace rimline {

/// A POSIX semaphore. That of libstdc++ loses wake-ups (its bugs 98033 and 104928): a thread may sleep
/// although the count has just become positive.
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
    /// Base class of elements. An element may be in the queue only once at a time, and must not move while it
    /// is there.
    struct Node {
        Node* next_ready = nullptr;
    };

    /// May be called from any thread. Never waits. Wakes a sleeping worker unless one is already on its way.
    void push(Node& node) noexcept;
    /// Returns the oldest element. Sleeps while the queue is empty. Returns null after close(), even if
    /// elements are left.
    Node* pop() noexcept;
    /// Ends all present and future calls of pop().
    void close() noexcept;

private:
    Node* take() noexcept;
    bool is_empty() noexcept;
    bool withdraw() noexcept;
    void wake_one() noexcept;

    // A bit of `sleepers_`: a worker was woken and has not arrived. The other bits are the number of
    // sleepers.
    static constexpr std::uint32_t k_worker_woken = 0x80000000u;

    std::atomic<Node*> incoming_{nullptr};
    std::atomic<std::uint32_t> sleepers_{0};
    std::atomic<bool> closed_{false};
    CountingSemaphore wakeups_;
    std::mutex mutex_;  // Taken by workers only.
    Node* first_ = nullptr;
};

}  // namespace rimline
