#pragma once

// One line on standard error that shows the progress of a long call. It is rewritten in place and erased at the
// end. It appears only on a terminal, and only if the call takes longer than half a second; then also if the
// call has not said yet how much of it is done.

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "tools/begin_call.h"
#include "tools/command.h"

namespace rimline::tools {

class Progress {
public:
    /// `task` is shown before the percentage: "reading bunny.obj".
    Progress(const Context& context, const std::string& task);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// The argument of the long call, which stops on Ctrl-C. This object must outlive it.
    LongCall call();

private:
    using Clock = std::chrono::steady_clock;
    void show(double done);
    void show_late(const std::stop_token& ended);

    std::stop_token stop_;
    std::string task_;
    bool on_terminal_;
    Clock::time_point start_ = Clock::now();
    std::mutex mutex_;  // Of what follows; calls may report from several threads.
    std::condition_variable_any ends_;
    bool is_shown_ = false;
    int shown_percent_ = -1;
    std::jthread late_;  // Shows the task of a call that reports nothing.
};

/// Returns work(begin), where `begin` shows a Progress for each part. Throws Error{cancelled} after Ctrl-C.
template <typename Work>
auto follow_progress(const Context& context, Work&& work) {
    std::optional<Progress> progress;
    auto result = work(BeginCall([&](const std::string& task) {
        progress.emplace(context, task);
        return progress->call();
    }));
    progress.reset();
    context.checkpoint();
    return result;
}

}  // namespace rimline::tools
