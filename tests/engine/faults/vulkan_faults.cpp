#include "tests/engine/faults/vulkan_faults.h"

#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <utility>

// The hooks are functions of a namespace, named as what they hook.
#define RIMLINE_HOOK VKAPI_ATTR
#define RIMLINE_NEXT(name) next<PFN_##name>(#name)

namespace rimline::tests {

namespace {

// The loader exports every function that is hooked.
template <typename Function>
Function next(const char* name) {
    static void* const loader = dlopen("libvulkan.so.1", RTLD_NOW);
    void* const found = loader ? dlsym(loader, name) : nullptr;
    if (!found) std::abort();
    return reinterpret_cast<Function>(found);
}

thread_local bool keeping_books = false;

// Over the books, for one thread at a time.
class Books {
public:
    explicit Books(std::mutex& mutex) : lock_(mutex) { keeping_books = true; }
    ~Books() { keeping_books = false; }
    Books(const Books&) = delete;
    Books& operator=(const Books&) = delete;

private:
    std::lock_guard<std::mutex> lock_;
};

class Faults {
public:
    void arm(const Fault& fault) {
        const Books books(mutex_);
        fault_ = fault;
        report_ = {};
        count_ = 0;
        is_armed_ = true;
    }

    FaultReport disarm() {
        const Books books(mutex_);
        is_armed_ = false;
        return report_;
    }

    bool set_armed(bool armed) {
        const Books books(mutex_);
        return std::exchange(is_armed_, armed);
    }

    // What a call that allocates answers instead of being made, or VK_SUCCESS to be made.
    VkResult before(const char* call, std::initializer_list<VkResult> results) {
        const Books books(mutex_);
        if (!is_turn(FaultKind::failure, call)) {
            ++calls_[call];
            return VK_SUCCESS;
        }
        const VkResult result = results.begin()[fault_.result % results.size()];
        report_ = {true, call, result};
        return result;
    }

    // The same of a submit or a wait.
    VkResult before_queue(const char* call, VkDevice device) {
        {
            const Books books(mutex_);
            if (lost_.contains(device)) return VK_ERROR_DEVICE_LOST;
            if (!is_turn(FaultKind::lost_device, call)) return VK_SUCCESS;
            report_ = {true, call, VK_ERROR_DEVICE_LOST};
            lost_.insert(device);
        }
        // What a lost device was doing has ended.
        RIMLINE_NEXT(vkDeviceWaitIdle)(device);
        return VK_ERROR_DEVICE_LOST;
    }

    void made(const char* type, void* handle) {
        const Books books(mutex_);
        ++live_[{type, handle}];
    }

    void destroyed(const char* type, void* handle) {
        if (!handle) return;
        const Books books(mutex_);
        // Below zero: destroyed twice, or never made.
        if (--live_[{type, handle}] == 0) live_.erase({type, handle});
    }

    void device_destroyed(VkDevice device) {
        const Books books(mutex_);
        lost_.erase(device);
        std::erase_if(queues_, [&](const auto& entry) { return entry.second == device; });
    }

    void has_queue(VkDevice device, VkQueue queue) {
        const Books books(mutex_);
        queues_[queue] = device;
    }
    VkDevice device_of(VkQueue queue) {
        const Books books(mutex_);
        return queues_.at(queue);
    }

    std::uint64_t calls_of(const std::string& function) {
        const Books books(mutex_);
        return calls_[function];
    }
    void add_waits(std::uint64_t count) {
        const Books books(mutex_);
        semaphore_waits_ += count;
    }
    std::uint64_t semaphore_waits() {
        const Books books(mutex_);
        return semaphore_waits_;
    }

    std::vector<std::string> live() {
        const Books books(mutex_);
        std::vector<std::string> names;
        for (const auto& [object, count] : live_) {
            std::ostringstream name;
            name << object.first << ' ' << object.second;
            if (count != 1) name << " made " << count << " times more often than destroyed";
            names.push_back(name.str());
        }
        return names;
    }

private:
    bool is_turn(FaultKind kind, const char* call) {
        if (fault_.function && std::strcmp(fault_.function, call) != 0) return false;
        return is_armed_ && fault_.kind == kind && count_++ == fault_.call;
    }

    std::mutex mutex_;
    bool is_armed_ = false;
    Fault fault_;
    FaultReport report_;
    std::uint64_t count_ = 0;
    std::map<std::string, std::uint64_t> calls_;
    std::uint64_t semaphore_waits_ = 0;
    std::map<std::pair<std::string, void*>, int> live_;
    std::set<VkDevice> lost_;
    std::map<VkQueue, VkDevice> queues_;
};

// Never destroyed: drivers call back while the program ends.
Faults& faults() {
    static Faults* const all = new Faults;
    return *all;
}

// Makes an object with `make`, unless it is this call's turn to fail.
template <typename Handle, typename Make>
VkResult make_object(const char* call, const char* type, std::initializer_list<VkResult> results,
                     Handle* handles, std::uint32_t count, Make&& make) {
    const VkResult fault = faults().before(call, results);
    if (fault != VK_SUCCESS) {
        // As drivers leave it, or worse: nobody may look at it.
        for (std::uint32_t i = 0; i < count; ++i) handles[i] = VK_NULL_HANDLE;
        return fault;
    }
    const VkResult result = make();
    for (std::uint32_t i = 0; i < count && result == VK_SUCCESS; ++i)
        faults().made(type, reinterpret_cast<void*>(handles[i]));
    return result;
}

#define RIMLINE_NO_MEMORY VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY

VKAPI_ATTR VkResult VKAPI_CALL create_messenger(VkInstance instance,
                                                const VkDebugUtilsMessengerCreateInfoEXT* info,
                                                const VkAllocationCallbacks* allocator,
                                                VkDebugUtilsMessengerEXT* messenger) {
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        RIMLINE_NEXT(vkGetInstanceProcAddr)(instance, "vkCreateDebugUtilsMessengerEXT"));
    return make_object("vkCreateDebugUtilsMessengerEXT", "VkDebugUtilsMessengerEXT",
                       {VK_ERROR_OUT_OF_HOST_MEMORY}, messenger, 1,
                       [&] { return create(instance, info, allocator, messenger); });
}

VKAPI_ATTR void VKAPI_CALL destroy_messenger(VkInstance instance,
                                             VkDebugUtilsMessengerEXT messenger,
                                             const VkAllocationCallbacks* allocator) {
    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(RIMLINE_NEXT(vkGetInstanceProcAddr)(
        instance, "vkDestroyDebugUtilsMessengerEXT"))(instance, messenger, allocator);
    faults().destroyed("VkDebugUtilsMessengerEXT", reinterpret_cast<void*>(messenger));
}

namespace hooks {

// Objects of a device that are made from one structure each, and destroyed alone.
#define RIMLINE_OBJECT(Type, Info, ...)                                                     \
    RIMLINE_HOOK VkResult vkCreate##Type(VkDevice device, const Info* info,                 \
                                         const VkAllocationCallbacks* allocator,            \
                                         Vk##Type* object) {                                \
        return make_object(                                                                 \
            "vkCreate" #Type, "Vk" #Type, {RIMLINE_NO_MEMORY, ##__VA_ARGS__}, object, 1,    \
            [&] { return RIMLINE_NEXT(vkCreate##Type)(device, info, allocator, object); }); \
    }                                                                                       \
    RIMLINE_DESTROY(Type)
#define RIMLINE_DESTROY(Type)                                                   \
    RIMLINE_HOOK void vkDestroy##Type(VkDevice device, Vk##Type object,         \
                                      const VkAllocationCallbacks* allocator) { \
        RIMLINE_NEXT(vkDestroy##Type)(device, object, allocator);               \
        faults().destroyed("Vk" #Type, reinterpret_cast<void*>(object));        \
    }

RIMLINE_OBJECT(Buffer, VkBufferCreateInfo)
RIMLINE_OBJECT(BufferView, VkBufferViewCreateInfo)
RIMLINE_OBJECT(CommandPool, VkCommandPoolCreateInfo)
RIMLINE_OBJECT(DescriptorPool, VkDescriptorPoolCreateInfo, VK_ERROR_FRAGMENTATION)
RIMLINE_OBJECT(DescriptorSetLayout, VkDescriptorSetLayoutCreateInfo)
RIMLINE_OBJECT(Event, VkEventCreateInfo)
RIMLINE_OBJECT(Fence, VkFenceCreateInfo)
RIMLINE_OBJECT(Framebuffer, VkFramebufferCreateInfo)
RIMLINE_OBJECT(Image, VkImageCreateInfo)
RIMLINE_OBJECT(ImageView, VkImageViewCreateInfo)
RIMLINE_OBJECT(PipelineCache, VkPipelineCacheCreateInfo)
RIMLINE_OBJECT(PipelineLayout, VkPipelineLayoutCreateInfo)
RIMLINE_OBJECT(QueryPool, VkQueryPoolCreateInfo)
RIMLINE_OBJECT(RenderPass, VkRenderPassCreateInfo)
RIMLINE_OBJECT(Sampler, VkSamplerCreateInfo, VK_ERROR_TOO_MANY_OBJECTS)
RIMLINE_OBJECT(Semaphore, VkSemaphoreCreateInfo)
RIMLINE_OBJECT(ShaderModule, VkShaderModuleCreateInfo)
RIMLINE_OBJECT(SwapchainKHR, VkSwapchainCreateInfoKHR, VK_ERROR_SURFACE_LOST_KHR,
               VK_ERROR_INITIALIZATION_FAILED)
RIMLINE_DESTROY(Pipeline)

#define RIMLINE_PIPELINES(Kind)                                                             \
    RIMLINE_HOOK VkResult vkCreate##Kind##Pipelines(                                        \
        VkDevice device, VkPipelineCache cache, std::uint32_t count,                        \
        const Vk##Kind##PipelineCreateInfo* infos, const VkAllocationCallbacks* allocator,  \
        VkPipeline* pipelines) {                                                            \
        return make_object("vkCreate" #Kind "Pipelines", "VkPipeline", {RIMLINE_NO_MEMORY}, \
                           pipelines, count, [&] {                                          \
                               return RIMLINE_NEXT(vkCreate##Kind##Pipelines)(              \
                                   device, cache, count, infos, allocator, pipelines);      \
                           });                                                              \
    }
RIMLINE_PIPELINES(Graphics)
RIMLINE_PIPELINES(Compute)

RIMLINE_HOOK VkResult vkAllocateMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                       const VkAllocationCallbacks* allocator,
                                       VkDeviceMemory* memory) {
    return make_object(
        "vkAllocateMemory", "VkDeviceMemory", {RIMLINE_NO_MEMORY, VK_ERROR_TOO_MANY_OBJECTS},
        memory, 1, [&] { return RIMLINE_NEXT(vkAllocateMemory)(device, info, allocator, memory); });
}
RIMLINE_HOOK void vkFreeMemory(VkDevice device, VkDeviceMemory memory,
                               const VkAllocationCallbacks* allocator) {
    RIMLINE_NEXT(vkFreeMemory)(device, memory, allocator);
    faults().destroyed("VkDeviceMemory", reinterpret_cast<void*>(memory));
}

// Instances and devices.

RIMLINE_HOOK VkResult vkCreateInstance(const VkInstanceCreateInfo* info,
                                       const VkAllocationCallbacks* allocator,
                                       VkInstance* instance) {
    return make_object(
        "vkCreateInstance", "VkInstance",
        {RIMLINE_NO_MEMORY, VK_ERROR_INITIALIZATION_FAILED, VK_ERROR_LAYER_NOT_PRESENT,
         VK_ERROR_EXTENSION_NOT_PRESENT, VK_ERROR_INCOMPATIBLE_DRIVER},
        instance, 1, [&] { return RIMLINE_NEXT(vkCreateInstance)(info, allocator, instance); });
}
RIMLINE_HOOK void vkDestroyInstance(VkInstance instance, const VkAllocationCallbacks* allocator) {
    RIMLINE_NEXT(vkDestroyInstance)(instance, allocator);
    faults().destroyed("VkInstance", instance);
}
RIMLINE_HOOK VkResult vkCreateDevice(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                     const VkAllocationCallbacks* allocator, VkDevice* device) {
    return make_object(
        "vkCreateDevice", "VkDevice",
        {RIMLINE_NO_MEMORY, VK_ERROR_INITIALIZATION_FAILED, VK_ERROR_EXTENSION_NOT_PRESENT,
         VK_ERROR_FEATURE_NOT_PRESENT, VK_ERROR_TOO_MANY_OBJECTS, VK_ERROR_DEVICE_LOST},
        device, 1, [&] { return RIMLINE_NEXT(vkCreateDevice)(physical, info, allocator, device); });
}
RIMLINE_HOOK void vkDestroyDevice(VkDevice device, const VkAllocationCallbacks* allocator) {
    RIMLINE_NEXT(vkDestroyDevice)(device, allocator);
    faults().destroyed("VkDevice", device);
    faults().device_destroyed(device);
}
RIMLINE_HOOK void vkGetDeviceQueue(VkDevice device, std::uint32_t family, std::uint32_t index,
                                   VkQueue* queue) {
    RIMLINE_NEXT(vkGetDeviceQueue)(device, family, index, queue);
    faults().has_queue(device, *queue);
}
// Calls that make nothing and may yet fail. RIMLINE_CALL(function, results, parameters, arguments).
#define RIMLINE_CALL(function, results, parameters, arguments)                 \
    RIMLINE_HOOK VkResult function parameters {                                \
        const VkResult fault = faults().before(#function, {results});          \
        return fault != VK_SUCCESS ? fault : RIMLINE_NEXT(function) arguments; \
    }
#define RIMLINE_NO_HOST_MEMORY VK_ERROR_OUT_OF_HOST_MEMORY

RIMLINE_CALL(vkEnumerateInstanceVersion, RIMLINE_NO_HOST_MEMORY, (std::uint32_t * version),
             (version))
RIMLINE_CALL(vkEnumerateInstanceLayerProperties, RIMLINE_NO_MEMORY,
             (std::uint32_t * count, VkLayerProperties* layers), (count, layers))
RIMLINE_CALL(vkEnumeratePhysicalDevices, RIMLINE_NO_MEMORY,
             (VkInstance instance, std::uint32_t* count, VkPhysicalDevice* devices),
             (instance, count, devices))
RIMLINE_CALL(vkEnumerateDeviceExtensionProperties, RIMLINE_NO_MEMORY,
             (VkPhysicalDevice device, const char* layer, std::uint32_t* count,
              VkExtensionProperties* extensions),
             (device, layer, count, extensions))
RIMLINE_CALL(vkBindBufferMemory, RIMLINE_NO_MEMORY,
             (VkDevice device, VkBuffer buffer, VkDeviceMemory memory, VkDeviceSize offset),
             (device, buffer, memory, offset))
RIMLINE_CALL(vkBindImageMemory, RIMLINE_NO_MEMORY,
             (VkDevice device, VkImage image, VkDeviceMemory memory, VkDeviceSize offset),
             (device, image, memory, offset))
#define RIMLINE_MAPPING VK_ERROR_MEMORY_MAP_FAILED, RIMLINE_NO_MEMORY
RIMLINE_CALL(vkMapMemory, RIMLINE_MAPPING,
             (VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size,
              VkMemoryMapFlags flags, void** data),
             (device, memory, offset, size, flags, data))
RIMLINE_CALL(vkFlushMappedMemoryRanges, RIMLINE_NO_MEMORY,
             (VkDevice device, std::uint32_t count, const VkMappedMemoryRange* ranges),
             (device, count, ranges))
RIMLINE_CALL(vkInvalidateMappedMemoryRanges, RIMLINE_NO_MEMORY,
             (VkDevice device, std::uint32_t count, const VkMappedMemoryRange* ranges),
             (device, count, ranges))
RIMLINE_CALL(vkAllocateCommandBuffers, RIMLINE_NO_MEMORY,
             (VkDevice device, const VkCommandBufferAllocateInfo* info, VkCommandBuffer* buffers),
             (device, info, buffers))
#define RIMLINE_POOL VK_ERROR_OUT_OF_POOL_MEMORY, VK_ERROR_FRAGMENTED_POOL, RIMLINE_NO_MEMORY
RIMLINE_CALL(vkAllocateDescriptorSets, RIMLINE_POOL,
             (VkDevice device, const VkDescriptorSetAllocateInfo* info, VkDescriptorSet* sets),
             (device, info, sets))
RIMLINE_CALL(vkResetDescriptorPool, RIMLINE_NO_MEMORY,
             (VkDevice device, VkDescriptorPool pool, VkDescriptorPoolResetFlags flags),
             (device, pool, flags))
RIMLINE_CALL(vkBeginCommandBuffer, RIMLINE_NO_MEMORY,
             (VkCommandBuffer commands, const VkCommandBufferBeginInfo* info), (commands, info))
RIMLINE_CALL(vkEndCommandBuffer, RIMLINE_NO_MEMORY, (VkCommandBuffer commands), (commands))
RIMLINE_CALL(vkResetCommandBuffer, RIMLINE_NO_MEMORY,
             (VkCommandBuffer commands, VkCommandBufferResetFlags flags), (commands, flags))
RIMLINE_CALL(vkResetCommandPool, RIMLINE_NO_MEMORY,
             (VkDevice device, VkCommandPool pool, VkCommandPoolResetFlags flags),
             (device, pool, flags))
RIMLINE_CALL(vkResetFences, RIMLINE_NO_MEMORY,
             (VkDevice device, std::uint32_t count, const VkFence* fences), (device, count, fences))
RIMLINE_CALL(vkSignalSemaphore, RIMLINE_NO_MEMORY,
             (VkDevice device, const VkSemaphoreSignalInfo* info), (device, info))
#define RIMLINE_SURFACE VK_ERROR_SURFACE_LOST_KHR, RIMLINE_NO_MEMORY
RIMLINE_CALL(vkGetPhysicalDeviceSurfaceSupportKHR, RIMLINE_SURFACE,
             (VkPhysicalDevice device, std::uint32_t family, VkSurfaceKHR surface, VkBool32* is),
             (device, family, surface, is))
RIMLINE_CALL(vkGetPhysicalDeviceSurfaceCapabilitiesKHR, RIMLINE_SURFACE,
             (VkPhysicalDevice device, VkSurfaceKHR surface, VkSurfaceCapabilitiesKHR* is),
             (device, surface, is))
RIMLINE_CALL(vkGetPhysicalDeviceSurfaceFormatsKHR, RIMLINE_SURFACE,
             (VkPhysicalDevice device, VkSurfaceKHR surface, std::uint32_t* count,
              VkSurfaceFormatKHR* formats),
             (device, surface, count, formats))
RIMLINE_CALL(vkGetPhysicalDeviceSurfacePresentModesKHR, RIMLINE_SURFACE,
             (VkPhysicalDevice device, VkSurfaceKHR surface, std::uint32_t* count,
              VkPresentModeKHR* modes),
             (device, surface, count, modes))
RIMLINE_CALL(vkGetSwapchainImagesKHR, RIMLINE_NO_MEMORY,
             (VkDevice device, VkSwapchainKHR swapchain, std::uint32_t* count, VkImage* images),
             (device, swapchain, count, images))

// Submits and waits: they fail for want of memory, and with the device.
#define RIMLINE_QUEUE_CALL(function, device_expression, parameters, arguments)            \
    RIMLINE_HOOK VkResult function parameters {                                           \
        VkResult fault = faults().before_queue(#function, device_expression);             \
        if (fault == VK_SUCCESS) fault = faults().before(#function, {RIMLINE_NO_MEMORY}); \
        return fault != VK_SUCCESS ? fault : RIMLINE_NEXT(function) arguments;            \
    }
RIMLINE_QUEUE_CALL(vkQueueSubmit, faults().device_of(queue),
                   (VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos, VkFence fence),
                   (queue, count, infos, fence))
RIMLINE_HOOK VkResult vkQueueSubmit2(VkQueue queue, std::uint32_t count, const VkSubmitInfo2* infos,
                                     VkFence fence) {
    const bool is_empty = count == 1 && infos->commandBufferInfoCount == 0;
    VkResult fault = faults().before_queue(
        is_empty ? "vkQueueSubmit2 of nothing" : "vkQueueSubmit2", faults().device_of(queue));
    if (fault == VK_SUCCESS) fault = faults().before("vkQueueSubmit2", {RIMLINE_NO_MEMORY});
    if (fault != VK_SUCCESS) return fault;
    for (std::uint32_t i = 0; i < count; ++i) faults().add_waits(infos[i].waitSemaphoreInfoCount);
    return RIMLINE_NEXT(vkQueueSubmit2)(queue, count, infos, fence);
}
RIMLINE_QUEUE_CALL(vkQueueWaitIdle, faults().device_of(queue), (VkQueue queue), (queue))
RIMLINE_QUEUE_CALL(vkDeviceWaitIdle, device, (VkDevice device), (device))
RIMLINE_QUEUE_CALL(vkWaitSemaphores, device,
                   (VkDevice device, const VkSemaphoreWaitInfo* info, std::uint64_t timeout),
                   (device, info, timeout))
RIMLINE_QUEUE_CALL(vkGetSemaphoreCounterValue, device,
                   (VkDevice device, VkSemaphore semaphore, std::uint64_t* value),
                   (device, semaphore, value))
RIMLINE_QUEUE_CALL(vkWaitForFences, device,
                   (VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                    std::uint64_t timeout),
                   (device, count, fences, all, timeout))
RIMLINE_QUEUE_CALL(vkGetFenceStatus, device, (VkDevice device, VkFence fence), (device, fence))
RIMLINE_QUEUE_CALL(vkGetQueryPoolResults, device,
                   (VkDevice device, VkQueryPool pool, std::uint32_t first, std::uint32_t count,
                    std::size_t size, void* data, VkDeviceSize stride, VkQueryResultFlags flags),
                   (device, pool, first, count, size, data, stride, flags))
#define RIMLINE_SHOWING VK_ERROR_OUT_OF_DATE_KHR, VK_ERROR_SURFACE_LOST_KHR

// Showing pictures has answers of its own. One that is suboptimal was acquired; what is presented is
// taken, and its semaphore waited for, but for want of memory.
RIMLINE_HOOK VkResult vkAcquireNextImageKHR(VkDevice device, VkSwapchainKHR swapchain,
                                            std::uint64_t timeout, VkSemaphore semaphore,
                                            VkFence fence, std::uint32_t* index) {
    VkResult fault = faults().before_queue("vkAcquireNextImageKHR", device);
    if (fault == VK_SUCCESS)
        fault = faults().before("vkAcquireNextImageKHR",
                                {RIMLINE_SHOWING, VK_SUBOPTIMAL_KHR, RIMLINE_NO_MEMORY});
    if (fault < 0) return fault;
    const VkResult result =
        RIMLINE_NEXT(vkAcquireNextImageKHR)(device, swapchain, timeout, semaphore, fence, index);
    return result == VK_SUCCESS ? fault : result;
}
RIMLINE_HOOK VkResult vkQueuePresentKHR(VkQueue queue, const VkPresentInfoKHR* info) {
    VkResult fault = faults().before_queue("vkQueuePresentKHR", faults().device_of(queue));
    if (fault == VK_SUCCESS)
        fault = faults().before("vkQueuePresentKHR",
                                {RIMLINE_SHOWING, VK_SUBOPTIMAL_KHR, RIMLINE_NO_MEMORY});
    for (const VkResult not_taken : {VK_ERROR_DEVICE_LOST, RIMLINE_NO_MEMORY})
        if (fault == not_taken) return fault;
    const VkResult result = RIMLINE_NEXT(vkQueuePresentKHR)(queue, info);
    return fault == VK_SUCCESS ? result : fault;
}

}  // namespace hooks

PFN_vkVoidFunction hooked(const char* name) {
#define RIMLINE_HOOKED(function)           \
    if (std::strcmp(name, #function) == 0) \
    return reinterpret_cast<PFN_vkVoidFunction>(&hooks::function)
    RIMLINE_HOOKED(vkAcquireNextImageKHR);
    RIMLINE_HOOKED(vkAllocateCommandBuffers);
    RIMLINE_HOOKED(vkAllocateDescriptorSets);
    RIMLINE_HOOKED(vkAllocateMemory);
    RIMLINE_HOOKED(vkBeginCommandBuffer);
    RIMLINE_HOOKED(vkBindBufferMemory);
    RIMLINE_HOOKED(vkBindImageMemory);
    RIMLINE_HOOKED(vkCreateBuffer);
    RIMLINE_HOOKED(vkCreateBufferView);
    RIMLINE_HOOKED(vkCreateCommandPool);
    RIMLINE_HOOKED(vkCreateComputePipelines);
    RIMLINE_HOOKED(vkCreateDescriptorPool);
    RIMLINE_HOOKED(vkCreateDescriptorSetLayout);
    RIMLINE_HOOKED(vkCreateDevice);
    RIMLINE_HOOKED(vkCreateEvent);
    RIMLINE_HOOKED(vkCreateFence);
    RIMLINE_HOOKED(vkCreateFramebuffer);
    RIMLINE_HOOKED(vkCreateGraphicsPipelines);
    RIMLINE_HOOKED(vkCreateImage);
    RIMLINE_HOOKED(vkCreateImageView);
    RIMLINE_HOOKED(vkCreateInstance);
    RIMLINE_HOOKED(vkCreatePipelineCache);
    RIMLINE_HOOKED(vkCreatePipelineLayout);
    RIMLINE_HOOKED(vkCreateQueryPool);
    RIMLINE_HOOKED(vkCreateRenderPass);
    RIMLINE_HOOKED(vkCreateSampler);
    RIMLINE_HOOKED(vkCreateSemaphore);
    RIMLINE_HOOKED(vkCreateShaderModule);
    RIMLINE_HOOKED(vkCreateSwapchainKHR);
    RIMLINE_HOOKED(vkDestroyBuffer);
    RIMLINE_HOOKED(vkDestroyBufferView);
    RIMLINE_HOOKED(vkDestroyCommandPool);
    RIMLINE_HOOKED(vkDestroyDescriptorPool);
    RIMLINE_HOOKED(vkDestroyDescriptorSetLayout);
    RIMLINE_HOOKED(vkDestroyDevice);
    RIMLINE_HOOKED(vkDestroyEvent);
    RIMLINE_HOOKED(vkDestroyFence);
    RIMLINE_HOOKED(vkDestroyFramebuffer);
    RIMLINE_HOOKED(vkDestroyImage);
    RIMLINE_HOOKED(vkDestroyImageView);
    RIMLINE_HOOKED(vkDestroyInstance);
    RIMLINE_HOOKED(vkDestroyPipeline);
    RIMLINE_HOOKED(vkDestroyPipelineCache);
    RIMLINE_HOOKED(vkDestroyPipelineLayout);
    RIMLINE_HOOKED(vkDestroyQueryPool);
    RIMLINE_HOOKED(vkDestroyRenderPass);
    RIMLINE_HOOKED(vkDestroySampler);
    RIMLINE_HOOKED(vkDestroySemaphore);
    RIMLINE_HOOKED(vkDestroyShaderModule);
    RIMLINE_HOOKED(vkDestroySwapchainKHR);
    RIMLINE_HOOKED(vkDeviceWaitIdle);
    RIMLINE_HOOKED(vkEndCommandBuffer);
    RIMLINE_HOOKED(vkEnumerateDeviceExtensionProperties);
    RIMLINE_HOOKED(vkEnumerateInstanceLayerProperties);
    RIMLINE_HOOKED(vkEnumerateInstanceVersion);
    RIMLINE_HOOKED(vkEnumeratePhysicalDevices);
    RIMLINE_HOOKED(vkFlushMappedMemoryRanges);
    RIMLINE_HOOKED(vkFreeMemory);
    RIMLINE_HOOKED(vkGetDeviceQueue);
    RIMLINE_HOOKED(vkGetFenceStatus);
    RIMLINE_HOOKED(vkGetPhysicalDeviceSurfaceCapabilitiesKHR);
    RIMLINE_HOOKED(vkGetPhysicalDeviceSurfaceFormatsKHR);
    RIMLINE_HOOKED(vkGetPhysicalDeviceSurfacePresentModesKHR);
    RIMLINE_HOOKED(vkGetPhysicalDeviceSurfaceSupportKHR);
    RIMLINE_HOOKED(vkGetQueryPoolResults);
    RIMLINE_HOOKED(vkGetSemaphoreCounterValue);
    RIMLINE_HOOKED(vkGetSwapchainImagesKHR);
    RIMLINE_HOOKED(vkInvalidateMappedMemoryRanges);
    RIMLINE_HOOKED(vkMapMemory);
    RIMLINE_HOOKED(vkQueuePresentKHR);
    RIMLINE_HOOKED(vkQueueSubmit);
    RIMLINE_HOOKED(vkQueueSubmit2);
    RIMLINE_HOOKED(vkQueueWaitIdle);
    RIMLINE_HOOKED(vkResetCommandBuffer);
    RIMLINE_HOOKED(vkResetCommandPool);
    RIMLINE_HOOKED(vkResetDescriptorPool);
    RIMLINE_HOOKED(vkResetFences);
    RIMLINE_HOOKED(vkSignalSemaphore);
    RIMLINE_HOOKED(vkWaitForFences);
    RIMLINE_HOOKED(vkWaitSemaphores);
#undef RIMLINE_HOOKED
    // As the loader's trampolines, these take every device.
    if (std::strcmp(name, "vkCreateDebugUtilsMessengerEXT") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(&create_messenger);
    if (std::strcmp(name, "vkDestroyDebugUtilsMessengerEXT") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(&destroy_messenger);
    return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL get_device_function(VkDevice device, const char* name) {
    const PFN_vkVoidFunction found = RIMLINE_NEXT(vkGetDeviceProcAddr)(device, name);
    const PFN_vkVoidFunction hook = found ? hooked(name) : nullptr;
    return hook ? hook : found;
}

}  // namespace

void arm(const Fault& fault) { faults().arm(fault); }
FaultReport disarm() { return faults().disarm(); }
NoFaults::NoFaults() : was_armed_(faults().set_armed(false)) {}
NoFaults::~NoFaults() { faults().set_armed(was_armed_); }
std::vector<std::string> live_objects() { return faults().live(); }
std::uint64_t calls_of(const std::string& function) { return faults().calls_of(function); }
std::uint64_t semaphore_waits() { return faults().semaphore_waits(); }
bool is_keeping_books() noexcept { return keeping_books; }

PFN_vkVoidFunction VKAPI_CALL failing_loader(VkInstance instance, const char* name) {
    if (std::strcmp(name, "vkGetDeviceProcAddr") == 0)
        return reinterpret_cast<PFN_vkVoidFunction>(&get_device_function);
    const PFN_vkVoidFunction found = RIMLINE_NEXT(vkGetInstanceProcAddr)(instance, name);
    const PFN_vkVoidFunction hook = found ? hooked(name) : nullptr;
    return hook ? hook : found;
}

}  // namespace rimline::tests
