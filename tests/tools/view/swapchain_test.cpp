// The images of a window under Xvfb, on surfaces that answer otherwise than Xvfb's.

#include "engine/vulkan/swapchain.h"

#include "engine/tested_device.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/image_barrier.h"
#include "tests/engine/support/changed_functions.h"
#include "tests/tools/view/shown_window.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

PFN_vkAcquireNextImageKHR acquire_image = nullptr;
PFN_vkCreateSwapchainKHR create_swapchain = nullptr;
PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR surface_capabilities = nullptr;
int made_swapchains = 0;
bool is_turned = false;
VkImageUsageFlags hidden_usages = 0;

VKAPI_ATTR VkResult VKAPI_CALL acquire_suboptimal(VkDevice device, VkSwapchainKHR swapchain,
                                                  std::uint64_t timeout, VkSemaphore semaphore,
                                                  VkFence fence, std::uint32_t* image) {
    const VkResult result = acquire_image(device, swapchain, timeout, semaphore, fence, image);
    return result == VK_SUCCESS ? VK_SUBOPTIMAL_KHR : result;
}

VKAPI_ATTR VkResult VKAPI_CALL count_swapchain(VkDevice device,
                                               const VkSwapchainCreateInfoKHR* info,
                                               const VkAllocationCallbacks* callbacks,
                                               VkSwapchainKHR* swapchain) {
    ++made_swapchains;
    VkSwapchainCreateInfoKHR possible = *info;
    possible.preTransform = VK_SURFACE_TRANSFORM_IDENTITY_BIT_KHR;
    return create_swapchain(device, &possible, callbacks, swapchain);
}

VKAPI_ATTR VkResult VKAPI_CALL other_capabilities(VkPhysicalDevice device, VkSurfaceKHR surface,
                                                  VkSurfaceCapabilitiesKHR* can) {
    const VkResult result = surface_capabilities(device, surface, can);
    if (is_turned) can->currentTransform = VK_SURFACE_TRANSFORM_ROTATE_180_BIT_KHR;
    can->supportedUsageFlags &= ~hidden_usages;
    return result;
}

// A window and its device, whose functions are those above.
class OtherSurface {
public:
    OtherSurface()
        : window_("test", tests::k_window_width, tests::k_window_height),
          instance_({.window_extensions = window_.vulkan_extensions()}),
          device_(instance_, tests::requested_device()),
          surface_(window_.make_surface(instance_)),
          context(tests::with_functions(
              device_.context(),
              [](DeviceFunctions& vk) {
                  acquire_image = std::exchange(vk.AcquireNextImageKHR, &acquire_suboptimal);
                  create_swapchain = std::exchange(vk.CreateSwapchainKHR, &count_swapchain);
                  surface_capabilities = std::exchange(vk.GetPhysicalDeviceSurfaceCapabilitiesKHR,
                                                       &other_capabilities);
              })),
          swapchain(context, surface_.get(), 1) {
        made_swapchains = 0;
        is_turned = false;
        hidden_usages = 0;
    }

    bool acquire() { return swapchain.acquire(0, {tests::k_window_width, tests::k_window_height}); }

    // An image without content.
    void show() {
        REQUIRE(acquire());
        const OwnedCommandPool pool = make_command_pool(context, "a test", context.queue_family);
        const Commands commands = begin_commands(context, make_commands(context, pool));
        const PictureTarget target{.image = swapchain.image()};
        record_barrier(commands, {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE},
                       {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE},
                       {{target, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR}});
        vk_check(commands->EndCommandBuffer(commands), "vkEndCommandBuffer");
        const OwnedFence fence = make_fence(context);
        submit_commands(context, {.queue = context.queue,
                                  .commands = commands,
                                  .waits = {{swapchain.acquired()}},
                                  .signal = swapchain.drawn(),
                                  .fence = fence});
        swapchain.present();
        wait_for_fence(context, fence);
    }

private:
    Window window_;
    VulkanInstance instance_;
    TestedDevice device_;
    WindowSurface surface_;

public:
    DeviceContext context;
    Swapchain swapchain;
};

}  // namespace

TEST_CASE("a surface that stays suboptimal keeps its images until it is another") {
    RIMLINE_OPEN_DISPLAY(display);
    OtherSurface surface;
    for (int frame = 0; frame < 5; ++frame) surface.show();
    CHECK(made_swapchains == 1);
    is_turned = true;
    for (int frame = 0; frame < 3; ++frame) surface.show();
    CHECK(made_swapchains == 2);
}

TEST_CASE("a window knows whether its images can be copied from") {
    RIMLINE_OPEN_DISPLAY(display);
    for (const bool can : {true, false}) {
        OtherSurface surface;
        CHECK_FALSE(surface.swapchain.can_be_copied_from());
        if (!can) hidden_usages = VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        surface.show();
        CHECK(surface.swapchain.can_be_copied_from() == can);
        CHECK(surface.swapchain.can_be_copied_to());
    }
}
