#pragma once

// Reads a model file into a MeshSource: OBJ, PLY, STL, OFF, glTF and GLB, and the points of XYZ and PTS
// text (point_file.h). The content of the file decides its format, the name only if the content does not.
//
// The readers do not guess and do not drop data silently. A file gives exactly its content, or an Error
// that names the file, the line or byte, and the fault. The length of the file bounds every allocation,
// so a wrong count cannot exhaust memory. Polygons are triangulated (triangulate.h).
//
// Vertices are numbered as in the file. STL: 3 * facet + corner. glTF: primitives in scene order, once
// for each node that references them. Normals, colors, texture coordinates, materials, images and lines
// are ignored, because they do not affect faces. Skins and morph targets of glTF are ignored, too.

#include <filesystem>

#include "silhouette/error.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline {

/// Whether the caller needs faces.
enum class FaceRequirement {
    faces,            ///< A file without triangles is an error.
    faces_or_points,  ///< A file with points only is accepted.
};

/// Throws Error{bad_input}, Error{io}, Error{too_large} or Error{cancelled}. Except for the last, the
/// message begins with the path and, if there is one, the place: "bunny.obj:17: ...",
/// "igea.ply: byte 4096: ...", "duck.gltf: accessors[3].count: ...".
/// Cost: O(file), at most a few times its length in memory. Each glTF instance counts.
MeshSource read_mesh_file(const std::filesystem::path& path,
                          FaceRequirement requirement = FaceRequirement::faces,
                          const LongCall& call = {});

}  // namespace rimline
