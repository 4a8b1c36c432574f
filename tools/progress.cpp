#include "tools/progress.h"

#include <unistd.h>

#include <cstdio>

namespace rimline::tools {

Progress::Progress(const Context& context, std::string task)
    : stop_(context.stop),
      task_(std::move(task)),
      on_terminal_(isatty(STDERR_FILENO) == 1 && !is_quiet()) {}

Progress::~Progress() {
    if (shown_percent_ >= 0) std::fputs("\r\033[K", stderr);
}

LongCall Progress::call() {
    LongCall call{stop_, {}};
    if (on_terminal_) call.progress = [this](double done) { show(done); };
    return call;
}

void Progress::show(double done) {
    const int percent = static_cast<int>(100.0 * done);
    constexpr std::chrono::milliseconds k_min_time(500);
    if (percent == shown_percent_ || Clock::now() - start_ < k_min_time) return;
    shown_percent_ = percent;
    std::fprintf(stderr, "\r\033[K%s %d%%", task_.c_str(), percent);
    std::fflush(stderr);
}

}  // namespace rimline::tools
