#include "tools/bench/record_time.h"

#include <array>
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
// A lamp within the faces of a closed mesh has all surfaces in its shadow, which needs no volume. So the first of these
// orbits is taken where a volume is counted.
constexpr std::array k_lamp_orbits_radii{0.3, 0.05, 0.15, 0.45, 0.6, 0.8};

}  // namespace

RecordTimes time_recording(const HoughOctree& octree, const Device& device, std::uint32_t frames,
                           const Context& context) {
    const Mesh& mesh = octree.mesh();
    const Orbit eyes(mesh.center(), direction_of(mesh.up()), 2.0 * mesh.radius());
    const auto angle = [](std::uint32_t frame) { return 0.5 * frame * std::numbers::pi / 180.0; };
    Renderer renderer(device.context(), {.samples = 1, .scale = 1});
    std::uint32_t bound = 0;  // Of the last frame.
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
            bound = report.shadows.empty() ? 0 : report.shadows.front().bound;
            if (frame >= k_record_warm_up) times_ms.push_back(report.record_ms - report.follow_ms);
        }
        return quantile(times_ms, 0.5);
    };
    RecordTimes times{.sun_ms = median_ms([](std::uint32_t) {
                          return Light{.vector = {1, 2, 1}};
                      })};
    for (const double radii : k_lamp_orbits_radii) {
        const Orbit lamps(mesh.center(), direction_of(mesh.up()), radii * mesh.radius());
        const auto lamp = [&](std::uint32_t frame) {
            return Light{.vector = lamps.position(angle(frame)), .directional = false};
        };
        times.resting_lamp_ms = median_ms([&](std::uint32_t) { return lamp(0); });
        const bool is_last = radii == k_lamp_orbits_radii.back();
        if (bound <= 1 && !is_last) continue;
        times.moving_lamp_ms = median_ms(lamp);
        if (bound > 1) break;
    }
    return times;
}

}  // namespace rimline::tools
