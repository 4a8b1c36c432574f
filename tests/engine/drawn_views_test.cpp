// Best views weighted by ratios that a device draws.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>

#include "engine/measure/visible_ratio.h"
#include "silhouette/field/best_views.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/models.h"
#include "tests/skip.h"

namespace rimline {
namespace {

TEST_CASE("views of which few candidates are drawn are those of drawing all") {
    RIMLINE_OPEN_GPU(gpu);
    bool are_few = false;
    for (const char* shape : {"knot", "torus", "sphere", "box"}) {
        CAPTURE(shape);
        const Mesh mesh(make_built_in_shape(shape, 2000));
        const HoughOctree octree(mesh);
        VisibleRatioPass pass(gpu->context(), octree);
        std::uint64_t drawn = 0;
        BestViewsOptions options{.count = 1};
        options.visible_ratios = [&](std::span<const glm::dvec3> eyes) {
            drawn += eyes.size();
            std::vector<double> ratios;
            for (const VisibleRatio& ratio : pass.measure(eyes)) ratios.push_back(ratio.ratio());
            return ratios;
        };
        const TangentialField field = make_view_field(mesh);
        const BestViews few = find_best_views(field, options);
        CHECK(few.renders == drawn);
        options.draws_all = true;
        const BestViews all = find_best_views(field, options);
        CHECK(all.renders + few.renders == drawn);
        CHECK(few.renders <= all.renders);
        are_few = are_few || few.renders < all.renders;
        REQUIRE(few.views.size() == all.views.size());
        for (std::size_t i = 0; i < few.views.size(); ++i) {
            CHECK(few.views[i].eye == all.views[i].eye);
            CHECK(few.views[i].visible_ratio == all.views[i].visible_ratio);
            CHECK(few.views[i].visible_ratio > 0.0);
        }
    }
    CHECK(are_few);
}

// The mean square of the noise is that of 0.1% of the radius.
MeshSource with_noise(const Mesh& mesh, std::uint32_t seed) {
    MeshSource source;
    source.positions.assign(mesh.positions().begin(), mesh.positions().end());
    for (const auto& [a, b, c] : mesh.triangles())
        source.triangles.push_back({index(a), index(b), index(c)});
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> noise(-1.0f, 1.0f);
    const auto size = static_cast<float>(1e-3 * mesh.radius());
    for (glm::vec3& p : source.positions)
        p += size * glm::vec3(noise(random), noise(random), noise(random));
    return source;
}

TEST_SUITE_BEGIN("long");

TEST_CASE("noise of a thousandth of the radius moves the first view by less than 10 degrees") {
    RIMLINE_OPEN_GPU(gpu);
    bool has_models = false;
    for (const char* name : {"fandisk.obj", "rocker-arm.obj", "stanford-bunny.obj"}) {
        const auto path = tests::find_model(name);
        if (!path) continue;
        has_models = true;
        CAPTURE(name);
        const auto first_view = [&](const Mesh& mesh) {
            const HoughOctree octree(mesh);
            VisibleRatioPass pass(gpu->context(), octree);
            BestViewsOptions options{.count = 1};
            options.up = glm::dvec3(0, 1, 0);
            options.visible_ratios = [&](std::span<const glm::dvec3> eyes) {
                std::vector<double> ratios;
                for (const VisibleRatio& ratio : pass.measure(eyes))
                    ratios.push_back(ratio.ratio());
                return ratios;
            };
            const BestViews best = find_best_views(make_view_field(mesh), options);
            return glm::normalize(best.views.at(0).eye - mesh.center());
        };
        const Mesh exact(read_mesh_file(*path));
        const glm::dvec3 view = first_view(exact);
        for (const std::uint32_t seed : {1u, 2u}) {
            const glm::dvec3 moved = first_view(Mesh(with_noise(exact, seed)));
            const double degrees = glm::degrees(std::acos(std::min(glm::dot(view, moved), 1.0)));
            CAPTURE(seed);
            CHECK(degrees < 10.0);
        }
    }
    if (!has_models) RIMLINE_SKIP("no models: set RIMLINE_MODELS");
}

TEST_SUITE_END();

}  // namespace
}  // namespace rimline
