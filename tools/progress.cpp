#include "tools/progress.h"

#include <unistd.h>

#include <cstdio>
#include <system_error>

#include "silhouette/printable_text.h"

namespace rimline::tools {

namespace {

constexpr std::chrono::milliseconds k_min_time(500);

}  // namespace

Progress::Progress(const Context& context, const std::string& task)
    : stop_(context.stop),
      task_(printable_text(task)),
      on_terminal_(isatty(STDERR_FILENO) == 1 && !is_quiet()) {
    if (!on_terminal_) return;
    try {
        late_ = std::jthread([this](const std::stop_token& ended) { show_late(ended); });
    } catch (const std::system_error&) {  // No more threads: only calls that report are shown.
    }
}

Progress::~Progress() {
    late_.request_stop();
    if (late_.joinable()) late_.join();
    if (is_shown_) std::fputs("\r\033[K", stderr);
}

LongCall Progress::call() {
    LongCall call{stop_, {}};
    if (on_terminal_) call.progress = [this](double done) { show(done); };
    return call;
}

void Progress::show(double done) {
    const int percent = static_cast<int>(100.0 * done);
    const std::lock_guard lock(mutex_);
    if (percent == shown_percent_ || Clock::now() - start_ < k_min_time) return;
    shown_percent_ = percent;
    is_shown_ = true;
    std::fprintf(stderr, "\r\033[K%s %d%%", task_.c_str(), percent);
    std::fflush(stderr);
}

void Progress::show_late(const std::stop_token& ended) {
    std::unique_lock lock(mutex_);
    ends_.wait_for(lock, ended, k_min_time, [] { return false; });
    if (ended.stop_requested() || is_shown_) return;
    is_shown_ = true;
    std::fprintf(stderr, "\r\033[K%s", task_.c_str());
    std::fflush(stderr);
}

}  // namespace rimline::tools
