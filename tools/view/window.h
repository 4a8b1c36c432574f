#pragma once

// A window of the desktop, by GLFW: where its keys, its mouse and dropped files come from, and what a
// swapchain shows its pictures in. It draws nothing itself.

#include <vulkan/vulkan.h>

#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "engine/vulkan/swapchain.h"

struct GLFWwindow;

namespace rimline::tools {

class Window {
public:
    /// Opens a window whose content is `width` x `height` screen units. At most one at a time. Throws
    /// Error{no_device} where there is no display to open it on, or none that Vulkan can show on.
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// Instance extensions that surfaces on this desktop need.
    std::vector<std::string> vulkan_extensions() const;
    /// Throws Error{no_device}.
    WindowSurface make_surface(VkInstance instance) const;

    /// Of what is shown, in pixels; zero while minimized or hidden.
    VkExtent2D size_px() const;
    bool is_shown() const;
    /// Of the content in screen units, which the mouse is measured in.
    glm::dvec2 size() const;
    void set_size(int width, int height);
    void set_title(const std::string& title);
    /// How much larger than usual the desktop draws letters.
    float content_scale() const;

    bool should_close() const;
    void close();

    /// Delivers events; waits up to `wait_s` seconds for the first of them. wake() ends the wait from
    /// any thread.
    void poll(double wait_s);
    static void wake();
    /// Whether anything has happened since the last call: a key, the mouse, a resize, a drop, a redraw.
    bool take_activity() noexcept;
    /// Names of the files dropped on the window since the last call.
    std::vector<std::string> take_dropped();

    GLFWwindow* handle() const noexcept { return window_; }

private:
    struct Events;

    void listen();

    GLFWwindow* window_ = nullptr;
    std::unique_ptr<Events> events_;  // Its address is the window's user pointer.
};

}  // namespace rimline::tools
