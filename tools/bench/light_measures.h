#pragma once

// How well a directional light shows what a viewpoint sees, measured on the CPU at the pixels of one
// picture: matte surfaces with smooth normals, as they are drawn (corner_normals.h), each seen from its
// visible side.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/bench/item_buffer.h"

namespace rimline::tools {

struct LightMeasure {
    double away = 0.0;   ///< Share of visible pixels whose face turns away from the light.
    double unlit = 0.0;  ///< The same, and those in a cast shadow.
    double contrast =
        0.0;  ///< Mean gradient of the cosine, for each hundredth of the picture's side.
};

class LitView {
public:
    /// From outside the mesh's sphere, zoomed on the mesh, which must outlive this.
    LitView(const Mesh& mesh, const glm::dvec3& eye);

    /// `sun` is a direction towards the light, of length 1. Cast shadows are those of a lamp 40 radii away.
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
