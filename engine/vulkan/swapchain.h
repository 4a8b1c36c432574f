#pragma once

// The pictures of a window: a surface, the images that it shows in turn, and when they must be made
// anew.
//
//     acquire --> record into image() --> submit: waits for acquired(), signals drawn() --> present
//
// An X11 swapchain may never report that its window was resized, so acquire() is told the window's size
// in every frame and makes the images anew when it is another one. A window of no size (minimized) has
// no images: acquire() returns nothing, and the caller waits for better times.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/vulkan/device.h"
#include "engine/vulkan/vulkan_handle.h"

namespace rimline {

/// Owns a surface that a window system made. The instance must outlive it.
class WindowSurface {
public:
    WindowSurface() = default;
    WindowSurface(VkInstance instance, VkSurfaceKHR surface) noexcept
        : instance_(instance), surface_(surface) {}
    WindowSurface(WindowSurface&& other) noexcept
        : instance_(other.instance_), surface_(std::exchange(other.surface_, VK_NULL_HANDLE)) {}
    WindowSurface& operator=(WindowSurface&& other) noexcept {
        std::swap(instance_, other.instance_);
        std::swap(surface_, other.surface_);
        return *this;
    }
    ~WindowSurface() {
        if (surface_ != VK_NULL_HANDLE) vkDestroySurfaceKHR(instance_, surface_, nullptr);
    }

    VkSurfaceKHR get() const noexcept { return surface_; }

private:
    VkInstance instance_ = VK_NULL_HANDLE;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
};

class Swapchain {
public:
    /// For `ring_slots` frames in flight; shows them one after another as the display refreshes (FIFO).
    /// Makes no images yet. `surface` must outlive it. Throws Error{no_device} where the device cannot
    /// show pictures there, or only in formats that hold no plain sRGB bytes.
    Swapchain(const DeviceContext& context, VkSurfaceKHR surface, std::uint32_t ring_slots);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// The next image, for the frame of ring slot `ring_slot`, whose last use must be done. Nothing
    /// where the window has no size now, or changed it this moment: draw again later. May wait for the
    /// display. Throws Error{no_device} when the surface is lost, Error{device_lost} when the device is,
    /// Error{too_large} where memory has run out.
    [[nodiscard]] bool acquire(std::uint32_t ring_slot, VkExtent2D window_size);

    /// Shows the acquired image when drawn() is signaled. Throws as acquire().
    void present();

    // Of the acquired image. Its content is undefined; present() wants PRESENT_SRC_KHR.
    VkImage image() const noexcept { return images_[current_].image; }
    VkImageView view() const noexcept { return images_[current_].view; }
    VkSemaphore acquired() const noexcept { return acquired_[ring_slot_]; }
    VkSemaphore drawn() const noexcept { return images_[current_].drawn; }

    VkFormat format() const noexcept { return format_; }
    VkExtent2D extent() const noexcept { return extent_; }
    /// How often images were made.
    std::uint32_t generation() const noexcept { return generation_; }

private:
    struct ShownImage {
        VkImage image = VK_NULL_HANDLE;
        OwnedImageView view;
        OwnedSemaphore drawn;
    };

    void remake(VkExtent2D window_size);
    void wait_until_unused() const noexcept;

    DeviceContext context_;
    VkSurfaceKHR surface_;
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    VkExtent2D extent_{};
    VkExtent2D window_size_{};  // For which extent_ was chosen.
    std::vector<OwnedSemaphore> acquired_;
    OwnedSwapchain swapchain_;
    std::vector<ShownImage> images_;
    std::uint32_t ring_slot_ = 0;
    std::uint32_t current_ = 0;
    std::uint32_t generation_ = 0;
    bool stale_ = true;
};

}  // namespace rimline
