#pragma once

// Makes a call of seconds on a separate thread, so that the window stays responsive.
//
// Only the latest call counts: start() cancels the one before it, and does not wait for it. The window's thread
// fetches the result with take().

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tools/begin_call.h"

namespace rimline::tools {

template <typename Result>
class BackgroundCall {
public:
    /// Makes the call on its thread. Must not throw.
    using Work = std::function<Result(const BeginCall& begin)>;

    struct Stage {
        std::string task;    ///< "reading bunny.obj"
        double share = 0.0;  ///< Progress of this task, in [0, 1].
    };

    /// `wake` is called on the other thread whenever stage() or the result has changed.
    explicit BackgroundCall(std::function<void()> wake = {}) : wake_(std::move(wake)) {}
    /// Cancels the call and waits for its end, and for that of those before it.
    ~BackgroundCall() { cancel(); }
    BackgroundCall(const BackgroundCall&) = delete;
    BackgroundCall& operator=(const BackgroundCall&) = delete;

    /// Cancels the call before, and starts the next; `task` is its stage until it begins one.
    void start(std::string task, Work work) {
        cancel();
        {
            const std::lock_guard lock(mutex_);
            stage_ = Stage{std::move(task), 0.0};
        }
        running_.has_ended = std::make_shared<std::atomic<bool>>(false);
        running_.thread = std::jthread([this, has_ended = running_.has_ended,
                                        work = std::move(work)](const std::stop_token& stop) {
            run(stop, work);
            has_ended->store(true);
        });
    }

    /// Asks the call to stop and does not wait for it. Its result is discarded, as is one that was not taken.
    void cancel() {
        running_.thread.request_stop();
        if (running_.thread.joinable()) cancelled_.push_back(std::move(running_));
        running_ = {};
        std::erase_if(cancelled_, [](const Running& call) { return call.has_ended->load(); });
        const std::lock_guard lock(mutex_);
        stage_.reset();
        result_.reset();
    }

    /// Nothing while no call is in progress.
    std::optional<Stage> stage() const {
        const std::lock_guard lock(mutex_);
        return stage_;
    }

    /// The result of the latest call, once.
    std::optional<Result> take() {
        const std::lock_guard lock(mutex_);
        return std::exchange(result_, std::nullopt);
    }

private:
    // Least increase of progress that wakes the window.
    static constexpr double k_min_step = 0.01;

    // A call that was cancelled changes nothing any more: what it would change is another one's.
    void run(const std::stop_token& stop, const Work& work) {
        const auto begin = [&](const std::string& task) {
            {
                const std::lock_guard lock(mutex_);
                if (!stop.stop_requested()) stage_ = Stage{task, 0.0};
            }
            wake();
            return LongCall{stop, [this, stop](double share) {
                                {
                                    const std::lock_guard lock(mutex_);
                                    if (stop.stop_requested()) return;
                                    if (share < stage_->share + k_min_step) return;
                                    stage_->share = share;
                                }
                                wake();
                            }};
        };
        Result result = work(begin);
        {
            const std::lock_guard lock(mutex_);
            if (stop.stop_requested()) return;
            stage_.reset();
            result_ = std::move(result);
        }
        wake();
    }

    void wake() const {
        if (wake_) wake_();
    }

    std::function<void()> wake_;
    mutable std::mutex mutex_;  // Guards the two members below.
    std::optional<Stage> stage_;
    std::optional<Result> result_;
    // Last: they are joined before the other members are destroyed.
    struct Running {
        std::shared_ptr<std::atomic<bool>> has_ended;
        std::jthread thread;
    };
    std::vector<Running> cancelled_;  // Some may still run.
    Running running_;
};

}  // namespace rimline::tools
