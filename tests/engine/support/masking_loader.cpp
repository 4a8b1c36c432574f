#include "tests/engine/support/masking_loader.h"

#include <algorithm>
#include <cstring>

#include "engine/vulkan/functions.h"

namespace rimline::tests {

namespace {

Mask current;
std::vector<std::string> opened;
VkInstance last_instance = VK_NULL_HANDLE;

template <typename Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(system_loader()(last_instance, name));
}

// Calls `change` for the structure of this type in a chain, if there is one.
template <typename Structure, typename Change>
void change_in(void* chain, VkStructureType type, Change&& change) {
    for (auto* at = static_cast<VkBaseOutStructure*>(chain); at; at = at->pNext)
        if (at->sType == type) change(*reinterpret_cast<Structure*>(at));
}

VKAPI_ATTR void VKAPI_CALL get_properties2(VkPhysicalDevice device,
                                           VkPhysicalDeviceProperties2* properties) {
    next<PFN_vkGetPhysicalDeviceProperties2>("vkGetPhysicalDeviceProperties2")(device, properties);
    change_in<VkPhysicalDeviceVulkan12Properties>(
        properties->pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES,
        [](VkPhysicalDeviceVulkan12Properties& v12) {
            if (!current.round_to_nearest) v12.shaderRoundingModeRTEFloat32 = VK_FALSE;
        });
}

// The budget is answered here: the driver need not know the structure, and is not shown it.
VKAPI_ATTR void VKAPI_CALL get_memory2(VkPhysicalDevice device,
                                       VkPhysicalDeviceMemoryProperties2* properties) {
    void* const chain = properties->pNext;
    if (current.budget_bytes) properties->pNext = nullptr;
    next<PFN_vkGetPhysicalDeviceMemoryProperties2>("vkGetPhysicalDeviceMemoryProperties2")(
        device, properties);
    properties->pNext = chain;
    if (current.budget_bytes)
        change_in<VkPhysicalDeviceMemoryBudgetPropertiesEXT>(
            chain, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT,
            [](VkPhysicalDeviceMemoryBudgetPropertiesEXT& budget) {
                std::ranges::fill(budget.heapBudget, *current.budget_bytes);
                std::ranges::fill(budget.heapUsage, VkDeviceSize{0});
            });
}

VKAPI_ATTR VkResult VKAPI_CALL get_surface_support(VkPhysicalDevice device, std::uint32_t family,
                                                   VkSurfaceKHR surface, VkBool32* supported) {
    if (!current.presents)
        return next<PFN_vkGetPhysicalDeviceSurfaceSupportKHR>(
            "vkGetPhysicalDeviceSurfaceSupportKHR")(device, family, surface, supported);
    *supported = *current.presents ? VK_TRUE : VK_FALSE;
    return VK_SUCCESS;
}

VKAPI_ATTR VkResult VKAPI_CALL get_extensions(VkPhysicalDevice device, const char* layer,
                                              std::uint32_t* count,
                                              VkExtensionProperties* extensions) {
    const auto get =
        next<PFN_vkEnumerateDeviceExtensionProperties>("vkEnumerateDeviceExtensionProperties");
    if (!current.budget_bytes || layer) return get(device, layer, count, extensions);
    std::uint32_t own = 0;
    get(device, layer, &own, nullptr);
    std::vector<VkExtensionProperties> all(own);
    get(device, layer, &own, all.data());
    all.push_back({VK_EXT_MEMORY_BUDGET_EXTENSION_NAME, 1});
    if (extensions) std::copy_n(all.begin(), std::min<std::size_t>(*count, all.size()), extensions);
    const bool is_complete = !extensions || *count >= all.size();
    *count = static_cast<std::uint32_t>(all.size());
    return is_complete ? VK_SUCCESS : VK_INCOMPLETE;
}

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical,
                                             const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator,
                                             VkDevice* device) {
    opened.assign(info->ppEnabledExtensionNames,
                  info->ppEnabledExtensionNames + info->enabledExtensionCount);
    VkDeviceCreateInfo without = *info;
    std::vector<const char*> names;
    for (const std::string& name : opened)
        if (name != VK_EXT_MEMORY_BUDGET_EXTENSION_NAME) names.push_back(name.c_str());
    without.enabledExtensionCount = static_cast<std::uint32_t>(names.size());
    without.ppEnabledExtensionNames = names.data();
    return next<PFN_vkCreateDevice>("vkCreateDevice")(physical, &without, allocator, device);
}

}  // namespace

Masked::Masked(const Mask& mask) { current = mask; }
Masked::~Masked() { current = {}; }
void Masked::set_budget(VkDeviceSize bytes) { current.budget_bytes = bytes; }
const std::vector<std::string>& Masked::opened_with() const { return opened; }

PFN_vkVoidFunction VKAPI_CALL masking_loader(VkInstance instance, const char* name) {
    const PFN_vkVoidFunction found = system_loader()(instance, name);
    if (instance != VK_NULL_HANDLE) last_instance = instance;
    const auto is = [name](const char* other) { return std::strcmp(name, other) == 0; };
    const auto replaced = [](auto* function) {
        return reinterpret_cast<PFN_vkVoidFunction>(function);
    };
    if (is("vkGetPhysicalDeviceProperties2")) return replaced(&get_properties2);
    if (is("vkGetPhysicalDeviceMemoryProperties2")) return replaced(&get_memory2);
    if (is("vkGetPhysicalDeviceSurfaceSupportKHR")) return replaced(&get_surface_support);
    if (is("vkEnumerateDeviceExtensionProperties")) return replaced(&get_extensions);
    if (is("vkCreateDevice")) return replaced(&create_device);
    return found;
}

}  // namespace rimline::tests
