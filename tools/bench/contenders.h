#pragma once

// Several methods timed at the same points in one run.
//
// A round times all points of one contender in a row. The rounds of the contenders alternate, so that each
// runs on warm caches and none gets a quieter machine. A point's time is the least over the rounds
// (time_step_us). Round 0 warms up and counts the work.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/methods/silhouette_method.h"
#include "tools/command.h"
#include "tools/timing.h"

namespace rimline::tools {

struct Contender {
    std::string name;
    /// The work that is timed.
    std::function<void(const HomogeneousPoint&)> step;
    /// Counters of the last step.
    std::function<TraversalCounters()> counters;
    /// Called before each round, untimed. May be empty.
    std::function<void()> prepare{};
    /// Counters of the last step that only this contender has. May be empty.
    std::function<std::vector<NamedCount>()> own_counts{};
    /// Takes every n-th point only. For slow contenders without state.
    std::size_t every = 1;
    /// Does only a part of the others' work; its time is a lower bound and no rival.
    bool is_part = false;
};

struct Times {
    std::string name;
    bool is_part = false;
    std::vector<double> us;               ///< One a point, the least of the rounds.
    std::vector<TraversalCounters> work;  ///< One a point.
    struct OwnCount {
        std::string name;
        double mean;
    };
    std::vector<OwnCount> own_counts;  ///< In the contender's order.

    double median_us() const { return quantile_us(0.5); }
    double mean_us() const;
    /// The least value that `share` of all points do not exceed (quantile).
    double quantile_us(double share) const;
    /// Rounded down.
    TraversalCounters mean_work() const;
};

/// Makes one round that warms up and `rounds` more. Shows `doing` as progress. `points` must not be empty.
std::vector<Times> time_in_turn(std::span<const Contender> contenders,
                                std::span<const HomogeneousPoint> points, std::uint32_t rounds,
                                const std::string& doing, const Context& context);

}  // namespace rimline::tools
