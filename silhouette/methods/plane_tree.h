#pragma once

// Boxes in plane space: a plane n·x = d as the point (n, d) of four dimensions.
//
// A. Hertzmann, D. Zorin, Illustrating Smooth Surfaces, SIGGRAPH 2000. A silhouette point (p, w) is the
// hyperplane n·p - w*d = 0. A box of planes with center c and half extents e lies on one side
// of it when |c·p - w*c_d| > e·|p| + w*e_d. They project planes onto the sides of a hypercube, with an
// octree a side, and search for zeros between vertices. Here planes keep their unit normals, so that one tree
// holds all of them, and the result is a set of edges. There is no origin to choose, and so no edge that is
// on the silhouette from the origin. Distances are taken about the mesh's center only to keep them small.

#include "silhouette/methods/plane_space.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class PlaneTree final : public SilhouetteMethod {
public:
    /// `mesh` must outlive the method.
    explicit PlaneTree(const Mesh& mesh);

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override;

private:
    PlaneSpace space_;
};

}  // namespace rimline
