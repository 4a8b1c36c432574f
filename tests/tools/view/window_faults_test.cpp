// A window on a Vulkan that fails on demand: whatever call fails, and whatever showing a picture answers,
// the window shows the same pictures as without.

#include <doctest/doctest.h>

#include <array>
#include <chrono>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include "engine/view_defaults.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/faults/failing_new.h"
#include "tests/engine/faults/vulkan_faults.h"
#include "tests/engine/support/requested_device.h"
#include "tests/engine/support/test_pictures.h"
#include "tests/skip.h"
#include "tests/tools/view/virtual_display.h"
#include "tools/view/window_renderer.h"

namespace rimline {
namespace {

using namespace rimline::tests;
using tools::FontTexture;
using tools::Window;
using tools::WindowRenderer;

constexpr int k_width = 32;
constexpr int k_height = 24;

// A display, a window, and what is drawn in it.
class Setting {
public:
    Setting()
        : window_("test", k_width, k_height),
          instance_({.validate = true,
                     .loader = &failing_loader,
                     .window_extensions = window_.vulkan_extensions()}),
          knot_(make_built_in_shape("knot", 200)) {}
    ~Setting() {
        const std::string first = instance_.first_validation_message();
        CHECK_MESSAGE(instance_.validation_message_count().value_or(0) == 0, first);
    }
    Setting(const Setting&) = delete;
    Setting& operator=(const Setting&) = delete;

    std::unique_ptr<WindowRenderer> make_renderer() {
        const NoFaults none;
        return std::make_unique<WindowRenderer>(instance_, window_, tests::requested_device(),
                                                FontTexture{1, 1, {255}});
    }

    // Three frames of a camera that moves, as the window shows them. A frame that throws is drawn once
    // more, and must then do. `beside`: all but the first are drawn beside the one before.
    std::vector<Picture> play(WindowRenderer& renderer, bool beside = false) {
        thrown_ = 0;
        std::vector<Picture> shown;
        Scene scene{.camera = fit_camera({}, knot_.mesh, default_view_direction({0, 1, 0}), 1.0),
                    .palette = default_palette(Style::ink, glm::vec3(0.9f))};
        scene.instances.push_back({.octree = &knot_.octree});
        scene.lights.push_back(default_sun(scene.camera));
        for (int frame = 0; frame < 3; ++frame) {
            scene.camera.eye.x += 0.1;
            try {
                shown.push_back(draw(renderer, scene, beside && frame > 0));
            } catch (const Error&) {
                ++thrown_;
                shown.push_back(draw(renderer, scene, false));
            } catch (const std::bad_alloc&) {
                ++thrown_;
                shown.push_back(draw(renderer, scene, false));
            }
        }
        return shown;
    }
    /// Frames of the last play that threw.
    int thrown() const { return thrown_; }

private:
    // Until there is an image to draw into. `beside`: as the loop draws the picture of a view at rest.
    Picture draw(WindowRenderer& renderer, const Scene& scene, bool beside) {
        constexpr tools::FrameQuality k_quality{.scale = 1};
        // As the loop waits for events. Without a pause, thousands of questions whether the picture is done would be
        // calls that can fail.
        const auto is_wanted = [] {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            return true;
        };
        for (int attempt = 0; attempt < 100; ++attempt) {
            {
                const CountingNew counting;
                FrameReport report;
                if (beside && renderer.has_kept_picture() &&
                    renderer.draw_beside(scene, k_quality, report, is_wanted) ==
                        WindowRenderer::Beside::done) {
                    renderer.rehearse(scene, k_quality, is_wanted);
                    if (!renderer.has_kept_picture()) continue;
                    if (auto frame = renderer.draw_kept(overlay_, true))
                        return std::move(frame->picture);
                }
                if (auto frame = renderer.draw(scene, overlay_, k_quality, true))
                    return std::move(frame->picture);
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        throw Error(ErrorCode::io, "the window never had an image");
    }

    Window window_;
    VulkanInstance instance_;
    Model knot_;
    OverlayDrawing overlay_;
    int thrown_ = 0;
};

bool are_equal(const std::vector<Picture>& a, const std::vector<Picture>& b) {
    return std::ranges::equal(a, b,
                              [](const Picture& x, const Picture& y) { return x.rgba == y.rgba; });
}

// Null, and the case skipped, where there is no display, device or validation.
std::unique_ptr<Setting> open_setting(std::string& reason) {
    try {
        auto setting = std::make_unique<Setting>();
        setting->make_renderer();
        return setting;
    } catch (const Error& error) {
        reason = error.what();
        return nullptr;
    }
}

#define RIMLINE_OPEN_SETTING(setting)                                   \
    std::string setting##_reason;                                       \
    const auto display = tests::VirtualDisplay::open(setting##_reason); \
    if (!display) RIMLINE_SKIP(setting##_reason);                       \
    const auto setting = open_setting(setting##_reason);                \
    if (!setting) RIMLINE_SKIP(setting##_reason)

void play_with_faults(FaultKind kind, std::uint64_t stride, bool beside = false) {
    RIMLINE_OPEN_SETTING(setting);
    const std::vector<Picture> expected = setting->play(*setting->make_renderer());
    std::uint64_t calls = 0;
    for (bool injected = true; injected; calls += stride) {
        REQUIRE(calls < 20'000);
        const std::vector<std::string> before = live_objects();
        FaultReport report;
        {
            const auto renderer = setting->make_renderer();
            arm({.kind = kind, .call = calls, .result = calls});
            const std::vector<Picture> shown = setting->play(*renderer, beside);
            report = disarm();
            CAPTURE(calls);
            CAPTURE(report.call);
            CAPTURE(name_of(report.result));
            CHECK(are_equal(shown, expected));
            // A device that is lost is made again without a word.
            CHECK(setting->thrown() <= (kind == FaultKind::failure ? 1 : 0));
        }
        CHECK(live_objects() == before);
        injected = report.injected;
    }
    MESSAGE("faults in up to ", calls, " calls");
}

TEST_CASE("whatever call fails while a window is drawn its pictures come all the same") {
    play_with_faults(FaultKind::failure, 29);
}
TEST_CASE("wherever the device of a window is lost its pictures come all the same") {
    play_with_faults(FaultKind::lost_device, 7);
}

TEST_CASE("whatever fails while a picture is drawn beside the one that is shown it comes") {
    play_with_faults(FaultKind::failure, 13, true);
    play_with_faults(FaultKind::lost_device, 5, true);
}

TEST_CASE("a window whose image cannot be had or shown shows the next one") {
    RIMLINE_OPEN_SETTING(setting);
    const std::vector<Picture> expected = setting->play(*setting->make_renderer());
    constexpr std::uint64_t k_results = 5;
    for (const char* function : {"vkAcquireNextImageKHR", "vkQueuePresentKHR"})
        for (std::uint64_t result = 0; result < k_results; ++result)
            for (const std::uint64_t call : {0u, 2u}) {
                const auto renderer = setting->make_renderer();
                arm({.call = call, .result = result, .function = function});
                const std::vector<Picture> shown = setting->play(*renderer);
                const FaultReport report = disarm();
                CAPTURE(function);
                CAPTURE(call);
                CAPTURE(name_of(report.result));
                CHECK(report.injected);
                CHECK(are_equal(shown, expected));
                // Only want of memory is told; what is out of date is made again, what is lost too.
                CHECK(setting->thrown() == (is_out_of_memory(report.result) ? 1 : 0));
                CHECK(
                    renderer->recreation_count() ==
                    (report.result == VK_ERROR_SURFACE_LOST_KHR || setting->thrown() > 0 ? 1 : 0));
            }
}

TEST_CASE("whatever allocation fails while a window is drawn its pictures come all the same") {
    RIMLINE_OPEN_SETTING(setting);
    const std::vector<Picture> expected = setting->play(*setting->make_renderer());
    std::uint64_t allocations = 0;
    for (bool failed = true; failed; allocations += 97) {
        REQUIRE(allocations < 20'000);
        const std::vector<std::string> before = live_objects();
        {
            const auto renderer = setting->make_renderer();
            arm_new(allocations);
            const std::vector<Picture> shown = setting->play(*renderer, allocations % 2 == 1);
            failed = disarm_new();
            CAPTURE(allocations);
            CHECK(are_equal(shown, expected));
            CHECK(setting->thrown() <= 1);
        }
        CHECK(live_objects() == before);
    }
    MESSAGE("faults in up to ", allocations, " allocations");
}

TEST_SUITE("long") {
    TEST_CASE("each call that fails while a window is drawn leaves its pictures") {
        play_with_faults(FaultKind::failure, 1);
    }
    TEST_CASE("each loss of the device of a window leaves its pictures") {
        play_with_faults(FaultKind::lost_device, 1);
    }
}

}  // namespace
}  // namespace rimline
