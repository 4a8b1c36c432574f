#pragma once

// When the edges of a mesh are drawn, for programs that draw models with their edges and do not look for
// silhouettes themselves: the classes of the glTF extension EXT_mesh_primitive_edge_visibility
// (formats/glb_writer.h).
//
//   hard         always: borders, edges of three or more faces, and creases
//   silhouette   while one of its two faces is front and the other back
//   hidden       never: an edge that can be on no silhouette, because both faces lie in one plane
//
// An edge is flat if rounding can have made it: if its four corners can be moved into one plane by half a unit in
// the last place of the largest coordinate among them. To first order the volume of their tetrahedron then is at
// most
//
//     (1/3) * move * sum of the areas of its four triangles
//
// An exact test would take the diagonals of a rotated box for silhouettes. A valley is a silhouette edge: its faces
// can differ as those of a ridge can, on an open mesh also where it is seen.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// If an edge has several in a file, the last of them in this order counts.
enum class EdgeVisibility : std::uint8_t { hidden, silhouette, hard };

/// The class of each edge. `is_crease` has a flag for each edge (clear_crease_flags() or crease_flags()). An edge
/// is hidden, too, if a face of it has no plane and it is no crease. O(edges), in parallel.
std::vector<EdgeVisibility> edge_visibility(const Mesh& mesh,
                                            std::span<const std::uint8_t> is_crease);

/// A flag for each edge that bends by at least `min_bend_rad`. O(edges), in parallel.
std::vector<std::uint8_t> crease_flags(const Mesh& mesh, float min_bend_rad);

/// The class of each edge by the codes of its faces (MeshSource::edge_codes), one for each face. O(faces).
std::vector<EdgeVisibility> edge_visibility_of_codes(const Mesh& mesh,
                                                     std::span<const std::uint8_t> codes);

struct EdgeVisibilityCounts {
    std::uint32_t hidden = 0, silhouette = 0, hard = 0;
    bool operator==(const EdgeVisibilityCounts&) const = default;
};
EdgeVisibilityCounts count_classes(std::span<const EdgeVisibility> edges) noexcept;

}  // namespace rimline
