#pragma once

// A built-in shape with its index, which holds on to the mesh.

#include <cstdint>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline::tests {

struct IndexedShape {
    IndexedShape(const char* shape, std::uint32_t faces)
        : mesh(make_built_in_shape(shape, faces)), octree(mesh) {}
    const Mesh mesh;
    const HoughOctree octree;
};

}  // namespace rimline::tests
