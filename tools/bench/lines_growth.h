#pragma once

// Line drawings of growing meshes, each measured as in lines.h.

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/bench/lines.h"
#include "tools/command.h"

namespace rimline::tools {

struct LinesGrowthOptions {
    std::uint32_t min_faces = 10'000;
    std::uint32_t max_faces = 10'000'000;
    LinesBenchOptions bench;
};

struct LinesGrowthStep {
    LinesResult result;
    std::uint64_t peak_bytes = 0;  ///< The peak memory of the program so far.
};

/// At growth_sizes(), whose errors it throws. Calls `on_step` after each. Stops after a step with wrong results.
std::vector<LinesGrowthStep> bench_lines_growth(
    const std::string& model, const LinesGrowthOptions& options,
    const std::function<void(const LinesGrowthStep&)>& on_step, const Context& context);

void print_lines_growth_names();
void print_growth(const LinesGrowthStep& step);
nlohmann::ordered_json to_json(const std::string& model, const std::vector<LinesGrowthStep>& steps);

}  // namespace rimline::tools
