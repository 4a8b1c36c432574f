#include "engine/vulkan/device.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline_cache.h"
#include "engine/vulkan/queue_choice.h"
#include "engine/vulkan/vulkan_result.h"

namespace rimline {

namespace {

// The features that judge_device() requires, chained for a query or for vkCreateDevice; `conditional` is chained only
// where the device knows the extension.
struct FeatureChain {
    VkPhysicalDeviceConditionalRenderingFeaturesEXT conditional{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_CONDITIONAL_RENDERING_FEATURES_EXT};
    VkPhysicalDeviceVulkan13Features v13{.sType =
                                             VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features v12{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, .pNext = &v13};
    VkPhysicalDeviceFeatures2 v10{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                  .pNext = &v12};
    explicit FeatureChain(bool has_conditional) {
        if (has_conditional) v13.pNext = &conditional;
    }
    FeatureChain(const FeatureChain&) = delete;
    FeatureChain& operator=(const FeatureChain&) = delete;
};

std::vector<VkPhysicalDevice> physical_devices(const VulkanInstance& instance) {
    return enumerate<VkPhysicalDevice>(
        [&](std::uint32_t* count, VkPhysicalDevice* devices) {
            const VkResult result =
                instance.functions().EnumeratePhysicalDevices(instance.handle(), count, devices);
            if (result != VK_ERROR_INITIALIZATION_FAILED) return result;
            // A loader without drivers returns this: the machine has no devices.
            *count = 0;
            return VK_SUCCESS;
        },
        "vkEnumeratePhysicalDevices");
}

// Null surface: the queues need not present.
std::optional<QueueChoice> queues_of(const InstanceFunctions& vk, VkPhysicalDevice device,
                                     VkSurfaceKHR surface = VK_NULL_HANDLE) {
    std::uint32_t count = 0;
    vk.GetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.GetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    families.resize(count);
    if (surface == VK_NULL_HANDLE) return choose_queues(families);
    std::vector<VkBool32> presents(count, VK_FALSE);
    for (std::uint32_t family = 0; family < count; ++family)
        vk_check(vk.GetPhysicalDeviceSurfaceSupportKHR(device, family, surface, &presents[family]),
                 "vkGetPhysicalDeviceSurfaceSupportKHR");
    return choose_queues(families, presents);
}

bool has_extension(const InstanceFunctions& vk, VkPhysicalDevice device, std::string_view name) {
    const auto extensions = enumerate<VkExtensionProperties>(
        [&](std::uint32_t* count, VkExtensionProperties* properties) {
            return vk.EnumerateDeviceExtensionProperties(device, nullptr, count, properties);
        },
        "vkEnumerateDeviceExtensionProperties");
    return std::ranges::any_of(extensions, [name](const VkExtensionProperties& extension) {
        return name == extension.extensionName;
    });
}

bool has_depth_stencil_format(const InstanceFunctions& vk, VkPhysicalDevice device) {
    constexpr VkFormatFeatureFlags k_needed =
        VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    VkFormatProperties properties;
    vk.GetPhysicalDeviceFormatProperties(device, k_depth_stencil_format, &properties);
    return (properties.optimalTilingFeatures & k_needed) == k_needed;
}

DeviceFacts describe(const InstanceFunctions& vk, VkPhysicalDevice device, VkSurfaceKHR surface) {
    VkPhysicalDeviceVulkan12Properties v12{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES};
    VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
    vk.GetPhysicalDeviceProperties(device, &properties.properties);
    DeviceFacts facts{.name = properties.properties.deviceName,
                      .driver = {},
                      .type = properties.properties.deviceType,
                      .api_version = properties.properties.apiVersion};
    // Older devices do not know the structures below. Their version is enough to refuse them.
    if (facts.api_version < VK_API_VERSION_1_3) return facts;

    properties.pNext = &v12;
    vk.GetPhysicalDeviceProperties2(device, &properties);
    FeatureChain features(has_extension(vk, device, VK_EXT_CONDITIONAL_RENDERING_EXTENSION_NAME));
    vk.GetPhysicalDeviceFeatures2(device, &features.v10);
    facts.driver = std::string(v12.driverName) + " " + v12.driverInfo;
    facts.geometry_shader = features.v10.features.geometryShader == VK_TRUE;
    facts.occlusion_query_precise = features.v10.features.occlusionQueryPrecise == VK_TRUE;
    facts.depth_clamp = features.v10.features.depthClamp == VK_TRUE;
    facts.depth_bounds = features.v10.features.depthBounds == VK_TRUE;
    facts.buffer_device_address = features.v12.bufferDeviceAddress == VK_TRUE;
    facts.scalar_block_layout = features.v12.scalarBlockLayout == VK_TRUE;
    facts.timeline_semaphore = features.v12.timelineSemaphore == VK_TRUE;
    facts.dynamic_rendering = features.v13.dynamicRendering == VK_TRUE;
    facts.synchronization2 = features.v13.synchronization2 == VK_TRUE;
    facts.maintenance4 = features.v13.maintenance4 == VK_TRUE;
    facts.swapchain = has_extension(vk, device, VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (surface != VK_NULL_HANDLE)
        facts.shows_window = facts.swapchain && queues_of(vk, device, surface).has_value();
    facts.memory_budget = has_extension(vk, device, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    facts.conditional_rendering = features.conditional.conditionalRendering == VK_TRUE;
    facts.round_to_nearest_float32 = v12.shaderRoundingModeRTEFloat32 == VK_TRUE;
    facts.graphics_and_compute_queue = queues_of(vk, device).has_value();
    facts.depth_stencil_format = has_depth_stencil_format(vk, device);
    return facts;
}

}  // namespace

std::vector<DeviceFacts> describe_devices(const VulkanInstance& instance, VkSurfaceKHR surface) {
    std::vector<DeviceFacts> facts;
    for (const VkPhysicalDevice device : physical_devices(instance))
        facts.push_back(describe(instance.functions(), device, surface));
    return facts;
}

DeviceFacts describe_device(VkInstance instance, VkPhysicalDevice device,
                            PFN_vkGetInstanceProcAddr loader) {
    return describe(load_instance_functions(loader ? loader : system_loader(), instance), device,
                    VK_NULL_HANDLE);
}

Device::Device(const VulkanInstance& instance, const DeviceRequest& request,
               const std::filesystem::path& cache_folder, VkSurfaceKHR surface) {
    const std::vector<DeviceFacts> all = describe_devices(instance, surface);
    const DeviceChoice choice = choose_device(all, request);
    const VkPhysicalDevice physical = physical_devices(instance).at(choice.index);
    facts_ = all[choice.index];

    const QueueChoice queues =
        queues_of(instance.functions(), physical, surface).value();  // It was judged usable.
    const float priority = 1.0f;
    const auto one_queue = [&](std::uint32_t family) {
        return VkDeviceQueueCreateInfo{.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                       .queueFamilyIndex = family,
                                       .queueCount = 1,
                                       .pQueuePriorities = &priority};
    };
    const std::array queue_infos{one_queue(queues.family), one_queue(queues.transfer_family)};
    FeatureChain features(facts_.conditional_rendering);
    features.conditional.conditionalRendering = facts_.conditional_rendering;
    features.v10.features.geometryShader = facts_.geometry_shader;
    features.v10.features.occlusionQueryPrecise = facts_.occlusion_query_precise;
    features.v10.features.depthClamp = VK_TRUE;
    features.v10.features.depthBounds = facts_.depth_bounds;
    features.v12.bufferDeviceAddress = VK_TRUE;
    features.v12.scalarBlockLayout = VK_TRUE;
    features.v12.timelineSemaphore = VK_TRUE;
    features.v13.dynamicRendering = VK_TRUE;
    features.v13.maintenance4 = VK_TRUE;  // glslang writes LocalSizeId.
    features.v13.synchronization2 = VK_TRUE;
    const bool presents = instance.presents() && facts_.swapchain;
    std::vector<const char*> extensions;
    if (presents) extensions.push_back(VK_KHR_SWAPCHAIN_EXTENSION_NAME);
    if (facts_.memory_budget) extensions.push_back(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    if (facts_.conditional_rendering)
        extensions.push_back(VK_EXT_CONDITIONAL_RENDERING_EXTENSION_NAME);
    // A device that has it must be opened with it. Its name is in a header for beta extensions.
    constexpr const char* k_portability_subset = "VK_KHR_portability_subset";
    if (has_extension(instance.functions(), physical, k_portability_subset))
        extensions.push_back(k_portability_subset);
    const VkDeviceCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = &features.v10,
        .queueCreateInfoCount = queues.transfer_family == queues.family ? 1u : 2u,
        .pQueueCreateInfos = queue_infos.data(),
        .enabledExtensionCount = static_cast<std::uint32_t>(extensions.size()),
        .ppEnabledExtensionNames = extensions.data()};
    VkDevice device = VK_NULL_HANDLE;
    vk_check(instance.functions().CreateDevice(physical, &info, nullptr, &device),
             "vkCreateDevice");
    try {
        open_queues(instance, device, physical, queues, presents);
        if (!cache_folder.empty()) {
            pipeline_cache_ = std::make_unique<PipelineCache>(context_, cache_folder);
            context_.pipeline_cache = pipeline_cache_->handle();
        }
    } catch (...) {
        context_ = {};
        reinterpret_cast<PFN_vkDestroyDevice>(
            instance.functions().GetDeviceProcAddr(device, "vkDestroyDevice"))(device, nullptr);
        throw;
    }
}

void Device::open_queues(const VulkanInstance& instance, VkDevice device, VkPhysicalDevice physical,
                         const QueueChoice& queues, bool presents) {
    context_ =
        make_device_context({.instance = instance.handle(),
                             .physical_device = physical,
                             .device = device,
                             .queue_family = queues.family,
                             .features = {.geometry_shader = facts_.geometry_shader,
                                          .swapchain = presents,
                                          .occlusion_query_precise = facts_.occlusion_query_precise,
                                          .depth_bounds = facts_.depth_bounds,
                                          .debug_names = instance.has_debug_utils(),
                                          .memory_budget = facts_.memory_budget,
                                          .conditional_rendering = facts_.conditional_rendering},
                             .loader = instance.loader()});
    context_.vk->GetDeviceQueue(device, queues.family, 0, &context_.queue);
    context_.transfer_family = queues.transfer_family;
    context_.vk->GetDeviceQueue(device, queues.transfer_family, 0, &context_.transfer_queue);
}

Device::~Device() {
    // A lost device runs nothing any more.
    (void)repeat_wait([&] { return context_.vk->DeviceWaitIdle(context_.device); });
    pipeline_cache_.reset();
    context_.allocator.reset();
    context_.vk->DestroyDevice(context_.device, nullptr);
}

}  // namespace rimline
