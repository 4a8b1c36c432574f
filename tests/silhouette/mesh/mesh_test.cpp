#include "silhouette/mesh/mesh.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stop_token>
#include <tuple>
#include <vector>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/small_meshes.h"
#include "tests/stops.h"

namespace rimline {
namespace {

using tests::band;
using tests::book;
using tests::closed_grid;
using tests::Indices;
using tests::with_any_positions;

struct Counts {
    std::uint32_t vertices, faces, regular, inconsistent, nonmanifold, border, degenerate,
        components;
    bool closed, oriented;
    bool operator==(const Counts&) const = default;
};

Counts counts_of(const Mesh& mesh) {
    return {mesh.vertex_count(),
            mesh.face_count(),
            mesh.edges_of_class(EdgeClass::regular).size(),
            mesh.edges_of_class(EdgeClass::inconsistent).size(),
            mesh.edges_of_class(EdgeClass::nonmanifold).size(),
            mesh.edges_of_class(EdgeClass::border).size(),
            mesh.degenerate_face_count(),
            mesh.component_count(),
            mesh.is_closed(),
            mesh.is_oriented()};
}

// Everything the header says of edges, from a linear scan of the triangles.
void check_edges(const Mesh& mesh) {
    struct Side {
        std::uint32_t face;
        std::uint32_t corner;
        bool ascending;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> sides_of;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& t = mesh.triangles()[f];
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
            for (const EdgeId e : mesh.edges_of(FaceId{f})) CHECK(e == k_no_edge);
            continue;
        }
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint32_t a = index(t[c]);
            const std::uint32_t b = index(t[(c + 1) % 3]);
            sides_of[{std::min(a, b), std::max(a, b)}].push_back({f, c, a < b});
        }
    }
    REQUIRE(mesh.edge_count() == sides_of.size());
    std::tuple<std::size_t, std::uint32_t, std::uint32_t> previous{};
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
        CAPTURE(e);
        const Edge& edge = mesh.edge(EdgeId{e});
        const std::uint32_t low = std::min(index(edge.vertices[0]), index(edge.vertices[1]));
        const std::uint32_t high = std::max(index(edge.vertices[0]), index(edge.vertices[1]));
        const auto found = sides_of.find({low, high});
        REQUIRE(found != sides_of.end());
        const std::vector<Side>& sides = found->second;

        const EdgeClass expected = sides.size() == 1  ? EdgeClass::border
                                   : sides.size() > 2 ? EdgeClass::nonmanifold
                                   : sides[0].ascending == sides[1].ascending
                                       ? EdgeClass::inconsistent
                                       : EdgeClass::regular;
        CHECK(mesh.edge_class(EdgeId{e}) == expected);
        const Mesh::EdgeRange range = mesh.edges_of_class(expected);
        CHECK((range.first <= e && e < range.last));

        const std::span<const FaceId> faces = mesh.faces_of(EdgeId{e});
        REQUIRE(faces.size() == sides.size());
        for (std::size_t i = 0; i < sides.size(); ++i) {
            CHECK(index(faces[i]) == sides[i].face);
            CHECK(mesh.edges_of(FaceId{sides[i].face})[sides[i].corner] == EdgeId{e});
        }
        CHECK(edge.faces[0] == faces[0]);
        CHECK(edge.faces[1] == (sides.size() == 2 ? faces[1] : k_no_face));
        CHECK((index(edge.vertices[0]) == low) == sides[0].ascending);

        const std::tuple order{static_cast<std::size_t>(expected), low, high};
        if (e > 0) CHECK(previous < order);
        previous = order;
    }
}

Mesh checked(const MeshSource& source) {
    Mesh mesh(source);
    check_edges(mesh);
    return mesh;
}

}  // namespace

TEST_CASE("a mesh without triangles is empty") {
    const Mesh nothing = checked({});
    CHECK(counts_of(nothing) == Counts{0, 0, 0, 0, 0, 0, 0, 0, false, true});
    CHECK(nothing.radius() == 0.0);
    const Mesh points = checked({{{1, 2, 3}, {4, 5, 6}}, {}});
    CHECK(points.vertex_count() == 0);
    CHECK(points.file_vertex_count() == 2);
    CHECK(points.bounds().high == glm::vec3(0.0f));
}

TEST_CASE("one triangle has three borders") {
    const Mesh mesh = checked({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
    CHECK(counts_of(mesh) == Counts{3, 1, 0, 0, 0, 3, 0, 1, false, true});
    CHECK(mesh.plane(FaceId{0}).nz == 1.0f);
}

TEST_CASE("a tetrahedron is closed and oriented") {
    const Mesh mesh = checked(tests::tetrahedron());
    CHECK(counts_of(mesh) == Counts{4, 4, 6, 0, 0, 0, 0, 1, true, true});
    CHECK(mesh.radius() == doctest::Approx(std::sqrt(3.0)));
    CHECK(mesh.center() == glm::dvec3(0.0));
}

TEST_CASE("a face turned over makes its three edges inconsistent") {
    MeshSource source = tests::tetrahedron();
    std::swap(source.triangles[2][0], source.triangles[2][1]);
    CHECK(counts_of(checked(source)) == Counts{4, 4, 3, 3, 0, 0, 0, 1, true, false});
}

TEST_CASE("equal positions are one vertex, zero and minus zero too") {
    // Two triangles of a square, their shared corners written twice with different zeros.
    const MeshSource source{
        {{0.0f, -0.0f, 0}, {1, 0, 0}, {1, 1, 0}, {-0.0f, 0.0f, -0.0f}, {1, 1, -0.0f}, {0, 1, 0}},
        {{0, 1, 2}, {3, 4, 5}}};
    const Mesh mesh = checked(source);
    CHECK(counts_of(mesh) == Counts{4, 2, 1, 0, 0, 4, 0, 1, false, true});
    CHECK(mesh.file_vertex_count() == 6);
    CHECK(mesh.file_vertex(VertexId{0}) == 0);
    CHECK(mesh.file_vertex(VertexId{3}) == 5);
}

TEST_CASE("nearly equal positions stay apart") {
    const MeshSource source{
        {{1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 0x1p-149f}, {2, 0, 0}, {1, -1, 0}},
        {{0, 1, 2}, {4, 3, 5}}};
    CHECK(counts_of(checked(source)) == Counts{5, 2, 0, 0, 0, 6, 0, 2, false, true});
}

TEST_CASE("unused vertices are dropped, and the first of equals stands for all even if unused") {
    const MeshSource source{
        {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {7, 7, 7}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{4, 5, 6}}};
    const Mesh mesh = checked(source);
    REQUIRE(mesh.vertex_count() == 3);
    CHECK(mesh.file_vertex_count() == 7);
    CHECK(mesh.file_vertex(VertexId{0}) == 1);
    CHECK(mesh.file_vertex(VertexId{1}) == 2);
    CHECK(mesh.file_vertex(VertexId{2}) == 6);
    CHECK(mesh.bounds().high == glm::vec3(1, 1, 0));
}

TEST_CASE("triangles with equal corners are counted and have no edges") {
    const MeshSource source{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}},
                            {{0, 1, 2}, {0, 1, 1}, {1, 2, 3}, {2, 2, 2}}};
    const Mesh mesh = checked(source);
    CHECK(counts_of(mesh) == Counts{3, 4, 0, 0, 0, 3, 3, 1, false, true});
    CHECK_FALSE(mesh.plane(FaceId{1}).has_normal());
}

TEST_CASE("a mesh of nothing but degenerate triangles is not closed") {
    const Mesh mesh = checked({{{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}, {0, 0, 0}}});
    CHECK(counts_of(mesh) == Counts{2, 2, 0, 0, 0, 0, 2, 0, false, true});
}

TEST_CASE("a collinear triangle is counted as degenerate but joins its neighbors") {
    const MeshSource source{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}},
                            {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}}};
    const Mesh mesh = checked(source);
    CHECK(mesh.degenerate_face_count() == 1);
    CHECK(mesh.component_count() == 1);
    CHECK(mesh.edges_of_class(EdgeClass::border).size() == 5);
}

TEST_CASE("a book of three wings has one edge with three faces") {
    const Mesh mesh = checked(book(3));
    CHECK(counts_of(mesh) == Counts{5, 3, 0, 0, 1, 6, 0, 1, false, true});
    const EdgeId spine{mesh.edges_of_class(EdgeClass::nonmanifold).first};
    CHECK(mesh.faces_of(spine).size() == 3);
    CHECK(mesh.edge(spine).faces[1] == k_no_face);
}

TEST_CASE("two tetrahedra with a common edge are closed: every edge has an even number of faces") {
    const MeshSource source = with_any_positions(
        6,
        {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {0, 1, 4}, {0, 4, 5}, {0, 5, 1}, {1, 5, 4}});
    const Mesh mesh = checked(source);
    CHECK(counts_of(mesh) == Counts{6, 8, 10, 0, 1, 0, 0, 1, true, true});
}

TEST_CASE("two tetrahedra with a common vertex are two components") {
    const MeshSource source = with_any_positions(
        7,
        {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}});
    CHECK(counts_of(checked(source)) == Counts{7, 8, 12, 0, 0, 0, 0, 2, true, true});
}

TEST_CASE("a triangle and its reverse are closed, a triangle twice is inconsistent") {
    CHECK(counts_of(checked(with_any_positions(3, {{0, 1, 2}, {2, 1, 0}}))) ==
          Counts{3, 2, 3, 0, 0, 0, 0, 1, true, true});
    CHECK(counts_of(checked(with_any_positions(3, {{0, 1, 2}, {1, 2, 0}}))) ==
          Counts{3, 2, 0, 3, 0, 0, 0, 1, true, false});
}

TEST_CASE("a plain band is oriented, a Moebius band has one inconsistent edge") {
    for (const std::uint32_t quads : {3u, 4u, 9u}) {
        CAPTURE(quads);
        const std::uint32_t n = 2 * quads;
        CHECK(counts_of(checked(band(quads, false))) ==
              Counts{n, n, n, 0, 0, n, 0, 1, false, true});
        CHECK(counts_of(checked(band(quads, true))) ==
              Counts{n, n, n - 1, 1, 0, n, 0, 1, false, false});
    }
}

TEST_CASE("a torus grid is oriented, a Klein bottle is closed but not") {
    CHECK(counts_of(checked(closed_grid(5, 7, false))) ==
          Counts{35, 70, 105, 0, 0, 0, 0, 1, true, true});
    CHECK(counts_of(checked(closed_grid(5, 7, true))) ==
          Counts{35, 70, 98, 7, 0, 0, 0, 1, true, false});
}

TEST_CASE("edges of random soups are as a linear scan finds them") {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        CAPTURE(seed);
        tests::Random random(seed);
        const std::uint32_t vertices = 1 + random.below(12);
        Indices triangles(random.below(40));
        for (auto& t : triangles)
            for (std::uint32_t& corner : t) corner = random.below(vertices);
        checked(with_any_positions(vertices, triangles));
    }
}

TEST_CASE("counts do not depend on the order of vertices, faces and corners") {
    tests::Random random(7);
    Indices soup(60);
    for (auto& t : soup)
        for (std::uint32_t& corner : t) corner = random.below(20);
    const std::vector<MeshSource> sources{with_any_positions(20, soup),
                                          band(6, true),
                                          book(5),
                                          closed_grid(4, 5, true),
                                          make_built_in_shape("terrain", 200),
                                          make_built_in_shape("scene", 600)};
    for (const MeshSource& source : sources) {
        const Counts expected = counts_of(checked(source));
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            CAPTURE(seed);
            CHECK(counts_of(checked(tests::shuffled(source, seed))) == expected);
        }
    }
}

TEST_CASE("a fan around a vertex of very high valence is built") {
    constexpr std::uint32_t k_faces = 200'000;
    MeshSource source;
    source.positions.emplace_back(0.0f, 0.0f, 1.0f);
    for (std::uint32_t i = 0; i <= k_faces; ++i) {
        source.positions.emplace_back(float(i), float(i) * float(i % 7), 0.0f);
        if (i > 0) source.triangles.push_back({0, i, i + 1});
    }
    const Mesh mesh(source);
    CHECK(mesh.edges_of_class(EdgeClass::regular).size() == k_faces - 1);
    CHECK(mesh.edges_of_class(EdgeClass::border).size() == k_faces + 2);
    CHECK(mesh.component_count() == 1);
}

TEST_CASE("bounds, center and radius are of the used vertices") {
    const Mesh mesh({{{50, 50, 50}, {-1, 0, 0}, {3, 0, 0}, {1, 2, 0}}, {{1, 2, 3}}});
    CHECK(mesh.bounds().low == glm::vec3(-1, 0, 0));
    CHECK(mesh.bounds().high == glm::vec3(3, 2, 0));
    CHECK(mesh.center() == glm::dvec3(1, 1, 0));
    CHECK(mesh.radius() == std::sqrt(5.0));
}

TEST_CASE("the largest coordinates give finite measures") {
    constexpr float m = k_max_coordinate;
    const Mesh mesh =
        checked({{{m, m, m}, {-m, m, m}, {m, -m, -m}, {-m, -m, -m}}, {{0, 1, 2}, {2, 1, 3}}});
    CHECK(mesh.degenerate_face_count() == 0);
    CHECK(mesh.center() == glm::dvec3(0.0));
    CHECK(mesh.radius() == doctest::Approx(std::sqrt(3.0) * 0x1p60));
}

TEST_CASE("the up axis is the source's") {
    MeshSource source = tests::tetrahedron();
    CHECK(Mesh(source).up() == UpAxis::y);
    source.up = UpAxis::z;
    CHECK(Mesh(source).up() == UpAxis::z);
}

TEST_CASE("a source whose arrays do not fit together stops the program") {
    const auto stops_with = [](const std::function<void(MeshSource&)>& change) {
        MeshSource source = tests::tetrahedron();
        change(source);
        return tests::stops([&] { Mesh mesh(source); });
    };
    CHECK_FALSE(stops_with([](MeshSource& s) { s.edge_codes.resize(s.triangles.size()); }));
    CHECK(stops_with([](MeshSource& s) { s.edge_codes.resize(s.triangles.size() - 1); }));
    CHECK(stops_with([](MeshSource& s) { s.triangles[0][1] = 4; }));
    CHECK(stops_with([](MeshSource& s) { s.positions[0].x = std::nanf(""); }));
    CHECK(stops_with([](MeshSource& s) { s.materials.of_face.resize(2); }));
}

TEST_CASE("a mesh being made tells how far it is, and stops at any of its checkpoints") {
    const MeshSource source = make_built_in_shape("knot", 300'000);
    std::vector<double> shares;
    LongCall call;
    call.progress = [&](double share) { shares.push_back(share); };
    const Mesh followed(source, Welding::equal_positions, call);
    CHECK(counts_of(followed) == counts_of(Mesh(source)));
    // Each of three loops over the vertices has three at least: at 0, 65536 and 131072.
    REQUIRE(shares.size() >= 9);
    CHECK(std::ranges::is_sorted(shares));
    CHECK(shares.front() == 0.0);
    CHECK(shares.back() == 1.0);
    for (std::size_t last = 1; last < shares.size(); ++last) {
        CAPTURE(last);
        std::stop_source stop;
        std::size_t calls = 0;
        call.stop = stop.get_token();
        call.progress = [&](double) {
            if (++calls == last) stop.request_stop();
        };
        CHECK_THROWS_AS(Mesh(source, Welding::equal_positions, call), Error);
        CHECK(calls == last);
    }
}

}  // namespace rimline
