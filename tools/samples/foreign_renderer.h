#pragma once

// The existing renderer of embedding.cpp: a minimal one in plain Vulkan, with one frame at a time, a buffer
// that the host reads, and a compute pipeline. It does not use Rimline. It links the loader, or, with
// SAMPLE_WITH_VOLK, loads it with volk.

#ifdef SAMPLE_WITH_VOLK
#define VOLK_IMPLEMENTATION
#include <volk.h>
#else
#include <vulkan/vulkan.h>
#endif

#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

namespace samples {

inline void require(VkResult result) {
    if (result < 0) throw std::runtime_error("Vulkan failed with " + std::to_string(result));
}

struct ForeignRenderer {
    static constexpr VkFormat k_format = VK_FORMAT_B8G8R8A8_SRGB;
    static constexpr VkExtent2D k_extent{320, 240};

    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;  // Of family 0.
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;

    ForeignRenderer() {
        make_device();
        make_image();
        make_commands();
    }
    ~ForeignRenderer() {
        if (device != VK_NULL_HANDLE) {
            vkDestroyFence(device, done_, nullptr);
            vkDestroyCommandPool(device, pool_, nullptr);
            vkDestroyImageView(device, view, nullptr);
            vkDestroyImage(device, image, nullptr);
            vkFreeMemory(device, memory, nullptr);
            vkDestroyDevice(device, nullptr);
        }
        if (instance != VK_NULL_HANDLE) vkDestroyInstance(instance, nullptr);
    }
    ForeignRenderer(const ForeignRenderer&) = delete;
    ForeignRenderer& operator=(const ForeignRenderer&) = delete;

    VkCommandBuffer begin_frame() {
        const VkCommandBufferBeginInfo info{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        require(vkBeginCommandBuffer(commands_, &info));
        return commands_;
    }

    /// Submits, to begin when `timeline` has reached `value`, and waits until the host can read the results
    /// of shaders.
    void end_frame(VkSemaphore timeline, std::uint64_t value) {
        const VkMemoryBarrier to_host{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
                                      .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT,
                                      .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
        vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT,
                             VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0, nullptr, 0, nullptr);
        require(vkEndCommandBuffer(commands_));
        const VkTimelineSemaphoreSubmitInfo values{
            .sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO,
            .waitSemaphoreValueCount = 1,
            .pWaitSemaphoreValues = &value};
        const VkPipelineStageFlags stages = VK_PIPELINE_STAGE_ALL_COMMANDS_BIT;
        const VkSubmitInfo submit{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                                  .pNext = &values,
                                  .waitSemaphoreCount = 1,
                                  .pWaitSemaphores = &timeline,
                                  .pWaitDstStageMask = &stages,
                                  .commandBufferCount = 1,
                                  .pCommandBuffers = &commands_};
        require(vkQueueSubmit(queue, 1, &submit, done_));
        require(vkWaitForFences(device, 1, &done_, VK_TRUE, ~0ull));
        require(vkResetFences(device, 1, &done_));
    }

private:
    void make_device() {
#ifdef SAMPLE_WITH_VOLK
        require(volkInitialize());
#endif
        const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                            .apiVersion = VK_API_VERSION_1_3};
        const VkInstanceCreateInfo instance_info{.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                                 .pApplicationInfo = &application};
        require(vkCreateInstance(&instance_info, nullptr, &instance));
#ifdef SAMPLE_WITH_VOLK
        volkLoadInstance(instance);
#endif
        std::uint32_t one = 1;
        require(vkEnumeratePhysicalDevices(instance, &one, &physical_device));
        if (one == 0) throw std::runtime_error("there is no Vulkan device");
        // The features that judge_device() requires. Call it if the device is not known to have them.
        VkPhysicalDeviceVulkan13Features v13{
            .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
            .synchronization2 = VK_TRUE,
            .dynamicRendering = VK_TRUE,
            .maintenance4 = VK_TRUE};
        VkPhysicalDeviceVulkan12Features v12{
            .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
            .pNext = &v13,
            .scalarBlockLayout = VK_TRUE,
            .timelineSemaphore = VK_TRUE,
            .bufferDeviceAddress = VK_TRUE};
        const VkPhysicalDeviceFeatures v10{.geometryShader = VK_TRUE, .depthClamp = VK_TRUE};
        const float priority = 1.0f;
        const VkDeviceQueueCreateInfo queue_info{
            .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
            .queueCount = 1,  // Family 0 supports graphics and compute on every desktop driver.
            .pQueuePriorities = &priority};
        const VkDeviceCreateInfo info{.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                      .pNext = &v12,
                                      .queueCreateInfoCount = 1,
                                      .pQueueCreateInfos = &queue_info,
                                      .pEnabledFeatures = &v10};
        require(vkCreateDevice(physical_device, &info, nullptr, &device));
#ifdef SAMPLE_WITH_VOLK
        volkLoadDevice(device);
#endif
        vkGetDeviceQueue(device, 0, 0, &queue);
    }

    void make_image() {
        const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                     .imageType = VK_IMAGE_TYPE_2D,
                                     .format = k_format,
                                     .extent = {k_extent.width, k_extent.height, 1},
                                     .mipLevels = 1,
                                     .arrayLayers = 1,
                                     .samples = VK_SAMPLE_COUNT_1_BIT,
                                     .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT};
        require(vkCreateImage(device, &info, nullptr, &image));
        VkMemoryRequirements requirements;
        vkGetImageMemoryRequirements(device, image, &requirements);
        std::uint32_t type = 0;
        while ((requirements.memoryTypeBits >> type & 1u) == 0) ++type;
        const VkMemoryAllocateInfo memory_info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                               .allocationSize = requirements.size,
                                               .memoryTypeIndex = type};
        require(vkAllocateMemory(device, &memory_info, nullptr, &memory));
        require(vkBindImageMemory(device, image, memory, 0));
        const VkImageViewCreateInfo view_info{
            .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
            .image = image,
            .viewType = VK_IMAGE_VIEW_TYPE_2D,
            .format = k_format,
            .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
        require(vkCreateImageView(device, &view_info, nullptr, &view));
    }

    void make_commands() {
        const VkCommandPoolCreateInfo pool_info{
            .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
            .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT};
        require(vkCreateCommandPool(device, &pool_info, nullptr, &pool_));
        const VkCommandBufferAllocateInfo info{
            .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
            .commandPool = pool_,
            .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
            .commandBufferCount = 1};
        require(vkAllocateCommandBuffers(device, &info, &commands_));
        const VkFenceCreateInfo fence_info{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        require(vkCreateFence(device, &fence_info, nullptr, &done_));
    }

    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    VkFence done_ = VK_NULL_HANDLE;
};

/// One `Content` that shaders reach by address and the host sees.
template <typename Content>
class SharedBuffer {
public:
    explicit SharedBuffer(const ForeignRenderer& renderer) : device_(renderer.device) {
        const VkBufferCreateInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
                                      .size = sizeof(Content),
                                      .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                               VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT};
        require(vkCreateBuffer(device_, &info, nullptr, &buffer_));
        VkMemoryRequirements requirements;
        vkGetBufferMemoryRequirements(device_, buffer_, &requirements);
        const VkMemoryAllocateFlagsInfo flags{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                              .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
        const VkMemoryAllocateInfo memory_info{
            .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
            .pNext = &flags,
            .allocationSize = requirements.size,
            .memoryTypeIndex = host_type(renderer, requirements.memoryTypeBits)};
        require(vkAllocateMemory(device_, &memory_info, nullptr, &memory_));
        require(vkBindBufferMemory(device_, buffer_, memory_, 0));
        void* mapped = nullptr;
        require(vkMapMemory(device_, memory_, 0, VK_WHOLE_SIZE, 0, &mapped));
        content_ = new (mapped) Content{};
    }
    ~SharedBuffer() {
        vkDestroyBuffer(device_, buffer_, nullptr);
        vkFreeMemory(device_, memory_, nullptr);
    }
    SharedBuffer(const SharedBuffer&) = delete;
    SharedBuffer& operator=(const SharedBuffer&) = delete;

    Content& content() const { return *content_; }
    VkDeviceAddress address() const {
        const VkBufferDeviceAddressInfo info{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                             .buffer = buffer_};
        return vkGetBufferDeviceAddress(device_, &info);
    }

private:
    static std::uint32_t host_type(const ForeignRenderer& renderer, std::uint32_t allowed) {
        constexpr VkMemoryPropertyFlags k_needed =
            VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        VkPhysicalDeviceMemoryProperties memory;
        vkGetPhysicalDeviceMemoryProperties(renderer.physical_device, &memory);
        for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type)
            if ((allowed >> type & 1u) != 0 &&
                (memory.memoryTypes[type].propertyFlags & k_needed) == k_needed)
                return type;
        throw std::runtime_error("no memory that the host sees");
    }

    VkDevice device_;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    Content* content_ = nullptr;
};

/// A compute shader with push constants.
class ComputePipeline {
public:
    ComputePipeline(const ForeignRenderer& renderer, std::span<const std::uint32_t> code,
                    std::uint32_t constant_bytes)
        : device_(renderer.device) {
        const VkPushConstantRange constants{VK_SHADER_STAGE_COMPUTE_BIT, 0, constant_bytes};
        const VkPipelineLayoutCreateInfo layout_info{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
            .pushConstantRangeCount = 1,
            .pPushConstantRanges = &constants};
        require(vkCreatePipelineLayout(device_, &layout_info, nullptr, &layout_));
        const VkShaderModuleCreateInfo module_info{
            .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
            .codeSize = code.size_bytes(),
            .pCode = code.data()};
        require(vkCreateShaderModule(device_, &module_info, nullptr, &module_));
        const VkComputePipelineCreateInfo info{
            .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
            .stage = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                      .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                      .module = module_,
                      .pName = "main"},
            .layout = layout_};
        require(vkCreateComputePipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_));
    }
    ~ComputePipeline() {
        vkDestroyPipeline(device_, pipeline_, nullptr);
        vkDestroyShaderModule(device_, module_, nullptr);
        vkDestroyPipelineLayout(device_, layout_, nullptr);
    }
    ComputePipeline(const ComputePipeline&) = delete;
    ComputePipeline& operator=(const ComputePipeline&) = delete;

    void dispatch(VkCommandBuffer commands, std::uint32_t groups, const void* constants,
                  std::uint32_t constant_bytes) const {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
        vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, constant_bytes,
                           constants);
        vkCmdDispatch(commands, groups, 1, 1);
    }

private:
    VkDevice device_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkShaderModule module_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace samples
