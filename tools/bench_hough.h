#pragma once

// The measurements of silhouettes: the octree and its tracker against brute force.
//
// A case first checks that every method gives the same silhouettes, then times them. A round times all
// of one method's points in a row, and rounds of the methods alternate, so that each runs on warm caches
// and none gets a quieter machine. A point's time is the least over the rounds; what is reported is the
// median and the mean over the points.

#include <cstdint>
#include <string>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

struct HoughBenchOptions {
    std::uint32_t viewpoints = 300;  ///< Of static extraction, spread evenly at 1, 2 and 3 radii.
    std::uint32_t frames = 720;      ///< Of the orbit at 2 radii in steps of half a degree.
    std::uint32_t rounds = 5;
};

struct MethodResult {
    std::string method;
    double median_us = 0.0;
    double mean_us = 0.0;
    TraversalCounters counters;  ///< The mean over the points, rounded.
};

struct CaseResult {
    std::string name;
    std::string model;
    std::uint32_t faces = 0;
    std::uint32_t edges = 0;
    double build_ms = 0.0;     ///< Of the octree.
    double mean_size = 0.0;    ///< Edges on the silhouette, a point.
    double mean_flips = 0.0;   ///< Faces that turn, a frame; 0 where nothing moves.
    std::string difference{};  ///< Of a method from the scalar oracle; the case is not timed then.
    std::vector<MethodResult> methods{};  ///< Ours first, then the baselines.
};

/// Static extraction, then updates.
std::vector<CaseResult> bench_hough(const std::string& model, const Mesh& mesh,
                                    const HoughBenchOptions& options, const Context& context);

}  // namespace rimline::tools
