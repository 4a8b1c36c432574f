#pragma once

// The time of `rimline draw MODEL` as a whole, without loading the model and without writing the file.

#include <cstdint>
#include <string>

#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

/// By the clock, on all threads: medians of rounds.
struct WholeResult {
    double surface_ms = 0.0;     ///< LineSurface.
    double extraction_ms = 0.0;  ///< The silhouette, by brute force.
    double drawing_ms = 0.0;
    double text_ms = 0.0;  ///< The page and the text of the SVG.
    double all_ms = 0.0;
    std::uint64_t text_bytes = 0;
};

/// With the default options of `draw`. Above a million faces there is one round. The mesh must have an extent.
/// Throws Error{cancelled}.
WholeResult time_whole_drawing(const std::string& model, const Mesh& mesh, std::uint32_t rounds,
                               const Context& context);

}  // namespace rimline::tools
