#include "silhouette/mesh/shapes/built_in_shape.h"

#include <doctest/doctest.h>
#include <bit>
#include <cmath>
#include <numbers>

#include "silhouette/error.h"
#include "silhouette/mesh/shapes/shape_makers.h"
#include "tests/silhouette/mesh/shapes/measures.h"

namespace rimline {
namespace {

constexpr std::array<std::string_view, 5> k_closed_shapes{"sphere", "torus", "knot", "box",
                                                          "spring"};
constexpr std::array<std::uint32_t, 17> k_face_counts{
    0, 1, 2, 3, 4, 12, 99, 100, 123, 150, 300, 777, 1000, 4321, 10'000, 100'000, 400'000};

// FNV-1a over the bits of everything.
std::uint64_t fingerprint(const MeshSource& source) {
    std::uint64_t h = 0xcbf29ce484222325u;
    const auto add = [&](std::uint32_t word) { h = (h ^ word) * 0x100000001b3u; };
    for (const glm::vec3& p : source.positions)
        for (int axis = 0; axis < 3; ++axis) add(std::bit_cast<std::uint32_t>(p[axis]));
    for (const auto& t : source.triangles)
        for (const std::uint32_t v : t) add(v);
    return h;
}

}  // namespace

TEST_CASE("closed shapes are closed oriented outwards two-manifold and of the right genus" *
          doctest::test_suite("plain")) {
    for (const std::string_view name : k_closed_shapes)
        for (const std::uint32_t faces : k_face_counts) {
            CAPTURE(name);
            CAPTURE(faces);
            const MeshSource source = make_built_in_shape(name, faces);
            const Mesh mesh(source);
            CHECK(mesh.is_closed());
            CHECK(mesh.is_oriented());
            CHECK(mesh.edges_of_class(EdgeClass::nonmanifold).size() == 0);
            CHECK(mesh.degenerate_face_count() == 0);
            CHECK(mesh.component_count() == 1);
            CHECK(mesh.vertex_count() == source.positions.size());  // Welded already.
            CHECK(tests::signed_volume(mesh) > 0.0);
            CHECK(tests::euler_characteristic(mesh) == (name == "torus" || name == "knot" ? 0 : 2));
        }
}

TEST_CASE(
    "face counts follow the request within a factor of two, and closely when there are many") {
    for (const std::string_view name : k_built_in_shapes)
        for (const std::uint32_t faces : k_face_counts) {
            CAPTURE(name);
            CAPTURE(faces);
            const auto made = double(make_built_in_shape(name, faces).triangles.size());
            CHECK(made >= 2);
            if (faces < (name == "scene" ? 1000 : 100)) continue;
            CHECK(made >= 0.5 * faces);
            CHECK(made <= 2.0 * faces);
            if (faces >= 10'000) CHECK(made == doctest::Approx(faces).epsilon(0.05));
        }
}

TEST_CASE("coarse and fine shapes do not cut through themselves" * doctest::test_suite("plain")) {
    for (const std::string_view name : k_closed_shapes)
        for (const std::uint32_t faces : {1u, 150u, 250u, 500u, 1500u, 3000u}) {
            CAPTURE(name);
            CAPTURE(faces);
            const Mesh mesh(make_built_in_shape(name, faces));
            std::uint32_t cuts = 0;
            for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
                for (std::uint32_t g = 0; g < f; ++g) cuts += tests::faces_intersect(mesh, f, g);
            CHECK(cuts == 0);
        }
}

TEST_CASE("a sphere's vertices lie on the unit sphere and its faces are alike") {
    for (const std::uint32_t faces : {20u, 1000u, 100'000u}) {
        CAPTURE(faces);
        const Mesh mesh(make_built_in_shape("sphere", faces));
        for (const glm::vec3& p : mesh.positions())
            REQUIRE(std::abs(glm::length(glm::dvec3(p)) - 1.0) < 0x1.8p-24);
        double least = 1e9;
        double greatest = 0.0;
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            const double area =
                glm::length(glm::cross(tests::corner(mesh, f, 1) - tests::corner(mesh, f, 0),
                                       tests::corner(mesh, f, 2) - tests::corner(mesh, f, 0)));
            least = std::min(least, area);
            greatest = std::max(greatest, area);
        }
        CHECK(greatest < 2.5 * least);
    }
}

TEST_CASE("volumes come to those of the smooth shapes") {
    constexpr double k_pi = std::numbers::pi;
    const auto volume = [](std::string_view name) {
        return tests::signed_volume(Mesh(make_built_in_shape(name, 100'000)));
    };
    CHECK(volume("sphere") == doctest::Approx(4.0 / 3.0 * k_pi).epsilon(1e-3));
    CHECK(volume("torus") == doctest::Approx(2.0 * k_pi * k_pi * 0.16).epsilon(1e-3));
    CHECK(volume("box") == doctest::Approx(8.0));
    // Of a tube around a curve: section times length, whatever the curve (Pappus).
    CHECK(volume("knot") == doctest::Approx(k_pi * 0.25 * 0.25 * 15.337).epsilon(2e-3));
    const double helix = 4.0 * std::hypot(2.0 * k_pi * 0.8, 0.55);
    CHECK(volume("spring") ==
          doctest::Approx(k_pi * 0.18 * 0.18 * (helix + 4.0 / 3.0 * 0.18)).epsilon(4e-3));
}

TEST_CASE("smooth shapes bend gently everywhere, seams and ends too") {
    for (const std::string_view name : {"sphere", "torus", "knot", "spring"}) {
        CAPTURE(name);
        const double coarse = tests::sharpest_bend(Mesh(make_built_in_shape(name, 4000)));
        const double fine = tests::sharpest_bend(Mesh(make_built_in_shape(name, 64'000)));
        CHECK(coarse < 0.7);
        CHECK(fine < 0.33 * coarse);  // Four times finer along each direction.
    }
}

TEST_CASE("a box's vertices lie on its surface and its planes are its six") {
    const Mesh mesh(make_built_in_shape("box", 5000));
    for (const glm::vec3& p : mesh.positions())
        CHECK(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) == 1.0f);
    for (const Plane& plane : mesh.planes()) {
        CHECK(plane.d == 1.0f);
        CHECK(std::abs(plane.nx) + std::abs(plane.ny) + std::abs(plane.nz) == 1.0f);
    }
}

TEST_CASE("terrain is one open sheet that looks up and is no steeper when finer") {
    for (const std::uint32_t faces : {1u, 2u, 8u, 1000u, 100'000u}) {
        CAPTURE(faces);
        const Mesh mesh(make_built_in_shape("terrain", faces));
        const auto n = static_cast<std::uint32_t>(std::lround(std::sqrt(mesh.face_count() / 2.0)));
        CHECK(mesh.face_count() == 2 * n * n);
        CHECK_FALSE(mesh.is_closed());
        CHECK(mesh.is_oriented());
        CHECK(mesh.edges_of_class(EdgeClass::border).size() == 4 * n);
        CHECK(tests::euler_characteristic(mesh) == 1);
        CHECK(mesh.bounds().low.x == -1.0f);
        CHECK(mesh.bounds().high.z == 1.0f);
        for (const Plane& plane : mesh.planes()) REQUIRE(plane.ny > 0.1f);
    }
    const Mesh mesh(make_built_in_shape("terrain", 10'000));
    const float relief = mesh.bounds().high.y - mesh.bounds().low.y;
    CHECK(relief > 0.2f);
    CHECK(relief < 1.0f);
}

TEST_CASE("finer terrain passes through the points of coarser") {
    const MeshSource coarse = make_built_in_shape("terrain", 2 * 10 * 10);
    const MeshSource fine = make_built_in_shape("terrain", 2 * 40 * 40);
    for (std::uint32_t j = 0; j <= 10; ++j)
        for (std::uint32_t i = 0; i <= 10; ++i)
            CHECK(coarse.positions[j * 11 + i] == fine.positions[4 * j * 41 + 4 * i]);
}

TEST_CASE("a torus has the radii asked for") {
    const Mesh mesh(make_torus(2000, 3.0, 0.5));
    for (const glm::vec3& p : mesh.positions())
        CHECK(std::abs(std::hypot(std::hypot(p.x, p.z) - 3.0f, p.y) - 0.5f) < 1e-6f);
}

TEST_CASE("shapes are the same on every machine, bit for bit") {
    struct Golden {
        std::string_view name;
        std::uint64_t fingerprint;
    };
    const Golden goldens[] = {{"sphere", 0x08e31e02483c4241u}, {"torus", 0xa31d3dc22d2eed55u},
                              {"knot", 0xcba8c3a98385835du},   {"box", 0xe66c8c18c1cbdac7u},
                              {"spring", 0x72ebfa51ee96c799u}, {"terrain", 0x005c21987345abedu},
                              {"scene", 0x6b6bc94c8630cd82u}};
    for (const auto& [name, expected] : goldens) {
        CAPTURE(name);
        CHECK(fingerprint(make_built_in_shape(name, 1000)) == expected);
    }
}

TEST_CASE("more faces than fit are refused") {
    for (const std::string_view name : k_built_in_shapes) {
        CAPTURE(name);
        try {
            make_built_in_shape(name, (1u << 28) + 1);
            FAIL("not refused");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::too_large);
        }
    }
}

}  // namespace rimline
