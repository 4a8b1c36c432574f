#pragma once

// Times of single steps, and quantiles of them.

#include <chrono>
#include <functional>
#include <vector>

namespace rimline::tools {

/// The time by the clock since it was made.
class Stopwatch {
public:
    double ms() const {
        return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
    }
    double us() const { return 1e3 * ms(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Microseconds of one call, which must do its work on this thread. Returns the lesser of the clock's time
/// and the thread's processor time. On a busy machine the system interrupts long steps often and short
/// steps hardly ever, so that the clock alone would make the slower of two methods look slower than it is.
/// Reading the processor time takes too long to use it alone for short steps.
double time_step_us(const std::function<void()>& step);

/// The least value that `share` of all values do not exceed. `values` must not be empty.
double quantile(std::vector<double> values, double share);

}  // namespace rimline::tools
