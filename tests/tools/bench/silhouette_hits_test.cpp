#include "tools/bench/silhouette_hits.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "silhouette/hough/spread_viewpoints.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/points/point_silhouette.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

using Vertices = std::set<std::uint32_t>;

Vertices with_neighbors(const Mesh& mesh, const Vertices& vertices) {
    Vertices wide = vertices;
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const std::uint32_t a = index(mesh.edge(EdgeId{e}).vertices[0]);
        const std::uint32_t b = index(mesh.edge(EdgeId{e}).vertices[1]);
        if (vertices.contains(a)) wide.insert(b);
        if (vertices.contains(b)) wide.insert(a);
    }
    return wide;
}

std::uint64_t common(const Vertices& a, const Vertices& b) {
    std::uint64_t count = 0;
    for (const std::uint32_t v : a) count += b.contains(v);
    return count;
}

// The definition, by sets.
void add(SilhouetteHits& hits, const Mesh& mesh, const Vertices& found, const Vertices& truth) {
    hits.truth += truth.size();
    hits.found += found.size();
    hits.hits += common(found, truth);
    hits.near_found += common(found, with_neighbors(mesh, truth));
    hits.near_truth += common(truth, with_neighbors(mesh, found));
}

void check_equal(const SilhouetteHits& a, const SilhouetteHits& b) {
    CHECK(a.truth == b.truth);
    CHECK(a.found == b.found);
    CHECK(a.hits == b.hits);
    CHECK(a.near_found == b.near_found);
    CHECK(a.near_truth == b.near_truth);
}

}  // namespace

TEST_CASE("hits of silhouettes and of every threshold are those that sets of vertices give") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    std::vector<glm::dvec3> positions;
    for (const glm::vec3& p : mesh.positions()) positions.emplace_back(p);
    const PointSurface surface(positions);
    const SilhouetteComparison result = compare_silhouettes(mesh, surface, {});

    const UmbrellaIndex umbrellas(surface);
    SilhouetteHits by_umbrellas;
    std::vector<SilhouetteHits> by_threshold(k_threshold_count);
    for (const HomogeneousPoint& direction : spread_directions(16)) {
        const glm::vec3 eye(mesh.center() +
                            2.5 * mesh.radius() * glm::normalize(glm::dvec3(direction.xyz())));
        Vertices truth;
        for (const EdgeId edge : brute_force_silhouette(mesh, HomogeneousPoint::viewpoint(eye)))
            for (const VertexId v : mesh.edge(edge).vertices) truth.insert(index(v));
        Vertices found;
        for (const PointId p :
             PointSilhouette(umbrellas, umbrellas.viewpoint(glm::dvec3(eye))).points())
            found.insert(index(p));
        add(by_umbrellas, mesh, found, truth);
        for (const std::uint32_t t : {0u, 17u, 24u, k_threshold_count - 1}) {
            Vertices thresholded;
            for (std::uint32_t v = 0; v < surface.size(); ++v) {
                const glm::dvec3 normal = surface.normal(PointId{v});
                const glm::dvec3 to = glm::normalize(glm::dvec3(eye) - positions[v]);
                if (normal != glm::dvec3(0.0) && std::abs(glm::dot(normal, to)) < threshold(t))
                    thresholded.insert(v);
            }
            add(by_threshold[t], mesh, thresholded, truth);
        }
    }
    CHECK(by_umbrellas.truth > 1000);
    check_equal(result.umbrellas, by_umbrellas);
    for (const std::uint32_t t : {0u, 17u, 24u, k_threshold_count - 1})
        check_equal(result.thresholds[t], by_threshold[t]);
    // A closed smooth mesh that is sampled well is found again nearly whole, and no threshold does that.
    CHECK(result.umbrellas.score() > 0.9);
    const std::uint32_t best = best_threshold({{"knot", "smooth", &result}});
    for (const SilhouetteHits& hits : result.thresholds)
        CHECK(hits.score() <= result.thresholds[best].score());
    CHECK(result.thresholds[best].score() < result.umbrellas.score());
}

TEST_CASE("without true points no point is missed") {
    const SilhouetteHits none;
    CHECK(none.recall() == 1.0);
    CHECK(none.precision() == 1.0);
    SilhouetteHits wrong;
    wrong.truth = wrong.found = 3;
    CHECK(wrong.score() == 0.0);
}
