#pragma once

// What a file or a generator says of points, before equal ones are merged: the input of PointCloud, as
// MeshSource is that of Mesh.
//
// Positions are doubles: a scan in a surveyor's coordinates has its millimetres far behind the point.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/mesh_source.h"

namespace rimline {

/// sRGB, 8 bits a channel: red, green, blue.
using PointColor = std::array<std::uint8_t, 3>;

/// What to do with positions that are NaN or infinite. Finite ones beyond k_max_coordinate are an error.
enum class BadPoints {
    refuse,  ///< The first is an error that names its place, and its number, from 0, where a file has one.
    keep,  ///< They keep their numbers; PointCloud leaves them out and counts them.
};

struct PointSource {
    /// In the file's own numbering. Finite ones within k_max_coordinate; others only where they were
    /// asked for (BadPoints::keep).
    std::vector<glm::dvec3> positions;
    /// As the file says, of any length, zero where a point has none; one a position, or empty.
    std::vector<glm::vec3> normals;
    /// One a position, or empty.
    std::vector<PointColor> colors;
    /// How strongly a scanner's light came back, in the file's own unit; one a position, or empty.
    std::vector<float> intensities;
    /// The faces of a file that holds a mesh, as positions' indices: not for finding silhouettes, but to
    /// know what is true of its points. Empty where a position is not finite.
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// The file format's convention.
    UpAxis up = UpAxis::y;
};

/// A mesh's positions, its faces kept aside.
PointSource points_of(MeshSource mesh);

}  // namespace rimline
