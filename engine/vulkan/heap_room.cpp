#include "engine/vulkan/heap_room.h"

namespace rimline {

std::vector<HeapRoom> heap_rooms(const InstanceFunctions& vk, VkPhysicalDevice device,
                                 bool has_budget) {
    VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT};
    VkPhysicalDeviceMemoryProperties2 properties{
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2,
        .pNext = has_budget ? &budget : nullptr};
    vk.GetPhysicalDeviceMemoryProperties2(device, &properties);
    const VkPhysicalDeviceMemoryProperties& memory = properties.memoryProperties;
    std::vector<HeapRoom> rooms;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        const VkMemoryHeap& heap = memory.memoryHeaps[i];
        rooms.push_back({.size_bytes = heap.size,
                         .budget_bytes = has_budget ? budget.heapBudget[i] : heap.size,
                         .used_bytes = has_budget ? budget.heapUsage[i] : 0,
                         .is_device_local = (heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0});
    }
    return rooms;
}

}  // namespace rimline
