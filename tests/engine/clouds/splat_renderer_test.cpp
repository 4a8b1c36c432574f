#include "engine/clouds/splat_renderer.h"

#include <cmath>
#include <numbers>

#include "engine/picture_readback.h"
#include "engine/vulkan/commands.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

constexpr std::uint32_t k_splat_renderer_size = 200;
constexpr std::uint32_t k_red = 0xff0000ffu, k_green = 0xff00ff00u, k_blue = 0xffff0000u;

// 100 pixels a unit, seen from far up the z axis; with what it refers to.
struct TestScene : SplatScene {
    TestScene(std::vector<gpu::SplatRecord> splats, std::vector<gpu::StrokeRecord> lines)
        : own{std::move(splats), {}, 0} {
        cloud = &own;
        strokes = std::move(lines);
        camera = {.eye = {0, 0, 5}, .target = {0, 0, 0}, .ortho_height = 2.0};
        radius = 2.0;
    }
    TestScene(const TestScene&) = delete;
    TestScene& operator=(const TestScene&) = delete;
    SplatCloud own;
};
TestScene scene_of(std::vector<gpu::SplatRecord> splats,
                   std::vector<gpu::StrokeRecord> strokes = {}) {
    return {std::move(splats), std::move(strokes)};
}

struct Counts {
    double red = 0, green = 0, blue = 0, white = 0;
};
// Pixels by their color, those between two by shares, in linear light.
Counts count(const Picture& picture) {
    Counts counts;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        const double r = linear_from_srgb(picture.rgba[i]);
        const double g = linear_from_srgb(picture.rgba[i + 1]);
        const double b = linear_from_srgb(picture.rgba[i + 2]);
        const double white = std::min({r, g, b});
        counts.white += white;
        counts.red += r - white;
        counts.green += g - white;
        counts.blue += b - white;
    }
    return counts;
}

const glm::vec3 k_up(0.0f, 0.0f, 1.0f);

}  // namespace

TEST_CASE("A disc covers its area, and of a tilted one what its plane shows") {
    RIMLINE_OPEN_GPU(gpu);
    SplatRenderer renderer(gpu->context());
    for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
        CAPTURE(degrees);
        const double angle = degrees * std::numbers::pi / 180.0;
        for (const float turned : {1.0f, -1.0f}) {
            const glm::vec3 normal(turned * std::sin(angle), 0.0f, turned * std::cos(angle));
            const Counts seen =
                count(renderer.render(scene_of({{{0.2f, -0.1f, 0.0f}, 0.5f, normal, k_red, {}}}),
                                      k_splat_renderer_size, k_splat_renderer_size));
            const double area = std::numbers::pi * 50.0 * 50.0 * std::cos(angle);
            CHECK(seen.red == doctest::Approx(area).epsilon(0.01));
            CHECK(seen.white ==
                  doctest::Approx(k_splat_renderer_size * k_splat_renderer_size - area)
                      .epsilon(0.01));
        }
    }
}

TEST_CASE("A disc without a normal faces the camera, in perspective too") {
    RIMLINE_OPEN_GPU(gpu);
    SplatRenderer renderer(gpu->context());
    TestScene scene = scene_of({{{0.0f, 0.0f, 0.0f}, 0.5f, glm::vec3(0.0f), k_red, {}}});
    scene.camera = {.eye = {3, 4, 5}, .target = {0, 0, 0}, .fov_y_deg = 40.0};
    const double distance = std::sqrt(50.0);
    const double pixels =
        k_splat_renderer_size / 2.0 / std::tan(20.0 * std::numbers::pi / 180.0) * 0.5 / distance;
    CHECK(count(renderer.render(scene, k_splat_renderer_size, k_splat_renderer_size)).red ==
          doctest::Approx(std::numbers::pi * pixels * pixels).epsilon(0.01));
}

TEST_CASE("Nearer discs hide others, whatever their order") {
    RIMLINE_OPEN_GPU(gpu);
    SplatRenderer renderer(gpu->context());
    const gpu::SplatRecord near{{0.0f, 0.0f, 0.5f}, 0.3f, k_up, k_green, {}};
    const gpu::SplatRecord far{{0.0f, 0.0f, -0.5f}, 0.6f, k_up, k_red, {}};
    for (const auto& splats : {std::vector{near, far}, std::vector{far, near}}) {
        const Counts seen =
            count(renderer.render(scene_of(splats), k_splat_renderer_size, k_splat_renderer_size));
        CHECK(seen.green == doctest::Approx(std::numbers::pi * 900.0).epsilon(0.01));
        CHECK(seen.red == doctest::Approx(std::numbers::pi * 2700.0).epsilon(0.01));
    }
}

TEST_CASE(
    "Where discs of one plane overlap each pixel is the nearest point's, whatever their radii") {
    RIMLINE_OPEN_GPU(gpu);
    SplatRenderer renderer(gpu->context());
    for (const float radius : {0.6f, 0.8f}) {
        const Picture picture =
            renderer.render(scene_of({{{-0.2f, 0.0f, 0.0f}, 0.6f, k_up, k_red, {}},
                                      {{0.2f, 0.0f, 0.0f}, radius, k_up, k_green, {}}}),
                            k_splat_renderer_size, k_splat_renderer_size);
        for (std::uint32_t x = 60; x < 140; ++x) {
            CAPTURE(x);
            const std::size_t pixel =
                4 * (std::size_t{k_splat_renderer_size} * (k_splat_renderer_size / 2) + x);
            if (x < 99) CHECK(picture.rgba[pixel] == 255);
            if (x > 100) CHECK(picture.rgba[pixel + 1] == 255);
        }
    }
}

TEST_CASE("A disc whose center is behind the camera hides nothing that is nearer than it") {
    RIMLINE_OPEN_GPU(gpu);
    SplatRenderer renderer(gpu->context());
    const gpu::SplatRecord floor{{0.0f, -0.5f, 0.05f}, 5.0f, {0.0f, 1.0f, 0.0f}, k_red, {}};
    const gpu::SplatRecord above{{0.0f, -0.2f, -1.0f}, 0.1f, k_up, k_green, {}};
    const auto draw = [&](std::vector<gpu::SplatRecord> splats) {
        TestScene scene = scene_of(std::move(splats));
        scene.camera = {.eye = {0, 0, 0}, .target = {0, 0, -1}, .fov_y_deg = 60.0};
        scene.radius = 5.0;
        return count(renderer.render(scene, k_splat_renderer_size, k_splat_renderer_size));
    };
    CHECK(draw({floor}).red > 10000.0);
    const double expected = draw({above}).green;
    CHECK(expected > 500.0);
    CHECK(draw({floor, above}).green == doctest::Approx(expected).epsilon(0.01));
}

TEST_CASE("Cuts leave what lies on their side") {
    RIMLINE_OPEN_GPU(gpu);
    SplatRenderer renderer(gpu->context());
    gpu::SplatRecord disc{{0.0f, 0.0f, 0.0f}, 0.5f, k_up, k_red, {{1.0f, 0.0f, 0.0f}, {}}};
    const double whole = std::numbers::pi * 2500.0;
    const Picture right =
        renderer.render(scene_of({disc}), k_splat_renderer_size, k_splat_renderer_size);
    CHECK(count(right).red == doctest::Approx(0.5 * whole).epsilon(0.01));
    CHECK(right.rgba[4 * (std::size_t{k_splat_renderer_size} * (k_splat_renderer_size / 2) + 120) +
                     1] == 0);
    CHECK(right.rgba[4 * (std::size_t{k_splat_renderer_size} * (k_splat_renderer_size / 2) + 80) +
                     1] == 255);
    disc.cuts[1] = {0.0f, 2.0f, 7.0f};
    CHECK(count(renderer.render(scene_of({disc}), k_splat_renderer_size, k_splat_renderer_size))
              .red == doctest::Approx(0.25 * whole).epsilon(0.01));
}

TEST_CASE("Lines are as wide as asked, have round ends and are hidden by what is nearer") {
    RIMLINE_OPEN_GPU(gpu);
    SplatRenderer renderer(gpu->context());
    const gpu::StrokeRecord stroke{{-0.5f, 0.0f, 0.0f}, 3.0f, {0.5f, 0.0f, 0.0f}, k_blue, {}};
    const double area = 6.0 * 100.0 + std::numbers::pi * 9.0;
    CHECK(
        count(renderer.render(scene_of({}, {stroke}), k_splat_renderer_size, k_splat_renderer_size))
            .blue == doctest::Approx(area).epsilon(0.02));
    const gpu::SplatRecord disc{{0.0f, 0.0f, 0.1f}, 0.25f, k_up, k_red, {}};
    CHECK(count(renderer.render(scene_of({disc}, {stroke}), k_splat_renderer_size,
                                k_splat_renderer_size))
              .blue == doctest::Approx(area - 300.0).epsilon(0.02));
    // Moved towards the camera by more than the disc stands before it, by less, and never beyond half way.
    for (const auto& [lift, seen] : {std::pair{0.15f, area}, {0.05f, area - 300.0}, {1e9f, area}}) {
        gpu::StrokeRecord lifted = stroke;
        lifted.lifts = glm::vec2(lift);
        TestScene scene = scene_of({disc}, {lifted});
        if (lift > 1.0f) scene.camera.ortho_height = 0.0;  // 100 pixels a unit in z = 0.
        scene.camera.fov_y_deg = 2.0 * std::atan(0.2) * 180.0 / std::numbers::pi;
        CHECK(count(renderer.render(scene, k_splat_renderer_size, k_splat_renderer_size)).blue ==
              doctest::Approx(seen).epsilon(0.02));
    }
    // Of no length a dot.
    CHECK(count(renderer.render(scene_of({}, {{stroke.from, 3.0f, stroke.from, k_blue, {}}}),
                                k_splat_renderer_size, k_splat_renderer_size))
              .blue == doctest::Approx(std::numbers::pi * 9.0).epsilon(0.05));
    // From behind the camera's near plane nothing.
    TestScene scene = scene_of({}, {{{0.0f, 0.0f, 9.0f}, 3.0f, {0.0f, 0.5f, 0.0f}, k_blue, {}}});
    scene.camera = {.eye = {0, 0, 5}, .target = {0, 0, 0}, .fov_y_deg = 40.0};
    CHECK(count(renderer.render(scene, k_splat_renderer_size, k_splat_renderer_size)).blue == 0.0);
}

TEST_CASE("Discs are lit from the camera unless they say otherwise") {
    RIMLINE_OPEN_GPU(gpu);
    SplatRenderer renderer(gpu->context());
    const auto middle = [&](std::uint32_t color, double degrees) {
        const double angle = degrees * std::numbers::pi / 180.0;
        const Picture picture = renderer.render(
            scene_of(
                {{{0.0f, 0.0f, 0.0f}, 0.5f, {std::sin(angle), 0.0, std::cos(angle)}, color, {}}}),
            k_splat_renderer_size, k_splat_renderer_size);
        return linear_from_srgb(
            picture.rgba[4 *
                         (std::size_t{k_splat_renderer_size} * (k_splat_renderer_size / 2) + 100)]);
    };
    CHECK(middle(0x0000ffu, 0.0) == doctest::Approx(1.0));
    CHECK(middle(0x0000ffu, 60.0) == doctest::Approx(0.35 + 0.65 * 0.5).epsilon(0.02));
    CHECK(middle(k_red, 60.0) == doctest::Approx(1.0));
}

TEST_CASE("Images of another size are refused while a recorded frame may use the present ones") {
    RIMLINE_OPEN_GPU(gpu);
    const DeviceContext& context = gpu->context();
    SplatRenderer renderer(context, {.scale = 1});
    const TestScene scene = scene_of({});
    const Image small = make_picture_image(context, {16, 16});
    const Image large = make_picture_image(context, {32, 16});
    (void)renderer.prepare(scene, picture_target(small));
    const OwnedCommandPool pool = make_command_pool(context, "a test", context.queue_family);
    const Commands dropped = begin_commands(context, make_commands(context, pool));
    renderer.record(dropped, scene, picture_target(small));
    CHECK_THROWS_WITH_AS((void)renderer.prepare(scene, picture_target(large)),
                         doctest::Contains("wait for them"), Error);
    CHECK_NOTHROW((void)renderer.prepare(scene, picture_target(small)));
    renderer.forget_recorded();
    CHECK_NOTHROW((void)renderer.prepare(scene, picture_target(large)));
    // One that has ended holds nothing up.
    for (const Image* image : {&large, &small, &large}) {
        const UploadPoint uploaded = renderer.prepare(scene, picture_target(*image));
        run_commands(
            context,
            [&](Commands commands) { renderer.record(commands, scene, picture_target(*image)); },
            uploaded);
    }
    CHECK(renderer.render(scene, 8, 8).width == 8);
}

TEST_CASE("Nothing is the background, in any size") {
    RIMLINE_OPEN_GPU(gpu);
    SplatRenderer renderer(gpu->context());
    TestScene scene = scene_of({});
    scene.background = {0.0f, 1.0f, 0.0f};
    for (const auto& [width, height] :
         {std::pair{1u, 1u}, std::pair{7u, 300u}, std::pair{64u, 1u}}) {
        const Picture picture = renderer.render(scene, width, height);
        CHECK(picture.rgba.size() == std::size_t{4} * width * height);
        CHECK(count(picture).green == doctest::Approx(double(width) * height));
    }
}
