#include "silhouette/mesh/shapes/tube.h"

#include <doctest/doctest.h>
#include <cmath>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/shapes/circle.h"
#include "tests/silhouette/mesh/shapes/measures.h"

namespace rimline {
namespace {

glm::dvec3 cylinder_point(std::uint32_t ring, std::uint32_t side, std::uint32_t sides) {
    const CosSin around = cos_sin_of_turns(double(side) / sides);
    return {around.sin, double(ring), around.cos};
}

}  // namespace

TEST_CASE("a grid has about the quads asked for, and as many as it needs") {
    for (const double quads : {10.0, 100.0, 12'345.0, 1e8})
        for (const double aspect : {0.5, 3.0, 20.0}) {
            CAPTURE(quads);
            CAPTURE(aspect);
            const TubeGrid grid = tube_grid(quads, aspect, {1, 1});
            CHECK(double(grid.rings) * grid.sides == doctest::Approx(quads).epsilon(0.5));
            if (quads > 10'000.0)
                CHECK(double(grid.rings) / grid.sides == doctest::Approx(aspect).epsilon(0.05));
        }
    const TubeGrid least = tube_grid(1.0, 4.0, {24, 3});
    CHECK((least.rings == 24 && least.sides == 3));
}

TEST_CASE("a tube with poles is closed and looks outwards, down to a single ring") {
    for (const std::uint32_t rings : {1u, 2u, 5u})
        for (const std::uint32_t sides : {3u, 4u, 9u}) {
            CAPTURE(rings);
            CAPTURE(sides);
            MeshSource source;
            append_tube(
                source, {rings, sides},
                [&](std::uint32_t ring, std::uint32_t side) {
                    return cylinder_point(ring, side, sides);
                },
                Poles{{0, -0.5, 0}, {0, rings - 0.5, 0}});
            const Mesh mesh(source);
            CHECK(mesh.face_count() == 2 * (rings - 1) * sides + 2 * sides);
            CHECK(mesh.is_closed());
            CHECK(mesh.is_oriented());
            CHECK(tests::euler_characteristic(mesh) == 2);
            // A prism of height rings - 1 with a pyramid of height 1/2 at each end.
            const double base = 0.5 * sides * cos_sin_of_turns(1.0 / sides).sin;
            CHECK(tests::signed_volume(mesh) == doctest::Approx(base * (rings - 1 + 1.0 / 3.0)));
        }
}

TEST_CASE("a tube without poles joins its ends") {
    MeshSource source;
    append_tube(source, {5, 4}, [](std::uint32_t ring, std::uint32_t side) {
        const CosSin around = cos_sin_of_turns(ring / 5.0);
        const CosSin section = cos_sin_of_turns(side / 4.0);
        const double from_axis = 3.0 + section.cos;
        return glm::dvec3(from_axis * around.cos, from_axis * around.sin, section.sin);
    });
    const Mesh mesh(source);
    CHECK(mesh.face_count() == 40);
    CHECK(mesh.is_closed());
    CHECK(mesh.is_oriented());
    CHECK(tests::euler_characteristic(mesh) == 0);
}

TEST_CASE("tubes are appended behind what is there") {
    MeshSource source;
    const auto point = [](std::uint32_t ring, std::uint32_t side) {
        return cylinder_point(ring, side, 3);
    };
    append_tube(source, {2, 3}, point, Poles{{0, -1, 0}, {0, 2, 0}});
    append_tube(
        source, {2, 3},
        [&](std::uint32_t ring, std::uint32_t side) {
            return point(ring, side) + glm::dvec3(5, 0, 0);
        },
        Poles{{5, -1, 0}, {5, 2, 0}});
    const Mesh mesh(source);
    CHECK(mesh.component_count() == 2);
    CHECK(mesh.is_closed());
    CHECK(mesh.face_count() == 24);
}

}  // namespace rimline
