#pragma once

// What `rimline bench --check` asks of a run: ratios that a machine's speed cancels out of.
//
// Three meshes have goals of their own, known by their number of faces: the Stanford bunny, igea, and
// igea subdivided twice. Any other must not be slower than brute force, in extraction or in updates.
// Times without a baseline are shown beside what is wanted of them and fail nothing.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tools/command.h"

namespace rimline::tools {

constexpr std::uint32_t k_bunny_faces = 69451;
constexpr std::uint32_t k_igea_faces = 268686;
constexpr std::uint32_t k_large_faces = 16 * k_igea_faces;  ///< igea, --subdivide 2

struct ModelResult;

struct Target {
    std::string what;
    double value = 0.0;
    double reach = 0.0;  ///< At least; at most where `less_is_better`.
    double aim = 0.0;    ///< What would be good; 0 where nothing is aimed at beyond `reach`.
    bool less_is_better = false;
    bool is_time = false;  ///< Fails nothing.
    std::string unit = "x";

    bool is_reached() const noexcept { return less_is_better ? value <= reach : value >= reach; }
    /// By how much it was missed, as a factor: above 1; infinite where nothing was reached, or none allowed.
    double shortfall() const noexcept { return less_is_better ? value / reach : reach / value; }
};

/// Of a model whose results are right.
std::vector<Target> targets_of(const ModelResult& result);

/// Prints a line each.
void print_targets(std::span<const Target> targets);

/// The status of a --check that missed `missed`, which is printed; success where it is empty.
ExitStatus report_missed(const std::string& missed);

/// What --check fails for: the first target that is missed and no time; empty where there is none.
std::string first_missed(std::span<const Target> targets);

}  // namespace rimline::tools
