#include "engine/vulkan/device.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "engine/vulkan/queue_choice.h"
#include "engine/vulkan/vulkan_handle.h"

namespace rimline {

namespace {

// The features that judge_device() requires, chained for a query or for vkCreateDevice.
struct FeatureChain {
    VkPhysicalDeviceVulkan13Features v13{.sType =
                                             VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features v12{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, .pNext = &v13};
    VkPhysicalDeviceFeatures2 v10{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                  .pNext = &v12};
    FeatureChain() = default;
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;
};

std::vector<VkPhysicalDevice> physical_devices(const VulkanInstance& instance) {
    return enumerate<VkPhysicalDevice>(
        [&](std::uint32_t* count, VkPhysicalDevice* devices) {
            const VkResult result = vkEnumeratePhysicalDevices(instance.handle(), count, devices);
            if (result != VK_ERROR_INITIALIZATION_FAILED) return result;
            // A loader without drivers returns this: the machine has no devices.
            *count = 0;
            return VK_SUCCESS;
        },
        "vkEnumeratePhysicalDevices");
}

std::optional<QueueChoice> queues_of(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    return choose_queues(std::span(families).first(count));
}

bool has_extension(VkPhysicalDevice device, std::string_view name) {
    const auto extensions = enumerate<VkExtensionProperties>(
        [&](std::uint32_t* count, VkExtensionProperties* properties) {
            return vkEnumerateDeviceExtensionProperties(device, nullptr, count, properties);
        },
        "vkEnumerateDeviceExtensionProperties");
    return std::ranges::any_of(extensions, [name](const VkExtensionProperties& extension) {
        return name == extension.extensionName;
    });
}

bool has_depth_stencil_format(VkPhysicalDevice device) {
    constexpr VkFormatFeatureFlags k_needed =
        VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    VkFormatProperties properties;
    vkGetPhysicalDeviceFormatProperties(device, k_depth_stencil_format, &properties);
    return (properties.optimalTilingFeatures & k_needed) == k_needed;
}

std::uint32_t common_samples(const VkPhysicalDeviceLimits& limits) {
    const VkSampleCountFlags counts = limits.framebufferColorSampleCounts &
                                      limits.framebufferDepthSampleCounts &
                                      limits.framebufferStencilSampleCounts;
    return (counts & VK_SAMPLE_COUNT_4_BIT) != 0   ? 4
           : (counts & VK_SAMPLE_COUNT_2_BIT) != 0 ? 2
                                                   : 1;
}

DeviceFacts describe(VkPhysicalDevice device) {
    VkPhysicalDeviceVulkan12Properties v12{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    vkGetPhysicalDeviceProperties(device, &properties.properties);
    DeviceFacts facts{.name = properties.properties.deviceName,
                      .driver = {},
                      .type = properties.properties.deviceType,
                      .api_version = properties.properties.apiVersion};
    // Older devices do not know the structures below. Their version is enough to refuse them.
    if (facts.api_version < VK_API_VERSION_1_3) return facts;

    properties.pNext = &v12;
    vkGetPhysicalDeviceProperties2(device, &properties);
    FeatureChain features;
    vkGetPhysicalDeviceFeatures2(device, &features.v10);
    facts.driver = std::string(v12.driverName) + " " + v12.driverInfo;
    facts.geometry_shader = features.v10.features.geometryShader == VK_TRUE;
    facts.occlusion_query_precise = features.v10.features.occlusionQueryPrecise == VK_TRUE;
    facts.depth_clamp = features.v10.features.depthClamp == VK_TRUE;
    facts.buffer_device_address = features.v12.bufferDeviceAddress == VK_TRUE;
    facts.scalar_block_layout = features.v12.scalarBlockLayout == VK_TRUE;
    facts.timeline_semaphore = features.v12.timelineSemaphore == VK_TRUE;
    facts.dynamic_rendering = features.v13.dynamicRendering == VK_TRUE;
    facts.synchronization2 = features.v13.synchronization2 == VK_TRUE;
    facts.maintenance4 = features.v13.maintenance4 == VK_TRUE;
    facts.swapchain = has_extension(device, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    facts.round_to_nearest_float32 = v12.shaderRoundingModeRTEFloat32 == VK_TRUE;
    facts.graphics_and_compute_queue = queues_of(device).has_value();
    facts.samples = common_samples(properties.properties.limits);
    facts.depth_stencil_format = has_depth_stencil_format(device);
    return facts;
}

}  // namespace

std::vector<DeviceFacts> describe_devices(const VulkanInstance& instance) {
    std::vector<DeviceFacts> facts;
    for (const VkPhysicalDevice device : physical_devices(instance))
        facts.push_back(describe(device));
    return facts;
}

DeviceContext make_device_context(VkPhysicalDevice physical_device, VkDevice device, VkQueue queue,
                                  std::uint32_t queue_family, const DeviceFeatures& features) {
    DeviceContext context{.physical_device = physical_device,
                          .device = device,
                          .queue = queue,
                          .queue_family = queue_family,
                          .transfer_queue = queue,
                          .transfer_family = queue_family,
                          .features = features};
    vkGetPhysicalDeviceMemoryProperties(physical_device, &context.memory);
    VkPhysicalDeviceMaintenance4Properties maintenance4{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES};
    VkPhysicalDeviceMaintenance3Properties maintenance3{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_3_PROPERTIES,
        .pNext = &maintenance4};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                           .pNext = &maintenance3};
    vkGetPhysicalDeviceProperties2(physical_device, &properties);
    context.limits = properties.properties.limits;
    context.max_buffer_bytes = maintenance4.maxBufferSize;
    context.max_allocation_bytes = maintenance3.maxMemoryAllocationSize;
    context.samples = common_samples(context.limits);
    return context;
}

Device::Device(const VulkanInstance& instance, const DeviceRequest& request) {
    const std::vector<DeviceFacts> all = describe_devices(instance);
    const DeviceChoice choice = choose_device(all, request);
    const VkPhysicalDevice physical = physical_devices(instance).at(choice.index);
    facts_ = all[choice.index];

    const QueueChoice queues = queues_of(physical).value();  // It was judged usable.
    const float priority = 1.0f;
    const auto one_queue = [&](std::uint32_t family) {
        return VkDeviceQueueCreateInfo{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                       .queueFamilyIndex = family,
                                       .queueCount = 1,
                                       .pQueuePriorities = &priority};
    };
    const std::array queue_infos{one_queue(queues.family), one_queue(queues.transfer_family)};
    FeatureChain features;
    features.v10.features.geometryShader = facts_.geometry_shader;
    features.v10.features.occlusionQueryPrecise = facts_.occlusion_query_precise;
    features.v10.features.depthClamp = VK_TRUE;
    features.v12.bufferDeviceAddress = VK_TRUE;
    features.v12.scalarBlockLayout = VK_TRUE;
    features.v12.timelineSemaphore = VK_TRUE;
    features.v13.dynamicRendering = VK_TRUE;
    features.v13.maintenance4 = VK_TRUE;  // glslang writes LocalSizeId.
    features.v13.synchronization2 = VK_TRUE;
    const bool presents = instance.presents() && facts_.swapchain;
    const char* const swapchain_extension = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    const VkDeviceCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = &features.v10,
        .queueCreateInfoCount = queues.transfer_family == queues.family ? 1u : 2u,
        .pQueueCreateInfos = queue_infos.data(),
        .enabledExtensionCount = presents ? 1u : 0u,
        .ppEnabledExtensionNames = &swapchain_extension};
    VkDevice device = VK_NULL_HANDLE;
    vk_check(vkCreateDevice(physical, &info, nullptr, &device), "vkCreateDevice");
    VkQueue queue = VK_NULL_HANDLE;
    vkGetDeviceQueue(device, queues.family, 0, &queue);
    context_ = make_device_context(physical, device, queue, queues.family,
                                   {.geometry_shader = facts_.geometry_shader,
                                    .swapchain = presents,
                                    .occlusion_query_precise = facts_.occlusion_query_precise});
    context_.transfer_family = queues.transfer_family;
    vkGetDeviceQueue(device, queues.transfer_family, 0, &context_.transfer_queue);
}

Device::~Device() {
    // A lost device runs nothing any more.
    (void)repeat_wait([&] { return vkDeviceWaitIdle(context_.device); });
    vkDestroyDevice(context_.device, nullptr);
}

}  // namespace rimline
