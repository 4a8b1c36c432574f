#pragma once

// The Gauss map: silhouettes along directions only.
//
// B. Gooch, P. Sloan, A. Gooch, P. Shirley, R. Riesenfeld, Interactive Technical Illustration,
// Symposium on Interactive 3D Graphics 1999; F. Benichou, G. Elber, Output Sensitive Extraction of
// Silhouettes from Polygonal Geometry, Pacific Graphics 1999. A face is its normal on the unit sphere,
// an edge is the arc between its faces' normals. An edge is on the silhouette along v when the great circle
// v·x = 0 cuts the arc. Gooch et al. keep arcs in a hierarchy of cells of the sphere; Benichou and Elber
// project the sphere onto a cube, where arcs become segments and great circles lines.
//
// Here normals are projected onto the cube, n/|n|∞, and a hierarchy of boxes holds the arcs. A segment
// is not split where it leaves a side of the cube: straight through the cube it spans the same plane with
// the center as the arc, so the great circle cuts both or neither. Viewpoints are refused: a viewpoint sees
// every face along a different direction.

#include "silhouette/methods/plane_space.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class GaussMap final : public SilhouetteMethod {
public:
    /// `mesh` must outlive the method.
    explicit GaussMap(const Mesh& mesh);

    /// Both throw Error{bad_input} for viewpoints.
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override;

private:
    PlaneSpace space_;
};

}  // namespace rimline
