#pragma once

// The images of a window: a surface, and a swapchain that is made again when the window's size changes.
//
//     acquire --> record into image() --> submit: waits for acquired(), signals drawn() --> present
//
// An X11 swapchain may never report that its window was resized. So acquire() gets the window's size in every
// frame, and makes new images when the size has changed. A minimized window has size 0 and no images:
// acquire() returns false, and the caller waits until the window has a size again.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/vulkan_handle.h"
#include "engine/vulkan/vulkan_instance.h"

namespace rimline {

/// Owns a surface of a window system. The instance must outlive it.
class WindowSurface {
public:
    WindowSurface() = default;
    WindowSurface(const VulkanInstance& instance, VkSurfaceKHR surface) noexcept
        : instance_(&instance), surface_(surface) {}
    WindowSurface(WindowSurface&& other) noexcept
        : instance_(other.instance_), surface_(std::exchange(other.surface_, VK_NULL_HANDLE)) {}
    WindowSurface& operator=(WindowSurface&& other) noexcept {
        std::swap(instance_, other.instance_);
        std::swap(surface_, other.surface_);
        return *this;
    }
    ~WindowSurface() {
        if (surface_ != VK_NULL_HANDLE)
            instance_->functions().DestroySurfaceKHR(instance_->handle(), surface_, nullptr);
    }

    VkSurfaceKHR get() const noexcept { return surface_; }

private:
    const VulkanInstance* instance_ = nullptr;
    VkSurfaceKHR surface_ = VK_NULL_HANDLE;
};

class Swapchain {
public:
    /// For `ring_slots` frames in flight. Images are shown in order, one for each refresh of the display
    /// (FIFO). Makes no images yet. `surface` must outlive it. Throws Error{no_device} if the device cannot
    /// present to the surface, or only in formats that do not hold plain sRGB bytes.
    Swapchain(const DeviceContext& context, VkSurfaceKHR surface, std::uint32_t ring_slots);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    /// Acquires the next image, for the frame of `ring_slot`, whose last frame must be done. Returns false if
    /// the window has size 0 or is just changing its size; then try again later. May wait for the display.
    /// Throws Error{no_device} if the surface is lost, Error{device_lost} if the device is, and
    /// Error{too_large} if memory has run out.
    [[nodiscard]] bool acquire(std::uint32_t ring_slot, VkExtent2D window_size);

    /// Presents the acquired image after drawn() is signaled. Throws as acquire().
    void present();

    // The acquired image. Its content is undefined; for present() it must be in PRESENT_SRC_KHR.
    VkImage image() const noexcept { return images_[current_].image; }
    VkImageView view() const noexcept { return images_[current_].view; }
    VkSemaphore acquired() const noexcept { return acquired_[ring_slot_]; }
    VkSemaphore drawn() const noexcept { return images_[current_].drawn; }

    VkFormat format() const noexcept { return format_; }
    VkExtent2D extent() const noexcept { return extent_; }
    /// Whether smaller images can be enlarged into the images (vkCmdBlitImage, linear).
    bool can_be_copied_to() const noexcept { return can_be_copied_to_; }
    /// Whether the images can be copied from, as for saving the window's picture.
    bool can_be_copied_from() const noexcept { return can_be_copied_from_; }

private:
    struct ShownImage {
        VkImage image = VK_NULL_HANDLE;
        OwnedImageView view;
        OwnedSemaphore drawn;
    };

    VkSurfaceCapabilitiesKHR capabilities() const;
    bool has_changed() const;
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
    VkSurfaceTransformFlagBitsKHR transform_ = VK_SURFACE_TRANSFORM_IDENTITY_BIT_KHR;
    bool stale_ = true;  // The images must be made again.
    bool is_suboptimal_ = false;
    bool can_be_copied_to_ = false;
    bool can_be_copied_from_ = false;
};

}  // namespace rimline
