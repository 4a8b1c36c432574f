#pragma once

// What `rimline bench --check` requires of a run: ratios that do not depend on the machine's speed.
//
// A time without a baseline is shown beside its target. Missing it fails nothing.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "tools/command.h"

namespace rimline::tools {

constexpr std::uint32_t k_bunny_faces = 69451;
constexpr std::uint32_t k_igea_faces = 268686;
constexpr std::uint32_t k_large_faces = 16 * k_igea_faces;  ///< igea, --subdivide 2

struct Target {
    std::string what;
    double value = 0.0;
    double reach = 0.0;  ///< The least value allowed; the greatest where `less_is_better`.
    double aim = 0.0;    ///< A good value; 0 where `reach` is enough.
    bool less_is_better = false;
    bool is_time = false;  ///< Missing it fails nothing.
    std::string unit = "x";

    bool is_reached() const noexcept { return less_is_better ? value <= reach : value >= reach; }
    /// The factor by which a missed target was missed: above 1. Infinite where the value is zero and more is
    /// better, or where zero is allowed and less is better.
    double shortfall() const noexcept { return less_is_better ? value / reach : reach / value; }
};

/// Prints a line each.
void print_targets(std::span<const Target> targets);

/// The first target that is missed and no time. Empty where there is none.
std::string first_missed(std::span<const Target> targets);

/// The targets of all models of a run.
class TargetList {
public:
    /// `model` names the source of the targets.
    void add(const std::string& model, std::span<const Target> targets);
    /// "MODEL: WHAT" of the first missed target that is no time. Empty when there is none.
    const std::string& first_missed() const noexcept { return first_missed_; }
    /// An array with an object for each target.
    const nlohmann::ordered_json& json() const noexcept { return json_; }

private:
    std::string first_missed_;
    nlohmann::ordered_json json_ = nlohmann::ordered_json::array();
};

/// Prints that `missed` was missed and returns check_failed. Returns success where `missed` is empty.
ExitStatus report_missed(const std::string& missed);

}  // namespace rimline::tools
