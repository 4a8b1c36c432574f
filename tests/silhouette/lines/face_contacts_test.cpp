#include "silhouette/lines/face_contacts.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <set>
#include <vector>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

FaceContacts contacts_of(const MeshSource& source) {
    const Mesh mesh(source);
    const FaceTree tree(mesh);
    return find_face_contacts(mesh, tree, find_flat_faces(mesh));
}

// Face 0 lies in the plane z = 0; face 1 as given.
MeshSource two_faces(const std::array<glm::vec3, 3>& other) {
    return {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, other[0], other[1], other[2]},
            {{0, 1, 2}, {3, 4, 5}}};
}

TEST_CASE("faces that share corners and edges only have no contacts") {
    CHECK(contacts_of(tests::tetrahedron()).empty());
    CHECK(contacts_of(tests::octahedron()).empty());
    CHECK(contacts_of(make_built_in_shape("knot", 2000)).empty());
    CHECK(contacts_of(tests::book(5)).empty());
    CHECK(contacts_of({}).empty());
    CHECK(contacts_of(two_faces({{{9, 9, 9}, {8, 9, 9}, {9, 8, 9}}})).empty());
}

TEST_CASE("two edges of a face pierce another") {
    const FaceContacts found = contacts_of(two_faces({{{1, 1, -1}, {1, 1, 1}, {1, 2, 1}}}));
    CHECK(found.piercings.size() == 2);
    CHECK(found.crossings.empty());
    CHECK(found.footholds.empty());
    CHECK(found.touches.empty());
}

TEST_CASE("an edge through an edge is a crossing of both") {
    const FaceContacts found = contacts_of(two_faces({{{2, 0, -1}, {2, 0, 1}, {2, -3, 0}}}));
    CHECK(found.crossings.size() == 2);
    CHECK(found.piercings.empty());
}

TEST_CASE("a corner on a face is a touch, on its side a foothold too") {
    const FaceContacts inside = contacts_of(two_faces({{{1, 1, 0}, {1, 1, 3}, {2, 1, 3}}}));
    REQUIRE(inside.touches.size() == 1);
    CHECK(inside.touches[0].side == FaceContacts::Touch::k_inside);
    CHECK(inside.footholds.empty());
    const FaceContacts on_side = contacts_of(two_faces({{{1, 0, 0}, {1, 1, 3}, {2, 1, 3}}}));
    REQUIRE(on_side.touches.size() == 1);
    CHECK(on_side.touches[0].side < 3);
    CHECK(on_side.footholds.size() == 1);
}

TEST_CASE("contacts do not depend on the order of faces") {
    MeshSource source;
    tests::Random random(3);
    for (std::uint32_t f = 0; f < 200; ++f) {
        for (int k = 0; k < 3; ++k)
            source.positions.push_back({float(random.between(0, 9)), float(random.between(0, 9)),
                                        float(random.between(0, 9))});
        source.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    const FaceContacts first = contacts_of(source);
    random.shuffle(source.triangles);
    const FaceContacts second = contacts_of(source);
    CHECK(!first.piercings.empty());
    CHECK(first.piercings.size() == second.piercings.size());
    CHECK(first.crossings.size() == second.crossings.size());
    CHECK(first.footholds.size() == second.footholds.size());
    CHECK(first.touches.size() == second.touches.size());
}

// Of sides that have no vertex of the face, by five signs of volumes.
std::vector<FaceContacts::Piercing> piercings_by_volumes(const Mesh& mesh) {
    std::vector<FaceContacts::Piercing> all;
    const auto at = [&](VertexId v) { return glm::dvec3(mesh.positions()[index(v)]); };
    const auto is_left = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                            const glm::dvec3& d) {
        return glm::dot(b - a, glm::cross(c - a, d - a)) > 0.0;
    };
    for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge) {
        const auto& ends = mesh.edges()[edge].vertices;
        const glm::dvec3 a = at(ends[0]), b = at(ends[1]);
        for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
            const Triangle& t = mesh.triangles()[face];
            if (std::ranges::find_first_of(t, ends) != t.end()) continue;
            const glm::dvec3 p = at(t[0]), q = at(t[1]), r = at(t[2]);
            if (is_left(a, p, q, r) == is_left(b, p, q, r)) continue;
            const bool around = is_left(a, b, p, q);
            if (around == is_left(a, b, q, r) && around == is_left(a, b, r, p))
                all.push_back({edge, face});
        }
    }
    return all;
}

TEST_CASE("stars that go through each other have the contacts of their faces") {
    tests::Random random(11);
    for (int round = 0; round < 12; ++round) {
        CAPTURE(round);
        // The sides of a cone. (Its base has sides in its plane, which volumes in doubles do not see.)
        MeshSource source = tests::star(400, 0.2 + 0.3 * round);
        const MeshSource through = tests::star(300, 0.7 + round % 3);
        const auto first = static_cast<std::uint32_t>(source.positions.size());
        const glm::vec3 shift = 0.4f * random.in_cube();
        for (const glm::vec3& p : through.positions) source.positions.push_back(p + shift);
        for (const auto& t : through.triangles)
            source.triangles.push_back({first + t[0], first + t[1], first + t[2]});
        const Mesh mesh(source);
        const auto found =
            find_face_contacts(mesh, FaceTree(mesh), find_flat_faces(mesh)).piercings;
        CHECK(found.size() > 100);
        CHECK(found == piercings_by_volumes(mesh));
    }
}

// Twice the area of p, q, r in a plane, of whole numbers.
int area_of(const glm::ivec2& p, const glm::ivec2& q, const glm::ivec2& r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}
int sign_of(int value) { return (value > 0) - (value < 0); }

// Faces in one plane with corners at whole numbers, and what meets by these.
struct LatticeFaces {
    explicit LatticeFaces(std::uint64_t seed) {
        tests::Random random(seed);
        std::set<std::array<std::uint32_t, 3>> used;
        while (source.triangles.size() < 60) {
            std::array<std::uint32_t, 3> t{};
            for (std::uint32_t& corner : t)
                corner = static_cast<std::uint32_t>(random.below(k_side * k_side));
            std::array<std::uint32_t, 3> sorted = t;
            std::ranges::sort(sorted);
            if (area_of(at(t[0]), at(t[1]), at(t[2])) != 0 && used.insert(sorted).second)
                source.triangles.push_back(t);
        }
    }
    static glm::ivec2 at(std::uint32_t corner) {
        return {int(corner) % k_side, int(corner) / k_side};
    }
    void place(int orientation) {
        source.positions.clear();
        for (std::uint32_t i = 0; i < k_side * k_side; ++i) {
            const glm::vec2 p(at(i));
            source.positions.push_back(orientation == 0   ? glm::vec3(p.x, p.y, 0)
                                       : orientation == 1 ? glm::vec3(2, p.x, p.y)
                                                          : glm::vec3(p.x, p.y, -p.x - p.y));
        }
    }
    static constexpr int k_side = 6;
    MeshSource source;
};

TEST_CASE("faces in one plane have the contacts that whole numbers find") {
    std::size_t touches = 0, crossings = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        for (int orientation = 0; orientation < 3; ++orientation) {
            CAPTURE(seed);
            CAPTURE(orientation);
            LatticeFaces faces(seed);
            faces.place(orientation);
            const Mesh mesh(faces.source);
            const FaceContacts found =
                find_face_contacts(mesh, FaceTree(mesh), find_flat_faces(mesh));
            const auto place = [&](VertexId v) { return LatticeFaces::at(mesh.file_vertex(v)); };
            std::vector<std::array<std::uint32_t, 2>> expected, touched, crossed;
            for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
                for (std::uint32_t g = 0; g < mesh.face_count(); ++g) {
                    const Triangle& t = mesh.triangles()[g];
                    if (std::ranges::count(t, VertexId{v}) > 0) continue;
                    std::array<int, 3> signs{};
                    for (std::size_t k = 0; k < 3; ++k)
                        signs[k] = sign_of(
                            area_of(place(t[k]), place(t[(k + 1) % 3]), place(VertexId{v})));
                    if (std::ranges::min(signs) >= 0 || std::ranges::max(signs) <= 0)
                        expected.push_back({v, g});
                }
            for (const FaceContacts::Touch& touch : found.touches)
                touched.push_back({touch.vertex, touch.face});
            CHECK(touched == expected);
            touches += expected.size();
            expected.clear();
            for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
                for (std::uint32_t f = 0; f < mesh.edge_count(); ++f) {
                    const auto& [a, b] = mesh.edge(EdgeId{e}).vertices;
                    const auto& [c, d] = mesh.edge(EdgeId{f}).vertices;
                    const auto turn = [&](VertexId p, VertexId q, VertexId r) {
                        return sign_of(area_of(place(p), place(q), place(r)));
                    };
                    if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0)
                        expected.push_back({e, f});
                }
            for (const auto& crossing : found.crossings)
                crossed.push_back({crossing.edge, crossing.other});
            CHECK(crossed == expected);
            crossings += expected.size();
            CHECK(found.piercings.empty());
        }
    CHECK(touches > 1000);
    CHECK(crossings > 1000);
}

TEST_CASE("a search can be cancelled") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const FaceTree tree(mesh);
    std::stop_source stop;
    stop.request_stop();
    CHECK_THROWS_AS(find_face_contacts(mesh, tree, find_flat_faces(mesh), {stop.get_token(), {}}),
                    Error);
}

}  // namespace
}  // namespace rimline
