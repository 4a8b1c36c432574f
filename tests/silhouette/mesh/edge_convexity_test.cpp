#include "silhouette/mesh/edge_convexity.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string_view>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/random.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

glm::dvec3 corner(const Mesh& mesh, VertexId v) { return glm::dvec3(mesh.positions()[index(v)]); }

// How far the far corner of the edge's face 1 - side lies in front of the plane of its face `side`.
double height_over(const Mesh& mesh, EdgeId edge, std::size_t side) {
    const auto corners_of = [&](FaceId face) {
        const Triangle& t = mesh.triangles()[index(face)];
        return std::array{corner(mesh, t[0]), corner(mesh, t[1]), corner(mesh, t[2])};
    };
    const Edge& e = mesh.edge(edge);
    const auto face = corners_of(e.faces[side]);
    const glm::dvec3 normal = glm::normalize(glm::cross(face[1] - face[0], face[2] - face[0]));
    double height = 0.0;
    for (const glm::dvec3& p : corners_of(e.faces[1 - side])) {
        const double h = glm::dot(normal, p - face[0]);
        if (std::abs(h) > std::abs(height)) height = h;
    }
    return height;
}

EdgeConvexity turned_over(EdgeConvexity c) {
    if (c == EdgeConvexity::convex) return EdgeConvexity::concave;
    return c == EdgeConvexity::concave ? EdgeConvexity::convex : c;
}

MeshSource inside_out(MeshSource source) {
    for (auto& t : source.triangles) std::swap(t[1], t[2]);
    return source;
}

// Two faces on the edge from (0, 0, 0) to (0, 1, 0), front upwards, with their outer corners at these
// heights.
MeshSource roof(float left, float right) {
    return {{{0, 0, 0}, {0, 1, 0}, {-1, 0, left}, {1, 0, right}}, {{0, 1, 2}, {1, 0, 3}}};
}

EdgeConvexity of_the_regular_edge(const MeshSource& source) {
    const Mesh mesh(source);
    REQUIRE(mesh.edges_of_class(EdgeClass::regular).size() == 1);
    return edge_convexity(mesh, EdgeId{0});
}

TEST_CASE("a ridge is convex, a valley concave, and one plane is flat") {
    CHECK(of_the_regular_edge(roof(-1.0f, -1.0f)) == EdgeConvexity::convex);
    CHECK(of_the_regular_edge(roof(1.0f, 1.0f)) == EdgeConvexity::concave);
    CHECK(of_the_regular_edge(roof(0.0f, 0.0f)) == EdgeConvexity::flat);
    CHECK(of_the_regular_edge(roof(0.5f, -0.5f)) == EdgeConvexity::flat);
    // The least that floats can say.
    CHECK(of_the_regular_edge(roof(0.5f, std::nextafter(-0.5f, -1.0f))) == EdgeConvexity::convex);
    CHECK(of_the_regular_edge(roof(0.5f, std::nextafter(-0.5f, 0.0f))) == EdgeConvexity::concave);
    CHECK(of_the_regular_edge(roof(0.0f, 0x1p-149f)) == EdgeConvexity::concave);
    CHECK(of_the_regular_edge(roof(0.0f, -0x1p-149f)) == EdgeConvexity::convex);
    // One face folded onto the other, and a face without area.
    CHECK(of_the_regular_edge({{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {2, 0, 0}},
                               {{0, 1, 2}, {1, 0, 3}}}) == EdgeConvexity::flat);
    CHECK(of_the_regular_edge({{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 3, 0}},
                               {{0, 1, 2}, {1, 0, 3}}}) == EdgeConvexity::flat);
}

// Four whole points of one plane are exact in float, the products of their differences are not in double.
TEST_CASE("what rounding cannot tell from flat is flat, and nothing is ever called the opposite") {
    tests::Random random(8);
    std::uint32_t rounded = 0;
    std::uint32_t certain = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const auto whole = [&](int most) {
            const int x = random.between(-most, most);
            const int y = random.between(-most, most);
            const int z = random.between(-most, most);
            return glm::dvec3(x, y, z);
        };
        const glm::dvec3 u = whole(2000);
        const glm::dvec3 v = whole(2000);
        const glm::dvec3 origin = whole(100'000);
        const auto in_plane = [&](int i_least) {  // Different for each, so that no two are equal.
            return origin + double(random.between(i_least, i_least + 200)) * u +
                   double(random.between(-500, 500)) * v;
        };
        std::array<glm::dvec3, 4> p{in_plane(-500), in_plane(-200), in_plane(100), in_plane(400)};
        const auto of_points = [&] {
            MeshSource source;
            for (const glm::dvec3& q : p) source.positions.emplace_back(q);
            source.triangles = {{0, 1, 2}, {1, 0, 3}};
            return of_the_regular_edge(source);
        };
        const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);  // Exact.
        rounded += glm::dot(normal, p[3] - p[0]) != 0.0;
        REQUIRE(of_points() == EdgeConvexity::flat);
        // One step to the side, the determinant is the normal's x.
        p[3].x += 1.0;
        const EdgeConvexity found = of_points();
        REQUIRE(found != (normal.x > 0.0 ? EdgeConvexity::convex : EdgeConvexity::concave));
        certain += found != EdgeConvexity::flat;
    }
    CHECK(rounded > 100);
    CHECK(certain > 1000);
}

TEST_CASE("only regular edges are convex or concave") {
    for (const Mesh& mesh :
         {Mesh(tests::book(2)), Mesh(tests::book(5)), Mesh(tests::band(7, true)), Mesh({})}) {
        const std::uint32_t regular = mesh.edges_of_class(EdgeClass::regular).last;
        for (std::uint32_t e = regular; e < mesh.edge_count(); ++e)
            CHECK(edge_convexity(mesh, EdgeId{e}) == EdgeConvexity::none);
        CHECK(concave_edge_bits(mesh).size() == (regular + 31) / 32);
    }
    CHECK(Mesh(tests::book(2)).edges_of_class(EdgeClass::inconsistent).size() == 1);
    CHECK(Mesh(tests::book(5)).edges_of_class(EdgeClass::nonmanifold).size() == 1);
}

TEST_CASE("the class says on which side of each face's plane the other face lies") {
    std::uint32_t counts[3] = {};
    for (const std::string_view shape : k_built_in_shapes) {
        CAPTURE(shape);
        const Mesh mesh(make_built_in_shape(shape, 1500));
        const std::vector<std::uint32_t> bits = concave_edge_bits(mesh);
        for (std::uint32_t e = 0; e < mesh.edges_of_class(EdgeClass::regular).last; ++e) {
            const EdgeConvexity c = edge_convexity(mesh, EdgeId{e});
            ++counts[static_cast<std::size_t>(c)];
            for (const std::size_t side : {0u, 1u}) {
                const double height = height_over(mesh, EdgeId{e}, side);
                // What double cannot tell from flat is far below what it measures here.
                if (c == EdgeConvexity::convex) REQUIRE(height < 1e-14);
                if (c == EdgeConvexity::concave) REQUIRE(height > -1e-14);
                if (std::abs(height) > 1e-12) REQUIRE(c != EdgeConvexity::flat);
            }
            REQUIRE((bits[e / 32] >> (e % 32) & 1u) == (c == EdgeConvexity::concave));
        }
    }
    for (const std::uint32_t count : counts) CHECK(count > 100);
}

TEST_CASE("the class depends neither on the order of faces nor on the scale") {
    const MeshSource source = make_built_in_shape("knot", 1500);
    const Mesh mesh(source);
    const std::uint64_t seed = 5;
    CAPTURE(seed);
    const auto total = [](const Mesh& m) {
        std::array<std::uint32_t, 3> counts{};
        for (std::uint32_t e = 0; e < m.edges_of_class(EdgeClass::regular).last; ++e)
            ++counts[static_cast<std::size_t>(edge_convexity(m, EdgeId{e}))];
        return counts;
    };
    CHECK(total(Mesh(tests::shuffled(source, seed))) == total(mesh));
    const Mesh turned(inside_out(source));
    REQUIRE(turned.edge_count() == mesh.edge_count());
    for (const float scale : {0x1p-100f, 0x1p58f}) {
        MeshSource scaled = source;
        for (glm::vec3& p : scaled.positions) p *= scale;
        const Mesh other(scaled);
        for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
            REQUIRE(edge_convexity(other, EdgeId{e}) == edge_convexity(mesh, EdgeId{e}));
    }
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
        REQUIRE(edge_convexity(turned, EdgeId{e}) == turned_over(edge_convexity(mesh, EdgeId{e})));
}

TEST_CASE("removing keeps the order of the rest and edges that have no bit") {
    const std::vector<std::uint32_t> bits{1u << 3, 1u << 1};
    std::vector<EdgeId> edges{EdgeId{33}, EdgeId{4}, EdgeId{3}, EdgeId{500}, EdgeId{34}, EdgeId{0}};
    remove_concave_edges(bits, edges);
    CHECK(edges == std::vector<EdgeId>{EdgeId{4}, EdgeId{500}, EdgeId{34}, EdgeId{0}});
    remove_concave_edges({}, edges);
    CHECK(edges.size() == 4);
}

bool segment_hits(const glm::dvec3& from, const glm::dvec3& to,
                  const std::array<glm::dvec3, 3>& t) {
    const auto volume = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                           const glm::dvec3& d) {
        return glm::dot(glm::cross(b - a, c - a), d - a);
    };
    if ((volume(t[0], t[1], t[2], from) > 0.0) == (volume(t[0], t[1], t[2], to) > 0.0))
        return false;
    const bool side = volume(from, to, t[0], t[1]) > 0.0;
    return (volume(from, to, t[1], t[2]) > 0.0) == side &&
           (volume(from, to, t[2], t[0]) > 0.0) == side;
}

// Whether nothing lies between `p` and a place just before the middle of the edge. No face is left out,
// the edge's own least of all: one of them is what hides a valley.
bool is_visible(const Mesh& mesh, EdgeId edge, const glm::dvec3& p) {
    const Edge& e = mesh.edge(edge);
    const glm::dvec3 a = corner(mesh, e.vertices[0]);
    const glm::dvec3 b = corner(mesh, e.vertices[1]);
    const glm::dvec3 middle = 0.5 * (a + b);
    const double gap = 1e-4 * glm::length(b - a) / glm::length(p - middle);
    const glm::dvec3 target = middle + gap * (p - middle);
    return std::ranges::none_of(mesh.triangles(), [&](const Triangle& t) {
        return segment_hits(p, target,
                            {corner(mesh, t[0]), corner(mesh, t[1]), corner(mesh, t[2])});
    });
}

struct Seen {
    std::uint32_t removed = 0, removed_visible = 0, kept_visible = 0;
};

// Around a mesh of radius about 1.5 or less, clear of it.
Seen look_around(const Mesh& mesh, std::uint32_t points, std::uint64_t seed) {
    const std::vector<std::uint32_t> concave = concave_edge_bits(mesh);
    tests::Random random(seed);
    Seen seen;
    for (std::uint32_t i = 0; i < points; ++i) {
        const glm::vec3 p = glm::vec3(mesh.center()) + static_cast<float>(2.5 * mesh.radius()) *
                                                           glm::normalize(random.in_cube());
        const std::vector<EdgeId> all =
            brute_force_silhouette(mesh, HomogeneousPoint::viewpoint(p));
        std::vector<EdgeId> kept = all;
        remove_concave_edges(concave, kept);
        for (const EdgeId edge : all) {
            const bool is_kept = std::ranges::find(kept, edge) != kept.end();
            const bool is_seen = is_visible(mesh, edge, glm::dvec3(p));
            seen.removed += !is_kept;
            seen.removed_visible += !is_kept && is_seen;
            seen.kept_visible += is_kept && is_seen;
        }
    }
    return seen;
}

TEST_CASE("no edge that is removed is visible from outside a closed embedded shape") {
    const std::uint64_t seed = 6;
    CAPTURE(seed);
    for (const std::string_view shape : {"sphere", "torus", "knot", "box", "spring"}) {
        CAPTURE(shape);
        const Mesh mesh(make_built_in_shape(shape, 800));
        REQUIRE(mesh.is_closed());
        const Seen seen = look_around(mesh, 30, seed);
        MESSAGE(shape << ": " << seen.removed << " removed, " << seen.kept_visible
                      << " of the kept are visible");
        CHECK(seen.removed_visible == 0);
        CHECK(seen.kept_visible > 100);
        const bool has_valleys = shape != "sphere" && shape != "box";
        CHECK((seen.removed > 100) == has_valleys);
    }
}

TEST_CASE("on a shape turned inside out or open what is removed is visible, as documented") {
    const std::uint64_t seed = 7;
    CAPTURE(seed);
    const Mesh turned(inside_out(make_built_in_shape("torus", 800)));
    CHECK(look_around(turned, 10, seed).removed_visible > 100);
    const Mesh terrain(make_built_in_shape("terrain", 800));
    REQUIRE_FALSE(terrain.is_closed());
    CHECK(look_around(terrain, 30, seed).removed_visible > 10);
}

}  // namespace
}  // namespace rimline
