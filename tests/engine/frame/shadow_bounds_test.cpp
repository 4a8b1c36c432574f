// Shadows are limited to where they can be seen: the picture must not change, and all that volumes count must
// lie within the limits.

#include "engine/frame/shadow_bounds.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "engine/frame/render_targets.h"
#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "tests/engine/support/depth_readback.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/shadow_scenes.h"

namespace rimline {
namespace {

using namespace rimline::tests;

constexpr std::uint32_t k_shadow_bounds_width = 96;
constexpr std::uint32_t k_shadow_bounds_height = 72;

bool is_limited(const ShadowReach& reach) {
    return reach.width < k_shadow_bounds_width || reach.height < k_shadow_bounds_height;
}

struct Extent {
    std::int64_t left, top, right, bottom;
};

Extent extent_of(const ShadowReach& reach) {
    return {reach.x, reach.y, reach.x + std::int64_t{reach.width},
            reach.y + std::int64_t{reach.height}};
}

bool contains(const ShadowReach& reach, std::size_t pixel, float depth) {
    const Extent extent = extent_of(reach);
    const auto x = static_cast<std::int64_t>(pixel % k_shadow_bounds_width);
    const auto y = static_cast<std::int64_t>(pixel / k_shadow_bounds_width);
    return x >= extent.left && x < extent.right && y >= extent.top && y < extent.bottom &&
           depth >= reach.min_depth && depth <= reach.max_depth;
}

// Draws scenes without limits, and checks what the limits are that a renderer with them reports.
class Limits {
public:
    explicit Limits(const Gpu& gpu)
        : context_(gpu.context()),
          limited_(gpu.context(), {.samples = 1, .scale = 1}),
          everywhere_(gpu.context(),
                      {.samples = 1, .scale = 1, .limits_shadows = false, .keeps_stencil = true}),
          fine_(gpu.context(), {.samples = 4, .scale = 2}),
          fine_everywhere_(gpu.context(), {.samples = 4, .scale = 2, .limits_shadows = false}) {}

    /// Both pictures are equal, and what the last light counts lies in the reach of a caster.
    void check(Scene scene, const std::string& name) {
        CAPTURE(name);
        scene.style = Style::mask;
        scene.palette = default_palette(Style::mask, {0.02f, 0.1f, 0.5f});
        const Picture some = limited_.render(scene, k_shadow_bounds_width, k_shadow_bounds_height);
        const std::vector<ShadowReport> shadows = limited_.report().shadows;
        const Picture all =
            everywhere_.render(scene, k_shadow_bounds_width, k_shadow_bounds_height);
        std::vector<Mark> marks;
        for (std::size_t at = 0; at < some.rgba.size(); at += 4)
            if (!std::equal(&some.rgba[at], &some.rgba[at] + 4, &all.rgba[at]))
                marks.push_back({at / 4, {255, 0, 0}});
        save_picture("limited_" + name, some, marks);
        CHECK(marks.size() == 0);
        if (++scenes_ % 8 == 0)
            CHECK(
                fine_.render(scene, k_shadow_bounds_width, k_shadow_bounds_height).rgba ==
                fine_everywhere_.render(scene, k_shadow_bounds_width, k_shadow_bounds_height).rgba);
        // The whole picture is drawn where its grid is.
        scene.palette.grid_strength = 1e-30f;
        everywhere_.render(scene, k_shadow_bounds_width, k_shadow_bounds_height);
        const Image& image = everywhere_.targets()->depth();
        const std::vector<std::uint8_t> counts = read_stencil(context_, image);
        const std::vector<float> depths = read_depth(context_, image);
        std::size_t beyond = 0;
        for (std::size_t pixel = 0; pixel < counts.size(); ++pixel) {
            // Without a surface, a count does not matter.
            if (counts[pixel] == 0 || depths[pixel] == 0.0f) continue;
            ++counted_;
            if (std::ranges::none_of(shadows, [&](const ShadowReport& shadow) {
                    return shadow.light + 1 == scene.lights.size() &&
                           contains(shadow.reach, pixel, depths[pixel]);
                }))
                ++beyond;
        }
        CHECK(beyond == 0);
        for (const ShadowReport& shadow : shadows) {
            limited_count_ += is_limited(shadow.reach) ? 1 : 0;
            area_ += double(shadow.reach.width) * shadow.reach.height /
                     (k_shadow_bounds_width * k_shadow_bounds_height);
            depth_limited_ += shadow.reach.min_depth > 0.0f ? 1 : 0;
            ++volumes_;
        }
    }

    std::size_t counted() const { return counted_; }
    std::size_t volumes() const { return volumes_; }
    std::size_t limited() const { return limited_count_; }
    std::size_t depth_limited() const { return depth_limited_; }
    double mean_area() const { return area_ / double(volumes_); }

private:
    DeviceContext context_;
    Renderer limited_, everywhere_, fine_, fine_everywhere_;
    std::size_t scenes_ = 0, counted_ = 0, volumes_ = 0, limited_count_ = 0, depth_limited_ = 0;
    double area_ = 0.0;
};

TEST_CASE("shadows of random scenes lie within their limits" * doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    constexpr std::uint64_t k_seed = 20261125;
    CAPTURE(k_seed);
    RandomScenes scenes(k_seed);
    Limits limits(*gpu);
    for (int number = 0; number < 160; ++number)
        limits.check(scenes.next(), std::to_string(number));
    std::printf(
        "%zu of %zu volumes have a smaller rectangle, of %.2f of the picture on average; "
        "%zu have a least depth\n",
        limits.limited(), limits.volumes(), limits.mean_area(), limits.depth_limited());
    CHECK(limits.counted() > 10'000);
    CHECK(limits.limited() > 100);
    CHECK(limits.depth_limited() > 100);
}

TEST_CASE("shadows of several casters lie within their limits wherever the light and the eye are" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Model ground(square(20.0, -1.6));
    const Model knot(make_built_in_shape("knot", 1500));
    const Model box(make_built_in_shape("box", 12));
    const Model wall(square(1.5, 0.0));
    Limits limits(*gpu);
    const auto scene_of = [&](const Light& light, const Camera& camera) {
        return Scene{.instances = {ground_of(ground), instance_of(knot),
                                   instance_of(box, turned({1, 2, -1}, 0.7), {2.4, -0.4, -1.8}),
                                   instance_of(wall, turned({1, 0, 0}, 1.2), {-2.6, 0.3, 0.5})},
                     .lights = {light},
                     .camera = camera};
    };
    const std::vector<Light> lights{
        sun({0.7, 1.5, 0.4}),    sun({1.0, 0.0, 0.0}),  // In the plane of the boxes' faces.
        sun({-0.3, -1.0, 0.2}),                         // From below.
        sun({0.2, 0.4, 1.0}),    lamp({2.0, 3.0, -1.0}),
        lamp({0.1, 0.05, -0.1}),  // In the knot's box.
        lamp({2.4, -0.4, -1.8}),  // In the box.
        lamp({3.1, 2.4, 4.1}),    // Close to the first eye.
        lamp({0.0, 60.0, 10.0}), lamp({1.05, 1.01, 0.2}),
    };
    const std::vector<Camera> cameras{
        looking({3, 2.5, 4}, {0, -0.6, 0}),
        looking({1.6, -1.3, 1.0}, {-1.0, -1.0, 0.4}),  // In the knot's shadow.
        looking({0.2, 0.1, 0.0}, {3.0, -1.0, 1.0}),    // In the knot's box.
        looking({9.0, 5.0, 12.0}, {-8, -0.6, 3}),      // The casters are at the picture's edge.
        looking({3, 2.5, 4}, {8, 4.0, 9}),             // They are behind.
        looking({3, 2.5, 4}, {0, -0.6, 0}, 6.0),
        looking({0.5, 0.2, 0.1}, {0, -0.6, 0}, 9.0),
    };
    for (std::size_t l = 0; l < lights.size(); ++l)
        for (std::size_t c = 0; c < cameras.size(); ++c) {
            Scene scene = scene_of(lights[l], cameras[c]);
            if ((l + c) % 3 == 0) scene.lights.push_back(lights[(l + 1) % lights.size()]);
            limits.check(scene, "light " + std::to_string(l) + ", camera " + std::to_string(c));
        }
    // More surfaces than are looked at one by one.
    Scene crowd{.instances = {ground_of(ground)},
                .lights = {sun({0.9, 1.1, 0.3}), lamp({0.3, 1.5, 0.2})},
                .camera = cameras[0]};
    for (int i = 0; i < 40; ++i)
        crowd.instances.push_back(
            instance_of(box, turned({1, 0.1 * i, 0}, 0.2 * i),
                        {3.0 * std::cos(0.7 * i), -0.8 + 0.05 * i, 0.12 * i * std::sin(0.7 * i)}));
    limits.check(crowd, "crowd");
    CHECK(limits.limited() > limits.volumes() / 2);
    CHECK(limits.depth_limited() > limits.volumes() / 3);
}

TEST_CASE("a shadow that cannot be in the picture is not drawn") {
    const Model box(make_built_in_shape("box", 12));
    const Model ground(square(20.0, -1.6));
    Scene scene{.instances = {instance_of(box), ground_of(ground)},
                .lights = {sun({0.4, 1.0, 0.2})},
                .camera = looking({10, 4, 10}, {14, -1.6, 14})};
    const auto reach = [&](bool has_backdrop) {
        CasterMeshes casters;
        casters.try_emplace(&box.mesh, box.mesh);
        const FrameView view(scene, {k_shadow_bounds_width, k_shadow_bounds_height}, casters);
        return ShadowBounds(view, has_backdrop).reach_of(0, 0, 0.0f);
    };
    CHECK(reach(false).is_empty());
    // From a low sun it falls into the picture, without the ground only on a backdrop.
    scene.lights = {sun({-1.0, 0.08, -1.0})};
    CHECK(!reach(false).is_empty());
    scene.instances.pop_back();
    CHECK(reach(false).is_empty());
    CHECK(!reach(true).is_empty());
    // Away from the camera it does not fall on a backdrop either.
    scene.lights = {sun({1.0, 0.08, 1.0})};
    CHECK(reach(true).is_empty());
}

TEST_CASE("the limits of a shadow are no wider than its caster and its shadow") {
    RIMLINE_OPEN_GPU(gpu);
    const Model box(make_built_in_shape("box", 12));
    const Model ground(square(20.0, -1.0));
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1, .keeps_stencil = true});
    for (const Light& light :
         {sun({0.7, 1.5, 0.4}), sun({-1.0, 0.9, -0.2}), lamp({1.0, 4.0, -2.0})})
        for (const double height : {0.0, 12.0}) {
            Scene scene{.instances = {instance_of(box), ground_of(ground)},
                        .lights = {light},
                        .camera = looking({5, 8, 9}, {0, -0.6, 0}, height)};
            renderer.render(scene, k_shadow_bounds_width, k_shadow_bounds_height);
            REQUIRE(renderer.report().shadows.size() == 1);
            const Extent found = extent_of(renderer.report().shadows[0].reach);
            const std::vector<std::uint8_t> counts =
                read_stencil(gpu->context(), renderer.targets()->depth());
            scene.instances.pop_back();
            scene.shadows = false;
            scene.palette.grid_strength = 1e-30f;
            renderer.render(scene, k_shadow_bounds_width, k_shadow_bounds_height);
            const std::vector<float> depths =
                read_depth(gpu->context(), renderer.targets()->depth());
            Extent needed{k_shadow_bounds_width, k_shadow_bounds_height, 0, 0};
            for (std::size_t pixel = 0; pixel < counts.size(); ++pixel) {
                if (counts[pixel] == 0 && depths[pixel] == 0.0f) continue;
                const auto x = static_cast<std::int64_t>(pixel % k_shadow_bounds_width);
                const auto y = static_cast<std::int64_t>(pixel / k_shadow_bounds_width);
                needed = {std::min(needed.left, x), std::min(needed.top, y),
                          std::max(needed.right, x + 1), std::max(needed.bottom, y + 1)};
            }
            CAPTURE(light.vector.z);
            CAPTURE(height);
            CHECK(needed.right - needed.left > 10);
            for (const auto& [wide, narrow] : {std::pair{found.right, needed.right},
                                               {found.bottom, needed.bottom},
                                               {-found.left, -needed.left},
                                               {-found.top, -needed.top}}) {
                CHECK(wide >= narrow);
                CHECK(wide <= narrow + 4);
            }
        }
}

}  // namespace
}  // namespace rimline
