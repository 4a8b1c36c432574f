#pragma once

// A strict look at every line of an OBJ file, before tinyobjloader reads it.
//
// tinyobjloader takes `v x 1 0` for numbers, adds decimals up in floating point, lets indices point
// anywhere, takes a comment after a face for corners and knows no continued lines. This scan refuses
// what it would guess at, keeps the positions, correctly rounded, and hands on plain statements that
// can be understood in one way only.

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

struct ObjScan {
    std::vector<glm::vec3> positions;
    std::uint64_t face_count = 0;
    std::uint64_t corner_count = 0;  ///< Of all faces together.
    /// The file's `v` and `f` statements, one a line, in order; of a corner only the vertex.
    std::string statements;
};

/// Throws Error{bad_input} with the line of: words where numbers belong, coordinates that are not
/// finite, indices that are 0 or out of range (negative ones count back from the line they are on),
/// faces with fewer than three corners, keywords that are not OBJ, and statements that make geometry
/// but cannot be kept (free-form surfaces, included files).
ObjScan scan_obj(const SourceFile& file, const LongCall& call);

}  // namespace rimline
