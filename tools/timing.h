#pragma once

// Several ways of doing one thing, timed at the same points in one run.
//
// A round times all points of one contender in a row, and the rounds of the contenders alternate, so
// that each runs on warm caches and none gets a quieter machine. A point's time is the least over the
// rounds. Round 0 warms up and counts the work.
//
// A step's time is the clock's or the thread's processor time, whichever is less. On a busy machine long
// steps are interrupted in every round and short ones hardly ever: the clock alone would make the slower
// contender look slower than it is. (Processor time alone has a reading too slow for short steps.)

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/methods/silhouette_method.h"
#include "tools/command.h"

namespace rimline::tools {

struct Contender {
    std::string name;
    /// What is timed.
    std::function<void(const HomogeneousPoint&)> step;
    /// Of the last step.
    std::function<TraversalCounters()> counters;
    /// Before each round, untimed; may be empty.
    std::function<void()> prepare{};
    /// Of the last step, what only it counts; may be empty.
    std::function<std::vector<NamedCount>()> own_counts{};
    /// Takes every so-manieth point only; for what is slow and remembers nothing.
    std::size_t every = 1;
    /// Does a part of what the others do: a yardstick that nobody can lose to.
    bool is_part = false;
};

struct Times {
    std::string name;
    bool is_part = false;
    std::vector<double> us;               ///< By point, the least of the rounds.
    std::vector<TraversalCounters> work;  ///< By point.
    struct OwnCount {
        std::string name;
        double mean;
    };
    std::vector<OwnCount> own_counts;  ///< In the contender's order.

    double median_us() const { return quantile_us(0.5); }
    double mean_us() const;
    /// The least value that `share` of all points do not exceed.
    double quantile_us(double share) const;
    /// Rounded down.
    TraversalCounters mean_work() const;
};

/// Of one call, as said above. What it does, it does on this thread.
double time_step_us(const std::function<void()>& step);

/// `rounds` after the one that warms up. `doing` is shown as progress. `points` must not be empty.
std::vector<Times> time_in_turn(std::span<const Contender> contenders,
                                std::span<const HomogeneousPoint> points, std::uint32_t rounds,
                                const std::string& doing, const Context& context);

/// See Times::quantile_us. `values` must not be empty.
double quantile(std::vector<double> values, double share);

}  // namespace rimline::tools
