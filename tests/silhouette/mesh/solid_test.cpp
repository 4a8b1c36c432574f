#include "silhouette/mesh/solid.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <stop_token>
#include <vector>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/winding.h"
#include "tests/silhouette/mesh/random.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

using tests::Random;

MeshSource moved(MeshSource source, const glm::vec3& by, float scale = 1.0f) {
    for (glm::vec3& p : source.positions) p = scale * p + by;
    return source;
}

MeshSource both(MeshSource a, const MeshSource& b) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const auto& t : b.triangles)
        a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return a;
}

MeshSource turned(const MeshSource& source) {
    MeshSource other = source;
    for (auto& t : other.triangles) std::swap(t[1], t[2]);
    return other;
}

// Whether an edge goes through a face that it shares no vertex with, by five signs of volumes.
bool crosses_itself(const Mesh& mesh) {
    const auto corner = [&](VertexId v) { return glm::dvec3(mesh.positions()[index(v)]); };
    for (const Edge& edge : mesh.edges()) {
        const glm::dvec3 a = corner(edge.vertices[0]), b = corner(edge.vertices[1]);
        for (const Triangle& t : mesh.triangles()) {
            bool shares = false;
            for (const VertexId v : t) shares |= v == edge.vertices[0] || v == edge.vertices[1];
            if (shares) continue;
            const glm::dvec3 p = corner(t[0]), q = corner(t[1]), r = corner(t[2]);
            const auto side = [](const glm::dvec3& w, const glm::dvec3& x, const glm::dvec3& y,
                                 const glm::dvec3& z) {
                return glm::dot(x - w, glm::cross(y - w, z - w)) > 0.0;
            };
            if (side(a, p, q, r) == side(b, p, q, r)) continue;
            const bool around = side(a, b, p, q);
            if (around == side(a, b, q, r) && around == side(a, b, r, p)) return true;
        }
    }
    return false;
}

TEST_CASE("built-in shapes that are closed are solids at any number of faces" *
          doctest::test_suite("plain")) {
    for (const std::string_view shape : {"sphere", "torus", "knot", "box", "spring"})
        for (const std::uint32_t faces : {0u, 100u, 3'000u, 40'000u}) {
            CAPTURE(shape);
            CAPTURE(faces);
            const Mesh mesh(make_built_in_shape(shape, faces));
            CHECK(is_solid(mesh));
            CHECK_FALSE(is_solid(turned_inside_out(mesh)));
        }
    CHECK_FALSE(is_solid(Mesh(make_built_in_shape("terrain", 1'000))));
    CHECK_FALSE(is_solid(Mesh(MeshSource{})));
}

TEST_CASE(
    "shells beside and within each other are a solid, one that lines a hollow is not shown to be") {
    const MeshSource ball = make_built_in_shape("sphere", 300);
    CHECK(is_solid(Mesh(both(ball, moved(ball, {2.5f, 0.0f, 0.0f})))));
    CHECK(is_solid(Mesh(both(ball, moved(ball, glm::vec3(0.0f), 0.5f)))));
    CHECK_FALSE(is_solid(Mesh(both(ball, turned(moved(ball, glm::vec3(0.0f), 0.5f))))));
    CHECK_FALSE(is_solid(Mesh(both(ball, turned(moved(ball, {2.5f, 0.0f, 0.0f}))))));
    CHECK_FALSE(is_solid(Mesh(both(ball, moved(ball, {1.5f, 0.1f, 0.2f})))));
}

TEST_CASE("shells that touch in a corner are a solid, in an edge or a face not") {
    const MeshSource whole = tests::octahedron();
    CHECK(is_solid(Mesh(both(whole, moved(whole, {2.0f, 0.0f, 0.0f})))));
    // The corner of one in the middle of the other's face.
    CHECK_FALSE(is_solid(
        Mesh(both(moved(whole, glm::vec3(0.0f), 3.0f), moved(whole, {2.0f, 1.0f, 1.0f})))));
    const MeshSource box = make_built_in_shape("box", 12);
    CHECK_FALSE(is_solid(Mesh(both(box, moved(box, {2.0f, 2.0f, 0.0f})))));
    CHECK_FALSE(is_solid(Mesh(both(box, moved(box, {2.0f, 0.5f, 0.25f})))));
    CHECK(is_solid(Mesh(both(box, moved(box, {2.001f, 0.5f, 0.25f})))));
}

TEST_CASE("faces folded flat onto each other and sheets of two sides are no solids") {
    const MeshSource sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}};
    CHECK_FALSE(is_solid(Mesh(sheet)));
    // A tetrahedron with a face that is divided in three about a point in its plane, beyond an edge.
    MeshSource folded = tests::tetrahedron();
    folded.positions.push_back({-0.5f, -0.5f, -2.0f});
    folded.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 0, 4}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    CHECK_FALSE(is_solid(Mesh(folded)));
    folded.positions[4] = {0.4f, 0.4f, -0.3f};  // Within the face, a little outside its plane.
    CHECK(is_solid(Mesh(folded)));
}

TEST_CASE("what is too flat or too small for doubles to tell is not said to be a solid") {
    const auto flat = [](float height) {
        return Mesh(MeshSource{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25f, 0.25f, height}},
                               {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}});
    };
    CHECK(is_solid(flat(0x1p-20f)));
    CHECK_FALSE(is_solid(flat(-0x1p-20f)));
    CHECK_FALSE(is_solid(flat(0x1p-41f)));
    // A needle that encloses a negative volume, of less than its products' rounding; at any corner first.
    for (std::uint32_t first = 0; first < 4; ++first) {
        MeshSource needle{{{0.006118535064160824f, 0.006121410522609949f, 0.006627361290156841f},
                           {0.8314335942268372f, 0.8314335942268372f, 0.799463152885437f},
                           {0.8314276337623596f, 0.8314276337623596f, 0.7994624376296997f},
                           {0.831428050994873f, 0.831428050994873f, 0.7994691729545593f}},
                          {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
        std::rotate(needle.triangles.begin(), needle.triangles.begin() + first,
                    needle.triangles.end());
        for (auto& t : needle.triangles) std::rotate(t.begin(), t.begin() + first % 3, t.end());
        CHECK_FALSE(is_solid(Mesh(needle)));
    }
    // The corner of one on the edge of the other, in denormal numbers.
    const MeshSource a{{{-0x1.06cp-139f, -0x1.558p-140f, -0x1.dp-143f},
                        {-0x1.d46p-136f, 0x1.5b4p-136f, 0x1.12d8p-136f},
                        {-0x1.45e8p-136f, -0x1.6518p-136f, 0x1.83p-136f},
                        {-0x1.1158p-136f, -0x1.f41p-136f, -0x1.5e8p-140f}},
                       {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
    const MeshSource b{{{-0x1.b7p-137f, 0x1.114p-137f, 0x1.ceep-138f},
                        {-0x1.7ep-139f, 0x1.7d68p-136f, 0x1.678p-140f},
                        {-0x1.48ap-138f, 0x1.9c98p-136f, -0x1.48p-143f},
                        {-0x1.e2p-139f, 0x1.7c7p-136f, 0x1.068p-139f}},
                       {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
    for (const MeshSource& one : {a, turned(a)})
        for (const MeshSource& other : {b, turned(b)})
            CHECK_FALSE(is_solid(Mesh(both(one, other))));
}

// A cone of so many sides.
MeshSource cone(std::uint32_t sides) {
    MeshSource source{{{0, 0, 1}, {0, 0, 0}}, {}};
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / sides;
        source.positions.push_back({std::cos(angle), std::sin(angle), 0.0});
        const std::uint32_t a = 2 + i, b = 2 + (i + 1) % sides;
        source.triangles.push_back({0, a, b});
        source.triangles.push_back({1, b, a});
    }
    return source;
}

// Long thin faces between two rings, one of them tiny: their boxes overlap, and few meet in any corner.
MeshSource spike(std::uint32_t sides) {
    MeshSource source;
    for (const double radius : {1.0, 1e-3})
        for (std::uint32_t i = 0; i < sides; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / sides;
            source.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                                          1.0 - radius);
        }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t next = (i + 1) % sides;
        source.triangles.push_back({i, next, sides + i});
        source.triangles.push_back({next, sides + next, sides + i});
    }
    // The ends, by a zigzag.
    for (std::uint32_t low = 0, high = sides - 1; high - low > 1;) {
        const bool is_low = (low + high) % 2 != 0;
        const std::uint32_t middle = is_low ? low + 1 : high - 1;
        source.triangles.push_back({low, high, middle});
        source.triangles.push_back({sides + high, sides + low, sides + middle});
        (is_low ? low : high) = middle;
    }
    return source;
}

TEST_CASE("cones are solids and long thin faces in thousands are given up at once" *
          doctest::test_suite("plain")) {
    CHECK(is_solid(Mesh(cone(500))));
    CHECK(is_solid(Mesh(cone(50'000))));
    CHECK(is_solid(Mesh(spike(500))));
    CHECK_FALSE(is_solid(Mesh(spike(20000))));
}

TEST_CASE("dented balls are solids just where no edge goes through a face") {
    Random random(7);
    int solids = 0;
    constexpr int k_balls = 400;
    for (int ball = 0; ball < k_balls; ++ball) {
        MeshSource source = make_built_in_shape("sphere", 180);
        const int dents = random.between(1, 6);
        for (int d = 0; d < dents; ++d) {
            glm::vec3& p =
                source.positions[random.below(static_cast<std::uint32_t>(source.positions.size()))];
            p = p * (0.2f + random.signed_unit()) + 0.2f * random.in_cube();
        }
        const Mesh mesh(source);
        CAPTURE(ball);
        const bool expected = !crosses_itself(mesh);
        CHECK(is_solid(mesh) == expected);
        CHECK(is_solid(Mesh(tests::shuffled(source, 3))) == expected);
        solids += expected;
    }
    CHECK(solids > k_balls / 10);
    CHECK(solids < k_balls - k_balls / 10);
}

TEST_CASE("asking whether a mesh is a solid can be stopped, and reports how far it is") {
    const Mesh mesh(make_built_in_shape("knot", 200'000));
    std::stop_source stop;
    std::vector<double> reports;
    CHECK(is_solid(mesh, {{}, [&](double done) { reports.push_back(done); }}));
    CHECK(reports.size() > 2);
    CHECK(std::ranges::is_sorted(reports));
    stop.request_stop();
    CHECK_THROWS_AS(is_solid(mesh, {stop.get_token(), {}}), Error);
    // Also where nothing is searched.
    CHECK_THROWS_AS(is_solid(Mesh(cone(50'000)), {stop.get_token(), {}}), Error);
}

}  // namespace
}  // namespace rimline
