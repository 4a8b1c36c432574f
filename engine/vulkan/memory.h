#pragma once

// Buffers and images that own their memory.

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <string>

#include "engine/vulkan/device.h"
#include "engine/vulkan/vulkan_handle.h"

namespace rimline {

enum class BufferPlace {
    /// Fast for the GPU; the host writes it through uploads. Shared by both queue families, so that either
    /// reads what the other wrote as soon as a semaphore says so.
    device,
    upload,    ///< Persistently mapped; the host writes, the GPU reads.
    readback,  ///< Persistently mapped; the GPU writes, the host reads.
};

/// Every buffer can be addressed by shaders, bound as uniforms, copied from and to, drawn from
/// indirectly, and can hold indices.
class Buffer {
public:
    Buffer() = default;
    /// A size of 0 is made 4. Throws Error{too_large} when that is beyond a limit of the device, or when
    /// it has no such memory left; the message names `what` and the limit.
    Buffer(const DeviceContext& context, VkDeviceSize size, BufferPlace place,
           const std::string& what);

    VkBuffer handle() const noexcept { return buffer_.get(); }
    VkDeviceAddress address() const noexcept { return address_; }
    VkDeviceSize size() const noexcept { return size_; }
    /// Null for BufferPlace::device.
    std::byte* mapped() const noexcept { return mapped_; }

private:
    OwnedMemory memory_;
    OwnedBuffer buffer_;
    VkDeviceAddress address_ = 0;
    VkDeviceSize size_ = 0;
    std::byte* mapped_ = nullptr;
};

/// What a buffer of `size_bytes` holds.
constexpr VkDeviceSize buffer_bytes(VkDeviceSize size_bytes) noexcept {
    return size_bytes > 4 ? size_bytes : 4;
}

/// Makes a device buffer that holds `data`, and waits until it does.
Buffer upload_buffer(const DeviceContext& context, std::span<const std::byte> data,
                     const std::string& what);

template <typename T>
Buffer upload_buffer(const DeviceContext& context, std::span<const T> data,
                     const std::string& what) {
    return upload_buffer(context, std::as_bytes(data), what);
}

/// Copies a buffer back to the host and waits. For tests and finished pictures.
void read_buffer(const DeviceContext& context, const Buffer& buffer, std::span<std::byte> data);

struct ImageDescription {
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkExtent2D extent{};
    VkImageUsageFlags usage = 0;
    std::uint32_t samples = 1;
    /// What sampling sees of it; attachments use every aspect of the format.
    VkImageAspectFlags sampled_aspect = VK_IMAGE_ASPECT_COLOR_BIT;
};

class Image {
public:
    Image() = default;
    /// Throws Error{too_large} naming the limit when the device cannot make it.
    Image(const DeviceContext& context, const ImageDescription& description,
          const std::string& what);

    VkImage handle() const noexcept { return image_.get(); }
    VkImageView attachment_view() const noexcept { return attachment_view_.get(); }
    VkImageView sampled_view() const noexcept { return sampled_view_.get(); }
    const ImageDescription& description() const noexcept { return description_; }
    /// Every aspect of its format.
    VkImageAspectFlags aspects() const noexcept;

private:
    ImageDescription description_;
    OwnedMemory memory_;
    OwnedImage image_;
    OwnedImageView attachment_view_;
    OwnedImageView sampled_view_;
};

}  // namespace rimline
