#include "silhouette/hough/service/ready_queue.h"

#include <cerrno>

#include "silhouette/error.h"

namespace rimline {

CountingSemaphore::CountingSemaphore() noexcept { RIMLINE_CHECK(sem_init(&semaphore_, 0, 0) == 0); }

CountingSemaphore::~CountingSemaphore() { sem_destroy(&semaphore_); }

void CountingSemaphore::acquire() noexcept {
    int result = 0;
    do {
        result = sem_wait(&semaphore_);
    } while (result != 0 && errno == EINTR);  // Interrupted by a signal handler.
    RIMLINE_CHECK(result == 0);
}

void CountingSemaphore::release() noexcept { RIMLINE_CHECK(sem_post(&semaphore_) == 0); }

// These atomics need sequential consistency. A pusher writes incoming_ and then reads sleepers_. A
// worker writes sleepers_, when it goes to sleep or arrives, and then reads incoming_. At least one of
// the two must see the other's write.

void ReadyQueue::push(Node& node) noexcept {
    // No ABA problem: consumers only take the whole stack.
    node.next_ready = incoming_.load(std::memory_order_relaxed);
    while (!incoming_.compare_exchange_weak(node.next_ready, &node)) {
    }
    wake_one();
}

ReadyQueue::Node* ReadyQueue::pop() noexcept {
    while (!closed_) {
        if (Node* node = take()) return node;
        ++sleepers_;
        // Do not sleep if work has arrived, unless another thread has already removed this worker from
        // the count and signals it. The worker must then consume that signal.
        if ((closed_ || !is_empty()) && withdraw()) continue;
        wakeups_.acquire();
        sleepers_ &= ~k_worker_woken;
    }
    return nullptr;
}

void ReadyQueue::close() noexcept {
    closed_ = true;
    // Without the limit of wake_one(): wakes all sleepers. Later sleepers see closed_.
    const std::uint32_t asleep = sleepers_.exchange(0) & ~k_worker_woken;
    for (std::uint32_t call = 0; call < asleep; ++call) wakeups_.release();
}

ReadyQueue::Node* ReadyQueue::take() noexcept {
    Node* node = nullptr;
    bool more = false;
    {
        const std::lock_guard lock(mutex_);
        if (first_ == nullptr) {
            Node* last_in = incoming_.exchange(nullptr);
            while (last_in != nullptr) {
                Node* before = last_in->next_ready;
                last_in->next_ready = first_;
                first_ = last_in;
                last_in = before;
            }
        }
        if (first_ == nullptr) return nullptr;
        node = first_;
        first_ = node->next_ready;
        more = first_ != nullptr;
    }
    if (more) wake_one();
    return node;
}

bool ReadyQueue::is_empty() noexcept {
    const std::lock_guard lock(mutex_);
    return first_ == nullptr && incoming_ == nullptr;
}

bool ReadyQueue::withdraw() noexcept {
    std::uint32_t state = sleepers_;
    while ((state & ~k_worker_woken) != 0)
        if (sleepers_.compare_exchange_weak(state, state - 1)) return true;
    return false;
}

void ReadyQueue::wake_one() noexcept {
    std::uint32_t state = sleepers_;
    while (state != 0 && (state & k_worker_woken) == 0)
        if (sleepers_.compare_exchange_weak(state, (state - 1) | k_worker_woken)) {
            wakeups_.release();
            return;
        }
}

}  // namespace rimline
