#include "engine/vulkan/memory.h"

#include <algorithm>
#include <array>
#include <string>

#include "engine/vulkan/barrier.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/debug_names.h"
#include "engine/vulkan/memory_budget.h"
#include "engine/vulkan/picture_target.h"

namespace rimline {

namespace {

VkMemoryPropertyFlags wanted_properties(BufferPlace place) {
    switch (place) {
        case BufferPlace::device: return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
        case BufferPlace::upload: return VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
        case BufferPlace::readback: return VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    }
    return 0;
}

void check_extent(const VkPhysicalDeviceLimits& limits, const ImageDescription& description,
                  const std::string& what) {
    const VkExtent2D extent = description.extent;
    const auto check = [&](std::uint32_t length, std::uint32_t limit, const char* name) {
        if (length <= limit) return;
        throw Error(ErrorCode::too_large, what + " of " + std::to_string(extent.width) + "x" +
                                              std::to_string(extent.height) +
                                              " exceeds the device's " + name + " of " +
                                              std::to_string(limit));
    };
    check(std::max(extent.width, extent.height), limits.maxImageDimension2D, "maxImageDimension2D");
    constexpr VkImageUsageFlags k_drawn =
        VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if ((description.usage & k_drawn) == 0) return;
    check(extent.width, limits.maxFramebufferWidth, "maxFramebufferWidth");
    check(extent.height, limits.maxFramebufferHeight, "maxFramebufferHeight");
}

}  // namespace

Buffer::Buffer(const DeviceContext& context, VkDeviceSize size, BufferPlace place,
               const std::string& what)
    : size_(buffer_bytes(size)) {
    if (size_ > context.max_buffer_bytes)
        throw Error(ErrorCode::too_large, what + " needs " + size_text(size_) +
                                              ", more than the device's maxBufferSize of " +
                                              size_text(context.max_buffer_bytes));
    const std::array families{context.queue_family, context.transfer_family};
    const bool is_shared =
        place == BufferPlace::device && context.queue_family != context.transfer_family;
    const VkBufferUsageFlags conditional =
        place == BufferPlace::upload && context.features.conditional_rendering
            ? VK_BUFFER_USAGE_CONDITIONAL_RENDERING_BIT_EXT
            : 0;
    const VkBufferCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = size_,
        .usage = conditional | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                 VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
                 VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                 VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
        .sharingMode = is_shared ? VK_SHARING_MODE_CONCURRENT : VK_SHARING_MODE_EXCLUSIVE,
        .queueFamilyIndexCount = is_shared ? 2u : 0u,
        .pQueueFamilyIndices = families.data()};
    VkBuffer handle = VK_NULL_HANDLE;
    check_room(context.vk->CreateBuffer(context.device, &info, nullptr, &handle), "vkCreateBuffer",
               size_, what);
    buffer_ = {context, handle};
    set_name(*context.vk, VK_OBJECT_TYPE_BUFFER, handle, what);
    VkMemoryRequirements requirements;
    context.vk->GetBufferMemoryRequirements(context.device, handle, &requirements);
    requirements.alignment = std::max(requirements.alignment, k_min_buffer_alignment);
    const VkMemoryPropertyFlags needed =
        place == BufferPlace::device
            ? 0
            : VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    memory_ = OwnedMemory(context, {.requirements = requirements,
                                    .needed = needed,
                                    .wanted = wanted_properties(place),
                                    .buffer = handle,
                                    .what = what});
    const MemoryPart& part = memory_.part();
    check_room(context.vk->BindBufferMemory(context.device, handle, part.memory, part.offset),
               "vkBindBufferMemory", size_, what);
    mapped_ = part.mapped;
    const VkBufferDeviceAddressInfo address{.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                            .buffer = handle};
    address_ = context.vk->GetBufferDeviceAddress(context.device, &address);
}

bool grow(Buffer& buffer, const DeviceContext& context, VkDeviceSize size, BufferPlace place,
          const char* what) {
    constexpr VkDeviceSize k_most_spare = VkDeviceSize{16} << 20;
    if (buffer.size() >= size && buffer.size() > 0) return false;
    buffer = {};
    buffer = Buffer(context, size + std::min(size / 2, k_most_spare), place, what);
    return true;
}

Buffer upload_buffer(const DeviceContext& context, std::span<const std::byte> data,
                     const std::string& what) {
    Buffer buffer(context, data.size(), BufferPlace::device, what);
    if (data.empty()) return buffer;
    const Buffer staging(context, data.size(), BufferPlace::upload, what);
    std::memcpy(staging.mapped(), data.data(), data.size());
    run_commands(context, [&](Commands commands) {
        const VkBufferCopy region{.size = data.size()};
        commands->CmdCopyBuffer(commands, staging.handle(), buffer.handle(), 1, &region);
    });
    return buffer;
}

void read_buffer(const DeviceContext& context, const Buffer& buffer, std::span<std::byte> data) {
    RIMLINE_CHECK(data.size() <= buffer.size());
    if (data.empty()) return;
    const Buffer staging(context, data.size(), BufferPlace::readback, "reading back");
    run_commands(context, [&](Commands commands) {
        const VkBufferCopy region{.size = data.size()};
        commands->CmdCopyBuffer(commands, buffer.handle(), staging.handle(), 1, &region);
        record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    });
    std::memcpy(data.data(), staging.mapped(), data.size());
}

VkImageAspectFlags Image::aspects() const noexcept {
    const VkImageAspectFlags depth = depth_aspects(description_.format);
    return depth != 0 ? depth : VkImageAspectFlags{VK_IMAGE_ASPECT_COLOR_BIT};
}

VkExtent2D max_attachment_extent(const VkPhysicalDeviceLimits& limits) noexcept {
    return {std::min(limits.maxImageDimension2D, limits.maxFramebufferWidth),
            std::min(limits.maxImageDimension2D, limits.maxFramebufferHeight)};
}

Image::Image(const DeviceContext& context, const ImageDescription& description,
             const std::string& what)
    : description_(description) {
    check_extent(context.limits, description, what);
    const std::array families{context.queue_family, context.transfer_family};
    const bool is_shared = description.is_shared && context.queue_family != context.transfer_family;
    const VkImageCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = description.format,
        .extent = {description.extent.width, description.extent.height, 1},
        .mipLevels = description.mip_levels,
        .arrayLayers = 1,
        .samples = static_cast<VkSampleCountFlagBits>(description.samples),
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = description.usage,
        .sharingMode = is_shared ? VK_SHARING_MODE_CONCURRENT : VK_SHARING_MODE_EXCLUSIVE,
        .queueFamilyIndexCount = is_shared ? 2u : 0u,
        .pQueueFamilyIndices = families.data()};
    VkImage handle = VK_NULL_HANDLE;
    const VkDeviceSize pixels = VkDeviceSize{description.extent.width} * description.extent.height;
    check_room(context.vk->CreateImage(context.device, &info, nullptr, &handle), "vkCreateImage",
               4 * pixels * description.samples, what);
    image_ = {context, handle};
    set_name(*context.vk, VK_OBJECT_TYPE_IMAGE, handle, what);
    VkMemoryRequirements requirements;
    context.vk->GetImageMemoryRequirements(context.device, handle, &requirements);
    VkMemoryPropertyFlags wanted = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    if ((description.usage & VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT) != 0)
        wanted |= VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT;
    memory_ = OwnedMemory(
        context, {.requirements = requirements, .wanted = wanted, .image = handle, .what = what});
    const MemoryPart& part = memory_.part();
    check_room(context.vk->BindImageMemory(context.device, handle, part.memory, part.offset),
               "vkBindImageMemory", requirements.size, what);

    const auto view_of = [&](VkImageAspectFlags aspects, std::uint32_t levels) {
        const VkImageViewCreateInfo view{.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                         .image = handle,
                                         .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                         .format = description.format,
                                         .subresourceRange = {aspects, 0, levels, 0, 1}};
        VkImageView view_handle = VK_NULL_HANDLE;
        vk_check(context.vk->CreateImageView(context.device, &view, nullptr, &view_handle),
                 "vkCreateImageView");
        set_name(*context.vk, VK_OBJECT_TYPE_IMAGE_VIEW, view_handle, what);
        return OwnedImageView(context, view_handle);
    };
    attachment_view_ = view_of(aspects(), 1);
    if ((description.usage & VK_IMAGE_USAGE_SAMPLED_BIT) != 0)
        sampled_view_ = view_of(description.sampled_aspect, description.mip_levels);
}

}  // namespace rimline
