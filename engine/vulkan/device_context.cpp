#include "engine/vulkan/device_context.h"

#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory_blocks.h"
#include "silhouette/error.h"

namespace rimline {

VkSampleCountFlags common_samples(const VkPhysicalDeviceLimits& limits) noexcept {
    return limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts &
           limits.framebufferStencilSampleCounts;
}

void require_round_to_nearest(const DeviceContext& context, const std::string& what) {
    if (context.round_to_nearest_float32) return;
    throw Error(ErrorCode::no_device, what +
                                          " needs RoundingModeRTE for 32-bit floats in shaders "
                                          "(shaderRoundingModeRTEFloat32), which the device lacks");
}

DeviceContext make_device_context(const HostDevice& host) {
    RIMLINE_CHECK(host.instance != VK_NULL_HANDLE && host.physical_device != VK_NULL_HANDLE);
    RIMLINE_CHECK(host.device != VK_NULL_HANDLE);
    const InstanceFunctions instance =
        load_instance_functions(host.loader ? host.loader : system_loader(), host.instance);
    DeviceFunctions functions = load_device_functions(instance, host.device);
    // Layers give these to everybody.
    if (!host.features.debug_names) {
        functions.CmdBeginDebugUtilsLabelEXT = nullptr;
        functions.CmdEndDebugUtilsLabelEXT = nullptr;
        functions.SetDebugUtilsObjectNameEXT = nullptr;
    }
    DeviceContext context{.vk = std::make_shared<const DeviceFunctions>(functions),
                          .physical_device = host.physical_device,
                          .device = host.device,
                          .queue = host.queue,
                          .queue_family = host.queue_family,
                          .transfer_queue = host.queue,
                          .transfer_family = host.queue_family,
                          .queue_mutex = host.queue_mutex,
                          .pipeline_cache = host.pipeline_cache,
                          .features = host.features};
    VkPhysicalDeviceMemoryProperties2 memory{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2};
    instance.GetPhysicalDeviceMemoryProperties2(host.physical_device, &memory);
    context.memory = memory.memoryProperties;
    VkPhysicalDeviceMaintenance4Properties maintenance4{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES};
    VkPhysicalDeviceMaintenance3Properties maintenance3{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES,
        .pNext = &maintenance4};
    VkPhysicalDeviceVulkan12Properties v12{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES, .pNext = &maintenance3};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &v12};
    instance.GetPhysicalDeviceProperties2(host.physical_device, &properties);
    context.limits = properties.properties.limits;
    context.max_buffer_bytes = maintenance4.maxBufferSize;
    context.max_allocation_bytes = maintenance3.maxMemoryAllocationSize;
    // A caller's is not owned.
    context.allocator =
        host.allocator ? std::shared_ptr<MemoryAllocator>(host.allocator, [](MemoryAllocator*) {})
                       : std::make_shared<MemoryBlocks>(
                             context.vk, context.memory, context.max_allocation_bytes,
                             host.features.memory_budget ? host.physical_device : VK_NULL_HANDLE);
    context.independent_resolve_none = v12.independentResolveNone == VK_TRUE;
    context.type = properties.properties.deviceType;
    context.driver = v12.driverID;
    context.round_to_nearest_float32 = v12.shaderRoundingModeRTEFloat32 == VK_TRUE;
    context.sample_counts = common_samples(context.limits);
    return context;
}

}  // namespace rimline
