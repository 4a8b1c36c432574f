#include "tools/bench/edge_normals.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "silhouette/hough/spread_viewpoints.h"
#include "silhouette/mesh/angle_between.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;
using namespace rimline::tools;

TEST_CASE("edge normals: stored ones turn by no more than their steps") {
    const auto max_degrees = [](StoredNormals stored) {
        double max = 0.0;
        for (const HomogeneousPoint& p : spread_directions(20'000)) {
            const glm::vec3 normal = glm::normalize(p.xyz());
            max = std::max(max, angle_between(glm::dvec3(normal),
                                              glm::dvec3(stored_and_read(normal, stored))));
        }
        return glm::degrees(max);
    };
    CHECK(max_degrees(StoredNormals::floats) == 0.0);
    // Half a step of 1/127 along each axis across the normal.
    CHECK(max_degrees(StoredNormals::bytes) < 0.4);
    CHECK(max_degrees(StoredNormals::bytes) > 0.2);
    // A step and a half.
    CHECK(max_degrees(StoredNormals::cesium_bytes) < 0.8);
    CHECK(max_degrees(StoredNormals::oct16) < 1.0);
    CHECK(max_degrees(StoredNormals::oct16) > 0.3);
}

TEST_CASE("edge normals: of a sphere, floats are right and the others nearly") {
    const Mesh mesh(make_built_in_shape("sphere", 5000));
    const std::vector<EdgeVisibility> edges(mesh.edge_count(), EdgeVisibility::silhouette);
    const EdgeNormalsResult result = judge_edges(mesh, edges, 100, {});
    CHECK(result.silhouette > 5000);
    CHECK(result.hidden == 0);
    const auto of = [&](StoredNormals stored) { return result.misjudged[std::size_t(stored)]; };
    CHECK(of(StoredNormals::floats).missed + of(StoredNormals::floats).extra < 10);
    for (const StoredNormals stored :
         {StoredNormals::bytes, StoredNormals::cesium_bytes, StoredNormals::oct16}) {
        CHECK(of(stored).missed > 0);
        CHECK(of(stored).missed < result.silhouette / 5);
        CHECK(of(stored).extra < result.silhouette / 5);
    }
    CHECK(of(StoredNormals::bytes).missed < of(StoredNormals::cesium_bytes).missed);
    CHECK(of(StoredNormals::bytes).missed < of(StoredNormals::oct16).missed);
    // What is called hidden is counted as hidden.
    const EdgeNormalsResult none =
        judge_edges(mesh, std::vector<EdgeVisibility>(mesh.edge_count()), 100, {});
    CHECK(none.hidden == result.silhouette);
    CHECK(none.silhouette == 0);
}
