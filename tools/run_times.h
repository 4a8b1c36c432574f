#pragma once

// Where the time of a run went, by the clock: steps that follow each other without gaps, so that they add up to
// the whole run.

#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace rimline::tools {

class RunTimes {
public:
    using Clock = std::chrono::steady_clock;

    /// `started` is when the program began (Context::started).
    explicit RunTimes(Clock::time_point started) : started_(started), last_(started) {}

    /// What was done since the last call, or since the program began, was the step `name`: "reading". Steps of the
    /// same name are one.
    void end(const std::string& name);

    double total_ms() const noexcept;

    /// The steps and their sum, in ms: {"reading": 12.5, ..., "total": 100.2}.
    nlohmann::ordered_json json() const;
    /// One line for each step, and one for their sum: "  reading     0.104 s".
    std::string table() const;
    /// "0.66 s: reading 0.10, drawing 0.41"; without steps of less than 5 ms.
    std::string sentence() const;

private:
    struct Step {
        std::string name;
        double ms;
    };

    Clock::time_point started_, last_;
    std::vector<Step> steps_;
};

}  // namespace rimline::tools
