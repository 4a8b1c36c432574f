#pragma once

// One line of standard error that tells how far a long call is, rewritten in place and gone when the
// object is. Only on a terminal, and only once the call has taken longer than a moment.

#include <chrono>
#include <string>

#include "tools/command.h"

namespace rimline::tools {

class Progress {
public:
    /// `doing` is shown before the share: "reading bunny.obj".
    Progress(const Context& context, std::string doing);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// What to hand to the long call, which stops on Ctrl-C. This object must outlive it.
    LongCall call();

private:
    using Clock = std::chrono::steady_clock;
    void show(double done);

    std::stop_token stop_;
    std::string doing_;
    bool on_terminal_;
    Clock::time_point start_ = Clock::now();
    int shown_percent_ = -1;
};

}  // namespace rimline::tools
