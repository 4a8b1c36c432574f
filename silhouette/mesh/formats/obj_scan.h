#pragma once

// Checks every line of an OBJ file strictly, before tinyobjloader reads it.
//
// tinyobjloader reads `v x 1 0` as numbers, sums decimals in floating point, does not check indices,
// reads a comment after a face as corners and does not support continued lines. This scan rejects
// invalid input, stores correctly rounded positions and passes unambiguous statements to
// tinyobjloader.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "silhouette/mesh/formats/mtl.h"
#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

/// `usemtl`: the faces from `first_face` on have material `name`, an index in ObjScan::material_names.
struct ObjMaterialUse {
    std::uint64_t first_face;
    std::size_t name;
};

struct ObjScan {
    std::vector<glm::vec3> positions;
    /// As in the file, one for each position; NaN for a position without a color. Empty if none has one.
    std::vector<glm::vec3> colors;
    std::uint64_t face_count = 0;
    std::uint64_t corner_count = 0;  ///< Sum over all faces.
    /// The file's `v` and `f` statements, one per line, in order. A corner holds only its vertex.
    std::string statements;
    std::vector<NamedLine> libraries;  ///< The `mtllib` statements.
    std::vector<NamedLine>
        material_names;  ///< Of `usemtl` statements, each once, with its first line.
    std::vector<ObjMaterialUse> material_uses;
    std::vector<glm::vec2> uvs;  ///< As in the file; not finite where its numbers are not.
    /// The index in `uvs` for each corner of all faces, or k_no_uv. It ends with the last corner that has one.
    std::vector<std::uint32_t> corner_uvs;
    static constexpr std::uint32_t k_no_uv = 0xffffffffu;
};

/// Throws Error{bad_input} with the line of the fault. Faults are: words instead of numbers,
/// coordinates that are not finite, indices that are 0 or out of range (negative indices count back
/// from their line), faces with fewer than three corners, keywords that are not OBJ, and unsupported
/// statements that make geometry (free-form surfaces, included files).
ObjScan scan_obj(const SourceFile& file, const LongCall& call);

}  // namespace rimline
