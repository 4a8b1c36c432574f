#pragma once

// What a long run is judged by: that it holds no more at its end than after its first tenth, and that hardly any step
// takes much longer than most.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rimline::tests {

/// What the process holds now.
struct Holdings {
    std::uint64_t anonymous_bytes =
        0;  ///< Resident ones, after free memory was given back to the system.
    std::uint64_t heap_bytes = 0;  ///< Allocated and not freed.
    std::uint64_t descriptors = 0;
    std::uint64_t threads = 0;
    std::uint64_t vulkan_objects = 0;
};
Holdings holdings_now();

struct SoakLimits {
    /// Of a step's time, the 99.9th percentile in medians. 0: not judged.
    double slowest = 4.0;
    /// Whether memory is judged too that the heap does not know: not where drivers come and go, which leave some.
    bool judges_anonymous = true;
    /// What libraries that are not ours may leave behind with each step.
    std::uint64_t lost_bytes = 0;
};

/// One kind of work, repeated until its time is over.
class SoakRecord {
public:
    SoakRecord(std::string name, double seconds, const SoakLimits& limits);

    /// Whether there is time for another step. Takes stock when a tenth is over.
    bool goes_on();
    void add_step(double seconds);
    /// Prints a line. Whether the limits were kept; else says on the next line what was not.
    bool report();

private:
    std::string name_;
    SoakLimits limits_;
    double started_s_, first_tenth_s_, end_s_;
    bool is_first_tenth_over_ = false;
    Holdings after_first_tenth_;
    // Times by the logarithm: a list of ten million would itself be growth.
    std::vector<std::uint64_t> histogram_;
    std::uint64_t steps_ = 0;
};

/// Seconds since some moment.
double wall_clock_s();
/// Of processor time of this thread.
double thread_clock_s();

}  // namespace rimline::tests
