#include "engine/vulkan/device_context.h"

#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory_blocks.h"

namespace rimline {

VkSampleCountFlags common_samples(const VkPhysicalDeviceLimits& limits) noexcept {
    return limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts &
           limits.framebufferStencilSampleCounts;
}

DeviceContext make_device_context(const HostDevice& host) {
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
    VkPhysicalDeviceDepthStencilResolveProperties resolve{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DEPTH_STENCIL_RESOLVE_PROPERTIES,
        .pNext = &maintenance4};
    VkPhysicalDeviceMaintenance3Properties maintenance3{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES, .pNext = &resolve};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &maintenance3};
    instance.GetPhysicalDeviceProperties2(host.physical_device, &properties);
    context.limits = properties.properties.limits;
    context.max_buffer_bytes = maintenance4.maxBufferSize;
    context.max_allocation_bytes = maintenance3.maxMemoryAllocationSize;
    // A caller's is not owned.
    context.allocator =
        host.allocator ? std::shared_ptr<MemoryAllocator>(host.allocator, [](MemoryAllocator*) {})
                       : std::make_shared<MemoryBlocks>(context.vk, context.memory,
                                                        context.max_allocation_bytes);
    context.independent_resolve_none = resolve.independentResolveNone == VK_TRUE;
    context.type = properties.properties.deviceType;
    context.sample_counts = common_samples(context.limits);
    return context;
}

}  // namespace rimline
