#pragma once

// What everything on a device needs of it: handles, functions, limits. Made by Device (device.h), or from a
// caller's handles.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <string>

namespace rimline {

struct DeviceFunctions;
class MemoryAllocator;

/// The format of every depth attachment. Reversed depth needs floats.
constexpr VkFormat k_depth_stencil_format = VK_FORMAT_D32_SFLOAT_S8_UINT;

/// Optional features, beyond those that judge_device() requires. Each is true only if it was enabled when the
/// device was opened. Passes choose their methods by it.
struct DeviceFeatures {
    bool geometry_shader = false;
    bool swapchain = false;  ///< Enabled only for an instance that presents.
    bool occlusion_query_precise = false;
    bool depth_bounds = false;  ///< Shadow volumes are counted at fewer samples (shadow_bounds.h).
    bool debug_names = false;   ///< The instance has enabled VK_EXT_debug_utils.
    bool memory_budget =
        false;  ///< VK_EXT_memory_budget: large allocations ask for the budget first.
    bool conditional_rendering =
        false;  ///< VK_EXT_conditional_rendering: PictureTarget::condition can be given.
};

/// A lock around every use of a caller's queues, for callers that use them on other threads too.
class QueueMutex {
public:
    virtual ~QueueMutex() = default;
    virtual void lock() = 0;
    virtual void unlock() = 0;
};

/// What passes need of a device, Rimline's or a caller's. The caller keeps all handles alive, and has enabled
/// what judge_device() requires: Vulkan 1.3 with depthClamp, bufferDeviceAddress, scalarBlockLayout,
/// timelineSemaphore, dynamicRendering, synchronization2 and maintenance4. Copies are equal; one of them must outlive
/// all objects of the device.
struct DeviceContext {
    /// Vulkan's functions for this device (functions.h).
    std::shared_ptr<const DeviceFunctions> vk;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;
    /// For copies into static buffers (uploads.h): a queue of another family, or the queue above.
    VkQueue transfer_queue = VK_NULL_HANDLE;
    std::uint32_t transfer_family = 0;
    QueueMutex* queue_mutex = nullptr;                ///< Held while work is submitted. Null: none.
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;  ///< Of all pipelines. Null: none.
    VkPhysicalDeviceMemoryProperties memory{};
    VkPhysicalDeviceLimits limits{};
    /// maxBufferSize and maxMemoryAllocationSize.
    VkDeviceSize max_buffer_bytes = ~VkDeviceSize{0};
    VkDeviceSize max_allocation_bytes = ~VkDeviceSize{0};
    DeviceFeatures features{};
    std::shared_ptr<MemoryAllocator> allocator;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    VkDriverId driver{};  ///< 0: unknown.
    /// Shaders may declare RoundingModeRTE for 32-bit floats. Only meshes that deform need it.
    bool round_to_nearest_float32 = false;
    VkSampleCountFlags sample_counts = VK_SAMPLE_COUNT_1_BIT;  ///< Of all attachments.
    /// Depth can be resolved without stencil (VkPhysicalDeviceDepthStencilResolveProperties).
    bool independent_resolve_none = false;
};

/// A caller's device, for make_device_context().
struct HostDevice {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    /// Used for everything. A caller with another queue for copies sets transfer_queue and transfer_family
    /// in the context.
    VkQueue queue = VK_NULL_HANDLE;
    std::uint32_t queue_family = 0;
    DeviceFeatures features{};  ///< Those that the caller has enabled.
    /// Must outlive the context. Null: the caller uses the queue on no other thread while Rimline submits
    /// (renderer.h says when it does).
    QueueMutex* queue_mutex = nullptr;
    /// Gives the memory of all buffers and images; must outlive the context. Null: Rimline's own blocks, which
    /// are freed with the last copy of the context: destroy the device after it.
    MemoryAllocator* allocator = nullptr;
    /// All pipelines are made with it; it must outlive the context. Null: none.
    VkPipelineCache pipeline_cache = VK_NULL_HANDLE;
    /// The vkGetInstanceProcAddr of the caller's loader, which gives the vkGetDeviceProcAddr that all
    /// functions come from. Null: the system's loader.
    PFN_vkGetInstanceProcAddr loader = nullptr;
};

/// The sample counts that color, depth and stencil share.
VkSampleCountFlags common_samples(const VkPhysicalDeviceLimits& limits) noexcept;

/// Throws Error{no_device} naming `what` if the device's shaders cannot declare RoundingModeRTE for 32-bit floats.
void require_round_to_nearest(const DeviceContext& context, const std::string& what);

/// Throws Error{no_device} naming a function that the loader or the device lacks.
DeviceContext make_device_context(const HostDevice& host);

}  // namespace rimline
