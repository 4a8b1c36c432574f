#pragma once

// The material libraries (.mtl) of an OBJ file: the colors and textures of its materials by name.
//
// A library only adds colors, so none of its faults is an error. Libraries and textures must be in the folder of
// the OBJ or below it. Of a library, `newmtl`, `Kd r g b` and `map_Kd file` are read, of the options of map_Kd
// -s, -o and -clamp. Keywords and options may have letters of any case, as exporters write `map_kd` too; names of
// materials and files may not. The numbers of Kd are taken as sRGB, as most programs show them.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/face_materials.h"
#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

/// A statement of an OBJ that holds a name.
struct NamedLine {
    std::string text;    ///< All after the keyword, without spaces at its ends.
    std::uint64_t line;  ///< Of the OBJ.
};

/// map_Kd. A place of the picture is scale * (u, v) + offset, from its left bottom corner.
struct ColorMap {
    MaterialTexture texture;
    glm::vec2 scale{1.0f};
    glm::vec2 offset{0.0f};
};

struct LibraryMaterial {
    std::optional<glm::vec3> color;  ///< In linear light.
    std::optional<ColorMap> map;
};

struct MaterialLibraries {
    /// If a name occurs twice, the first counts.
    std::map<std::string, LibraryMaterial, std::less<>> materials;
    bool is_complete = true;  ///< Every statement names a library, and all could be read.
    std::vector<std::filesystem::path> files;  ///< The libraries, and the textures that they name.

    /// A material as `usemtl` names it, or null. A '#' in the name may begin a comment.
    const LibraryMaterial* find(std::string_view name) const;
};

/// Reads the libraries that `mtllib` statements name, each once. Adds a warning for each one that is missing or
/// cannot be read, and for each faulty line. Throws Error{cancelled}.
MaterialLibraries read_material_libraries(const SourceFile& obj,
                                          std::span<const NamedLine> statements,
                                          const LongCall& call, std::vector<std::string>& warnings);

}  // namespace rimline
