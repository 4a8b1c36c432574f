#pragma once

// Vulkan's functions, as pointers that were read from a loader. The library links no loader: a program that
// defines Vulkan's names as variables, as volk does, can use it, and a program without a loader starts.
//
//     context.vk->CreateBuffer(context.device, &info, nullptr, &buffer);
//
// Members are named as in the specification, without the prefix.

#include <vulkan/vulkan.h>

// Functions that need no instance.
#define RIMLINE_GLOBAL_FUNCTIONS(X)         \
    X(CreateInstance)                       \
    X(EnumerateInstanceExtensionProperties) \
    X(EnumerateInstanceLayerProperties)     \
    X(EnumerateInstanceVersion)

#define RIMLINE_INSTANCE_FUNCTIONS(X)     \
    X(CreateDevice)                       \
    X(DestroyInstance)                    \
    X(EnumerateDeviceExtensionProperties) \
    X(EnumeratePhysicalDevices)           \
    X(GetDeviceProcAddr)                  \
    X(GetPhysicalDeviceFeatures2)         \
    X(GetPhysicalDeviceFormatProperties)  \
    X(GetPhysicalDeviceMemoryProperties2) \
    X(GetPhysicalDeviceProperties)        \
    X(GetPhysicalDeviceProperties2)       \
    X(GetPhysicalDeviceQueueFamilyProperties)

// Of extensions: null where the instance has not enabled them.
#define RIMLINE_INSTANCE_EXTENSION_FUNCTIONS(X) \
    X(CreateDebugUtilsMessengerEXT)             \
    X(DestroyDebugUtilsMessengerEXT)            \
    X(DestroySurfaceKHR)                        \
    X(GetPhysicalDeviceSurfaceCapabilitiesKHR)  \
    X(GetPhysicalDeviceSurfaceFormatsKHR)       \
    X(GetPhysicalDeviceSurfaceSupportKHR)

#define RIMLINE_DEVICE_FUNCTIONS(X) \
    X(AllocateCommandBuffers)       \
    X(AllocateDescriptorSets)       \
    X(AllocateMemory)               \
    X(BeginCommandBuffer)           \
    X(BindBufferMemory)             \
    X(BindImageMemory)              \
    X(CmdBeginQuery)                \
    X(CmdBeginRendering)            \
    X(CmdBindDescriptorSets)        \
    X(CmdBindIndexBuffer)           \
    X(CmdBindPipeline)              \
    X(CmdBlitImage)                 \
    X(CmdClearAttachments)          \
    X(CmdCopyBuffer)                \
    X(CmdCopyBufferToImage)         \
    X(CmdCopyImageToBuffer)         \
    X(CmdDispatch)                  \
    X(CmdDraw)                      \
    X(CmdDrawIndexed)               \
    X(CmdDrawIndirect)              \
    X(CmdEndQuery)                  \
    X(CmdEndRendering)              \
    X(CmdFillBuffer)                \
    X(CmdPipelineBarrier2)          \
    X(CmdPushConstants)             \
    X(CmdResetQueryPool)            \
    X(CmdSetCullMode)               \
    X(CmdSetDepthBounds)            \
    X(CmdSetScissor)                \
    X(CmdSetStencilOp)              \
    X(CmdSetViewport)               \
    X(CmdWriteTimestamp2)           \
    X(CreateBuffer)                 \
    X(CreateCommandPool)            \
    X(CreateComputePipelines)       \
    X(CreateDescriptorPool)         \
    X(CreateDescriptorSetLayout)    \
    X(CreateFence)                  \
    X(CreateGraphicsPipelines)      \
    X(CreateImage)                  \
    X(CreateImageView)              \
    X(CreatePipelineCache)          \
    X(CreatePipelineLayout)         \
    X(CreateQueryPool)              \
    X(CreateSampler)                \
    X(CreateSemaphore)              \
    X(CreateShaderModule)           \
    X(DestroyBuffer)                \
    X(DestroyCommandPool)           \
    X(DestroyDescriptorPool)        \
    X(DestroyDescriptorSetLayout)   \
    X(DestroyDevice)                \
    X(DestroyFence)                 \
    X(DestroyImage)                 \
    X(DestroyImageView)             \
    X(DestroyPipeline)              \
    X(DestroyPipelineCache)         \
    X(DestroyPipelineLayout)        \
    X(DestroyQueryPool)             \
    X(DestroySampler)               \
    X(DestroySemaphore)             \
    X(DestroyShaderModule)          \
    X(DeviceWaitIdle)               \
    X(EndCommandBuffer)             \
    X(FreeMemory)                   \
    X(GetBufferDeviceAddress)       \
    X(GetBufferMemoryRequirements)  \
    X(GetDeviceQueue)               \
    X(GetImageMemoryRequirements)   \
    X(GetPipelineCacheData)         \
    X(GetQueryPoolResults)          \
    X(GetSemaphoreCounterValue)     \
    X(MapMemory)                    \
    X(QueueSubmit2)                 \
    X(QueueWaitIdle)                \
    X(ResetCommandBuffer)           \
    X(ResetFences)                  \
    X(UpdateDescriptorSets)         \
    X(WaitForFences)                \
    X(WaitSemaphores)

// Of extensions: null where the device, or for names and labels the instance, has not enabled them.
#define RIMLINE_DEVICE_EXTENSION_FUNCTIONS(X) \
    X(AcquireNextImageKHR)                    \
    X(CmdBeginConditionalRenderingEXT)        \
    X(CmdBeginDebugUtilsLabelEXT)             \
    X(CmdEndConditionalRenderingEXT)          \
    X(CmdEndDebugUtilsLabelEXT)               \
    X(CreateSwapchainKHR)                     \
    X(DestroySwapchainKHR)                    \
    X(GetSwapchainImagesKHR)                  \
    X(QueuePresentKHR)                        \
    X(SetDebugUtilsObjectNameEXT)

namespace rimline {

#define RIMLINE_MEMBER(name) PFN_vk##name name = nullptr;

struct GlobalFunctions {
    PFN_vkGetInstanceProcAddr GetInstanceProcAddr = nullptr;
    RIMLINE_GLOBAL_FUNCTIONS(RIMLINE_MEMBER)
};

struct InstanceFunctions {
    RIMLINE_INSTANCE_FUNCTIONS(RIMLINE_MEMBER)
    RIMLINE_INSTANCE_EXTENSION_FUNCTIONS(RIMLINE_MEMBER)
};

/// Of a device, and of its instance.
struct DeviceFunctions : InstanceFunctions {
    VkDevice device = VK_NULL_HANDLE;  ///< Whose functions these are.
    RIMLINE_DEVICE_FUNCTIONS(RIMLINE_MEMBER)
    RIMLINE_DEVICE_EXTENSION_FUNCTIONS(RIMLINE_MEMBER)
};

#undef RIMLINE_MEMBER

/// The vkGetInstanceProcAddr of the system's loader, which is loaded by the first call and never again
/// unloaded. Throws Error{no_device} if there is no loader. Any thread.
PFN_vkGetInstanceProcAddr system_loader();

/// These throw Error{no_device} naming a function that is missing and must be there.
GlobalFunctions load_global_functions(PFN_vkGetInstanceProcAddr loader);
InstanceFunctions load_instance_functions(PFN_vkGetInstanceProcAddr loader, VkInstance instance);
DeviceFunctions load_device_functions(const InstanceFunctions& instance, VkDevice device);

/// A command buffer and the functions that record into it:
///
///     commands->CmdDraw(commands, 3, 1, 0, 0);
class Commands {
public:
    Commands(const DeviceFunctions& vk, VkCommandBuffer handle) noexcept
        : vk_(&vk), handle_(handle) {}

    const DeviceFunctions* operator->() const noexcept { return vk_; }
    operator VkCommandBuffer() const noexcept { return handle_; }

private:
    const DeviceFunctions* vk_;
    VkCommandBuffer handle_;
};

}  // namespace rimline
