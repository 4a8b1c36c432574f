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
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/shadow_scenes.h"
#include "tests/engine/support/tracked_volume.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

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

TEST_CASE("a stack is bounded by what it counts, and drawn in batches beyond that") {
    const Model stack(stacked(one_triangle(), 256, 0.002f));
    const Model boxes(stacked(thin_box(), 128, 0.002f));
    const HomogeneousPoint light = HomogeneousPoint::direction({0.05f, 1.0f, 0.02f});
    const TrackedVolume of_stack(stack, light);
    const TrackedVolume of_boxes(boxes, light);
    ShadowBatches batches;
    VolumeCount count, single, general;

    batches.begin();
    CHECK(batches.add(7, of_boxes.counted(ShadowForm::single), single) >= 128);
    const std::vector<ShadowBatch> one = batches.end();
    CHECK(single.bound <= k_batch_limit);
    REQUIRE(one.size() == 1);
    REQUIRE(one[0].draws.size() == 1);
    CHECK_FALSE(one[0].draws[0].part.has_value());

    batches.begin();
    CHECK(batches.add(5, of_boxes.counted(ShadowForm::general), general) >= 256);
    CHECK(batches.add(7, of_stack.counted(ShadowForm::general), count) == 256);
    const std::vector<ShadowBatch> several = batches.end();
    // Twice 256 triangles in a row, at most 254 a batch, in halves of halves.
    CHECK(several.size() <= 5);
    for (const auto& [instance, faces] : {std::pair{5u, 128u * 12u}, {7u, 256u}}) {
        const VolumeCount& counted = instance == 5 ? general : count;
        std::uint32_t next = 0;
        std::size_t part = 0;
        for (const ShadowBatch& batch : several)
            for (const ShadowDraw& draw : batch.draws) {
                if (draw.instance != instance) continue;
                REQUIRE(draw.part.has_value());
                CHECK(draw.part->first_face == next);
                CHECK(draw.part->face_count == counted.parts[part].face_count);
                CHECK(draw.part->first_side == counted.parts[part].first_side);
                CHECK(draw.part->side_count == counted.parts[part].side_count);
                next += draw.part->face_count;
                ++part;
            }
        CHECK(next == faces);
        CHECK(part == counted.parts.size());
        CHECK(part < 10);  // Of many faces each.
    }
}

TEST_CASE("the bounds of each batch add up to at most its limit") {
    constexpr std::uint64_t k_seed = 12;
    CAPTURE(k_seed);
    Random random(k_seed);
    std::deque<Model> models;
    models.emplace_back(floating_soup(3000, k_seed));
    models.emplace_back(stacked(thin_box(), 200, 0.002f));
    models.emplace_back(make_built_in_shape("knot", 3000));
    std::size_t parts = 0;
    for (int round = 0; round < 40; ++round) {
        const HomogeneousPoint light = round % 2 == 0
                                           ? HomogeneousPoint::direction(random.in_cube())
                                           : HomogeneousPoint::viewpoint(4.0f * random.in_cube());
        std::deque<TrackedVolume> volumes;
        std::deque<VolumeCount> counts;
        ShadowBatches batches;
        batches.begin();
        const std::uint32_t casters = 1 + random.below(4);
        for (std::uint32_t i = 0; i < casters; ++i) {
            const TrackedVolume& volume = volumes.emplace_back(models[random.below(3)], light);
            const ShadowForm form = random.below(2) == 0 ? ShadowForm::general : ShadowForm::single;
            batches.add(i, volume.counted(form), counts.emplace_back());
        }
        const std::vector<ShadowBatch> planned = batches.end();
        std::vector<std::uint32_t> faces(casters, 0), whole(casters, 0);
        std::vector<std::size_t> part(casters, 0);
        for (const ShadowBatch& batch : planned) {
            std::uint32_t sum = 0;
            for (const ShadowDraw& draw : batch.draws) {
                const VolumeCount& count = counts[draw.instance];
                if (!draw.part) {
                    CHECK(++whole[draw.instance] == 1);
                    sum += count.bound;
                    continue;
                }
                CHECK(draw.part->first_face == faces[draw.instance]);
                faces[draw.instance] += draw.part->face_count;
                sum += count.parts[part[draw.instance]++].bound;
            }
            CHECK(sum <= k_batch_limit);
        }
        for (std::uint32_t i = 0; i < casters; ++i) {
            CHECK(whole[i] == (part[i] == 0 ? 1 : 0));
            if (part[i] > 0) CHECK(faces[i] == counts[i].faces.size());
            parts += part[i];
        }
    }
    CHECK(parts > 100);
}

TEST_CASE("nothing shines through 256 triangles 128 closed casters or 256 in the single form" *
          doctest::test_suite("plain")) {
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

TEST_CASE("a volume in parts gives the picture of its pieces as casters of their own" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    // Layers of a sphere's shells, so that parts end within surfaces: 2 * 140 triangles are in a row.
    const MeshSource shell = make_built_in_shape("sphere", 80);
    MeshSource shells;
    std::deque<Model> pieces;
    for (std::uint32_t i = 0; i < 140; ++i) {
        MeshSource scaled = shell;
        for (glm::vec3& p : scaled.positions) p *= 0.3f + 0.002f * static_cast<float>(i);
        const auto first = static_cast<std::uint32_t>(shells.positions.size());
        shells.positions.insert(shells.positions.end(), scaled.positions.begin(),
                                scaled.positions.end());
        for (const auto& t : scaled.triangles)
            shells.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        pieces.emplace_back(scaled);
    }
    const Model whole(shells);
    const Model ground(square(3.0, -0.8));
    int forms_in_parts = 0;
    for (const Light& light :
         {lamp({0.0, 0.0, 0.0}), lamp({1.2, 2.0, 0.7}), lamp({40, 50, -30}), sun({0.3, 1.0, 0.2})})
        for (const ShadowForm form : {ShadowForm::general, ShadowForm::single})
            for (const ShadowMethod method : {ShadowMethod::fail, ShadowMethod::automatic}) {
                Scene scene{.instances = {ground_of(ground), instance_of(whole)},
                            .lights = {light},
                            .camera = looking({2.5, 2.2, 3.1}, {0.0, -0.3, 0.0}),
                            .lines = false};
                scene.shadow_form = form;
                scene.shadow_method = method;
                Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
                const Picture in_parts = renderer.render(scene, 128, 128);
                const ShadowReport& shadow = renderer.report().shadows[0];
                CHECK((shadow.runs > 0) == (shadow.bound > k_batch_limit));
                CHECK(shadow.runs <= 8);
                forms_in_parts += shadow.runs > 0 && shadow.choice.form == form ? 1 : 0;
                scene.instances.resize(1);
                for (const Model& piece : pieces) scene.instances.push_back(instance_of(piece));
                const Picture expected = renderer.render(scene, 128, 128);
                for (const ShadowReport& report : renderer.report().shadows)
                    CHECK(report.runs == 0);
                CHECK(in_parts.rgba == expected.rgba);
            }
    CHECK(forms_in_parts > 8);  // The single form too, at one light.
}
