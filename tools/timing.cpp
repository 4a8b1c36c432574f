#include "tools/timing.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "silhouette/error.h"

namespace rimline::tools {

namespace {

double thread_us() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double time_step_us(const std::function<void()>& step) {
    using Clock = std::chrono::steady_clock;
    const double thread_start_us = thread_us();
    const Clock::time_point start = Clock::now();
    step();
    const std::chrono::duration<double, std::micro> took = Clock::now() - start;
    return std::min(took.count(), thread_us() - thread_start_us);
}

double quantile(std::vector<double> values, double share) {
    RIMLINE_CHECK(!values.empty());
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    const auto at =
        values.begin() + std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(rank), 1) - 1;
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

}  // namespace rimline::tools
