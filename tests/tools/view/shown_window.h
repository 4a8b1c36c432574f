#pragma once

// A window under Xvfb for tests, with all that it needs, and what they look at.

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "engine/tested_device.h"
#include "tests/engine/support/requested_device.h"
#include "tests/skip.h"
#include "tests/tools/view/virtual_display.h"
#include "tools/view/view_loop.h"
#include "tools/view/window.h"

namespace rimline::tests {

inline constexpr int k_window_width = 320;
inline constexpr int k_window_height = 240;

// A window with a small model in it, and everything it needs; validation on where it is installed.
class ShownWindow {
public:
    explicit ShownWindow(tools::ViewLoopOptions options, bool as_points = false)
        : window("test", k_window_width, k_window_height), instance(make_instance(window)) {
        session.appearance.ground = true;
        session.show(tools::open_document({.model = "shape:knot:3000", .as_points = as_points},
                                          [](const std::string&) { return LongCall{}; }),
                     double(k_window_width) / k_window_height);
        options.device = requested_device();
        loop.emplace(window, *instance, session, options);
    }
    ~ShownWindow() {
        loop.reset();
        const std::string first = instance->first_validation_message();
        CHECK_MESSAGE(instance->validation_message_count().value_or(0) == 0, first);
    }

    // What the window shows in the next frame.
    Picture capture() {
        loop->capture_next();
        for (int attempt = 0; attempt < 100 && !loop->step(true); ++attempt)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return loop->captured();
    }

    // The same once nothing has moved for a while.
    Picture capture_at_rest() {
        Picture picture = capture();
        for (int attempt = 0; attempt < 400 && loop->is_coarse(); ++attempt) picture = capture();
        REQUIRE(!loop->is_coarse());
        return picture;
    }

    // The same scene by a device and a renderer of its own, as `rimline render` draws it.
    Picture rendered(std::uint32_t width, std::uint32_t height) const {
        const VulkanInstance own;
        const TestedDevice device(own, requested_device());
        if (session.is_cloud())
            return SplatRenderer(device.context()).render(session.cloud_scene(), width, height);
        const tools::ViewPicture picture = session.picture(tools::ImageSize{width, height});
        return Renderer(device.context()).render(std::get<Scene>(picture), width, height);
    }

    void resize(int width, int height) {
        window.set_size(width, height);
        const auto arrived = [&] {
            const VkExtent2D size = window.size_px();
            return size.width == static_cast<std::uint32_t>(width) &&
                   size.height == static_cast<std::uint32_t>(height);
        };
        for (int attempt = 0; attempt < 400 && !arrived(); ++attempt) window.poll(0.01);
        REQUIRE(arrived());
    }

    tools::Window window;
    std::unique_ptr<VulkanInstance> instance;
    tools::ViewSession session;
    std::optional<tools::ViewLoop> loop;

private:
    static std::unique_ptr<VulkanInstance> make_instance(const tools::Window& window) {
        try {
            return std::make_unique<VulkanInstance>(
                InstanceOptions{.validate = true, .window_extensions = window.vulkan_extensions()});
        } catch (const Error& error) {
            MESSAGE("without validation: ", std::string(error.what()));
            return std::make_unique<VulkanInstance>(
                InstanceOptions{.window_extensions = window.vulkan_extensions()});
        }
    }
};

// The greatest difference of a channel; 256 where the sizes differ.
inline int difference(const Picture& a, const Picture& b) {
    if (a.width != b.width || a.height != b.height || a.rgba.size() != b.rgba.size()) return 256;
    int greatest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i)
        if (i % 4 != 3) greatest = std::max(greatest, std::abs(int(a.rgba[i]) - int(b.rgba[i])));
    return greatest;
}

// Pixels whose red differs, left of where the panel ends and right of it.
inline std::array<std::size_t, 2> changed_pixels(const Picture& with_panel,
                                                 const Picture& picture) {
    REQUIRE(with_panel.width == picture.width);
    REQUIRE(with_panel.rgba.size() == picture.rgba.size());
    std::array<std::size_t, 2> changed{};
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
        if (std::abs(int(with_panel.rgba[i]) - int(picture.rgba[i])) > 1)
            ++changed[i / 4 % picture.width < 320 ? 0 : 1];
    return changed;
}

// A key that is pressed and released before the next frame.
inline void tap_key(const tools::Window& window, int key, int modifiers = 0) {
    const GLFWkeyfun handler = glfwSetKeyCallback(window.handle(), nullptr);
    handler(window.handle(), key, 0, GLFW_PRESS, modifiers);
    handler(window.handle(), key, 0, GLFW_RELEASE, modifiers);
    glfwSetKeyCallback(window.handle(), handler);
}

// The mouse is there from now on, in units of the window.
inline void move_mouse(tools::Window& window, double x, double y) {
    glfwFocusWindow(window.handle());
    const auto is_there = [&] {
        double at_x = 0.0, at_y = 0.0;
        glfwSetCursorPos(window.handle(), x, y);
        glfwGetCursorPos(window.handle(), &at_x, &at_y);
        return at_x == x && at_y == y && glfwGetWindowAttrib(window.handle(), GLFW_FOCUSED) != 0;
    };
    for (int attempt = 0; attempt < 400 && !is_there(); ++attempt) window.poll(0.01);
    REQUIRE(is_there());
    // GLFW passes on only what moves the mouse from outside.
    const GLFWcursorposfun handler = glfwSetCursorPosCallback(window.handle(), nullptr);
    handler(window.handle(), x, y);
    glfwSetCursorPosCallback(window.handle(), handler);
}

// A button of the mouse is down in the next frame, and up in the one after it.
inline void click(const tools::Window& window, int button) {
    const GLFWmousebuttonfun handler = glfwSetMouseButtonCallback(window.handle(), nullptr);
    handler(window.handle(), button, GLFW_PRESS, 0);
    glfwSetMouseButtonCallback(window.handle(), handler);
}

// A button is released, also in the frame in which it is pressed.
inline void release(const tools::Window& window, int button) {
    const GLFWmousebuttonfun handler = glfwSetMouseButtonCallback(window.handle(), nullptr);
    handler(window.handle(), button, GLFW_RELEASE, 0);
    glfwSetMouseButtonCallback(window.handle(), handler);
}

}  // namespace rimline::tests

/// Defines `display`, or ends the case as skipped where there is none or no Vulkan device.
#define RIMLINE_OPEN_DISPLAY(display)                                            \
    std::string display##_reason;                                                \
    const auto display = rimline::tests::VirtualDisplay::open(display##_reason); \
    if (!display) RIMLINE_SKIP(display##_reason);                                \
    try {                                                                        \
        const VulkanInstance probe;                                              \
        const TestedDevice device(probe, tests::requested_device());             \
    } catch (const Error& error) {                                               \
        RIMLINE_SKIP(error.what());                                              \
    }
