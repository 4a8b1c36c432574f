#pragma once

// Long calls that take turns on one object. Those that wait are told to stop like those that work. A call that a
// progress function makes on the object whose call it hears of would wait for itself: it is refused.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "silhouette/error.h"
#include "tools/command.h"

namespace rimline::tools {

class Turns {
public:
    /// From construction to destruction, the calling thread has the turn.
    class Turn {
    public:
        /// Waits for it. Throws Error{cancelled}, what `call.progress` throws, and UsageError where this thread has it.
        Turn(Turns& turns, const LongCall& call) : turns_(turns) {
            using namespace std::chrono_literals;
            std::unique_lock lock(turns_.mutex_);
            if (turns_.is_taken_ && turns_.taker_ == std::this_thread::get_id())
                throw UsageError("a progress function uses the object that it hears of");
            while (!turns_.is_free_again_.wait_for(lock, call.stop, 50ms,
                                                   [&] { return !turns_.is_taken_; })) {
                lock.unlock();
                call.checkpoint(0.0);
                lock.lock();
            }
            turns_.is_taken_ = true;
            turns_.taker_ = std::this_thread::get_id();
        }
        ~Turn() {
            const std::lock_guard lock(turns_.mutex_);
            turns_.is_taken_ = false;
            turns_.is_free_again_.notify_one();
        }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;

    private:
        Turns& turns_;
    };

private:
    std::mutex mutex_;
    std::condition_variable_any is_free_again_;
    bool is_taken_ = false;
    std::thread::id taker_;  // While it is taken.
};

}  // namespace rimline::tools
