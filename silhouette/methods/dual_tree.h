#pragma once

// The geometric dual: a plane n·x = d as the point n/d, a viewpoint p as the plane x·p = 1.
//
// M. Pop, C. Duncan, G. Barequet, M. Goodrich, W. Huang, S. Kumar, Efficient perspective-accurate
// silhouette computation and applications, Symposium on Computational Geometry 2001. An edge is the
// segment between its faces' dual points and is on the silhouette when the point's dual plane cuts it;
// a face turns when its dual point lies in the double wedge between the old dual plane and the new. The
// authors search an octree of dual points for the wedge and take the first silhouette from another
// method; here a second tree, of the segments, finds it too. A direction is the plane x·v = 0.
//
// About an origin O the dual point is D = n/(d - n·O), and n·p - w*d = (d - n·O)(D·q - w). Three rules
// make that robust: an edge whose faces see O from different sides has its segment run through infinity
// and is tested always; so is what belongs to a plane so near to O that its side is not certain; and D
// is held in a box of all its rounding errors. The dual of a plane near O is far away, and boxes that
// reach there are large (thesis 3.2.1, Figure 3.1): that is the method's weakness, not this code's.

#include "silhouette/methods/plane_space.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class DualTree final : public SilhouetteMethod {
public:
    /// `origin` within k_max_coordinate.
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
