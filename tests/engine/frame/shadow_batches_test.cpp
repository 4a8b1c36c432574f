#include "engine/frame/shadow_batches.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/shadow_scenes.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

// How many triangles a ray from the light meets, in double.
std::uint32_t triangles_on_ray(const Mesh& mesh, const glm::dvec3& from,
                               const glm::dvec3& direction) {
    std::uint32_t count = 0;
    for (const Triangle& triangle : mesh.triangles()) {
        glm::dvec3 v[3];
        for (std::size_t i = 0; i < 3; ++i)
            v[i] = glm::dvec3(mesh.positions()[index(triangle[i])]) - from;
        const double a = glm::dot(direction, glm::cross(v[0], v[1]));
        const double b = glm::dot(direction, glm::cross(v[1], v[2]));
        const double c = glm::dot(direction, glm::cross(v[2], v[0]));
        const bool crosses = (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
        const glm::dvec3 n = glm::cross(v[1] - v[0], v[2] - v[0]);
        count += crosses && glm::dot(n, v[0]) / glm::dot(n, direction) > 0.0 ? 1 : 0;
    }
    return count;
}

CountedVolume volume_of(const SilhouetteTracker& tracker, ShadowForm form) {
    return {.mesh = &tracker.mesh(),
            .silhouette = tracker.silhouette(),
            .face_words = tracker.face_words(),
            .light = tracker.point(),
            .form = form};
}

// A stack of copies, each a step above the one before.
MeshSource stacked(const MeshSource& layer, std::uint32_t count, float step) {
    MeshSource stack;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(stack.positions.size());
        for (const glm::vec3& p : layer.positions)
            stack.positions.push_back(p + glm::vec3(0.0f, step * static_cast<float>(i), 0.0f));
        for (const auto& t : layer.triangles)
            stack.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return stack;
}

MeshSource thin_box() {
    MeshSource box = make_built_in_shape("box", 12);
    for (glm::vec3& p : box.positions) p = {0.7f * p.x, 0.0005f * p.y, 0.7f * p.z};
    return box;
}

MeshSource one_triangle() { return {{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}}, {{0, 2, 1}}}; }

// The share of a picture in the mask style that light reaches.
std::size_t lit_pixels(const Picture& picture) {
    std::size_t lit = 0;
    for (std::size_t at = 0; at < picture.rgba.size(); at += 4)
        lit += picture.rgba[at] > 200 && picture.rgba[at + 2] > 200 ? 1 : 0;
    return lit;
}

// A ground in the shadow of a stack in one instance, or of as many instances.
struct StackScene {
    std::deque<Model> models;
    Scene scene;

    StackScene(const MeshSource& layer, std::uint32_t count, bool as_instances) {
        const Model& ground = models.emplace_back(square(0.3, -0.5));
        scene.instances.push_back(ground_of(ground));
        if (as_instances) {
            const Model& model = models.emplace_back(layer);
            for (std::uint32_t i = 0; i < count; ++i)
                scene.instances.push_back(
                    instance_of(model, glm::dmat3(1.0), {0.0, 0.002 * i, 0.0}));
        } else {
            scene.instances.push_back(
                instance_of(models.emplace_back(stacked(layer, count, 0.002f))));
        }
        scene.lights = {sun({0.05, 1.0, 0.02})};
        scene.camera = looking({0.9, -0.1, 0.2}, {0.0, -0.5, 0.0});
        scene.style = Style::mask;
        scene.palette = default_palette(Style::mask, {0.02f, 0.1f, 0.5f});
        scene.lines = false;
    }
};

}  // namespace

TEST_CASE("no ray meets more triangles than the silhouette's bound") {
    constexpr std::uint64_t k_seed = 3;
    CAPTURE(k_seed);
    Random random(k_seed);
    std::deque<Model> models;
    for (const char* name : {"box", "torus", "knot", "spring", "terrain", "scene"})
        models.emplace_back(make_built_in_shape(name, 600));
    models.emplace_back(moebius_strip(40));
    models.emplace_back(triangle_soup(60, k_seed));
    models.emplace_back(figure_eight(24, 12));
    models.emplace_back(boxes_on_an_edge());
    ShadowCounter counter;
    double tightness = 0.0;
    int cases = 0;
    for (const Model& model : models)
        for (int i = 0; i < 40; ++i) {
            const Mesh& mesh = model.mesh;
            // Outside, inside the bounds, far away, on the axes' planes, and directions.
            glm::vec3 place = random.in_cube() * (i % 4 == 0 ? 20.0f : i % 4 == 1 ? 0.8f : 2.5f);
            if (i % 5 == 0) place[static_cast<int>(random.below(3))] = 0.0f;
            const HomogeneousPoint light = i % 3 == 0 ? HomogeneousPoint::direction(place)
                                                      : HomogeneousPoint::viewpoint(place);
            const SilhouetteTracker tracker(model.octree, light);
            const std::uint32_t bound = counter.bound(volume_of(tracker, ShadowForm::general));
            const std::uint32_t single = counter.bound(volume_of(tracker, ShadowForm::single));
            std::uint32_t most = 0;
            for (int ray = 0; ray < 60; ++ray) {
                const Triangle& t = mesh.triangles()[random.below(mesh.face_count())];
                glm::dvec3 target(0.0);
                double sum = 0.0;
                for (const VertexId vertex : t) {
                    const double weight = 1.01 + random.signed_unit();
                    target += weight * glm::dvec3(mesh.positions()[index(vertex)]);
                    sum += weight;
                }
                target /= sum;
                const glm::dvec3 from = light.is_direction()
                                            ? target + 10.0 * glm::dvec3(light.xyz())
                                            : glm::dvec3(light.xyz());
                most = std::max(most, triangles_on_ray(mesh, from, target - from));
            }
            INFO("light ", place.x, ", ", place.y, ", ", place.z, ", w ", light.w);
            CHECK(most <= bound);
            // Half of the triangles on a ray are front where it comes from outside and leaves.
            if (is_closed_chain(mesh) && (light.is_direction() || glm::length(place) > 4.0f))
                CHECK((most + 1) / 2 <= single);
            tightness += double(bound) / std::max(1u, most);
            ++cases;
        }
    std::printf("the bound is %.2f times what was met, on average\n", tightness / cases);
    CHECK(tightness / cases < 8.0);
}

TEST_CASE("a stack is bounded by what it counts, and drawn in batches beyond that") {
    const Model stack(stacked(one_triangle(), 256, 0.002f));
    const Model boxes(stacked(thin_box(), 128, 0.002f));
    ShadowCounter counter;
    const HomogeneousPoint sun = HomogeneousPoint::direction({0.05f, 1.0f, 0.02f});
    const SilhouetteTracker of_stack(stack.octree, sun);
    const SilhouetteTracker of_boxes(boxes.octree, sun);
    CHECK(counter.bound(volume_of(of_stack, ShadowForm::general)) == 256);
    CHECK(counter.bound(volume_of(of_boxes, ShadowForm::general)) >= 256);
    CHECK(counter.bound(volume_of(of_boxes, ShadowForm::single)) >= 128);
    CHECK(counter.bound(volume_of(of_boxes, ShadowForm::single)) <= 255);

    counter.begin();
    counter.add(7, volume_of(of_boxes, ShadowForm::single));
    const std::vector<ShadowBatch> one = counter.end();
    REQUIRE(one.size() == 1);
    CHECK(one[0].draws.size() == 1);

    counter.begin();
    counter.add(7, volume_of(of_stack, ShadowForm::general));
    const std::vector<ShadowBatch> several = counter.end();
    REQUIRE(several.size() == 3);
    std::uint32_t next = 0;
    for (const ShadowBatch& batch : several)
        for (const ShadowDraw& draw : batch.draws) {
            CHECK(draw.face_by_face);
            CHECK(draw.instance == 7);
            CHECK(draw.first_face == next);
            CHECK(draw.face_count <= k_batch_limit);
            next += draw.face_count;
        }
    CHECK(next == 256);
}

TEST_CASE("nothing shines through 256 triangles, 128 closed casters, or 256 in the single form") {
    RIMLINE_OPEN_GPU(gpu);
    struct Stack {
        MeshSource layer;
        std::uint32_t count;
        ShadowForm form;
    };
    for (const Stack& stack :
         {Stack{one_triangle(), 256, ShadowForm::general},
          Stack{thin_box(), 128, ShadowForm::general}, Stack{thin_box(), 256, ShadowForm::single}})
        for (const bool as_instances : {false, true})
            for (const ShadowMethod method : {ShadowMethod::fail, ShadowMethod::automatic}) {
                StackScene stacked(stack.layer, stack.count, as_instances);
                Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
                stacked.scene.shadow_form = stack.form;
                stacked.scene.shadow_method = method;
                INFO(stack.count, " layers, as instances: ", as_instances);
                CHECK(lit_pixels(renderer.render(stacked.scene, 128, 128)) == 0);
                stacked.scene.shadows = false;
                CHECK(lit_pixels(renderer.render(stacked.scene, 128, 128)) > 1000);
            }
}
