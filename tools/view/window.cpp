#include "tools/view/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdlib>
#include <tuple>
#include <utility>

namespace rimline::tools {

namespace {

std::string last_error() {
    const char* description = nullptr;
    glfwGetError(&description);
    return description != nullptr ? std::string(" (") + description + ")" : "";
}

// GLFW names keys by where they are on a US keyboard. Returns the one with the letter that the user's layout has there.
int key_of_layout(int key) {
    const char* const name = key != GLFW_KEY_UNKNOWN ? glfwGetKeyName(key, 0) : nullptr;
    const bool is_letter = name && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0';
    return is_letter ? GLFW_KEY_A + (name[0] - 'a') : key;
}

// No larger than what the screen leaves to windows.
std::pair<int, int> fitting_size(int width, int height, const Window::Least& least) {
    constexpr double k_of_screen = 0.9;
    GLFWmonitor* const monitor = glfwGetPrimaryMonitor();
    if (!monitor) return {std::max(width, least.width), std::max(height, least.height)};
    int x = 0, y = 0, free_width = 0, free_height = 0;
    glfwGetMonitorWorkarea(monitor, &x, &y, &free_width, &free_height);
    float scale_x = 1.0f, scale_y = 1.0f;
    glfwGetMonitorContentScale(monitor, &scale_x, &scale_y);
    const double wide = free_width / double{scale_x};
    const double high = free_height / double{scale_y};
    const double excess = std::max(width / wide, height / high);
    const double factor = excess > 1.0 ? k_of_screen / excess : 1.0;
    const auto side = [&](int wanted, int least_side, double room) {
        return std::max({static_cast<int>(factor * wanted), 1,
                         std::min(least_side, static_cast<int>(k_of_screen * room))});
    };
    return {side(width, least.width, wide), side(height, least.height, high)};
}

}  // namespace

struct Window::Events {
    bool active = true;
    std::vector<int> pressed_keys;
    std::vector<Shortcut> pressed_shortcuts;
    std::vector<std::string> dropped;
    glm::dvec2 mouse{0.0};
    std::optional<MousePress> press;

    static Events& of(GLFWwindow* window) {
        return *static_cast<Events*>(glfwGetWindowUserPointer(window));
    }
};

Window::Window(const std::string& title, int width, int height, std::optional<Least> least)
    : events_(std::make_unique<Events>()) {
#ifdef GLFW_PLATFORM
    // From version 3.4 on, GLFW asks for a Wayland display first, and libwayland prints an error where there is none.
    if (std::getenv("WAYLAND_DISPLAY") == nullptr) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    if (glfwInit() != GLFW_TRUE)
        throw Error(ErrorCode::no_device,
                    "no display: set DISPLAY or WAYLAND_DISPLAY, or use "
                    "rimline render, which needs none" +
                        last_error());
    if (glfwVulkanSupported() != GLFW_TRUE) {
        const std::string reason = last_error();
        glfwTerminate();
        throw Error(ErrorCode::no_device, "Vulkan cannot show pictures on this display" + reason);
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    if (least) std::tie(width, height) = fitting_size(width, height, *least);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
        const std::string reason = last_error();
        glfwTerminate();
        throw Error(ErrorCode::no_device, "the display opens no window" + reason);
    }
    listen();
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

// The panel installs its callbacks later; they call these.
void Window::listen() {
    glfwSetWindowUserPointer(window_, events_.get());
    const auto mark = [](GLFWwindow* window) { Events::of(window).active = true; };
    static constexpr auto k_mark = mark;
    glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
        k_mark(w);
        Events::of(w).mouse = {x, y};
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int, int action, int) {
        k_mark(w);
        Events& events = Events::of(w);
        if (action == GLFW_PRESS)
            events.press = {.from = events.mouse, .to = {}};
        else if (events.press && !events.press->to)
            events.press->to = events.mouse;
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* w, double, double) { k_mark(w); });
    glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int, int action, int mods) {
        k_mark(w);
        const int modifiers = mods & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER);
        const int letter = key_of_layout(key);
        if (action == GLFW_PRESS && modifiers == 0) Events::of(w).pressed_keys.push_back(letter);
        // Repeated while it is held.
        if (action != GLFW_RELEASE && modifiers == GLFW_MOD_CONTROL)
            Events::of(w).pressed_shortcuts.push_back({letter, (mods & GLFW_MOD_SHIFT) != 0});
    });
    glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned) { k_mark(w); });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* w, int) { k_mark(w); });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* w, int) { k_mark(w); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* w) { k_mark(w); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* w, int, int) { k_mark(w); });
    glfwSetWindowIconifyCallback(window_, [](GLFWwindow* w, int) { k_mark(w); });
    glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
        k_mark(w);
        Events& events = Events::of(w);
        events.dropped.insert(events.dropped.end(), paths, paths + count);
    });
}

std::vector<std::string> Window::vulkan_extensions() const {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    return {names, names + count};
}

WindowSurface Window::make_surface(const VulkanInstance& instance) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    vk_check(glfwCreateWindowSurface(instance.handle(), window_, nullptr, &surface),
             "glfwCreateWindowSurface");
    return {instance, surface};
}

bool Window::is_shown() const {
    return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_FALSE &&
           glfwGetWindowAttrib(window_, GLFW_VISIBLE) == GLFW_TRUE;
}

VkExtent2D Window::size_px() const {
    if (!is_shown()) return {0, 0};
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

glm::dvec2 Window::size() const {
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window_, &width, &height);
    return {width, height};
}

void Window::set_size(int width, int height) { glfwSetWindowSize(window_, width, height); }

void Window::set_title(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

float Window::content_scale() const {
    float x = 1.0f;
    float y = 1.0f;
    glfwGetWindowContentScale(window_, &x, &y);
    return x > 0.0f ? x : 1.0f;
}

bool Window::should_close() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }

void Window::poll(double wait_s) {
    if (wait_s > 0.0)
        glfwWaitEventsTimeout(wait_s);
    else
        glfwPollEvents();
}

void Window::wake() { glfwPostEmptyEvent(); }

bool Window::take_activity() noexcept { return std::exchange(events_->active, false); }

bool Window::has_activity() const noexcept { return events_->active; }

std::vector<int> Window::take_pressed_keys() { return std::exchange(events_->pressed_keys, {}); }

std::vector<Window::Shortcut> Window::take_pressed_shortcuts() {
    return std::exchange(events_->pressed_shortcuts, {});
}

std::optional<Window::MousePress> Window::take_press() { return std::exchange(events_->press, {}); }

std::vector<std::string> Window::take_dropped() { return std::exchange(events_->dropped, {}); }

}  // namespace rimline::tools
