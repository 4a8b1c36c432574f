#include "silhouette/mesh/face_stars.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <glm/ext/vector_int3_sized.hpp>
#include <span>

#include "silhouette/mesh/face_pairs.h"
#include "tests/rounds.h"
#include "tests/silhouette/mesh/random.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

using Vector = glm::i64vec3;

Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
std::int64_t dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// Directions between two that are not parallel.
struct Sector {
    Vector a, b;
    Vector normal() const { return cross(a, b); }
    // Of a direction in its plane.
    bool has(const Vector& d) const {
        return dot(cross(a, d), normal()) >= 0 && dot(cross(d, b), normal()) >= 0;
    }
};

// By integers.
bool share_a_direction(const Sector& one, const Sector& other) {
    const Vector line = cross(one.normal(), other.normal());
    if (line != Vector(0))
        return (one.has(line) && other.has(line)) || (one.has(-line) && other.has(-line));
    return one.has(other.a) || one.has(other.b) || other.has(one.a) || other.has(one.b);
}

TEST_CASE("faces that are said to meet in a corner only have no direction in common") {
    tests::Random random(3);
    int said = 0, apart = 0;
    for (int round = 0; round < tests::rounds(40'000); ++round) {
        CAPTURE(round);
        // Some around a corner far from the origin; some in one plane, where most are nearly so.
        const int reach = round % 3 == 0 ? 2 : 9;
        const Vector corner = round % 2 == 0 ? Vector(0) : Vector(1000, -500, 77);
        const auto direction = [&] {
            return Vector(random.between(-reach, reach), random.between(-reach, reach),
                          round % 5 == 0 ? 0 : random.between(-reach, reach));
        };
        const Sector one{direction(), direction()}, other{direction(), direction()};
        if (one.normal() == Vector(0) || other.normal() == Vector(0)) continue;
        MeshSource source{.positions = {glm::vec3(corner)}};
        for (const Vector& d : {one.a, one.b, other.a, other.b})
            source.positions.emplace_back(corner + d);
        source.triangles = {{0, 1, 2}, {4, 0, 3}};
        const Mesh mesh(source);
        if (mesh.vertex_count() < 5) continue;  // They share a side.
        const bool says = meet_in_corner_only(mesh, 0, 1);
        CHECK(says == meet_in_corner_only(mesh, 1, 0));
        CHECK_FALSE((says && share_a_direction(one, other)));
        said += says;
        apart += !share_a_direction(one, other);
    }
    // A third of those that do, wide as they are.
    CHECK(said > apart / 3);
    const Mesh box(tests::tetrahedron());
    CHECK_FALSE(meet_in_corner_only(box, 0, 1));  // A common side.
}

TEST_CASE("a star of n faces is searched in the time of n pairs and not of all") {
    constexpr std::uint32_t k_faces = 20'000;
    for (const MeshSource& source :
         {tests::star(k_faces, 0.0), tests::star(k_faces, 2.0), tests::cone(k_faces, 1.0)}) {
        const Mesh mesh(source);
        std::uint64_t most = 200 * std::uint64_t{mesh.face_count()};
        CHECK(most < std::uint64_t{k_faces} * k_faces / 20);
        CHECK(each_near_face_pair(
            mesh, FaceTree(mesh), [](std::span<const FacePair>) { return true; }, {}, most));
    }
}

}  // namespace
}  // namespace rimline
