// Lights that fill the shadows of others (Light::fills).

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

Scene unlined_scene(const tests::Model& model, Style style) {
    const glm::vec3 paper(0.9f);
    Scene scene{.camera = fit_camera({}, model.mesh, default_view_direction({0, 1, 0}), 1.0),
                .style = style,
                .palette = default_palette(style, paper),
                .lines = false};
    scene.instances.push_back(
        {.octree = &model.octree, .material = {.color = default_surface_color(style, paper)}});
    return scene;
}

TEST_CASE("a light that fills makes shadows lighter and changes nothing that is lit") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 4000));
    Renderer renderer(gpu->context());
    for (const Style style : {Style::ink, Style::toon, Style::hatch, Style::blueprint}) {
        for (const bool has_background : {true, false}) {
            Scene scene = unlined_scene(model, style);
            scene.has_background = has_background;
            scene.lights = {{.vector = {1.0, 1.0, 0.3}, .share = 1.0f}};
            const Picture alone = renderer.render(scene, 128, 128);
            std::array<int, 3> lightest{};
            for (std::size_t i = 0; i < alone.rgba.size(); ++i)
                if (i % 4 < 3) lightest[i % 4] = std::max(lightest[i % 4], int{alone.rgba[i]});
            for (const glm::dvec3 towards : {glm::dvec3(-1.0, 0.2, 0.4), glm::dvec3(1.0, 1.0, 0.3)})
                scene.lights.push_back(
                    {.vector = towards, .share = 0.6f, .casts_shadows = false, .fills = true});
            const Picture filled = renderer.render(scene, 128, 128);
            std::size_t darker = 0, too_light = 0, lighter = 0, other_alpha = 0;
            for (std::size_t i = 0; i < alone.rgba.size(); ++i) {
                const int before = alone.rgba[i], after = filled.rgba[i];
                if (i % 4 == 3) {
                    other_alpha += after != before ? 1 : 0;
                    continue;
                }
                darker += after < before - 1 ? 1 : 0;
                too_light += after > lightest[i % 4] + 1 ? 1 : 0;
                lighter += after > before + 1 ? 1 : 0;
            }
            CAPTURE(int(style));
            CAPTURE(has_background);
            CHECK(darker == 0);
            CHECK(too_light == 0);
            CHECK(lighter > 500);
            CHECK(other_alpha == 0);
        }
    }
}

TEST_CASE("a light that fills changes no strokes of one color on surfaces of many") {
    RIMLINE_OPEN_GPU(gpu);
    MeshSource source = make_built_in_shape("knot", 4000);
    source.materials.materials = {{glm::vec3(1.0f), k_no_texture}};
    source.materials.of_face.assign(source.triangles.size(), MaterialId{0});
    const tests::Model model(source);
    Renderer renderer(gpu->context());
    Scene scene = unlined_scene(model, Style::hatch);
    for (const bool has_material_inks : {false, true}) {
        CAPTURE(has_material_inks);
        // Dark strokes on white surfaces, before a paper that is darker still, or white.
        scene.palette.background = glm::vec3(has_material_inks ? 1.0f : 0.01f);
        scene.palette.ink = glm::vec3(0.1f);
        scene.instances[0].material.lines_in_mesh_colors = has_material_inks;
        scene.lights = {{.vector = {1.0, 1.0, 0.3}, .share = 1.0f}};
        const Picture alone = renderer.render(scene, 128, 128);
        scene.lights.push_back(
            {.vector = {-1.0, 0.2, 0.4}, .share = 0.6f, .casts_shadows = false, .fills = true});
        const Picture filled = renderer.render(scene, 128, 128);
        std::size_t changed = 0;
        for (std::size_t i = 0; i < alone.rgba.size(); ++i)
            changed += std::abs(int{alone.rgba[i]} - int{filled.rgba[i]}) > 1 ? 1 : 0;
        if (has_material_inks)
            CHECK(changed > 500);
        else
            CHECK(changed == 0);
    }
}

}  // namespace
}  // namespace rimline
