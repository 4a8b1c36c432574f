#include "engine/vulkan/swapchain.h"

#include <algorithm>
#include <array>

#include "engine/vulkan/commands.h"
#include "engine/vulkan/debug_names.h"

namespace rimline {

namespace {

// VkSurfaceCapabilitiesKHR::currentExtent.width where the swapchain chooses the extent.
constexpr std::uint32_t k_any_extent = 0xffffffffu;

OwnedSemaphore make_semaphore(const DeviceContext& context) {
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    vk_check(context.vk->CreateSemaphore(context.device, &info, nullptr, &semaphore),
             "vkCreateSemaphore");
    set_name(*context.vk, VK_OBJECT_TYPE_SEMAPHORE, semaphore, "a picture of the window");
    return {context, semaphore};
}

// Pictures hold sRGB bytes already. A format that encodes again would brighten them.
VkFormat choose_format(const DeviceContext& context, VkSurfaceKHR surface) {
    const auto offered = enumerate<VkSurfaceFormatKHR>(
        [&](std::uint32_t* count, VkSurfaceFormatKHR* formats) {
            return context.vk->GetPhysicalDeviceSurfaceFormatsKHR(context.physical_device, surface,
                                                                  count, formats);
        },
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
    for (const VkFormat format : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
        if (std::ranges::any_of(offered, [format](const VkSurfaceFormatKHR& f) {
                return f.format == format && f.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR;
            }))
            return format;
    throw Error(ErrorCode::no_device,
                "the window takes no pictures of 8 bits a channel in sRGB: choose another device "
                "with --device");
}

// Into an image of the same format.
bool can_be_enlarged(const DeviceContext& context, VkFormat format) {
    constexpr VkFormatFeatureFlags k_enlarging = VK_FORMAT_FEATURE_BLIT_SRC_BIT |
                                                 VK_FORMAT_FEATURE_BLIT_DST_BIT |
                                                 VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    VkFormatProperties properties;
    context.vk->GetPhysicalDeviceFormatProperties(context.physical_device, format, &properties);
    return (properties.optimalTilingFeatures & k_enlarging) == k_enlarging;
}

}  // namespace

Swapchain::Swapchain(const DeviceContext& context, VkSurfaceKHR surface, std::uint32_t ring_slots)
    : context_(context), surface_(surface) {
    VkBool32 supported = VK_FALSE;
    if (context.features.swapchain)
        vk_check(context.vk->GetPhysicalDeviceSurfaceSupportKHR(
                     context.physical_device, context.queue_family, surface, &supported),
                 "vkGetPhysicalDeviceSurfaceSupportKHR");
    if (supported != VK_TRUE)
        throw Error(ErrorCode::no_device,
                    "the device cannot show pictures in this window: choose another with --device");
    format_ = choose_format(context, surface);
    for (std::uint32_t i = 0; i < ring_slots; ++i) acquired_.push_back(make_semaphore(context));
}

Swapchain::~Swapchain() { wait_until_unused(); }

// Presentation may use its image and semaphore until the queue is idle. A lost device uses nothing.
void Swapchain::wait_until_unused() const noexcept {
    (void)repeat_wait([&] {
        const QueueLock lock(context_);
        return context_.vk->QueueWaitIdle(context_.queue);
    });
}

VkSurfaceCapabilitiesKHR Swapchain::capabilities() const {
    VkSurfaceCapabilitiesKHR can;
    vk_check(context_.vk->GetPhysicalDeviceSurfaceCapabilitiesKHR(context_.physical_device,
                                                                  surface_, &can),
             "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    return can;
}

// Whether new images would be other than these. A surface may be suboptimal for ever, for a reason that new images do
// not change.
bool Swapchain::has_changed() const {
    const VkSurfaceCapabilitiesKHR can = capabilities();
    const bool has_extent = can.currentExtent.width != k_any_extent;
    return can.currentTransform != transform_ ||
           (has_extent && (can.currentExtent.width != extent_.width ||
                           can.currentExtent.height != extent_.height));
}

void Swapchain::remake(VkExtent2D window_size) {
    wait_until_unused();
    const VkSurfaceCapabilitiesKHR can = capabilities();
    extent_ = can.currentExtent;
    if (extent_.width == k_any_extent)
        extent_ = {
            std::clamp(window_size.width, can.minImageExtent.width, can.maxImageExtent.width),
            std::clamp(window_size.height, can.minImageExtent.height, can.maxImageExtent.height)};
    window_size_ = window_size;
    images_.clear();
    if (extent_.width == 0 || extent_.height == 0) {
        swapchain_ = {};
        return;
    }

    can_be_copied_to_ = (can.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT) != 0 &&
                        can_be_enlarged(context_, format_);
    can_be_copied_from_ = (can.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_SRC_BIT) != 0;
    const std::uint32_t most = can.maxImageCount == 0 ? ~0u : can.maxImageCount;
    const VkSwapchainCreateInfoKHR info{
        .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
        .surface = surface_,
        .minImageCount = std::min(can.minImageCount + 1, most),
        .imageFormat = format_,
        .imageColorSpace = VK_COLOR_SPACE_SRGB_NONLINEAR_KHR,
        .imageExtent = extent_,
        .imageArrayLayers = 1,
        // The transfer usage is for saving the window's picture.
        .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                      (can.supportedUsageFlags &
                       (VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT)),
        .imageSharingMode = VK_SHARING_MODE_EXCLUSIVE,
        .preTransform = can.currentTransform,
        // The lowest is opaque. Pictures have alpha 1: the others show the same.
        .compositeAlpha = static_cast<VkCompositeAlphaFlagBitsKHR>(can.supportedCompositeAlpha &
                                                                   -can.supportedCompositeAlpha),
        .presentMode = VK_PRESENT_MODE_FIFO_KHR,
        .clipped = VK_FALSE,
        .oldSwapchain = swapchain_};
    VkSwapchainKHR handle = VK_NULL_HANDLE;
    const VkResult made = context_.vk->CreateSwapchainKHR(context_.device, &info, nullptr, &handle);
    // Also if it failed: the old swapchain is retired and cannot be replaced a second time.
    swapchain_ = OwnedSwapchain(context_, handle);
    vk_check(made, "vkCreateSwapchainKHR");

    for (const VkImage image : enumerate<VkImage>(
             [&](std::uint32_t*count, VkImage*images) {
                 return context_.vk->GetSwapchainImagesKHR(context_.device, handle, count, images);
             },
             "vkGetSwapchainImagesKHR")) {
        const VkImageViewCreateInfo view{
            .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
            .image = image,
            .viewType = VK_IMAGE_VIEW_TYPE_2D,
            .format = format_,
            .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
        VkImageView view_handle = VK_NULL_HANDLE;
        vk_check(context_.vk->CreateImageView(context_.device, &view, nullptr, &view_handle),
                 "vkCreateImageView");
        set_name(*context_.vk, VK_OBJECT_TYPE_IMAGE, image, "a picture of the window");
        set_name(*context_.vk, VK_OBJECT_TYPE_IMAGE_VIEW, view_handle, "a picture of the window");
        images_.push_back({image, {context_, view_handle}, make_semaphore(context_)});
    }
    transform_ = can.currentTransform;
    stale_ = false;
    is_suboptimal_ = false;
}

bool Swapchain::acquire(std::uint32_t ring_slot, VkExtent2D window_size) {
    if (window_size.width == 0 || window_size.height == 0) return false;
    ring_slot_ = ring_slot;
    if (window_size.width != window_size_.width || window_size.height != window_size_.height)
        stale_ = true;
    if (!stale_ && is_suboptimal_) stale_ = has_changed();
    // A second attempt, if the images went out of date between the two calls.
    for (int attempt = 0; attempt < 2; ++attempt) {
        if (stale_ || images_.empty()) remake(window_size);
        if (images_.empty()) return false;
        const VkResult result =
            context_.vk->AcquireNextImageKHR(context_.device, swapchain_, UINT64_MAX,
                                             acquired_[ring_slot], VK_NULL_HANDLE, &current_);
        if (result == VK_SUCCESS) return true;
        if (result == VK_SUBOPTIMAL_KHR) {
            is_suboptimal_ = true;
            return true;  // Its semaphore will be signaled, so it must be drawn.
        }
        stale_ = true;
        if (result != VK_ERROR_OUT_OF_DATE_KHR) vk_check(result, "vkAcquireNextImageKHR");
    }
    return false;
}

void Swapchain::present() {
    const VkSwapchainKHR swapchain = swapchain_;
    const VkSemaphore wait = drawn();
    const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                                .waitSemaphoreCount = 1,
                                .pWaitSemaphores = &wait,
                                .swapchainCount = 1,
                                .pSwapchains = &swapchain,
                                .pImageIndices = &current_};
    const VkResult result = [&] {
        const QueueLock lock(context_);
        return context_.vk->QueuePresentKHR(context_.queue, &info);
    }();
    if (result == VK_SUBOPTIMAL_KHR)
        is_suboptimal_ = true;
    else if (result == VK_ERROR_OUT_OF_DATE_KHR)
        stale_ = true;
    else
        vk_check(result, "vkQueuePresentKHR");
}

}  // namespace rimline
