// How far the first view of real models moves with a little noise or fewer faces.

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "silhouette/field/ray_ratios.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/upright.h"
#include "tests/models.h"
#include "tests/skip.h"
#include "tools/bench/mesh_variants.h"
#include "tools/options/simplified_mesh.h"
#include "tools/options/view_choice.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

constexpr double k_noise = 1e-3;

// The direction of the first view, as the commands choose it.
glm::dvec3 first_view(const Mesh& mesh, const glm::dvec3& up) {
    const HoughOctree octree(mesh);
    const RayRatios rays(octree);
    const ViewChoice choice{.count = 1};
    const TangentialField field = make_view_field(mesh, choice.field_options());
    const BestViews best = find_best_views(
        field, choice.options(
                   mesh, up, [&](std::span<const glm::dvec3> eyes) { return rays.measure(eyes); }));
    REQUIRE(best.views.size() == 1);
    return glm::normalize(best.views[0].eye - mesh.center());
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)));
}

// Most models are nearly symmetric: none moves to its mirror image.
void check_first_view(const std::string& file) {
    constexpr double k_most_deg = 10.0;
    const auto path = tests::find_model(file);
    if (!path) RIMLINE_SKIP(file + " is not in RIMLINE_MODELS");
    const Mesh mesh(read_mesh_file(*path));
    const glm::dvec3 up = choose_upright(mesh);
    const glm::dvec3 first = first_view(mesh, up);
    for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
        CAPTURE(seed);
        const Mesh noisy(with_noise(mesh, k_noise, seed));
        CHECK(angle_deg(first, first_view(noisy, up)) <= k_most_deg);
    }
    const Mesh simple(simplified(mesh, mesh.face_count() / 4));
    CHECK(angle_deg(first, first_view(simple, up)) <= k_most_deg);
}

TEST_SUITE("long") {
    TEST_CASE("the first view of beetle-alt.obj moves by 10 degrees at most") {
        check_first_view("beetle-alt.obj");
    }
    TEST_CASE("the first view of fandisk.obj moves by 10 degrees at most") {
        check_first_view("fandisk.obj");
    }
    TEST_CASE("the first view of horse.ply moves by 10 degrees at most") {
        check_first_view("horse.ply");
    }
    TEST_CASE("the first view of igea.ply moves by 10 degrees at most") {
        check_first_view("igea.ply");
    }
    TEST_CASE("the first view of nefertiti.obj moves by 10 degrees at most") {
        check_first_view("nefertiti.obj");
    }
    TEST_CASE("the first view of ogre.obj moves by 10 degrees at most") {
        check_first_view("ogre.obj");
    }
    TEST_CASE("the first view of rocker-arm.obj moves by 10 degrees at most") {
        check_first_view("rocker-arm.obj");
    }
    TEST_CASE("the first view of stanford-bunny.obj moves by 10 degrees at most") {
        check_first_view("stanford-bunny.obj");
    }
}

}  // namespace
