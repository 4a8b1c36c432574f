#pragma once

// Line drawings of a camera on an orbit: how much of the lines keeps its identity from frame to frame, and what the
// next frame costs beside a fresh drawing.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "silhouette/mesh/mesh.h"
#include "tools/bench/lines.h"
#include "tools/command.h"

namespace rimline::tools {

struct LinesOrbitOptions {
    std::uint32_t frames = 120;
    double step_degrees = 0.5;
    DrawnLines lines;
};

/// Shares are of length in the picture, summed over all frames but the first.
struct LinesOrbitResult {
    std::string model;
    std::uint32_t faces = 0;
    LinesOrbitOptions options;
    double stayed_share = 0.0;  ///< Of all lines, edges that were lines in the frame before.
    double kept_share = 0.0;    ///< Of these, those whose chain has the id that theirs had.
    double in_old_chains_share =
        0.0;  ///< Of all lines, those in chains whose id is of the frame before.
    double chains_a_frame = 0.0;
    double new_chains_a_frame = 0.0;  ///< Chains whose id is not of the frame before.
    ViewTimes fresh, next;            ///< Of LineDrawer::draw() and draw_next(), one thread.
};

/// The mesh must have an extent. Throws Error{cancelled}.
LinesOrbitResult bench_lines_orbit(const std::string& model, const Mesh& mesh,
                                   const LinesOrbitOptions& options, const Context& context);

void print_orbit(const LinesOrbitResult& result);
nlohmann::ordered_json to_json(const LinesOrbitResult& result);

}  // namespace rimline::tools
