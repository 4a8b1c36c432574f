#pragma once

// The material libraries (.mtl) of an OBJ file: the colors of its materials by name.
//
// A library only adds colors, so none of its faults is an error. Libraries must be in the folder of the OBJ or
// below it. Of a library, `newmtl` and `Kd r g b` are read. The numbers of Kd are taken as sRGB, as most
// programs show them.

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

/// A statement of an OBJ that holds a name.
struct NamedLine {
    std::string text;    ///< All after the keyword, without spaces at its ends.
    std::uint64_t line;  ///< Of the OBJ.
};

struct MaterialLibraries {
    /// The color of each material in linear light, or nothing if its library names none. If a name occurs
    /// twice, the first counts.
    std::map<std::string, std::optional<glm::vec3>, std::less<>> colors;
    bool is_complete = true;  ///< Every statement names a library, and all could be read.

    /// The entry of a material as `usemtl` names it, or null. A '#' in the name may begin a comment.
    const std::optional<glm::vec3>* find(std::string_view name) const;
};

/// Reads the libraries that `mtllib` statements name, each once. Adds a warning for each one that is missing or
/// cannot be read, and for each faulty line. Throws Error{cancelled}.
MaterialLibraries read_material_libraries(const SourceFile& obj,
                                          std::span<const NamedLine> statements,
                                          const LongCall& call, std::vector<std::string>& warnings);

}  // namespace rimline
