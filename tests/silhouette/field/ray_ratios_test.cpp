// Visible ratios by rays, against what is known in closed form. tests/engine/measure compares them with pictures.

#include "silhouette/field/ray_ratios.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <stop_token>
#include <string>
#include <type_traits>
#include <vector>

#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline {
namespace {

// A temporary would dangle.
static_assert(!std::is_constructible_v<RayRatios, HoughOctree>);
static_assert(!std::is_constructible_v<RayRatios, HoughOctree, RayRatios::Options>);

// In the plane z = height, facing z.
MeshSource plate(float height, float half = 1.0f) {
    return {.positions = {{-half, -half, height},
                          {half, -half, height},
                          {half, half, height},
                          {-half, half, height}},
            .triangles = {{0, 1, 2}, {0, 2, 3}}};
}

MeshSource joined(MeshSource a, const MeshSource& b) {
    const auto first = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const auto& [i, j, k] : b.triangles)
        a.triangles.push_back({first + i, first + j, first + k});
    return a;
}

double ratio_of(const MeshSource& source, const glm::dvec3& eye, bool has_borders = true) {
    const Mesh mesh(source);
    const HoughOctree octree(mesh);
    RayRatios::Options options;
    options.has_borders = has_borders;
    return RayRatios(octree, options).measure({&eye, 1})[0];
}

// Pixels are wide as seen from far away, so that some of a round silhouette's are hidden.
TEST_CASE("the silhouette of a convex body is visible") {
    for (const char* name : {"box", "sphere"}) {
        CAPTURE(name);
        const Mesh mesh(make_built_in_shape(name, 1000));
        const HoughOctree octree(mesh);
        const RayRatios rays(octree);
        std::vector<glm::dvec3> eyes;
        for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), {0, -1, 0}, {1, 2, 3}, {-3, 1, -0.1}})
            for (const double radii : {1.8, 20.0})
                eyes.push_back(mesh.center() + radii * mesh.radius() * glm::normalize(d));
        const double least = name == std::string("box") ? 1.0 : 0.95;
        for (const double ratio : rays.measure(eyes)) CHECK(ratio >= least);
    }
}

TEST_CASE("what a plate hides is hidden from its front, and from its back hides the plate's rim") {
    MeshSource box = make_built_in_shape("box");
    const Mesh whole(box);
    for (glm::vec3& p : box.positions)
        p = (p - glm::vec3(whole.center())) * float(0.3 / whole.radius());
    const glm::dvec3 front(0, 0, 4);
    const double with_rim = ratio_of(joined(plate(1.0f), box), front);
    CHECK(with_rim > 0.5);
    CHECK(with_rim < 0.9);
    CHECK(ratio_of(joined(plate(1.0f), box), front, false) == 0.0);
    CHECK(ratio_of(joined(plate(1.0f), box), -front) == 1.0);
    CHECK(ratio_of(joined(plate(-1.0f), box), front) == 1.0);
    // Half of two equal rims, but for perspective.
    const double rims = ratio_of(joined(plate(1.0f), plate(0.9f, 0.9f)), front, true);
    CHECK(rims > 0.5);
    CHECK(rims < 0.6);
}

TEST_CASE(
    "ratios do not change by a power of two, and do not depend on what is measured together") {
    MeshSource source = make_built_in_shape("knot", 2000);
    const Mesh mesh(source);
    const HoughOctree octree(mesh);
    const RayRatios rays(octree);
    std::vector<glm::dvec3> eyes;
    for (const glm::vec3 d : {glm::vec3(5, 1, 0), {0, 6, 1}, {-4, 2, 3}, {1, 0, -7}})
        eyes.emplace_back(d);
    const std::vector<double> ratios = rays.measure(eyes);
    for (std::size_t i = 0; i < eyes.size(); ++i) {
        CHECK(ratios[i] > 0.2);
        CHECK(ratios[i] < 0.95);
        CHECK(rays.measure({&eyes[i], 1})[0] == ratios[i]);
    }
    for (const float scale : {0x1p-20f, 0x1p20f}) {
        for (std::size_t i = 0; i < source.positions.size(); ++i)
            source.positions[i] = scale * mesh.positions()[i];
        std::vector<glm::dvec3> scaled_eyes = eyes;
        for (glm::dvec3& eye : scaled_eyes) eye *= double(scale);
        const Mesh scaled(source);
        const HoughOctree scaled_octree(scaled);
        CHECK(RayRatios(scaled_octree).measure(scaled_eyes) == ratios);
    }
}

TEST_CASE("viewpoints anywhere have ratios, and meshes without edges have zero") {
    const Mesh mesh(make_built_in_shape("scene", 1000));
    const HoughOctree octree(mesh);
    const std::vector<glm::dvec3> eyes{mesh.center(), glm::dvec3(mesh.positions()[0]),
                                       mesh.center() + glm::dvec3(1e-9, 0, 0),
                                       mesh.center() + glm::dvec3(0, 1e6 * mesh.radius(), 0)};
    for (const double ratio : RayRatios(octree).measure(eyes)) {
        CHECK(ratio >= 0.0);
        CHECK(ratio <= 1.0);
    }
    const Mesh empty{MeshSource{}};
    const HoughOctree none(empty);
    CHECK(RayRatios(none).measure(eyes) == std::vector<double>(4, 0.0));
    CHECK(RayRatios(none).measure({}).empty());
    // A face without extent, from its place and from elsewhere.
    const Mesh point(
        MeshSource{.positions = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, .triangles = {{0, 1, 2}}},
        Welding::none);
    const HoughOctree at_point(point);
    for (const glm::dvec3 eye : {glm::dvec3(1, 2, 3), {5, 2, 3}})
        CHECK(RayRatios(at_point).measure({&eye, 1})[0] >= 0.0);
}

TEST_CASE("lines that end near the viewer take no longer the narrower the view is") {
    const Mesh mesh(make_built_in_shape("box", 12));
    const HoughOctree octree(mesh);
    // Beside an edge: it passes the near plane, millions of pictures from what is seen.
    const auto& [low, high] = mesh.bounds();
    const glm::dvec3 eye = glm::dvec3(high) + 1e-3 * mesh.radius() * glm::dvec3(1.0, 2.0, -300.0);
    for (const double fov_deg : {70.6, 0.01, 1e-6, 1e-300}) {
        CAPTURE(fov_deg);
        RayRatios::Options options;
        options.fov_deg = fov_deg;
        const double ratio = RayRatios(octree, options).measure({&eye, 1})[0];
        CHECK(ratio >= 0.0);
        CHECK(ratio <= 1.0);
    }
}

TEST_CASE("a stop ends the making and the measuring of ratios by rays") {
    const Mesh mesh(make_built_in_shape("torus", 2000));
    const HoughOctree octree(mesh);
    const RayRatios rays(octree);
    std::stop_source stop;
    stop.request_stop();
    const glm::dvec3 eye(3, 2, 1);
    CHECK_THROWS_AS(rays.measure({&eye, 1}, stop.get_token()), Error);
    CHECK_THROWS_AS(RayRatios(octree, {}, {stop.get_token(), {}}), Error);
}

}  // namespace
}  // namespace rimline
