#include "engine/frame/vertex_places.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/random.h"

using namespace rimline;
using namespace rimline::tests;

TEST_CASE("a table of vertices has exactly the vertices") {
    constexpr std::uint64_t k_seed = 4;
    CAPTURE(k_seed);
    Random random(k_seed);
    for (const std::uint32_t faces : {1u, 12u, 400u, 5000u}) {
        MeshSource source = make_built_in_shape(faces < 400 ? "box" : "knot", std::max(faces, 12u));
        source.triangles.resize(std::min<std::size_t>(faces, source.triangles.size()));
        const Mesh mesh(source);
        const VertexPlaces places(mesh);
        for (const glm::vec3& vertex : mesh.positions()) {
            CHECK(places.has(vertex));
            glm::vec3 beside = vertex;
            const int axis = static_cast<int>(random.below(3));
            beside[axis] = std::nextafter(beside[axis], std::numeric_limits<float>::max());
            CHECK(places.has(beside) ==
                  (std::ranges::find(mesh.positions(), beside) != mesh.positions().end()));
        }
    }
    const Mesh zero(MeshSource{{{0.0f, -0.0f, 0.0f}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    CHECK(VertexPlaces(zero).has({-0.0f, 0.0f, -0.0f}));
    CHECK_FALSE(VertexPlaces(zero).has({1, 1, 0}));
    CHECK_FALSE(VertexPlaces(Mesh(MeshSource{})).has({0, 0, 0}));
}

TEST_CASE("a light on a vertex is moved a little outwards, any other stays") {
    const Mesh box(make_built_in_shape("box", 12));
    const VertexPlaces corners(box);
    for (const glm::vec3& vertex : box.positions()) {
        const HomogeneousPoint beside =
            light_off_vertices(corners, HomogeneousPoint::viewpoint(vertex));
        CHECK(beside.xyz() != vertex);
        CHECK(glm::distance(beside.xyz(), vertex) < 3e-5f);
        CHECK(glm::length(beside.xyz()) > glm::length(vertex));  // Outwards.
    }
    for (const HomogeneousPoint& other :
         {HomogeneousPoint::viewpoint({0.25f, 1.0f, 0.5f}), HomogeneousPoint::viewpoint({0, 0, 0}),
          HomogeneousPoint::viewpoint({5, 1, 1}), HomogeneousPoint::direction({1, 1, 1})})
        CHECK(light_off_vertices(corners, other) == other);
    // At the end of coordinates it can only go inwards, and where its neighbor is a vertex too, on.
    const float end = k_max_coordinate;
    const float next = 1.0f + 0x1p-16f;
    const Mesh vast(MeshSource{{{end, end, end}, {0, 0, 0}, {end, 0, 0}}, {{0, 1, 2}}});
    const HomogeneousPoint inwards =
        light_off_vertices(VertexPlaces(vast), HomogeneousPoint::viewpoint({end, end, end}));
    CHECK(inwards.is_valid());
    CHECK(inwards.xyz() != glm::vec3(end));
    const Mesh twins(MeshSource{{{1, 1, 1}, {next, next, next}, {0, 0, 1}}, {{0, 1, 2}}});
    const HomogeneousPoint past =
        light_off_vertices(VertexPlaces(twins), HomogeneousPoint::viewpoint({1, 1, 1}));
    for (const glm::vec3& vertex : twins.positions()) CHECK(past.xyz() != vertex);
}
