#include "engine/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <ranges>
#include <utility>
#include <vector>

#include "engine/stream/tracked_silhouette.h"
#include "engine/view_defaults.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/solid.h"
#include "tests/engine/support/default_samplings.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

Scene scene_of(const Mesh& mesh, const HoughOctree& octree, Style style) {
    const glm::vec3 paper(0.9f);
    Scene scene{.camera = fit_camera({}, mesh, default_view_direction({0, 1, 0}), 1.0),
                .style = style,
                .palette = default_palette(style, paper)};
    scene.instances.push_back(
        {.octree = &octree, .material = {.color = default_surface_color(style, paper)}});
    scene.lights.push_back(default_sun(scene.camera));
    return scene;
}

// Equal pixels of two pictures, as a share.
double agreement(const Picture& a, const Picture& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    std::size_t equal = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4)
        equal += std::equal(&a.rgba[i], &a.rgba[i] + 4, &b.rgba[i]);
    return double(equal) / double(a.rgba.size() / 4);
}

TEST_CASE("the same scene gives the same picture, and what it holds follows the tracker") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("knot", 4000));
    const HoughOctree octree(mesh);
    Renderer renderer(gpu->context());
    const Scene scene = scene_of(mesh, octree, Style::ink);
    const Picture first = renderer.render(scene, 128, 128);
    CHECK(renderer.report().silhouette ==
          brute_force_silhouette(mesh, renderer.silhouette(0, std::nullopt)->point).size());
    CHECK(renderer.report().bytes_streamed == renderer.report().bytes_full);
    const Picture second = renderer.render(scene, 128, 128);
    CHECK(renderer.report().bytes_streamed == 0);
    CHECK(first.rgba == second.rgba);
    // There is ink, paper and shadow in it: near black, the background, and what lies between.
    std::array<std::size_t, 3> tones{};
    for (std::size_t i = 0; i < first.rgba.size(); i += 4)
        ++tones[first.rgba[i] < 60 ? 0 : first.rgba[i] == first.rgba[0] ? 1 : 2];
    for (const std::size_t tone : tones) CHECK(tone > 200);
}

TEST_CASE(
    "a scene of nothing is its background, with lights or without, before and after one of "
    "something") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("box", 12));
    const HoughOctree octree(mesh);
    const Scene full = scene_of(mesh, octree, Style::ink);
    Scene empty = full;
    empty.instances.clear();
    Scene unlit = empty;
    unlit.lights.clear();
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    const Picture first = renderer.render(unlit, 32, 32);
    for (std::size_t i = 0; i < first.rgba.size(); i += 4)
        REQUIRE(std::equal(&first.rgba[i], &first.rgba[i] + 4, &first.rgba[0]));
    CHECK(renderer.render(empty, 32, 32).rgba == first.rgba);
    CHECK(renderer.render(full, 32, 32).rgba != first.rgba);
    CHECK(renderer.render(unlit, 32, 32).rgba == first.rgba);
}

TEST_CASE("solids are the same pictures without the backs of their faces" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    for (const std::string_view shape : {"sphere", "torus", "knot", "box", "spring"}) {
        const Mesh mesh(make_built_in_shape(shape, 3'000));
        REQUIRE(is_solid(mesh));
        const HoughOctree octree(mesh);
        for (const std::uint32_t samples : {1u, 4u}) {
            Renderer renderer(gpu->context(), {.samples = samples, .scale = 1});
            for (const Style style : {Style::ink, Style::toon, Style::hatch})
                for (const double ortho_height : {0.0, 1.5 * mesh.radius()})
                    for (const bool shadows : {false, true})
                        for (const glm::dvec3& direction :
                             {glm::dvec3(1, 1, 1), glm::dvec3(0.3, 0.9, 0.1),
                              glm::dvec3(-0.7, 0.2, 0.5)}) {
                            CAPTURE(shape);
                            CAPTURE(samples);
                            CAPTURE(int(style));
                            CAPTURE(ortho_height);
                            CAPTURE(shadows);
                            CAPTURE(direction.x);
                            Scene scene = scene_of(mesh, octree, style);
                            scene.camera = fit_camera({}, mesh, glm::normalize(direction), 1.0);
                            scene.camera.ortho_height = ortho_height;
                            scene.shadows = shadows;
                            const Picture with_backs = renderer.render(scene, 200, 200);
                            scene.instances[0].is_solid = true;
                            const Picture without = renderer.render(scene, 200, 200);
                            // Where a back and a front share a silhouette edge either may win.
                            CHECK(1.0 - agreement(with_backs, without) < 4e-4);
                        }
        }
    }
}

TEST_CASE(
    "backs are left out of what is said to be a solid, seen from outside, and of nothing else") {
    RIMLINE_OPEN_GPU(gpu);
    // No solid, to see what is left out of it.
    const Mesh sheet(make_built_in_shape("terrain", 3'000));
    const HoughOctree octree(sheet);
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    Scene scene = scene_of(sheet, octree, Style::toon);
    scene.shadows = false;
    const auto changed_share = [&](const Scene& as_it_is) {
        Scene said = as_it_is;
        said.instances[0].is_solid = true;
        const Picture picture = renderer.render(as_it_is, 100, 100);
        return 1.0 - agreement(picture, renderer.render(said, 100, 100));
    };
    CHECK(changed_share(scene) < 0.01);  // Backs show where hills begin to hide what is behind.
    Scene below = scene;
    below.camera.eye.y = 2.0 * sheet.center().y - scene.camera.eye.y;
    CHECK(changed_share(below) > 0.05);
    Scene fading = below;
    fading.instances[0].fade_radius = 10.0 * sheet.radius();
    CHECK(changed_share(fading) == 0.0);
    Scene within = below;
    within.camera.eye = sheet.center() + glm::dvec3(0.3, -0.02, 0.2);
    within.camera.target = sheet.center() + glm::dvec3(0.0, 0.3, 0.0);
    CHECK(changed_share(within) == 0.0);
    Scene waving = below;
    waving.instances[0].octree = nullptr;
    waving.instances[0].deforming = &sheet;
    CHECK(changed_share(waving) == 0.0);
}

TEST_CASE("a camera that moves frame by frame draws what a fresh renderer draws") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("spring", 4000));
    const HoughOctree octree(mesh);
    Renderer moving(gpu->context(), {.samples = 1, .scale = 1});
    Scene scene = scene_of(mesh, octree, Style::toon);
    const glm::dvec3 start = scene.camera.eye - scene.camera.target;
    Picture last;
    for (int frame = 0; frame <= 12; ++frame) {
        const double angle = 0.02 * frame;
        scene.camera.eye =
            scene.camera.target + glm::dvec3(start.x * std::cos(angle) + start.z * std::sin(angle),
                                             start.y,
                                             start.z * std::cos(angle) - start.x * std::sin(angle));
        scene.lights[0].vector.x += 0.05;
        last = moving.render(scene, 128, 128);
        if (frame > 0) CHECK(moving.report().bytes_streamed < moving.report().bytes_full);
    }
    Renderer fresh(gpu->context(), {.samples = 1, .scale = 1});
    CHECK(fresh.render(scene, 128, 128).rgba == last.rgba);
}

TEST_CASE("frames that overlap are the frames drawn one by one") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("knot", 4000));
    const HoughOctree octree(mesh);
    const auto scene_at = [&](int frame) {
        Scene scene = scene_of(mesh, octree, Style::toon);
        scene.camera.eye.x += 0.03 * frame;
        scene.lights[0].vector.y += 0.1 * frame;
        return scene;
    };
    Renderer one_by_one(gpu->context(), {.samples = 1, .scale = 1});
    Renderer overlapping(gpu->context(), {.samples = 1, .scale = 1});
    overlapping.submit(scene_at(0), 96, 64);
    for (int frame = 0; frame < 8; ++frame) {
        CAPTURE(frame);
        // The second to last frame has another size: what is in flight must survive that too.
        if (frame < 7) overlapping.submit(scene_at(frame + 1), frame == 5 ? 32 : 96, 64);
        const Picture expected = one_by_one.render(scene_at(frame), frame == 6 ? 32 : 96, 64);
        const Picture picture = overlapping.finish();
        CHECK(picture.width == expected.width);
        CHECK(picture.rgba == expected.rgba);
        CHECK(overlapping.report().bytes_streamed == one_by_one.report().bytes_streamed);
    }
}

TEST_CASE(
    "a frame is that of its own scene, whatever was announced, on a service of one's own or not") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("knot", 4000));
    const HoughOctree octree(mesh);
    const auto scene_at = [&](int frame) {
        Scene scene = scene_of(mesh, octree, Style::toon);
        scene.camera.eye.x += 0.02 * frame;
        scene.lights[0].vector.y += 0.05 * frame;
        return scene;
    };
    SilhouetteService service({.workers = 2});
    const RendererOptions shared{.samples = 1, .scale = 1, .service = &service};
    Renderer announced(gpu->context(), shared);
    Renderer misled(gpu->context(), shared);
    Renderer told_nothing(gpu->context(), {.samples = 1, .scale = 1});
    for (int frame = 0; frame < 10; ++frame) {
        CAPTURE(frame);
        const Picture expected = told_nothing.render(scene_at(frame), 96, 64);
        announced.submit(scene_at(frame), 96, 64);
        announced.announce(scene_at(frame + 1));
        CHECK(announced.finish().rgba == expected.rgba);
        CHECK(announced.report().bytes_streamed == told_nothing.report().bytes_streamed);
        misled.submit(scene_at(frame), 96, 64);
        misled.announce(scene_at(frame % 3 == 0 ? 40 : frame + 1));
        CHECK(misled.finish().rgba == expected.rgba);
        CHECK(misled.report().bytes_streamed <= misled.report().bytes_full);
    }
    service.stop();
    CHECK_THROWS_AS(announced.render(scene_at(12), 96, 64), const Error&);
}

TEST_CASE("a teleport sends the whole silhouette once, and the next step its changes") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("sphere", 20'000));
    const HoughOctree octree(mesh);
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    Scene scene = scene_of(mesh, octree, Style::ink);
    scene.shadows = false;
    renderer.render(scene, 64, 64);
    scene.camera.eye.x = -scene.camera.eye.x - 1.0;
    renderer.render(scene, 64, 64);
    CHECK(renderer.report().bytes_streamed == renderer.report().bytes_full);
    scene.camera.eye.x += 0.001;
    renderer.render(scene, 64, 64);
    CHECK(renderer.report().bytes_streamed > 0);
    CHECK(4 * renderer.report().bytes_streamed < renderer.report().bytes_full);
}

TEST_CASE("moving the object and moving everything else the other way give the same picture") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("box", 100));
    const HoughOctree octree(mesh);
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    Scene scene = scene_of(mesh, octree, Style::ink);
    const Picture plain = renderer.render(scene, 128, 128);
    // A quarter turn about y and powers of two: no rounding anywhere.
    const glm::dmat3 turn(glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0));
    const glm::dvec3 offset(4, -2, 8);
    scene.instances[0].rotation = turn;
    scene.instances[0].translation = offset;
    scene.camera.eye = turn * scene.camera.eye + offset;
    scene.camera.target = turn * scene.camera.target + offset;
    scene.lights[0].vector = turn * scene.lights[0].vector;
    // The camera's own axes are rounded elsewhere in double: a few pixels at edges may differ.
    CHECK(agreement(plain, renderer.render(scene, 128, 128)) > 0.995);
}

// A mesh with all lengths times `factor`.
MeshSource scaled(MeshSource source, float factor) {
    for (glm::vec3& position : source.positions) position *= factor;
    return source;
}

TEST_CASE("an instance of another scale is the picture of a mesh of that size") {
    RIMLINE_OPEN_GPU(gpu);
    const MeshSource knot = make_built_in_shape("knot", 2500);
    const tests::Model model(knot), small(make_built_in_shape("box", 12));
    std::vector<std::unique_ptr<tests::Model>> sizes;  // Each has an address of its own.
    Renderer renderer(gpu->context()), other(gpu->context());
    const glm::dmat3 turn(glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0));
    // Powers of two round nothing; strokes are random by coordinates.
    struct Case {
        double scale;
        Style style;
        double agreement;
    };
    for (const Case& c : {Case{4.0, Style::ink, 1.0}, Case{0.125, Style::toon, 1.0},
                          Case{2.0, Style::mask, 1.0}, Case{0.25, Style::blueprint, 1.0},
                          Case{3.3, Style::toon, 0.99}, Case{4.0, Style::hatch, 0.7}}) {
        CAPTURE(c.scale);
        sizes.push_back(std::make_unique<tests::Model>(scaled(knot, float(c.scale))));
        const tests::Model& large = *sizes.back();
        for (const bool orthographic : {false, true})
            for (const bool lamp : {false, true}) {
                CAPTURE(orthographic);
                CAPTURE(lamp);
                Scene expected = scene_of(large.mesh, large.octree, c.style);
                expected.crease_angle_deg = 40.0f;
                expected.instances[0].rotation = turn;
                expected.instances[0].translation = c.scale * glm::dvec3(0.5, -0.25, 1.0);
                // One that receives shadows, and one in front that casts them.
                expected.instances.push_back({.octree = &small.octree,
                                              .scale = 0.25 * c.scale,
                                              .translation = c.scale * glm::dvec3(0.5, 1.5, 0.0)});
                const double radius = large.mesh.radius();
                if (lamp)
                    expected.lights[0] = {.vector = radius * glm::dvec3(1.0, 2.5, 1.5),
                                          .directional = false};
                if (orthographic) expected.camera.ortho_height = 3.0 * radius;
                Scene scene = expected;
                scene.instances[0].octree = &model.octree;
                scene.instances[0].scale = c.scale;
                CHECK(agreement(renderer.render(scene, 160, 160),
                                other.render(expected, 160, 160)) >= c.agreement);
                CHECK(renderer.report().silhouette == other.report().silhouette);
            }
    }
    // A mesh that deforms, and a surface that fades.
    if (!gpu->context().round_to_nearest_float32) return;
    const tests::Model large(scaled(knot, 4.0f));
    Scene expected = scene_of(large.mesh, large.octree, Style::toon);
    expected.instances[0].octree = nullptr;
    expected.instances[0].deforming = &large.mesh;
    expected.instances[0].deformation = default_wave(large.mesh, {0, 1, 0}, 0.25);
    expected.instances[0].fade_radius = large.mesh.radius();
    Scene scene = expected;
    scene.instances[0].deforming = &model.mesh;
    scene.instances[0].deformation = default_wave(model.mesh, {0, 1, 0}, 0.25);
    scene.instances[0].scale = 4.0;
    CHECK(agreement(renderer.render(scene, 96, 96), other.render(expected, 96, 96)) > 0.99);
}

TEST_CASE("all sizes and sample counts draw, down to one pixel") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("torus", 500));
    const HoughOctree octree(mesh);
    const Scene scene = scene_of(mesh, octree, Style::ink);
    for (const std::uint32_t samples : {1u, 4u}) {
        Renderer renderer(gpu->context(), {.samples = samples, .scale = 3});
        for (const auto& [width, height] : {std::pair{1u, 1u}, {7u, 300u}, {33u, 17u}})
            CHECK(renderer.render(scene, width, height).rgba.size() == 4u * width * height);
    }
}

TEST_CASE("meshes without faces, lights or silhouette draw the background") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh{MeshSource{}};
    const HoughOctree octree(mesh);
    Scene scene = scene_of(mesh, octree, Style::ink);
    Renderer renderer(gpu->context());
    const Picture with_light = renderer.render(scene, 16, 16);
    scene.lights.clear();
    const Picture picture = renderer.render(scene, 16, 16);
    CHECK(picture.rgba == with_light.rgba);
    // The paper is 0.9 in linear light.
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
        REQUIRE(int(picture.rgba[i]) == (i % 4 == 3 ? 255 : 243));
}

TEST_CASE("a ground that fades is seen through from below" * doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("knot", 4000));
    const HoughOctree octree(mesh);
    const Mesh ground_mesh(make_ground(mesh, {0, 1, 0}, 8.0 * mesh.radius()));
    const HoughOctree ground(ground_mesh);
    Renderer renderer(gpu->context());
    for (const double height : {0.5, -0.5}) {
        CAPTURE(height);
        Scene scene = scene_of(mesh, octree, Style::toon);
        scene.camera = fit_camera({}, mesh, glm::normalize(glm::dvec3(1.0, height, 1.0)), 1.0);
        const Picture alone = renderer.render(scene, 128, 128);
        scene.instances.push_back({.octree = &ground,
                                   .material = scene.instances[0].material,
                                   .has_lines = false,
                                   .casts_shadows = false,
                                   .fade_radius = 7.0 * mesh.radius(),
                                   .fade_center = mesh.center()});
        const double equal = agreement(renderer.render(scene, 128, 128), alone);
        if (height < 0.0)
            CHECK(equal == 1.0);
        else
            CHECK(equal < 0.9);
    }
}

TEST_CASE(
    "a ground that fades is as light as the background, in all styles and whatever the angle of "
    "the light") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("knot", 4000));
    const HoughOctree octree(mesh);
    const Mesh ground_mesh(make_ground(mesh, {0, 1, 0}, 8.0 * mesh.radius()));
    const HoughOctree ground(ground_mesh);
    Renderer renderer(gpu->context());
    for (const Style style : {Style::ink, Style::toon, Style::hatch}) {
        Scene scene = scene_of(mesh, octree, style);
        scene.shadows = false;
        scene.lights = {{.vector = {1.0, 0.05, 0.3}}};
        const Picture alone = renderer.render(scene, 128, 128);
        scene.instances.push_back({.octree = &ground,
                                   .material = {.color = scene.palette.background},
                                   .has_lines = false,
                                   .casts_shadows = false,
                                   .fade_radius = 7.0 * mesh.radius(),
                                   .fade_center = mesh.center()});
        CHECK(agreement(renderer.render(scene, 128, 128), alone) > 0.999);
        // A light without shadows leaves the shadows of another one as dark as they are.
        scene.shadows = true;
        scene.lights = {{.vector = {1.0, 1.0, 0.3}}};
        const Picture one = renderer.render(scene, 128, 128);
        scene.instances[0].has_surfaces = true;
        scene.lights.push_back({.vector = {0.0, 1.0, 1.0}, .share = 0.5f, .casts_shadows = false});
        const Picture two = renderer.render(scene, 128, 128);
        CHECK(renderer.report().shadows.size() == 1);
        const double equal = agreement(one, two);
        CHECK(equal > 0.5);   // Background and ground.
        CHECK(equal < 0.99);  // The knot is brighter.
        double sum = 0.0, brighter = 0.0;
        for (std::size_t i = 0; i < one.rgba.size(); i += 4) {
            sum += one.rgba[i];
            brighter += two.rgba[i];
        }
        CHECK(brighter > sum);
    }
}

// From an 8-bit value to the next in linear light.
double one_step(std::uint8_t value) {
    const int lower = std::min(int{value}, 254);
    return tests::linear_from_srgb(std::uint8_t(lower + 1)) -
           tests::linear_from_srgb(std::uint8_t(lower));
}

TEST_CASE("a scene without background is a picture with straight alpha") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("sphere", 2000));
    const HoughOctree octree(mesh);
    Scene scene = scene_of(mesh, octree, Style::toon);
    scene.palette.background = {0.0f, 0.0f, 1.0f};
    for (const RendererOptions& sampling : tests::k_default_samplings) {
        CAPTURE(sampling.scale);
        Renderer renderer(gpu->context(), sampling);
        scene.has_background = true;
        const Picture opaque = renderer.render(scene, 128, 128);
        scene.has_background = false;
        const Picture picture = renderer.render(scene, 128, 128);
        std::size_t none = 0, between = 0, whole = 0;
        for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
            const std::uint8_t* pixel = &picture.rgba[i];
            if (pixel[3] == 0) {
                ++none;
                CHECK(pixel[0] + pixel[1] + pixel[2] == 0);
            } else if (pixel[3] == 255) {
                // Half a step of alpha is rounded away, and the background in it.
                ++whole;
                for (int channel = 0; channel < 3; ++channel)
                    CHECK(std::abs(tests::linear_from_srgb(pixel[channel]) -
                                   tests::linear_from_srgb(opaque.rgba[i + channel])) <=
                          0.5 / 255.0 + one_step(opaque.rgba[i + channel]));
            } else {
                // At the outline: the dark color of lines, with nothing of the background in it.
                ++between;
                CHECK(pixel[2] < 60);
            }
        }
        CHECK(none > 3000);
        CHECK(whole > 3000);
        CHECK(between > 100);
        scene.has_background = true;
        CHECK(renderer.render(scene, 128, 128).rgba == opaque.rgba);
    }
}

TEST_CASE("what lies before a parallel projection's near plane is cut off, and casts its shadow") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("knot", 4000));
    const HoughOctree octree(mesh);
    Renderer renderer(gpu->context());
    Scene scene = scene_of(mesh, octree, Style::toon);
    // In a single picture it is not known which are fronts of what was cut: backs are seen.
    scene.instances[0].is_solid = is_solid(mesh);
    CHECK(scene.instances[0].is_solid);
    const double distance = glm::distance(scene.camera.eye, scene.camera.target);
    const auto cut_at = [&](double near) {
        // Depth is 1 at the near plane.
        const double slope = 1.0 / (2.0 * distance);
        scene.camera.projection = Projection{.scale = {1.0 / mesh.radius(), -1.0 / mesh.radius()},
                                             .z = {slope, 1.0 + slope * near},
                                             .w = {0.0, 1.0}};
        scene.shadow_method = ShadowMethod::automatic;
        scene.shadow_form = ShadowForm::automatic;
        const Picture chosen = renderer.render(scene, 128, 128);
        scene.shadow_method = ShadowMethod::fail;
        scene.shadow_form = ShadowForm::general;
        scene.instances[0].is_solid = false;
        const Picture always_right = renderer.render(scene, 128, 128);
        scene.instances[0].is_solid = true;
        CHECK(agreement(chosen, always_right) == 1.0);
        return chosen;
    };
    const Picture whole = cut_at(0.1 * distance);
    const Picture cut = cut_at(distance);
    CHECK(agreement(whole, cut) < 0.98);
    CHECK(agreement(whole, cut_at(distance - 1.5 * mesh.radius())) == 1.0);
    // Nothing is left.
    const Picture none = cut_at(distance + 1.5 * mesh.radius());
    CHECK(agreement(none, cut) < 0.98);
    CHECK(std::ranges::all_of(std::views::iota(std::size_t{0}, none.rgba.size()),
                              [&](std::size_t i) { return none.rgba[i] == none.rgba[i % 4]; }));
}

TEST_CASE("a light at the camera shows no shadow") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("sphere", 2000));
    const HoughOctree octree(mesh);
    Scene scene = scene_of(mesh, octree, Style::mask);
    scene.palette.background = {0.0f, 0.0f, 1.0f};
    scene.lines = false;
    scene.lights = {{.vector = scene.camera.eye, .directional = false}};
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1});
    const Picture picture = renderer.render(scene, 128, 128);
    std::size_t lit = 0;
    std::size_t dark = 0;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        lit += picture.rgba[i] == 255;
        dark += picture.rgba[i] == 0 && picture.rgba[i + 2] == 0;
    }
    CHECK(lit > 5000);
    CHECK(dark == 0);
}

}  // namespace
}  // namespace rimline
