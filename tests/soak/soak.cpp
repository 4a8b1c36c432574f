// soak MINUTES [PART]: moves, frames under 24 lights, and window sessions, each for its share of the time. Fails where
// one of them holds more at its end than after its first tenth, or takes long now and then (soak_record.h). Status 77
// where there is no display or no Vulkan device; the parts before have run then.

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include "engine/renderer.h"
#include "engine/tested_device.h"
#include "engine/view_defaults.h"
#include "silhouette/hough/orbit.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/faults/vulkan_faults.h"
#include "tests/engine/support/requested_device.h"
#include "tests/engine/support/test_pictures.h"
#include "tests/skip.h"
#include "tests/soak/soak_record.h"
#include "tests/tools/scratch_folder.h"
#include "tests/tools/view/virtual_display.h"
#include "tools/view/view_loop.h"

namespace rimline {
namespace {

using namespace rimline::tests;
using namespace rimline::tools;

constexpr std::size_t k_lights = 24;

// A point that goes around a model for ever, in steps of a thousandth of a turn, at a height that changes slowly.
glm::dvec3 place(const Mesh& mesh, std::uint64_t step, double radii) {
    const double turn_rad = 0.00628 * double(step);
    const glm::dvec3 axis(0.3 * std::sin(0.013 * turn_rad), 1.0, 0.2 * std::cos(0.017 * turn_rad));
    return Orbit(mesh.center(), axis, radii * mesh.radius()).position(turn_rad);
}

bool soak_moves(double seconds) {
    const Model model(make_built_in_shape("knot", 500'000));
    const auto viewpoint = [&](std::uint64_t step) {
        return HomogeneousPoint::viewpoint(glm::vec3(place(model.mesh, step, 2.5)));
    };
    SilhouetteTracker tracker(model.octree, viewpoint(0));
    SoakRecord record("moves", seconds, {});
    for (std::uint64_t step = 1; record.goes_on();)
        for (int i = 0; i < 1000; ++i, ++step) {
            const double started_s = thread_clock_s();
            tracker.move_to(viewpoint(step));
            record.add_step(thread_clock_s() - started_s);
        }
    return record.report();
}

bool soak_frames(double seconds) {
    const VulkanInstance instance({.loader = &failing_loader});
    const TestedDevice device(instance, requested_device());
    const Model knot(make_built_in_shape("knot", 1'000)), box(make_built_in_shape("box", 12));
    Renderer renderer(device.context());
    Scene scene{.camera = fit_camera({}, knot.mesh, default_view_direction({0, 1, 0}), 1.0),
                .palette = default_palette(Style::ink, glm::vec3(0.9f))};
    scene.instances.push_back({.octree = &knot.octree});
    scene.instances.push_back({.octree = &box.octree});
    scene.lights.resize(k_lights, default_sun(scene.camera));
    SoakRecord record("frames", seconds, {});
    for (std::uint64_t step = 0; record.goes_on(); ++step) {
        scene.camera.eye = place(knot.mesh, step, 4.0);
        for (std::size_t i = 0; i < k_lights; ++i)
            scene.lights[i].vector =
                place(knot.mesh, (7 + i) * step + 1000 * i, 1.0) - knot.mesh.center();
        const double started_s = wall_clock_s();
        renderer.render(scene, 32, 32);
        record.add_step(wall_clock_s() - started_s);
    }
    return record.report();
}

void drop(const Window& window, const std::string& path) {
    const GLFWdropfun dropped = glfwSetDropCallback(window.handle(), nullptr);
    glfwSetDropCallback(window.handle(), dropped);
    const char* name = path.c_str();
    dropped(window.handle(), 1, &name);
}

// A window opens with a model, a file is dropped on it, it is resized, it closes.
void play_session(const std::string& file, int number) {
    Window window("soak", 96, 72);
    const VulkanInstance instance(
        {.loader = &failing_loader, .window_extensions = window.vulkan_extensions()});
    ViewSession session;
    session.show(
        open_document({.model = "shape:box"}, [](const std::string&) { return LongCall{}; }),
        96.0 / 72.0);
    ViewLoop loop(window, instance, session,
                  {.device = std::getenv("RIMLINE_DEVICE") ? std::getenv("RIMLINE_DEVICE") : ""});
    loop.step(true);
    drop(window, file);
    do loop.step(true);
    while (loop.is_loading());
    window.set_size(128 + number % 2, 96);
    for (int frame = 0; frame < 3; ++frame) loop.step(true);
    window.close();
    if (session.document().name() != file || !loop.message().empty()) {
        std::printf("FAILED   windows: %s is not shown: %s\n", file.c_str(),
                    loop.message().c_str());
        std::exit(1);
    }
}

bool soak_windows(double seconds) {
    std::string reason;
    const auto display = VirtualDisplay::open(reason);
    if (!display) throw Error(ErrorCode::no_device, reason);
    const ScratchFolder folder;
    setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1);
    std::ofstream(folder / "dropped.obj")
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    // libX11 leaves some hundred bytes of its tables of locales behind each time that GLFW starts. Drivers and the
    // desktop's libraries take their time now and then.
    SoakRecord record("windows", seconds,
                      {.slowest = 0.0, .judges_anonymous = false, .lost_bytes = 512});
    for (int number = 0; record.goes_on(); ++number) {
        const double started_s = wall_clock_s();
        play_session((folder / "dropped.obj").string(), number);
        record.add_step(wall_clock_s() - started_s);
    }
    return record.report();
}

}  // namespace
}  // namespace rimline

int main(int argc, char** argv) {
    const double minutes = argc == 2 || argc == 3 ? std::atof(argv[1]) : 0.0;
    const std::string only = argc == 3 ? argv[2] : "";
    struct Part {
        std::string name;
        double share;
        bool (*run)(double seconds);
    };
    const std::array parts{Part{"moves", 0.2, rimline::soak_moves},
                           Part{"frames", 0.4, rimline::soak_frames},
                           Part{"windows", 0.4, rimline::soak_windows}};
    const bool is_part = std::ranges::any_of(parts, [&](const Part& p) { return p.name == only; });
    if (!(minutes > 0.0) || !(only.empty() || is_part)) {
        std::fputs("usage: soak MINUTES [moves | frames | windows]\n", stderr);
        return 2;
    }
    // Else threads take turns with many arenas, each of which keeps what its threads needed at most.
    mallopt(M_ARENA_MAX, 1);
    try {
        bool are_steady = true;
        for (const Part& part : parts)
            if (only.empty() || only == part.name)
                are_steady =
                    part.run(60.0 * minutes * (only.empty() ? part.share : 1.0)) && are_steady;
        return are_steady ? 0 : 1;
    } catch (const rimline::Error& error) {
        const bool is_skipped = error.code() == rimline::ErrorCode::no_device;
        std::printf("%s%s\n", is_skipped ? "SKIPPED: " : "FAILED   ", error.what());
        return is_skipped ? rimline::tests::k_skipped_status : 1;
    }
}
