#pragma once

// A desktop window by GLFW. It receives keys, mouse and dropped files, and provides the surface of a
// swapchain. It draws nothing itself.

#include <vulkan/vulkan.h>

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/vulkan/swapchain.h"

struct GLFWwindow;

namespace rimline::tools {

class Window {
public:
    /// In screen units.
    struct Least {
        int width = 1, height = 1;
    };

    /// Opens a window with a content of `width` x `height` screen units. With `least`: smaller, of the same shape,
    /// where the screen has no room for it, and no smaller than `least` where it has. At most one at a time. Throws
    /// Error{no_device} if there is no display, or if Vulkan cannot present on it.
    Window(const std::string& title, int width, int height, std::optional<Least> least = {});
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// The instance extensions that a surface on this desktop needs.
    std::vector<std::string> vulkan_extensions() const;
    /// Throws Error{no_device}.
    WindowSurface make_surface(const VulkanInstance& instance) const;

    /// Size of the content in pixels. Zero while the window is minimized or hidden.
    VkExtent2D size_px() const;
    bool is_shown() const;
    /// Size of the content in screen units, the units of mouse positions.
    glm::dvec2 size() const;
    void set_size(int width, int height);
    void set_title(const std::string& title);
    /// The desktop's text scale; 1 is the usual size.
    float content_scale() const;

    bool should_close() const;
    void close();

    /// Processes events. Waits up to `wait_s` seconds for the first one. wake() ends the wait; it may be
    /// called on any thread.
    void poll(double wait_s);
    static void wake();
    /// Whether there was an event since the last call: key, mouse, resize, drop or redraw.
    bool take_activity() noexcept;
    /// The same, and keeps it for take_activity().
    bool has_activity() const noexcept;
    /// The keys pressed since the last call, as GLFW_KEY_..., in their order. None is lost, however short it was.
    std::vector<int> take_pressed_keys();
    /// Keys pressed with Ctrl, likewise.
    struct Shortcut {
        int key;
        bool has_shift;
    };
    std::vector<Shortcut> take_pressed_shortcuts();
    /// The files dropped on the window since the last call.
    std::vector<std::string> take_dropped();
    /// Where the mouse was when a button was pressed, and when one was released after that, in units of the window.
    struct MousePress {
        glm::dvec2 from;
        std::optional<glm::dvec2> to;
    };
    /// The last one since the last call.
    std::optional<MousePress> take_press();

    GLFWwindow* handle() const noexcept { return window_; }

private:
    struct Events;

    void listen();

    GLFWwindow* window_ = nullptr;
    std::unique_ptr<Events> events_;  // Its address is the window's user pointer.
};

}  // namespace rimline::tools
