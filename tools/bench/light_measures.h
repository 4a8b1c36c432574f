#pragma once

// Measures of a directional light for one viewpoint, on the CPU at the pixels of one picture. Surfaces are
// matte and have the smooth normals with which they are drawn (corner_normals.h), on their visible side.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/bench/item_buffer.h"

namespace rimline::tools {

struct LightMeasure {
    double away = 0.0;      ///< Share of visible pixels whose face turns away from the light.
    double unlit = 0.0;     ///< The same, and those in a cast shadow.
    double contrast = 0.0;  ///< Mean gradient of the cosine per hundredth of the picture's side.
};

class LitView {
public:
    /// The eye must be outside the mesh's sphere. The picture is zoomed to the mesh. `mesh` must outlive this
    /// object.
    LitView(const Mesh& mesh, const glm::dvec3& eye);

    /// `sun` is the direction towards the light, of length 1. Cast shadows are those of a lamp at 40 radii.
    LightMeasure measure(const glm::dvec3& sun) const;

private:
    struct Pixel {
        glm::dvec3 place, face_normal, normal;
        bool is_surface = false;
    };
    const Mesh& mesh_;
    std::vector<Pixel> pixels_;
};

}  // namespace rimline::tools
