#pragma once

// The lines of one view by other programs, for the meshes that users of those programs would draw: Freestyle and
// Line Art of Blender (blender_lines.py), and HLRBRep_PolyAlgo of Open CASCADE (occt_lines.cpp). None is required.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "silhouette/lines/line_view.h"
#include "silhouette/mesh/mesh.h"
#include "tools/bench/line_pieces.h"
#include "tools/command.h"

namespace rimline::tools {

struct OtherSegment {
    std::array<glm::vec3, 2> ends;
    bool is_visible;
};

struct OtherLines {
    std::string method;   ///< With the version of its program.
    std::string skipped;  ///< The reason why there are no lines; else empty.
    double ms = 0.0;  ///< As the program measures it, for one view of a mesh that it has loaded.
    std::vector<OtherSegment> segments;  ///< None where the program gives only its time.
};

/// Those that are installed, on one thread. `view` is perspective. Slow: each program reads the whole mesh. Throws
/// Error{cancelled}.
std::vector<OtherLines> other_lines(const Mesh& mesh, const LineView& view, const Context& context);

/// What another program says about pieces whose visibility is known. A piece has the visibility of the nearest
/// segment to its middle; where none is nearer than `reach`, the piece is not drawn.
struct OtherErrors {
    double wrong_share = 0.0;    ///< Of the length that is drawn.
    double missing_share = 0.0;  ///< Of the whole length.
};
OtherErrors compare_lines(std::span<const LinePiece> pieces, std::span<const OtherSegment> segments,
                          double reach);

}  // namespace rimline::tools
