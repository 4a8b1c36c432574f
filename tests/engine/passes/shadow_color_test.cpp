#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/shadow_scenes.h"

namespace rimline {
namespace {

constexpr std::uint32_t k_shadow_color_side = 96;

// With a second light whose share is too small to be seen, the lights are drawn after the surfaces, one by one.
Scene with_lights_apart(Scene scene) {
    scene.lights.push_back(
        {.vector = {0, 1, 0}, .directional = true, .share = 1e-6f, .casts_shadows = false});
    return scene;
}

struct Difference {
    int greatest = 0;
    std::size_t pixels = 0;
};

Difference difference(const Picture& a, const Picture& b) {
    Difference difference;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        int most = 0;
        for (std::size_t c = 0; c < 4; ++c)
            most = std::max(most, std::abs(a.rgba[i + c] - b.rgba[i + c]));
        difference.greatest = std::max(difference.greatest, most);
        difference.pixels += most > 0 ? 1 : 0;
    }
    return difference;
}

// Each face in one of three materials.
MeshSource in_colors(MeshSource source) {
    source.materials.materials = {{.base_color = {0.8f, 0.1f, 0.1f}},
                                  {.base_color = {0.1f, 0.7f, 0.2f}},
                                  {.base_color = {0.2f, 0.2f, 0.9f}}};
    for (std::uint32_t face = 0; face < source.triangles.size(); ++face)
        source.materials.of_face.push_back(MaterialId{face % 3});
    return source;
}

// Colors are rounded to half floats once instead of twice.
TEST_CASE("surfaces drawn at once with their color in shadow are those drawn light by light" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const RendererOptions options{.samples = 1, .scale = 2, .pass_times = true};
    Renderer with_lines(gpu->context(), options);
    RendererOptions with_backs_options = options;
    with_backs_options.outline.method = OutlineMethod::backs;
    Renderer with_backs(gpu->context(), with_backs_options);
    const tests::Model colored(in_colors(make_built_in_shape("knot", 900)));
    tests::RandomScenes scenes(20261127);
    std::size_t shaded = 0;
    std::size_t different = 0;
    for (int number = 0; number < 48; ++number) {
        Scene scene = scenes.next();
        scene.lights.resize(1);
        scene.lights[0].share = 1.0f;
        scene.style = std::array{Style::ink, Style::toon, Style::hatch, Style::mask}[number % 4];
        scene.palette = default_palette(scene.style, style_defaults(scene.style).background);
        scene.lines = number % 3 == 0;
        if (number % 5 == 0) scene.instances[0].fade_radius = 9.0;
        if (number % 5 == 0) scene.instances[0].fade_center = scene.instances[0].translation;
        scene.has_background = number % 7 != 0;
        if (number % 4 == 1) {
            scene.instances.push_back(tests::instance_of(colored));
            scene.instances.back().translation = scene.instances[0].translation;
            scene.instances.back().material.shows_mesh_colors = true;
        }
        Renderer& renderer = number % 6 == 0 ? with_backs : with_lines;
        CAPTURE(number);
        const Picture at_once = renderer.render(scene, k_shadow_color_side, k_shadow_color_side);
        const auto& passes = renderer.report().passes;
        if (!passes.empty()) CHECK(passes[3].name == "surfaces, in shadow");
        const Picture apart =
            renderer.render(with_lights_apart(scene), k_shadow_color_side, k_shadow_color_side);
        if (!passes.empty()) CHECK(renderer.report().passes[3].name == "surfaces, light 0");
        const Difference ways = difference(at_once, apart);
        CHECK(ways.greatest <= 1);
        different += ways.pixels;
        scene.shadows = false;
        const Difference shadows =
            difference(at_once, renderer.render(scene, k_shadow_color_side, k_shadow_color_side));
        if (shadows.greatest > 20) ++shaded;
    }
    CHECK(shaded > 24);
    CHECK(different < 48 * k_shadow_color_side * k_shadow_color_side / 50);
}

}  // namespace
}  // namespace rimline
