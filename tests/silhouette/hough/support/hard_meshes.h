#pragma once

// Meshes that break what assumes too much: soup, coplanar fans, planes through the origin of Hough
// space, duplicates, one face, none, a Moebius strip, books, far away, huge and tiny.

#include <cstdint>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh_source.h"

namespace rimline::tests {

struct NamedSource {
    std::string name;
    MeshSource source;
};

/// All of the hard ones.
std::vector<NamedSource> hard_meshes();

/// Those, and every built-in shape with about `faces` faces.
std::vector<NamedSource> made_meshes(std::uint32_t faces);

MeshSource triangle_soup(std::uint32_t faces, std::uint64_t seed);
/// A closed box of 12 faces.
MeshSource box(glm::vec3 low, glm::vec3 high);
/// Positions become scale * position + offset, in double, rounded once.
MeshSource placed(MeshSource source, double scale, glm::dvec3 offset);
/// Both, side by side.
MeshSource joined(MeshSource a, const MeshSource& b);

}  // namespace rimline::tests
