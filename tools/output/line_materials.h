#pragma once

// The colors of the surfaces along the lines of a drawing.

#include <cstdint>
#include <vector>

#include "silhouette/lines/line_drawing.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/material_inks.h"
#include "silhouette/mesh/mesh.h"
#include "tools/options/color.h"

namespace rimline::tools {

class LineMaterials {
public:
    /// `mesh` must outlive this object. O(faces) where faces have materials.
    explicit LineMaterials(const Mesh& mesh)
        : mesh_(&mesh), inks_(material_inks(mesh.materials())) {}

    const MaterialInks& inks() const noexcept { return inks_; }
    /// Dark shades of inks().colors, for lines on paper.
    std::vector<Color> inks_on_paper() const;
    /// The index in inks().colors of that face of an edge which is turned most towards `point`: of a silhouette, the
    /// front. k_no_material_ink for k_no_edge, an intersection of surfaces.
    std::uint8_t ink_of(EdgeId edge, const HomogeneousPoint& point) const;

private:
    const Mesh* mesh_;
    MaterialInks inks_;
};

}  // namespace rimline::tools
