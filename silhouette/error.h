#pragma once

// Two kinds of failure.
//
// `Error` reports a failure outside the program: a bad file, a machine that lacks something, a failed
// system call, a cancelled call. It is one type, with a code and a message that names the place.
// `RIMLINE_CHECK` reports a mistake of the calling code. It stops the program in every build and
// prints the condition and its line, because continuing would corrupt a result.

#include <functional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <system_error>

namespace rimline {

enum class ErrorCode {
    bad_input,  ///< An input file or value is wrong. The message names the file and place.
    no_device,  ///< No device is suitable. The message lists what each device lacks.
    device_lost,  ///< The GPU stopped. All objects of its device are lost (engine/vulkan/device_loss.h).
    io,           ///< The system could not read or write. The message names the path.
    too_large,  ///< A limit of the machine or of a format is exceeded. The message names it.
    cancelled,  ///< The caller stopped a long call.
};

class Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ErrorCode code() const noexcept { return code_; }

private:
    ErrorCode code_;
};

/// An Error{io} about one file or folder.
class FileError : public Error {
public:
    /// The message is "path: problem". `number` is the system's error (errno), or 0 if there is none.
    FileError(const std::string& path, const std::string& problem, int number = 0)
        : Error(ErrorCode::io, path + ": " + problem), path_(path), number_(number) {}
    /// The message ends with what the system calls its error: "path: problem: No such file or directory".
    static FileError of_system(const std::string& path, const std::string& problem, int number) {
        return {path, problem + ": " + std::generic_category().message(number), number};
    }
    const std::string& path() const noexcept { return path_; }
    int number() const noexcept { return number_; }

private:
    std::string path_;
    int number_;
};

/// Progress and cancellation of a long call. Both members may be empty.
struct LongCall {
    std::stop_token stop;
    /// Receives the finished share in [0, 1] on the calling thread. The share never decreases.
    std::function<void(double)> progress;

    /// Reports `done`. Throws Error{cancelled} if a stop was requested. A long loop calls it a few
    /// hundred times, not once per element.
    void checkpoint(double done) const {
        if (stop.stop_requested()) throw Error(ErrorCode::cancelled, "cancelled");
        if (progress) progress(done);
    }

    /// A call that covers the progress of this one from `begin` to `end`. This call must outlive it.
    LongCall part(double begin, double end) const {
        LongCall result{stop, {}};
        if (progress)
            result.progress = [this, begin, end](double done) {
                progress(begin + (end - begin) * done);
            };
        return result;
    }
};

[[noreturn]] void check_failed(const char* condition, const char* file, int line) noexcept;

}  // namespace rimline

#define RIMLINE_CHECK(condition) \
    ((condition) ? void(0) : ::rimline::check_failed(#condition, __FILE__, __LINE__))
