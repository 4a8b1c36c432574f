#pragma once

// Reads the points of a file into a PointSource: PLY, OBJ, XYZ, PTS and CSV text in double precision, and STL,
// OFF, glTF and GLB in float as mesh_file.h. It is as strict as mesh_file.h: a file gives exactly its
// content, or an Error that names the file and the line or byte.
//
//   PLY   x y z; nx ny nz; red green blue, as integers or as numbers in [0, 1]; intensity. All other
//         properties are skipped.
//   OBJ   `v x y z [r g b]`, with colors in [0, 1], or in [0, 255] if one is above 1. `vn` are normals
//         of corners. They are used as normals of the points if there are as many as vertices and every
//         face corner has equal vertex and normal indices. Otherwise they are ignored.
//   XYZ   One point per line: numbers separated by blanks, or by commas or semicolons, equally many in every
//         line. Decimals begin with a point. Lines that begin with # or // are comments. A first line may name the
//         columns; then the first three are x, y and z, and red, green, blue (r, g, b) or nx, ny, nz after them
//         are a triple. The first three numbers are x y z. With 4, 7 or 10 numbers, the
//         fourth is an intensity. The remaining numbers are triples. The first triple of columns whose
//         values all have length 1 (within 1%) or 0 is the normal. The first triple of integers from 0
//         to 255 is the color. Other columns are skipped.
//   CSV   The same.
//   PTS   The same, after a line that holds only the number of points. This may repeat.
//
// Points are numbered as in the file, from 0, as in mesh_file.h.

#include <filesystem>
#include <string>

#include "silhouette/error.h"
#include "silhouette/mesh/point_source.h"

namespace rimline {

/// Throws the same errors as read_mesh_file. A file without points is an error. Cost: O(file), at most a
/// few times its length in memory. A PLY or OBJ with faces is parsed twice.
PointSource read_point_file(const std::filesystem::path& path, BadPoints bad = BadPoints::refuse,
                            const LongCall& call = {});

/// The same for the bytes of a file, as read_mesh_bytes() takes them. `extension` may be ".xyz",
/// ".csv" or ".pts", too.
PointSource read_point_bytes(std::string name, std::string bytes, const std::string& extension,
                             BadPoints bad = BadPoints::refuse, const LongCall& call = {});

}  // namespace rimline
