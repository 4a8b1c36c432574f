#include "silhouette/mesh/plane.h"

#include <doctest/doctest.h>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/random.h"

namespace rimline {
namespace {

// A float operation through double, rounded once more, gives the correctly rounded float result (double
// has more than twice the digits), and no compiler can fuse it.
struct Steps {
    float nx_px, ny_py, nz_pz, first_sum, sum, wd;
    bool front() const { return sum > wd; }
};

Steps in_steps(const Plane& plane, const HomogeneousPoint& p) {
    const auto rounded = [](double value) { return static_cast<float>(value); };
    Steps s{};
    s.nx_px = rounded(double(plane.nx) * double(p.x));
    s.ny_py = rounded(double(plane.ny) * double(p.y));
    s.nz_pz = rounded(double(plane.nz) * double(p.z));
    s.first_sum = rounded(double(s.nx_px) + double(s.ny_py));
    s.sum = rounded(double(s.first_sum) + double(s.nz_pz));
    s.wd = rounded(double(p.w) * double(plane.d));
    return s;
}

bool front_if_fused(const Plane& plane, const HomogeneousPoint& p) {
    return std::fma(plane.nz, p.z, std::fma(plane.nx, p.x, plane.ny * p.y)) > p.w * plane.d;
}

std::array<glm::vec3, 3> corners_of(const Mesh& mesh, std::uint32_t face) {
    const Triangle& t = mesh.triangles()[face];
    return {mesh.positions()[index(t[0])], mesh.positions()[index(t[1])],
            mesh.positions()[index(t[2])]};
}

float scaled(float value, int exponent) { return std::ldexp(value, exponent); }
glm::vec3 scaled(glm::vec3 v, int exponent) {
    return {scaled(v.x, exponent), scaled(v.y, exponent), scaled(v.z, exponent)};
}

}  // namespace

TEST_CASE("the plane of a counter-clockwise triangle looks at who sees it so") {
    const Plane plane = supporting_plane({{{0, 0, 2}, {1, 0, 2}, {0, 1, 2}}});
    CHECK((plane.nx == 0.0f && plane.ny == 0.0f && plane.nz == 1.0f && plane.d == 2.0f));
    const Plane back = supporting_plane({{{0, 0, 2}, {0, 1, 2}, {1, 0, 2}}});
    CHECK((back.nz == -1.0f && back.d == -2.0f));
}

TEST_CASE("normals are of unit length and corners lie on their plane, from tiny to huge") {
    for (std::uint64_t seed = 1; seed <= 200; ++seed)
        for (const int exponent : {-120, -60, -20, 0, 20, 59}) {
            CAPTURE(seed);
            CAPTURE(exponent);
            tests::Random random(seed);
            const std::array<glm::vec3, 3> corners{scaled(random.in_cube(), exponent),
                                                   scaled(random.in_cube(), exponent),
                                                   scaled(random.in_cube(), exponent)};
            const Plane plane = supporting_plane(corners);
            const glm::dvec3 n(plane.nx, plane.ny, plane.nz);
            CHECK(std::abs(glm::length(n) - 1.0) < 1e-7);
            for (const glm::vec3& corner : corners)
                CHECK(std::abs(glm::dot(n, glm::dvec3(corner)) - plane.d) <
                      4e-7 * std::ldexp(1.0, exponent) + k_min_plane_distance);
        }
}

TEST_CASE("a triangle whose cross product is zero has no plane and is always back") {
    const std::array<std::array<glm::vec3, 3>, 4> degenerate{{{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}},
                                                              {{{1, 2, 3}, {4, 5, 6}, {4, 5, 6}}},
                                                              {{{1, 2, 3}, {4, 5, 6}, {1, 2, 3}}},
                                                              {{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}}}};
    for (const auto& corners : degenerate) {
        const Plane plane = supporting_plane(corners);
        CHECK_FALSE(plane.has_normal());
        CHECK(plane.d == 0.0f);
        CHECK_FALSE(is_front(plane, HomogeneousPoint::viewpoint({5, -7, 9})));
        CHECK_FALSE(is_front(plane, HomogeneousPoint::direction({0, 0, -1})));
    }
}

TEST_CASE("the smallest triangles there are have a plane") {
    constexpr float e = 0x1p-149f;
    const Plane plane = supporting_plane({{{0, 0, e}, {e, 0, e}, {0, e, e}}});
    CHECK(plane.nz == 1.0f);
    CHECK(plane.d == 0.0f);  // Below the smallest normal float.
    CHECK(supporting_plane({{{0, 0, 0x1p-126f}, {1, 0, 0x1p-126f}, {0, 1, 0x1p-126f}}}).d ==
          0x1p-126f);
}

TEST_CASE("components of a normal below the limit are zero") {
    // The slope in x is 2^-41, then 2^-39.
    const Plane below = supporting_plane({{{0, 0, 0}, {1, 0, -0x1p-41f}, {0, 1, 0}}});
    CHECK(below.nx == 0.0f);
    const Plane above = supporting_plane({{{0, 0, 0}, {1, 0, -0x1p-39f}, {0, 1, 0}}});
    CHECK(above.nx == 0x1p-39f);
}

TEST_CASE("face bits are the known ones") {
    struct Known {
        Plane plane;
        HomogeneousPoint point;
        bool front;
    };
    using P = HomogeneousPoint;
    const Plane z{0, 0, 1, 0};
    const Plane z2{0, 0, 1, 2};
    const Plane oblique{0.6f, 0.0f, 0.8f, 1.0f};
    const Plane diagonal{0x1.279a74p-1f, 0x1.279a74p-1f, 0x1.279a74p-1f, 0x1.279a74p-1f};
    const Plane none{0, 0, 0, 0};
    const Known table[] = {
        {z, P::viewpoint({0, 0, 1}), true},
        {z, P::viewpoint({0, 0, 0}), false},  // On the plane.
        {z, P::viewpoint({5, -3, 0}), false},
        {z, P::viewpoint({0, 0, -1}), false},
        {z, P::viewpoint({0x1p60f, 0x1p60f, 0x1p-60f}), true},
        {z, P::viewpoint({0, 0, 0x1p-61f}), false},  // Taken as zero.
        {z, P::direction({0, 0, 1}), true},
        {z, P::direction({1, 1, 0}), false},
        {z2, P::viewpoint({0, 0, 2}), false},
        {z2, P::viewpoint({0, 0, 0x1.000002p1f}), true},
        {z2, P::direction({0, 0, 0x1p-60f}), true},  // d plays no part.
        {z2, P::direction({0, 0, -0x1p-60f}), false},
        {oblique, P::viewpoint({0, 0, 1.25f}), false},  // 0.8f * 1.25f rounds to 1.
        {oblique, P::viewpoint({0, 0, 0x1.400002p0f}), true},
        {oblique, P::direction({-4, 7, 3}), false},  // 0.6f * 4 and 0.8f * 3 round alike.
        {oblique, P::direction({-4, 7, 0x1.800002p1f}), true},
        {diagonal, P::viewpoint({1, 0, 0}), false},  // A vertex of the triangle.
        {diagonal, P::viewpoint({0x1p-1f, 0x1p-1f, 0x1p-24f}), true},
        {diagonal, P::viewpoint({0x1p-1f, 0x1p-1f, 0x1p-25f}), false},  // Lost in the last sum.
        {diagonal, P::viewpoint({0x1p-25f, 0x1p-1f, 0x1p-1f}), false},  // Lost in the first.
        {none, P::viewpoint({1, 2, 3}), false},
        {none, P::direction({1, 2, 3}), false},
    };
    int row = 0;
    for (const auto& [plane, point, front] : table) {
        CAPTURE(row++);
        CHECK(is_front(plane, point) == front);
        CHECK(in_steps(plane, point).front() == front);
    }
}

TEST_CASE("the bit is the one of separately rounded steps, near planes most of all") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    tests::Random random(11);
    std::uint32_t fused_differs = 0;
    for (std::uint32_t i = 0; i < 400'000; ++i) {
        const std::uint32_t face = random.below(mesh.face_count());
        const auto corners = corners_of(mesh, face);
        const Plane& plane = mesh.planes()[face];
        // A point of the plane, but for rounding; every fourth is a direction in it.
        const float s = random.signed_unit();
        const float t = random.signed_unit();
        const glm::vec3 along = s * (corners[1] - corners[0]) + t * (corners[2] - corners[0]);
        const HomogeneousPoint point = i % 4 == 0 ? HomogeneousPoint::direction(along)
                                                  : HomogeneousPoint::viewpoint(corners[0] + along);
        REQUIRE(is_front(plane, point) == in_steps(plane, point).front());
        fused_differs += is_front(plane, point) != front_if_fused(plane, point);
    }
    // Otherwise these points could not tell the two apart.
    CHECK(fused_differs > 1000);
}

TEST_CASE("no product or sum of the bit is ever subnormal") {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        CAPTURE(seed);
        tests::Random random(seed);
        // Components at the limits and cancelling on purpose: equal magnitudes, one ulp apart.
        const auto near = [&](float value) {
            const float moved = random.below(2) ? std::nextafter(value, 0x1p100f) : value;
            return random.below(2) ? moved : -moved;
        };
        for (int i = 0; i < 2000; ++i) {
            const auto normal_component = [&] {
                return random.below(8) == 0 ? 0.0f : near(scaled(1.0f, -random.between(0, 40)));
            };
            const auto point_component = [&] {
                return random.below(8) == 0 ? 0.0f : near(scaled(1.0f, random.between(-60, 59)));
            };
            Plane plane{normal_component(), normal_component(), normal_component(),
                        near(scaled(1.0f, random.between(-126, 60)))};
            glm::vec3 p{point_component(), point_component(), point_component()};
            if (random.below(2)) {
                plane.ny = -plane.nx;
                p.y = near(std::abs(p.x) < 0x1p59f ? p.x : 1.0f);
            }
            const Steps s = in_steps(plane, random.below(2) ? HomogeneousPoint::viewpoint(p)
                                                            : HomogeneousPoint::direction(p));
            for (const float value : {s.nx_px, s.ny_py, s.nz_pz, s.first_sum, s.sum, s.wd}) {
                const int kind = std::fpclassify(value);
                REQUIRE((kind == FP_ZERO || kind == FP_NORMAL));
            }
        }
    }
}

TEST_CASE("scaling mesh and viewpoint by a power of two keeps every bit") {
    const MeshSource source = make_built_in_shape("torus", 600);
    const Mesh mesh(source);
    for (const int exponent : {-30, -7, 1, 13, 50}) {
        CAPTURE(exponent);
        MeshSource larger = source;
        for (glm::vec3& p : larger.positions) p = scaled(p, exponent);
        const Mesh scaled_mesh(larger);
        tests::Random random(3);
        for (int i = 0; i < 50; ++i) {
            // Some viewpoints are vertices: they lie on planes, where rounding decides.
            const glm::vec3 p = i % 2 ? 2.0f * random.in_cube()
                                      : mesh.positions()[random.below(mesh.vertex_count())];
            for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
                REQUIRE(is_front(mesh.planes()[f], HomogeneousPoint::viewpoint(p)) ==
                        is_front(scaled_mesh.planes()[f],
                                 HomogeneousPoint::viewpoint(scaled(p, exponent))));
        }
    }
}

TEST_CASE("a direction's length does not matter, and a far viewpoint sees as a direction does") {
    const Mesh mesh(make_built_in_shape("spring", 400));
    tests::Random random(5);
    for (int i = 0; i < 50; ++i) {
        const glm::vec3 v = random.in_cube();
        const HomogeneousPoint direction = HomogeneousPoint::direction(v);
        const HomogeneousPoint longer = HomogeneousPoint::direction(scaled(v, 40));
        const HomogeneousPoint far = HomogeneousPoint::viewpoint(scaled(v, 50));
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
            const Plane& plane = mesh.planes()[f];
            REQUIRE(is_front(plane, direction) == is_front(plane, longer));
            if (std::abs(glm::dot(glm::vec3(plane.nx, plane.ny, plane.nz), v)) > 1e-5f)
                REQUIRE(is_front(plane, direction) == is_front(plane, far));
        }
    }
}

}  // namespace rimline
