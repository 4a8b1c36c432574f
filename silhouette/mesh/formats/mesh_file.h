#pragma once

// Reads a model file into a MeshSource: OBJ, PLY, STL, OFF, glTF and GLB, and the points of XYZ, PTS
// and CSV text (point_file.h). The content of the file decides its format, the name only if the content does not.
//
// The readers do not guess and do not drop data silently. A file gives exactly its content, or an Error
// that names the file, the line or byte, and the fault. The length of the file bounds every allocation,
// so a wrong count cannot exhaust memory. Polygons are triangulated (triangulate.h).
//
// Vertices are numbered as in the file. STL: 3 * facet + corner. glTF: primitives in scene order, once
// for each node that references them.
//
// Faces get the colors that the file gives them (face_materials.h):
//   OBJ         Kd and map_Kd of the material libraries (mtllib) in the file's folder, and colors of vertices
//   PLY         red, green and blue of vertices and of faces, or diffuse_red and so on, or r, g and b
//   OFF         colors of vertices (COFF) and of faces; not indices of colormaps (off_colors.h)
//   STL         the attributes of binary files, if all of them follow a convention of colors (stl_colors.h)
//   glTF, GLB   baseColorFactor and baseColorTexture of materials, or diffuseFactor and diffuseTexture of
//               KHR_materials_pbrSpecularGlossiness, and COLOR_0 of vertices
// Colors of vertices become those of the corners of faces. Numbers of glTF are linear light; those of the other
// formats are taken as sRGB. If several kinds of color are given, they are multiplied. A material library that is
// missing or faulty is a warning, not an error, as is a texture. Materials are taken as opaque, those that are not (OBJ's
// d, glTF's alphaMode) with a warning. Normals and lines are ignored, as are skins
// and morph targets of glTF.

#include <filesystem>
#include <string>

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
/// Cost: O(file + result) in time. In memory a few times the length of the file, for the JSON of glTF at most 20 times,
/// and the result. Instances of glTF make the result larger than the file: they may have 16 vertices and 16 triangles
/// for each byte of the file and its buffers, but at least 2^24 and at most 2^28 of each. More is Error{too_large},
/// before any of them is made.
MeshSource read_mesh_file(const std::filesystem::path& path,
                          FaceRequirement requirement = FaceRequirement::faces,
                          const LongCall& call = {});

/// The same for the bytes of a file, as of a pipe. `name` stands for the path in messages, and `extension`, with its
/// point and in lower case (".ply"), for the ending of its name; Error{bad_input} if the content is of another format.
/// Empty: the content alone decides.
/// Files that it refers to are looked for in the working folder.
MeshSource read_mesh_bytes(std::string name, std::string bytes, const std::string& extension,
                           FaceRequirement requirement = FaceRequirement::faces,
                           const LongCall& call = {});

/// Empty, or a warning that says of a mesh that it lies so far from the origin that rounding to floats loses its shape
/// (lost_shape.h). `name` begins it. Readers give it as one of MeshSource::warnings.
std::string lost_shape_warning(const std::string& name, const MeshSource& source);

/// Reads the pictures of the textures (MaterialTexture::picture), PNG and JPEG, each file once. Only programs that
/// draw need them. A picture that is missing or faulty becomes a warning, with its place and file. Throws
/// Error{cancelled}. Cost: O(bytes of the files + pixels).
void read_textures(MeshSource& source, const LongCall& call = {});

/// The same warnings, without keeping any picture. It needs the memory of the largest one.
void check_textures(MeshSource& source, const LongCall& call = {});

}  // namespace rimline
