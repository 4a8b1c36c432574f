#pragma once

// Reads the points of a file into a PointSource: PLY, OBJ, XYZ and PTS text in double precision; STL, OFF,
// glTF and GLB in the float of mesh_file.h. As strict as mesh_file.h: a file gives exactly what its bytes
// say or an Error that names the file and the line or byte.
//
//   PLY   x y z; nx ny nz; red green blue, whole numbers or shares of 1. All other properties are
//         stepped over.
//   OBJ   `v x y z [r g b]`, colors as shares of 1, or of 255 where one is above 1. `vn` are normals of
//         corners; where there are as many as vertices, and no face gives a vertex another than the one of
//         its number, they are the points'. Else they are not kept.
//   XYZ   a point a line, numbers separated by blanks, as many in every line; lines that begin with # or
//         // are comments. Three numbers are x y z. Of 4, 7 or 10 the fourth is an intensity; what
//         then remains are triples. A triple whose values are all of length 1 (within
//         1%, or zero) is a normal, a triple of whole numbers from 0 to 255 a color, whichever comes
//         first of each kind. Other columns are stepped over.
//   PTS   the same, with the number of points alone in the line before them, once or several times.
//
// Points are numbered as the file numbers them, from 0, as mesh_file.h does.

#include <filesystem>

#include "silhouette/error.h"
#include "silhouette/mesh/point_source.h"

namespace rimline {

/// Throws what read_mesh_file throws; a file without points is an error. Cost: O(file), at most a few
/// times its length in memory. A PLY or OBJ with faces is understood twice.
PointSource read_point_file(const std::filesystem::path& path, BadPoints bad = BadPoints::refuse,
                            const LongCall& call = {});

}  // namespace rimline
