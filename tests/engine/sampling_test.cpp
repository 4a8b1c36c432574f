#include "engine/sampling.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "engine/vulkan/device_context.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/solid.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"
#include "tests/models.h"

namespace rimline {
namespace {

constexpr VkPhysicalDeviceLimits k_standard_places{.standardSampleLocations = VK_TRUE};

TEST_CASE("GPUs take several samples, devices of the CPU type more pixels") {
    DeviceContext context{.limits = k_standard_places,
                          .type = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU,
                          .sample_counts = 1 | 2 | 4 | 8};
    CHECK(sampling_of(context, 0, 0) == Sampling{4, 1});
    CHECK(sampling_of(context, 0, 3) == Sampling{4, 3});
    context.type = VK_PHYSICAL_DEVICE_TYPE_CPU;
    CHECK(sampling_of(context, 0, 0) == Sampling{1, 2});
    CHECK(sampling_of(context, 4, 0) == Sampling{4, 2});
}

TEST_CASE("a sample count that the device lacks is replaced by the next smaller one it has") {
    DeviceContext context{.limits = k_standard_places, .sample_counts = 1 | 4};
    CHECK(sampling_of(context, 2, 1).samples == 1);
    CHECK(sampling_of(context, 4, 1).samples == 4);
    CHECK(sampling_of(context, 8, 1).samples == 4);
    context.sample_counts = 1 | 2;
    CHECK(sampling_of(context, 4, 1).samples == 2);
    context.sample_counts = 1;
    CHECK(sampling_of(context, 4, 1).samples == 1);
    context.sample_counts = 1 | 2 | 4 | 8 | 16;
    CHECK(sampling_of(context, 8, 1).samples == 8);
    CHECK(sampling_of(context, 7, 1).samples == 4);
    CHECK(sampling_of(context, 16, 1).samples == 8);
}

TEST_CASE(
    "where samples are not at the standard locations there is one, on more pixels by default") {
    const DeviceContext context{.type = VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
                                .sample_counts = 1 | 2 | 4 | 8};
    CHECK(sampling_of(context, 0, 0) == Sampling{1, 2});
    CHECK(sampling_of(context, 4, 1) == Sampling{1, 1});
}

// The mean difference, of the greatest of three channels, over the pixels whose neighbors differ by more than
// a few steps.
double difference_along_edges(const Picture& expected, const Picture& found) {
    const auto value = [&](const Picture& picture, std::uint32_t x, std::uint32_t y, int channel) {
        return int(picture.rgba[4 * (std::size_t{y} * picture.width + x) + std::size_t(channel)]);
    };
    std::uint64_t sum = 0, count = 0;
    for (std::uint32_t y = 1; y + 1 < expected.height; ++y)
        for (std::uint32_t x = 1; x + 1 < expected.width; ++x) {
            int contrast = 0, difference = 0;
            for (int channel = 0; channel < 3; ++channel) {
                int low = 255, high = 0;
                for (std::uint32_t i = 0; i < 9; ++i) {
                    const int near = value(expected, x + i % 3 - 1, y + i / 3 - 1, channel);
                    low = std::min(low, near);
                    high = std::max(high, near);
                }
                contrast = std::max(contrast, high - low);
                difference = std::max(difference, std::abs(value(expected, x, y, channel) -
                                                           value(found, x, y, channel)));
            }
            if (contrast <= 8) continue;
            ++count;
            sum += std::uint64_t(difference);
        }
    REQUIRE(count > 1000);
    return double(sum) / double(count);
}

void check_default(const tests::Gpu& gpu, const std::string& name, const Mesh& mesh) {
    CAPTURE(name);
    const HoughOctree octree(mesh);
    for (const Style style : {Style::ink, Style::toon, Style::hatch}) {
        const glm::vec3 paper(0.9f);
        Scene scene{.camera = fit_camera({}, mesh, default_view_direction({0, 1, 0}), 4.0 / 3.0),
                    .style = style,
                    .palette = default_palette(style, paper)};
        scene.instances.push_back({.octree = &octree,
                                   .material = {.color = default_surface_color(style, paper)},
                                   .is_solid = is_solid(mesh)});
        scene.lights.push_back(default_sun(scene.camera));
        Renderer finest(gpu.context(), {.samples = 4, .scale = 2});
        Renderer usual(gpu.context());
        const double difference =
            difference_along_edges(finest.render(scene, 480, 360), usual.render(scene, 480, 360));
        CAPTURE(static_cast<int>(style));
        MESSAGE(name, ", style ", static_cast<int>(style), ": ", difference);
        CHECK(difference <= 2.0);
    }
}

TEST_CASE("pictures of a CPU device's default look like those of 16 samples a pixel" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    if (gpu->context().type != VK_PHYSICAL_DEVICE_TYPE_CPU) RIMLINE_SKIP("this is no CPU device");
    for (const char* shape : {"knot", "scene", "spring"})
        check_default(*gpu, shape, Mesh(make_built_in_shape(shape, 5000)));
}

TEST_CASE("pictures of real models by a CPU device's default look like those of 16 samples" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    if (gpu->context().type != VK_PHYSICAL_DEVICE_TYPE_CPU) RIMLINE_SKIP("this is no CPU device");
    for (const char* name : {"fandisk.obj", "stanford-bunny.obj", "rocker-arm.obj"}) {
        const auto path = tests::find_model(name);
        if (!path) RIMLINE_SKIP(std::string(name) + " is in no folder of RIMLINE_MODELS");
        check_default(*gpu, name, Mesh(read_mesh_file(*path)));
    }
}

}  // namespace
}  // namespace rimline
