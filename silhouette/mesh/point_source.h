#pragma once

// The points of a file or generator, before equal ones are merged. It is the input of PointCloud, as
// MeshSource is the input of Mesh.
//
// Positions are doubles, because a scan in survey coordinates needs millimeters in numbers of many
// digits.

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/mesh_source.h"

namespace rimline {

/// sRGB, 8 bits a channel: red, green, blue.
using PointColor = std::array<std::uint8_t, 3>;

/// What to do with positions that are NaN or infinite. Finite positions beyond k_max_coordinate are
/// always an error.
enum class BadPoints {
    refuse,  ///< The first one is an error that names its place and, if the file has one, its number.
    keep,    ///< They keep their numbers. PointCloud drops and counts them.
};

struct PointSource {
    /// Numbered as in the file. Finite ones are within k_max_coordinate. Others occur only with
    /// BadPoints::keep.
    std::vector<glm::dvec3> positions;
    /// One per position, or empty. As in the file: of any length, zero if a point has none.
    std::vector<glm::vec3> normals;
    /// One per position, or empty.
    std::vector<PointColor> colors;
    /// The strength of the scanner's returned light, in the file's unit. One per position, or empty.
    std::vector<float> intensities;
    /// The faces of a file that holds a mesh, as indices into `positions`. They are a reference to
    /// compare results for the points with, not an input for silhouettes. Empty if a position is not
    /// finite.
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// The up axis of the file format.
    UpAxis up = UpAxis::y;
    bool is_up_known = false;  ///< As MeshSource::is_up_known.
    /// The files that the file refers to, as in MeshSource.
    std::vector<std::filesystem::path> files = {};
};

/// The positions of a mesh. Its faces go to `triangles`.
PointSource points_of(MeshSource mesh);

}  // namespace rimline
