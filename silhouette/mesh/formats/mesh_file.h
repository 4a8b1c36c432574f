#pragma once

// Reads a model file into a MeshSource: OBJ, PLY, STL, OFF, glTF and GLB, and for their points XYZ and PTS
// text (point_file.h), by what is in the file, not only by its name.
//
// Nothing is guessed and nothing is dropped in silence: a file gives exactly what its bytes say or an
// Error that names the file and the line or byte, and what is wrong there. No allocation is sized by a
// count that the file's own length does not bear out. Polygons are triangulated (triangulate.h).
//
// Vertices are numbered as the file numbers them; STL: 3 * facet + corner; glTF: primitives in scene
// order, once for each node that names them. Left aside, as they say nothing about where faces lie:
// normals, colors, texture coordinates, materials, images, lines, and glTF's skins and morph targets,
// which stay at rest.

#include <filesystem>

#include "silhouette/error.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline {

/// What the caller can use.
enum class FaceRequirement {
    faces,            ///< Triangles are needed: a file without any is an error.
    faces_or_points,  ///< A file of points only is welcome too.
};

/// Throws Error{bad_input}, Error{io}, Error{too_large} or Error{cancelled}; but for the last its
/// message begins with the path and, where there is one, the place: "bunny.obj:17: ...",
/// "igea.ply: byte 4096: ...", "duck.gltf: accessors[3].count: ...".
/// Cost: O(file), at most a few times its length in memory; glTF instances count each time.
MeshSource read_mesh_file(const std::filesystem::path& path,
                          FaceRequirement requirement = FaceRequirement::faces,
                          const LongCall& call = {});

}  // namespace rimline
