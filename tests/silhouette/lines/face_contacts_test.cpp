#include "silhouette/lines/face_contacts.h"

#include <doctest/doctest.h>

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
