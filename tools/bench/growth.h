#pragma once

// Times for growing meshes: one shape at growing sizes, or one model and its subdivisions, each measured as
// in hough.h. Also the size where the octree overtakes brute force.

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/bench/hough.h"
#include "tools/command.h"

namespace rimline::tools {

struct GrowthOptions {
    std::uint32_t min_faces = 1'000;
    std::uint32_t max_faces = 10'000'000;
    HoughBenchOptions bench;
};

struct GrowthStep {
    ModelResult result;
    std::uint64_t peak_bytes = 0;  ///< The peak memory of the program so far.
};

/// At growth_sizes(), whose errors it throws. Calls `on_step` after each. Stops after a step with wrong results.
std::vector<GrowthStep> bench_growth(const std::string& model, const GrowthOptions& options,
                                     const std::function<void(const GrowthStep&)>& on_step,
                                     const Context& context);

void print_growth_names();
void print_growth(const GrowthStep& step);
/// Prints sentences, for extraction and for updates.
void print_overtaking(const std::vector<GrowthStep>& steps);
nlohmann::ordered_json to_json(const std::string& model, const std::vector<GrowthStep>& steps);

/// The number of faces from which on the octree is never slower: between two sizes on a straight line of the
/// logarithms; the first size where it is never slower; nothing where it is slower at the last size.
std::optional<double> overtaken_at(const std::vector<GrowthStep>& steps,
                                   CaseResult ModelResult::*which);

}  // namespace rimline::tools
