#pragma once

// Long calls that take turns on one object. Those that wait are told to stop like those that work.

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "silhouette/error.h"

namespace rimline::tools {

class Turns {
public:
    /// From construction to destruction, the calling thread has the turn.
    class Turn {
    public:
        /// Waits for it. Throws Error{cancelled}, and what `call.progress` throws.
        Turn(Turns& turns, const LongCall& call) : turns_(turns) {
            using namespace std::chrono_literals;
            std::unique_lock lock(turns_.mutex_);
            while (!turns_.is_free_again_.wait_for(lock, call.stop, 50ms,
                                                   [&] { return !turns_.is_taken_; })) {
                lock.unlock();
                call.checkpoint(0.0);
                lock.lock();
            }
            turns_.is_taken_ = true;
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
};

}  // namespace rimline::tools
