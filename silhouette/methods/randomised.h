#pragma once

// Randomized search: tests a few random edges, and follows the silhouette from each that is on it.
//
// L. Markosian, M. Kowalski, S. Trychin, L. Bourdev, D. Goldstein, J. Hughes, Real-Time
// Nonphotorealistic Rendering, SIGGRAPH 1997. Silhouettes of smooth shapes are long loops. One edge of
// a loop is enough to find the whole loop. Sharp edges are on silhouettes most often. So 8√edges seeds are
// drawn, with probabilities in proportion to the angle between the faces' normals; a smooth shape's
// silhouette has about √edges edges. An update takes the edges of the previous silhouette as seeds, and the
// edges around the vertices of those that have left it, with a quarter of the random seeds for new loops.
//
// All edges of the result are on the silhouette; loops without a seed are missed. The method is fast and not
// exact: the share of the silhouette that it finds must be reported beside any of its times.
//
// Inconsistent and non-manifold edges are treated like all others. Results are the same on every machine for
// the same seed and calls; extract() always starts from the seed.

#include <array>

#include "silhouette/methods/alias_table.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class Randomised final : public SilhouetteMethod {
public:
    /// `mesh` must outlive the method.
    Randomised(const Mesh& mesh, std::uint64_t seed);

    /// A subset of the silhouette, each edge once.
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override;
    /// The random edges tried in the last call, and those of them that were new edges of the silhouette.
    std::vector<NamedCount> own_counts() const override;

private:
    bool is_on_silhouette_from(EdgeId edge, const HomogeneousPoint& point);
    // Returns false also where this call has tested the edge before.
    bool test(EdgeId edge, const HomogeneousPoint& point);
    void begin_call();
    void try_random_edges(std::uint64_t count, const HomogeneousPoint& point);
    void trace(const HomogeneousPoint& point);
    void test_around(EdgeId edge, const HomogeneousPoint& point);
    void finish(std::vector<EdgeId>& edges, TraversalCounters& counters);

    const Mesh* mesh_;
    std::uint64_t seed_;
    RandomBits random_;
    std::uint64_t seed_count_;

    AliasTable edges_by_angle_;
    std::vector<std::uint32_t> vertex_begin_;
    std::vector<EdgeId> vertex_edges_;  // Of vertex v: [vertex_begin_[v], vertex_begin_[v + 1]).

    // One an edge but borders: all data that the test of most edges needs.
    struct EdgeToTest {
        std::array<Plane, 2> planes;  // Of the first two faces.
        std::uint32_t tested_in;      // The last call that tested the edge.
        EdgeClass edge_class;
    };
    std::vector<EdgeToTest> edges_;
    std::uint32_t call_ = 0;
    std::vector<EdgeId>
        found_;  // Edges found by this call; those before traced_ have been followed.
    std::size_t traced_ = 0;
    std::vector<EdgeId> previous_;
    std::uint64_t tried_ = 0;
    std::uint64_t hits_ = 0;
    TraversalCounters work_;
};

}  // namespace rimline
