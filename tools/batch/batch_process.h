#pragma once

// A model of a batch in a process of its own, with limits of time and memory.

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rimline::tools {

struct BatchLimits {
    std::optional<double> seconds;
    std::optional<std::uint64_t> memory_bytes;  ///< Of address space.
    std::uint32_t threads = 1;
};

/// How a process ended.
struct BatchEnd {
    /// ok, failed (status 1), usage (2), check (3), crashed (a signal), timeout.
    std::string status;
    std::string
        error;  ///< The last line of its standard error; of a failure without one, its status.
    std::string output;  ///< Its standard output.
    double ms = 0.0;     ///< By the clock.
};

class BatchProcess {
public:
    /// Starts this program with the arguments. Throws Error{io}.
    BatchProcess(const std::vector<std::string>& arguments, const BatchLimits& limits);
    /// Ends the process, if it still runs.
    ~BatchProcess();
    BatchProcess(const BatchProcess&) = delete;
    BatchProcess& operator=(const BatchProcess&) = delete;

    /// Nothing while it runs. Does not wait. Ends it if its time is over.
    std::optional<BatchEnd> poll_end();

private:
    using Clock = std::chrono::steady_clock;
    struct CloseFile {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };
    using File = std::unique_ptr<std::FILE, CloseFile>;
    static std::string contents(std::FILE* file);

    File output_, error_;
    pid_t id_ = -1;
    Clock::time_point start_ = Clock::now();
    std::optional<double> seconds_;
    bool is_over_time_ = false;
    Clock::time_point kill_at_{};
};

}  // namespace rimline::tools
