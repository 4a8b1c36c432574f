// Pictures of meshes that deform are those of the same mesh built at its new positions.

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/moving_face.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

constexpr std::uint32_t k_deforming_picture_side = 160;

// A model, and a ground that catches its shadow.
struct Stage {
    Stage(const MeshSource& source)
        : model(source), ground(make_ground(model.mesh, {0, 1, 0}, 4.0 * model.mesh.radius())) {}

    Scene scene(Style style) const {
        const glm::vec3 paper(0.9f);
        Scene scene{.camera = fit_camera({}, model.mesh, default_view_direction({0, 1, 0}), 1.0),
                    .style = style,
                    .palette = default_palette(style, paper)};
        scene.instances.push_back(
            {.octree = &model.octree, .material = {.color = default_surface_color(style, paper)}});
        scene.instances.push_back({.octree = &ground.octree, .has_lines = false});
        scene.lights.push_back(default_sun(scene.camera));
        scene.lights.push_back({.vector = {0.4, 3.0, 1.0}, .directional = false});
        return scene;
    }

    tests::Model model;
    tests::Model ground;
};

void deform(Scene& scene, const Mesh& mesh, const Deformation& deformation) {
    scene.instances[0].octree = nullptr;
    scene.instances[0].deforming = &mesh;
    scene.instances[0].deformation = deformation;
}

// Pixels where any channel differs by more than `slack`.
std::size_t differing(const Picture& a, const Picture& b, int slack) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        bool differs = false;
        for (std::size_t c = 0; c < 4; ++c)
            differs |= std::abs(int(a.rgba[i + c]) - int(b.rgba[i + c])) > slack;
        count += differs;
    }
    return count;
}

TEST_CASE("a mesh that deforms to where it is gives the picture of one that does not" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    // A solid, an open sheet, and a mesh with edges of every class.
    for (const MeshSource& source : {make_built_in_shape("knot", 3000),
                                     make_built_in_shape("terrain", 1000), tests::book(3)}) {
        const Stage stage(source);
        Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
        for (const Style style : {Style::mask, Style::toon, Style::ink}) {
            CAPTURE(static_cast<int>(style));
            Scene scene = stage.scene(style);
            const Picture still =
                renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side);
            const FrameReport expected = renderer.report();
            Wave wave = default_wave(stage.model.mesh, {0, 1, 0}, 0.4);
            wave.amplitude = 0.0;
            deform(scene, stage.model.mesh, wave);
            const Picture deformed =
                renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side);
            // Normals are rounded elsewhere, which tones show here and there.
            CHECK(differing(still, deformed, style == Style::mask ? 0 : 2) <=
                  (style == Style::mask ? 0u : 20u));
            CHECK(renderer.report().silhouette == expected.silhouette);
            CHECK(renderer.report().shadow_edges == expected.shadow_edges);
            CHECK(renderer.report().bytes_full == expected.bytes_full);
        }
    }
}

TEST_CASE("frames of a moving mesh, a moving camera and light equal those of meshes built anew") {
    RIMLINE_OPEN_GPU(gpu);
    const Stage stage(make_built_in_shape("spring", 3000));
    const Mesh& mesh = stage.model.mesh;
    Renderer live(gpu->context(), {.samples = 1, .scale = 1});
    MeshSource moved = make_built_in_shape("spring", 3000);
    REQUIRE(moved.positions.size() == mesh.vertex_count());
    const auto scene_at = [&](int frame) {
        Scene scene = stage.scene(Style::mask);
        scene.camera.eye.x += 0.2 * frame;
        scene.lights[0].vector.y += 0.2 * frame;
        return scene;
    };
    const auto positions_at = [&](int frame) {
        std::vector<glm::vec3> positions(mesh.positions().begin(), mesh.positions().end());
        for (glm::vec3& p : positions) p.x += 0.15f * std::sin(2.0f * p.y + 0.7f * float(frame));
        return positions;
    };
    std::vector<Picture> pictures;
    constexpr int k_frames = 6;
    for (int frame = 0; frame <= k_frames; ++frame) {
        if (frame < k_frames) {
            Scene scene = scene_at(frame);
            const std::vector<glm::vec3> positions = positions_at(frame);
            deform(scene, mesh, MovedPositions{positions, mesh.center(), 1.5 * mesh.radius()});
            live.submit(scene, k_deforming_picture_side,
                        k_deforming_picture_side);  // Copies the positions.
        }
        if (frame > 0) {
            pictures.push_back(live.finish());
            CHECK(live.report().bytes_streamed < live.report().bytes_full);
        }
    }
    for (int frame = 0; frame < k_frames; ++frame) {
        CAPTURE(frame);
        moved.positions = positions_at(frame);
        const tests::Model anew(moved);
        Scene scene = scene_at(frame);
        scene.instances[0].octree = &anew.octree;
        Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
        const Picture expected =
            renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side);
        tests::save_picture("deformed_" + std::to_string(frame),
                            pictures[static_cast<std::size_t>(frame)], {});
        tests::save_picture("built_anew_" + std::to_string(frame), expected, {});
        // The near plane stands elsewhere with the bounds, and bits at the last rounding may differ.
        CHECK(differing(expected, pictures[static_cast<std::size_t>(frame)], 2) <= 12);
        if (frame > 0)
            CHECK(differing(pictures[0], pictures[static_cast<std::size_t>(frame)], 2) > 500);
    }
}

// So many square sheets, one over the other: a ray from above meets a triangle of each.
MeshSource stack(int sheets) {
    MeshSource source;
    for (int i = 0; i < sheets; ++i) {
        const auto first = static_cast<std::uint32_t>(source.positions.size());
        const float y = 0.1f * float(i) / float(sheets);
        for (const auto& [x, z] :
             {std::pair{-1.0f, -1.0f}, {-1.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, -1.0f}})
            source.positions.emplace_back(x, y, z);
        source.triangles.push_back({first, first + 1, first + 2});
        source.triangles.push_back({first, first + 2, first + 3});
    }
    return source;
}

// A stack high over the ground, under one low sun: the shadow lies beside it.
Scene stack_scene(const Stage& stage) {
    Scene scene = stage.scene(Style::mask);
    scene.camera = {.eye = {0, 6, 8}};
    scene.instances[0].translation = {1.0, 2.0, 0.0};
    scene.lights = {{.vector = {1.2, 1.0, 0.2}, .directional = true}};
    return scene;
}

TEST_CASE(
    "the shadow of a mesh that deforms is right with 254 triangles in a row and wraps with 256" *
    doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    for (const int sheets : {127, 128, 200, 254, 256}) {
        CAPTURE(sheets);
        const Stage stage(stack(sheets));
        Scene scene = stack_scene(stage);
        Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
        const Picture expected =
            renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side);
        deform(scene, stage.model.mesh,
               MovedPositions{stage.model.mesh.positions(), stage.model.mesh.center(),
                              stage.model.mesh.radius()});
        const std::size_t wrong = differing(
            expected, renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side),
            0);
        if (sheets <= 254)
            CHECK(wrong == 0);
        else
            CHECK(wrong > 100);  // What has_deep_shadows is for.
    }
}

TEST_CASE("with has_deep_shadows any number of triangles may be in a row at rest and as they move" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    for (const int sheets : {100, 256, 300, 512, 768}) {
        CAPTURE(sheets);
        const Stage stage(stack(sheets));
        const Mesh& mesh = stage.model.mesh;
        Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
        Scene scene = stack_scene(stage);
        const Picture expected =
            renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side);
        scene.instances[0].has_deep_shadows = true;
        Wave still = default_wave(mesh, {0, 1, 0}, 0.3);
        still.amplitude = 0.0;
        deform(scene, mesh, still);
        CHECK(differing(expected,
                        renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side),
                        0) == 0);
        CHECK((renderer.report().shadows[0].bound > 254) == (sheets > 254));
        // The same renderer goes on as the sheets are sheared.
        for (int frame = 1; frame <= 2; ++frame) {
            CAPTURE(frame);
            MeshSource moved = stack(sheets);
            for (glm::vec3& position : moved.positions)
                position.x += 0.3f * float(frame) * position.z;
            const tests::Model anew(moved);
            REQUIRE(anew.mesh.vertex_count() == mesh.vertex_count());
            Scene rebuilt = scene;
            rebuilt.instances[0].deforming = nullptr;
            rebuilt.instances[0].octree = &anew.octree;
            Renderer fresh(gpu->context(), {.samples = 1, .scale = 1});
            const Picture still_picture =
                fresh.render(rebuilt, k_deforming_picture_side, k_deforming_picture_side);
            deform(scene, mesh,
                   MovedPositions{anew.mesh.positions(), mesh.center(), 2.0 * mesh.radius()});
            const Picture picture =
                renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side);
            // As of meshes built anew above.
            CHECK(differing(still_picture, picture, 2) <= 12);
            CHECK(differing(expected, picture, 2) > 100);
            scene.instances[0].has_deep_shadows = false;
            const std::size_t shallow = differing(
                still_picture,
                renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side), 2);
            CHECK((shallow <= 12) == (sheets % 256 != 0));
            scene.instances[0].has_deep_shadows = true;
        }
    }
}

TEST_CASE("a deep shadow is bounded where the mesh has moved to, and not where it rests") {
    RIMLINE_OPEN_GPU(gpu);
    constexpr int k_sheets = 256;
    // At rest the sheets lie beside one another.
    MeshSource row = stack(k_sheets);
    for (std::size_t i = 0; i < row.positions.size(); ++i)
        row.positions[i].x += 3.0f * float(i / 4);
    const Mesh row_mesh(row);
    const Stage stage(stack(k_sheets));
    const Mesh& stacked = stage.model.mesh;
    REQUIRE(row_mesh.vertex_count() == stacked.vertex_count());
    Scene scene = stack_scene(stage);
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    const Picture expected =
        renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side);
    deform(scene, row_mesh,
           MovedPositions{stacked.positions(), stacked.center(), stacked.radius()});
    scene.instances[0].has_deep_shadows = true;
    CHECK(differing(expected,
                    renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side),
                    0) == 0);
    CHECK(renderer.report().shadows[0].bound >= k_sheets);
    CHECK(renderer.report().shadows[0].runs >= 2);
}

TEST_CASE("waves that the CPU computes for deep shadows give the picture of those of the GPU") {
    RIMLINE_OPEN_GPU(gpu);
    const Stage stage(make_built_in_shape("spring", 3000));
    Scene scene = stage.scene(Style::mask);
    // Within the bounds.
    scene.lights.push_back(
        {.vector = stage.model.mesh.center() + glm::dvec3(0.05, 0.1, 0.0), .directional = false});
    for (const double turns : {0.1, 0.4, 0.8}) {
        CAPTURE(turns);
        deform(scene, stage.model.mesh, default_wave(stage.model.mesh, {0, 1, 0}, turns));
        Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
        scene.instances[0].has_deep_shadows = false;
        const Picture expected =
            renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side);
        scene.instances[0].has_deep_shadows = true;
        CHECK(differing(expected,
                        renderer.render(scene, k_deforming_picture_side, k_deforming_picture_side),
                        2) <= 12);
        for (const ShadowReport& shadow : renderer.report().shadows) CHECK(shadow.bound <= 254);
    }
}

TEST_CASE("instances come, deform, rest and go without a trace of each other") {
    RIMLINE_OPEN_GPU(gpu);
    const Stage stage(make_built_in_shape("torus", 1500));
    const Mesh& mesh = stage.model.mesh;
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    const Scene still = stage.scene(Style::ink);
    const Picture expected =
        renderer.render(still, k_deforming_picture_side, k_deforming_picture_side);
    Scene waving = stage.scene(Style::ink);
    deform(waving, mesh, default_wave(mesh, {0, 1, 0}, 0.1));
    // The same mesh twice, deformed differently.
    waving.instances.push_back(waving.instances[0]);
    waving.instances.back().translation = {0.0, 0.0, -2.0};
    waving.instances.back().deformation = default_wave(mesh, {0, 1, 0}, 0.6);
    const Picture first =
        renderer.render(waving, k_deforming_picture_side, k_deforming_picture_side);
    CHECK(differing(expected, first, 2) > 500);
    CHECK(renderer.render(waving, k_deforming_picture_side, k_deforming_picture_side).rgba ==
          first.rgba);
    Scene alone = waving;
    alone.lights.pop_back();
    renderer.render(alone, k_deforming_picture_side, k_deforming_picture_side);
    CHECK(renderer.render(waving, k_deforming_picture_side, k_deforming_picture_side).rgba ==
          first.rgba);
    CHECK(renderer.render(still, k_deforming_picture_side, k_deforming_picture_side).rgba ==
          expected.rgba);
    Scene without_lines = waving;
    without_lines.lines = false;
    without_lines.shadows = false;
    renderer.render(without_lines, k_deforming_picture_side, k_deforming_picture_side);
    CHECK(renderer.report().silhouette + renderer.report().shadow_edges == 0);
}

TEST_CASE("changes of a mesh that deforms count from the first frame that ran") {
    RIMLINE_OPEN_GPU(gpu);
    const Stage stage(make_built_in_shape("knot", 3000));
    Scene alone = stage.scene(Style::ink);
    alone.shadows = false;
    deform(alone, stage.model.mesh, default_wave(stage.model.mesh, {0, 1, 0}, 0.4));
    Scene both = alone;
    both.instances[1].has_lines = true;
    alone.instances.pop_back();

    Renderer probe(gpu->context(), {.samples = 1, .scale = 1});
    probe.render(alone, k_deforming_picture_side, k_deforming_picture_side);
    const std::uint64_t enough = probe.stream_bytes();
    probe.render(both, k_deforming_picture_side, k_deforming_picture_side);
    const std::uint64_t too_little = probe.stream_bytes() - 1;
    REQUIRE(enough < too_little);

    Renderer renderer(gpu->context(),
                      {.samples = 1, .scale = 1, .stream_memory_bytes = too_little});
    CHECK_THROWS_AS(renderer.render(both, k_deforming_picture_side, k_deforming_picture_side),
                    Error);
    renderer.render(alone, k_deforming_picture_side, k_deforming_picture_side);
    CHECK(renderer.report().camera.edges > 0);
    CHECK(renderer.report().camera.flips == 0);
    CHECK(renderer.report().camera.added == 0);
    CHECK(renderer.report().camera.removed == 0);
}

TEST_CASE("a mesh without faces that deforms draws nothing") {
    RIMLINE_OPEN_GPU(gpu);
    const Stage stage(MeshSource{});
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    Scene scene = stage.scene(Style::ink);
    const Picture expected = renderer.render(scene, 32, 32);
    deform(scene, stage.model.mesh, Wave{});
    CHECK(renderer.render(scene, 32, 32).rgba == expected.rgba);
}

}  // namespace
}  // namespace rimline
