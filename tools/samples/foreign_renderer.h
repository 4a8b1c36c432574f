#pragma once

// The existing renderer of embedding.cpp: a minimal one in plain Vulkan, with one frame at a time, a picture and
// its depth, a pipeline for surfaces, a compute pipeline, and buffers that the host reads. It does not use
// Rimline. It links the loader, or, with SAMPLE_WITH_VOLK, loads it with volk.

#ifdef SAMPLE_WITH_VOLK
#define VOLK_IMPLEMENTATION
#include <volk.h>
#else
#include <vulkan/vulkan.h>
#endif

#include <array>
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
    static constexpr VkFormat k_depth_format = VK_FORMAT_D32_SFLOAT;  // 0 is near, 1 is far.
    static constexpr VkExtent2D k_extent{640, 480};

    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;  // Of family 0.
    struct Image {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        VkImage image = VK_NULL_HANDLE;
        VkImageView view = VK_NULL_HANDLE;
    };
    Image color, depth;

    ForeignRenderer() {
        make_device();
        make_image(color, k_format, VK_IMAGE_ASPECT_COLOR_BIT,
                   VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
        make_image(depth, k_depth_format, VK_IMAGE_ASPECT_DEPTH_BIT,
                   VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT);
        make_commands();
    }
    ~ForeignRenderer() {
        if (device != VK_NULL_HANDLE) {
            vkDestroyFence(device, done_, nullptr);
            vkDestroyCommandPool(device, pool_, nullptr);
            for (const Image& image : {color, depth}) {
                vkDestroyImageView(device, image.view, nullptr);
                vkDestroyImage(device, image.image, nullptr);
                vkFreeMemory(device, image.memory, nullptr);
            }
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

    /// Clears the picture to `sky`, for surfaces to be drawn in it.
    void begin_surfaces(const std::array<float, 4>& sky) const {
        move(color.image, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
             VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
        move(depth.image, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
             VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
        VkRenderingAttachmentInfo color_attachment{
            .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = color.view,
            .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .clearValue = {.color = {{sky[0], sky[1], sky[2], sky[3]}}}};
        VkRenderingAttachmentInfo depth_attachment = color_attachment;
        depth_attachment.imageView = depth.view;
        depth_attachment.imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL;
        depth_attachment.clearValue = {.depthStencil = {1.0f, 0}};
        const VkRect2D all{{0, 0}, k_extent};
        const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                   .renderArea = all,
                                   .layerCount = 1,
                                   .colorAttachmentCount = 1,
                                   .pColorAttachments = &color_attachment,
                                   .pDepthAttachment = &depth_attachment};
        vkCmdBeginRendering(commands_, &info);
        const VkViewport viewport{0.0f, 0.0f, float(k_extent.width), float(k_extent.height),
                                  0.0f, 1.0f};
        vkCmdSetViewport(commands_, 0, 1, &viewport);
        vkCmdSetScissor(commands_, 0, 1, &all);
    }

    /// Leaves the picture in COLOR_ATTACHMENT_OPTIMAL, and the depth in DEPTH_READ_ONLY_OPTIMAL.
    void end_surfaces() const {
        vkCmdEndRendering(commands_);
        move(depth.image, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
             VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
    }

    /// Copies the picture, which is in TRANSFER_SRC_OPTIMAL, to a buffer: blue, green, red, alpha.
    void copy_picture(VkBuffer pixels) const {
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {k_extent.width, k_extent.height, 1}};
        vkCmdCopyImageToBuffer(commands_, color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixels,
                               1, &region);
    }

    /// Submits, to begin when `timeline` has reached `value`, and waits until the host can read the results
    /// of shaders.
    void end_frame(VkSemaphore timeline, std::uint64_t value) {
        const VkMemoryBarrier to_host{
            .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER,
            .srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT,
            .dstAccessMask = VK_ACCESS_HOST_READ_BIT};
        vkCmdPipelineBarrier(commands_,
                             VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT,
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

    void move(VkImage image, VkImageAspectFlags aspects, VkImageLayout from,
              VkImageLayout to) const {
        const VkImageMemoryBarrier barrier{
            .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER,
            .srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT,
            .dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT,
            .oldLayout = from,
            .newLayout = to,
            .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
            .image = image,
            .subresourceRange = {aspects, 0, 1, 0, 1}};
        vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                             VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1,
                             &barrier);
    }

    void make_image(Image& made, VkFormat format, VkImageAspectFlags aspect,
                    VkImageUsageFlags usage) const {
        const VkImageCreateInfo info{.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                     .imageType = VK_IMAGE_TYPE_2D,
                                     .format = format,
                                     .extent = {k_extent.width, k_extent.height, 1},
                                     .mipLevels = 1,
                                     .arrayLayers = 1,
                                     .samples = VK_SAMPLE_COUNT_1_BIT,
                                     .usage = usage};
        require(vkCreateImage(device, &info, nullptr, &made.image));
        VkMemoryRequirements requirements;
        vkGetImageMemoryRequirements(device, made.image, &requirements);
        std::uint32_t type = 0;
        while ((requirements.memoryTypeBits >> type & 1u) == 0) ++type;
        const VkMemoryAllocateInfo memory_info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                               .allocationSize = requirements.size,
                                               .memoryTypeIndex = type};
        require(vkAllocateMemory(device, &memory_info, nullptr, &made.memory));
        require(vkBindImageMemory(device, made.image, made.memory, 0));
        const VkImageViewCreateInfo view_info{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                              .image = made.image,
                                              .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                              .format = format,
                                              .subresourceRange = {aspect, 0, 1, 0, 1}};
        require(vkCreateImageView(device, &view_info, nullptr, &made.view));
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
                                               VK_BUFFER_USAGE_TRANSFER_DST_BIT |
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
    VkBuffer handle() const { return buffer_; }
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

/// Triangles in one color (shaders/sample_surface.vert).
class SurfacePipeline {
public:
    struct Constants {
        std::array<float, 16> clip_from_world;  // By columns.
        std::array<float, 4> color;             // Linear.
        VkDeviceAddress corners;
    };

    SurfacePipeline(const ForeignRenderer& renderer, std::span<const std::uint32_t> vertex,
                    std::span<const std::uint32_t> fragment)
        : device_(renderer.device) {
        const VkPushConstantRange constants{k_stages, 0, sizeof(Constants)};
        const VkPipelineLayoutCreateInfo layout_info{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
            .pushConstantRangeCount = 1,
            .pPushConstantRanges = &constants};
        require(vkCreatePipelineLayout(device_, &layout_info, nullptr, &layout_));
        const std::array stages{
            stage_of(VK_SHADER_STAGE_VERTEX_BIT, modules_[0] = module_of(vertex)),
            stage_of(VK_SHADER_STAGE_FRAGMENT_BIT, modules_[1] = module_of(fragment))};
        const VkPipelineVertexInputStateCreateInfo no_vertices{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
        const VkPipelineInputAssemblyStateCreateInfo triangles{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
            .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
        const VkPipelineViewportStateCreateInfo viewport{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
            .viewportCount = 1,
            .scissorCount = 1};
        const VkPipelineRasterizationStateCreateInfo raster{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1.0f};
        const VkPipelineMultisampleStateCreateInfo one_sample{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
            .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
        const VkPipelineDepthStencilStateCreateInfo depth{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
            .depthTestEnable = VK_TRUE,
            .depthWriteEnable = VK_TRUE,
            .depthCompareOp = VK_COMPARE_OP_LESS};
        const VkPipelineColorBlendAttachmentState replace{.colorWriteMask = 0xf};
        const VkPipelineColorBlendStateCreateInfo blend{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
            .attachmentCount = 1,
            .pAttachments = &replace};
        const std::array dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
        const VkPipelineDynamicStateCreateInfo dynamic{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
            .dynamicStateCount = dynamic_states.size(),
            .pDynamicStates = dynamic_states.data()};
        const VkPipelineRenderingCreateInfo rendering{
            .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
            .colorAttachmentCount = 1,
            .pColorAttachmentFormats = &ForeignRenderer::k_format,
            .depthAttachmentFormat = ForeignRenderer::k_depth_format};
        const VkGraphicsPipelineCreateInfo info{
            .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
            .pNext = &rendering,
            .stageCount = stages.size(),
            .pStages = stages.data(),
            .pVertexInputState = &no_vertices,
            .pInputAssemblyState = &triangles,
            .pViewportState = &viewport,
            .pRasterizationState = &raster,
            .pMultisampleState = &one_sample,
            .pDepthStencilState = &depth,
            .pColorBlendState = &blend,
            .pDynamicState = &dynamic,
            .layout = layout_};
        require(vkCreateGraphicsPipelines(device_, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_));
    }
    ~SurfacePipeline() {
        vkDestroyPipeline(device_, pipeline_, nullptr);
        for (const VkShaderModule module : modules_)
            vkDestroyShaderModule(device_, module, nullptr);
        vkDestroyPipelineLayout(device_, layout_, nullptr);
    }
    SurfacePipeline(const SurfacePipeline&) = delete;
    SurfacePipeline& operator=(const SurfacePipeline&) = delete;

    void draw(VkCommandBuffer commands, std::uint32_t corner_count,
              const Constants& constants) const {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
        vkCmdPushConstants(commands, layout_, k_stages, 0, sizeof constants, &constants);
        vkCmdDraw(commands, corner_count, 1, 0, 0);
    }

private:
    static constexpr VkShaderStageFlags k_stages =
        VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

    VkShaderModule module_of(std::span<const std::uint32_t> code) const {
        const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                            .codeSize = code.size_bytes(),
                                            .pCode = code.data()};
        VkShaderModule module = VK_NULL_HANDLE;
        require(vkCreateShaderModule(device_, &info, nullptr, &module));
        return module;
    }
    static VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits stage,
                                                    VkShaderModule module) {
        return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                .stage = stage,
                .module = module,
                .pName = "main"};
    }

    VkDevice device_;
    std::array<VkShaderModule, 2> modules_{};
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    VkPipeline pipeline_ = VK_NULL_HANDLE;
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
