#include "tests/silhouette/methods/proof/oracle.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline {
namespace {

TEST_CASE("the oracle takes the silhouette in any order and nothing else") {
    const Mesh mesh(make_built_in_shape("torus", 500));
    tests::Oracle oracle(mesh);
    const HomogeneousPoint point = HomogeneousPoint::viewpoint({3.0f, 1.0f, 2.0f});
    oracle.look_from(point);
    std::vector<EdgeId> edges(oracle.silhouette().begin(), oracle.silhouette().end());
    REQUIRE(edges.size() > 20);
    CHECK(oracle.agrees(edges));
    std::reverse(edges.begin(), edges.end());
    CHECK(oracle.agrees(edges));

    std::vector<EdgeId> wrong = edges;
    wrong.pop_back();
    CHECK_FALSE(oracle.agrees(wrong));
    wrong.push_back(wrong.front());
    CHECK_FALSE(oracle.agrees(wrong));
    wrong = edges;
    wrong.push_back(edges.front());
    CHECK_FALSE(oracle.agrees(wrong));
    wrong = edges;
    const auto other = std::ranges::find_if(mesh.edges(), [&](const Edge& edge) {
        const EdgeId id{static_cast<std::uint32_t>(&edge - mesh.edges().data())};
        return std::ranges::find(edges, id) == edges.end();
    });
    wrong.front() = EdgeId{static_cast<std::uint32_t>(other - mesh.edges().begin())};
    CHECK_FALSE(oracle.agrees(wrong));
    wrong.front() = k_no_edge;
    CHECK_FALSE(oracle.agrees(wrong));
    CHECK_FALSE(oracle.agrees({}));
    CHECK(oracle.agrees(edges));

    // A right result for one point is wrong for another.
    oracle.look_from(HomogeneousPoint::viewpoint({-3.0f, 1.0f, 2.0f}));
    CHECK_FALSE(oracle.agrees(edges));
    oracle.look_from(point);
    CHECK(oracle.agrees(edges));
    CHECK(oracle.checked_looks() == 3);
}

}  // namespace
}  // namespace rimline
