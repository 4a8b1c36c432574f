#pragma once

// Two kinds of failure.
//
// `Error` is for what the world gets wrong: bad files, machines that lack something, failed system
// calls, a cancelled call. It is one type with a code and a message that names the place.
// `RIMLINE_CHECK` is for what the caller's code gets wrong: it stops the program in every build, with
// the condition and its line, because going on would corrupt a result.

#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string>

namespace rimline {

enum class ErrorCode {
    bad_input,  ///< A file or value from outside is wrong; the message names the file and place.
    no_device,  ///< The machine lacks what is needed; the message lists what each device lacks.
    device_lost,  ///< The GPU gave up; everything on its device is gone (engine/vulkan/device_loss.h).
    io,           ///< The system refused to read or write; the message names the path.
    too_large,  ///< A limit of the machine or of the formats is exceeded; the message names it.
    cancelled,  ///< The caller asked a long call to stop.
};

class Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ErrorCode code() const noexcept { return code_; }

private:
    ErrorCode code_;
};

/// How a caller follows and stops a long call. Both members may be left empty.
struct LongCall {
    std::stop_token stop;
    /// Receives the finished share in [0, 1], never falling, on the calling thread.
    std::function<void(double)> progress;

    /// Reports `done` and throws Error{cancelled} when a stop was requested. Call it a few hundred
    /// times in a long loop, not once an element.
    void checkpoint(double done) const {
        if (stop.stop_requested()) throw Error(ErrorCode::cancelled, "cancelled");
        if (progress) progress(done);
    }

    /// The part of this call from one share of its progress to another, as a call of its own. This
    /// one must outlive it.
    LongCall part(double begin, double end) const {
        LongCall made{stop, {}};
        if (progress)
            made.progress = [this, begin, end](double done) {
                progress(begin + (end - begin) * done);
            };
        return made;
    }
};

[[noreturn]] void check_failed(const char* condition, const char* file, int line) noexcept;

}  // namespace rimline

#define RIMLINE_CHECK(condition) \
    ((condition) ? void(0) : ::rimline::check_failed(#condition, __FILE__, __LINE__))
