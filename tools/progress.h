#pragma once

// The progress of a long call in one line of standard error, rewritten in place and removed by the
// destructor. Shown only on a terminal, and only after half a second.

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

    /// The argument for the long call, which stops on Ctrl-C. This object must outlive the call.
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
