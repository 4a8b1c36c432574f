// The still life keeps the promises of its composition: parts hover a hair over one another without
// sharing planes, none cuts into another, and one lies in another's shadow.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/shapes/measures.h"

namespace rimline {
namespace {

// In the order of make_scene.
enum Part : std::uint32_t { slab, pedestal, knot, ball, block, ring, arch, small_ball, part_count };

}  // namespace

TEST_CASE("the scene is eight closed parts that look outwards") {
    for (const std::uint32_t faces : {0u, 1u, 1000u, 10'000u}) {
        CAPTURE(faces);
        const Mesh mesh(make_built_in_shape("scene", faces));
        CHECK(mesh.component_count() == part_count);
        CHECK(mesh.is_closed());
        CHECK(mesh.is_oriented());
        CHECK(mesh.edges_of_class(EdgeClass::nonmanifold).size() == 0);
        CHECK(mesh.degenerate_face_count() == 0);
        // Six spheres by topology and two tori.
        CHECK(tests::euler_characteristic(mesh) == 6 * 2);
        const auto component = tests::components_of(mesh);
        std::array<double, part_count> volume{};
        for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
            volume[component[f]] +=
                glm::dot(tests::corner(mesh, f, 0),
                         glm::cross(tests::corner(mesh, f, 1), tests::corner(mesh, f, 2)));
        for (const double v : volume) CHECK(v > 0.0);
    }
}

TEST_CASE("no part of the scene cuts into another, and all but the slab stand on something") {
    const Mesh mesh(make_built_in_shape("scene", 4000));
    const auto component = tests::components_of(mesh);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        for (std::uint32_t g = 0; g < f; ++g)
            if (component[f] != component[g]) REQUIRE_FALSE(tests::faces_intersect(mesh, f, g));
    std::array<double, part_count> low;
    std::array<double, part_count> high;
    low.fill(1e9);
    high.fill(-1e9);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint32_t part = component[f];
            low[part] = std::min(low[part], tests::corner(mesh, f, c).y);
            high[part] = std::max(high[part], tests::corner(mesh, f, c).y);
        }
    for (std::uint32_t part = 1; part < part_count; ++part) {
        CAPTURE(part);
        const double gap = low[part] - high[part == knot ? pedestal : slab];
        CHECK(gap > 0.0);
        CHECK(gap < 0.01);
    }
}

TEST_CASE("everything in the scene stands on the flat of the slab") {
    const Mesh mesh(make_built_in_shape("scene"));
    const auto component = tests::components_of(mesh);
    double flat = 0.0;
    double farthest = 0.0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        for (std::uint32_t c = 0; c < 3; ++c) {
            const glm::dvec3 p = tests::corner(mesh, f, c);
            if (component[f] != slab) farthest = std::max(farthest, std::hypot(p.x, p.z));
            if (component[f] == slab && p.y == 0.0) flat = std::max(flat, std::hypot(p.x, p.z));
        }
    CHECK(farthest < flat);
    // Its top, where things stand, is at height 0.
    CHECK(flat > 2.0);
}

TEST_CASE("no two parts of the scene share a plane where they overlap") {
    const Mesh mesh(make_built_in_shape("scene", 3000));
    const auto component = tests::components_of(mesh);
    const auto overlap = [&](std::uint32_t f, std::uint32_t g) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto range = [&](std::uint32_t face) {
                return std::minmax({tests::corner(mesh, face, 0)[axis],
                                    tests::corner(mesh, face, 1)[axis],
                                    tests::corner(mesh, face, 2)[axis]});
            };
            if (range(f).first > range(g).second + 1e-3 || range(g).first > range(f).second + 1e-3)
                return false;
        }
        return true;
    };
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        for (std::uint32_t g = 0; g < f; ++g) {
            if (component[f] == component[g]) continue;
            const Plane& a = mesh.planes()[f];
            const Plane& b = mesh.planes()[g];
            const double cos = double(a.nx) * b.nx + double(a.ny) * b.ny + double(a.nz) * b.nz;
            if (std::abs(cos) < 0.99999) continue;
            if (std::abs(a.d - (cos > 0.0 ? b.d : -b.d)) < 1e-3) REQUIRE_FALSE(overlap(f, g));
        }
}

TEST_CASE("the ball of the scene lies mostly in the knot's shadow, and partly not") {
    const Mesh mesh(make_built_in_shape("scene", 8000));
    const auto component = tests::components_of(mesh);
    const glm::dvec3 to_light = glm::normalize(glm::dvec3(-0.5, 0.9, 0.6));
    std::uint32_t facing = 0;
    std::uint32_t shadowed = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Plane& plane = mesh.planes()[f];
        const glm::dvec3 normal(plane.nx, plane.ny, plane.nz);
        if (component[f] != ball || glm::dot(normal, to_light) < 0.1) continue;
        const glm::dvec3 middle =
            (tests::corner(mesh, f, 0) + tests::corner(mesh, f, 1) + tests::corner(mesh, f, 2)) /
            3.0;
        ++facing;
        for (std::uint32_t g = 0; g < mesh.face_count(); ++g)
            if (component[g] == knot &&
                tests::segment_hits(mesh, middle, middle + 10.0 * to_light, g)) {
                ++shadowed;
                break;
            }
    }
    CAPTURE(facing);
    CAPTURE(shadowed);
    CHECK(shadowed > facing / 2);
    CHECK(shadowed < facing);
}

}  // namespace rimline
