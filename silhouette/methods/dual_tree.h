#pragma once

// The geometric dual: a plane n·x = d as the point n/d, a viewpoint p as the plane x·p = 1.
//
// M. Pop, C. Duncan, G. Barequet, M. Goodrich, W. Huang, S. Kumar, Efficient perspective-accurate
// silhouette computation and applications, Symposium on Computational Geometry 2001. An edge is the
// segment between its faces' dual points. It is on the silhouette when the point's dual plane cuts the
// segment. A face turns when its dual point lies in the double wedge between the old dual plane and the new
// one. The authors search an octree of dual points for the wedge and take the first silhouette from another
// method. Here a second tree, of the segments, finds the first silhouette too. A direction v is the plane
// x·v = 0.
//
// About an origin O the dual point is D = n/(d - n·O), and n·p - w*d = (d - n·O)(D·q - w). Three rules
// make that robust. An edge whose faces have O on different sides is always tested: its segment passes
// through infinity. So is an edge of a plane so near to O that its side is not certain. D is replaced by a
// box of all its rounding errors. The dual of a plane near O is far away, and the boxes that reach there are
// large (thesis 3.2.1, Figure 3.1): a weakness of the method, not of this code.

#include "silhouette/methods/plane_space.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class DualTree final : public SilhouetteMethod {
public:
    /// `origin` must be within k_max_coordinate. `mesh` must outlive the method.
    DualTree(const Mesh& mesh, const glm::dvec3& origin);

    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override;
    std::vector<NamedCount> own_counts() const override;

private:
    PlaneSpace space_;
};

}  // namespace rimline
