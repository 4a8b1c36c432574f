#pragma once

// How times grow with a mesh: one shape at growing sizes, or one model subdivided, each measured as
// bench_hough.h measures a model. And where the octree overtakes brute force.

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
    std::uint64_t peak_bytes = 0;  ///< The most memory that the program has held so far.
};

/// For shape:NAME, with FACES or without, sizes of 1, 3, 10, 30, .. thousand in the range, as near as
/// the shape can be made; for a file, itself and its subdivisions in the range. `on_step` hears of each
/// as it is done. Stops after a step whose results are wrong. Throws UsageError where the range holds
/// nothing.
std::vector<GrowthStep> bench_growth(const std::string& model, const GrowthOptions& options,
                                     const std::function<void(const GrowthStep&)>& on_step,
                                     const Context& context);

void print_growth_names();
void print_growth(const GrowthStep& step);
/// In words, for extraction and for updates.
void print_overtaking(const std::vector<GrowthStep>& steps);
nlohmann::ordered_json to_json(const std::string& model, const std::vector<GrowthStep>& steps);

/// The number of faces from which ours is never slower again, between sizes by a straight line of the
/// logarithms; nothing where it is slower at the last. The first size where it is never slower.
std::optional<double> overtaken_at(const std::vector<GrowthStep>& steps,
                                   CaseResult ModelResult::*which);

}  // namespace rimline::tools
