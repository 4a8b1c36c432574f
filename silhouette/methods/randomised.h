#pragma once

// Randomised search: a few random edges, and from each that is on the silhouette along it.
//
// L. Markosian, M. Kowalski, S. Trychin, L. Bourdev, D. Goldstein, J. Hughes, Real-Time
// Nonphotorealistic Rendering, SIGGRAPH 1997. Silhouettes of smooth shapes are long loops, of which one
// edge is enough to find all, and sharp edges are on them most often. So seeds are drawn in proportion
// to the angle between the faces' normals, 8√edges of them, as a smooth shape's silhouette has some
// √edges. A move begins with the silhouette that was: its edges are the seeds, and where one has left,
// all those around its vertices, with a quarter of the random ones for loops that are new.
//
// What is found is on the silhouette; loops that no seed meets are missed. So it is fast, and not
// exact: what share of the silhouette it finds must be reported beside any time of it.
//
// Inconsistent and non-manifold edges take part like all others. The same for the same seed and calls,
// on every machine; extract() always starts from the seed.

#include <array>

#include "silhouette/methods/alias_table.h"
#include "silhouette/methods/silhouette_method.h"

namespace rimline {

class Randomised final : public SilhouetteMethod {
public:
    Randomised(const Mesh& mesh, std::uint64_t seed);

    /// A subset of the silhouette, each edge once.
    void extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                 TraversalCounters& counters) override;
    void update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                TraversalCounters& counters) override;
    /// Random edges tried in the last call, and how many of them were on the silhouette and not yet
    /// found.
    std::vector<NamedCount> own_counts() const override;

private:
    bool is_on_silhouette_from(EdgeId edge, const HomogeneousPoint& point);
    // False too when it was tested before in this call.
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

    // By edge, borders excepted: all that a test of most edges needs, in one place.
    struct EdgeToTest {
        std::array<Plane, 2> planes;  // Of the first two faces.
        std::uint32_t tested_in;      // The call that tested it last.
        EdgeClass edge_class;
    };
    std::vector<EdgeToTest> edges_;
    std::uint32_t call_ = 0;
    std::vector<EdgeId> found_;  // In this call; those before traced_ have been traced.
    std::size_t traced_ = 0;
    std::vector<EdgeId> previous_;
    std::uint64_t tried_ = 0;
    std::uint64_t hits_ = 0;
    TraversalCounters work_;
};

}  // namespace rimline
