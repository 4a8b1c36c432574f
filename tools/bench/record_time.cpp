#include "tools/bench/record_time.h"

#include <numbers>
#include <vector>

#include "engine/renderer.h"
#include "silhouette/hough/orbit.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

constexpr std::uint32_t k_record_side_px =
    64;  // Recording takes as long for every size of the picture.
constexpr std::uint32_t k_record_warm_up = 2;
constexpr double k_lamp_orbit_radii = 0.3;

}  // namespace

RecordTimes time_recording(const HoughOctree& octree, const Device& device, std::uint32_t frames,
                           const Context& context) {
    const Mesh& mesh = octree.mesh();
    const Orbit eyes(mesh.center(), direction_of(mesh.up()), 2.0 * mesh.radius());
    const Orbit lamps(mesh.center(), direction_of(mesh.up()), k_lamp_orbit_radii * mesh.radius());
    const auto angle = [](std::uint32_t frame) { return 0.5 * frame * std::numbers::pi / 180.0; };
    Renderer renderer(device.context(), {.samples = 1, .scale = 1});
    const auto median_ms = [&](const auto& light_at) {
        std::vector<double> times_ms;
        for (std::uint32_t frame = 0; frame < frames + k_record_warm_up; ++frame) {
            context.checkpoint();
            Scene scene;
            scene.instances.push_back({.octree = &octree});
            scene.camera = {.eye = eyes.position(angle(frame)),
                            .target = mesh.center(),
                            .up = direction_of(mesh.up())};
            scene.lights = {light_at(frame)};
            renderer.render(scene, k_record_side_px, k_record_side_px);
            const FrameReport& report = renderer.report();
            if (frame >= k_record_warm_up) times_ms.push_back(report.record_ms - report.follow_ms);
        }
        return quantile(times_ms, 0.5);
    };
    const auto lamp = [&](std::uint32_t frame) {
        return Light{.vector = lamps.position(angle(frame)), .directional = false};
    };
    return {.sun_ms = median_ms([](std::uint32_t) {
                return Light{.vector = {1, 2, 1}};
            }),
            .resting_lamp_ms = median_ms([&](std::uint32_t) { return lamp(0); }),
            .moving_lamp_ms = median_ms(lamp)};
}

}  // namespace rimline::tools
