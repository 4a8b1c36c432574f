#pragma once

// Buffers and images that own their memory.

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/memory_allocator.h"
#include "engine/vulkan/vulkan_handle.h"

namespace rimline {

enum class BufferPlace {
    /// Fast for the GPU; the host writes it through uploads. Shared by both queue families: either may read
    /// what the other wrote after waiting for its semaphore.
    device,
    upload,    ///< Persistently mapped; the host writes, the GPU reads.
    readback,  ///< Persistently mapped; the GPU writes, the host reads.
};

/// Owns a part of the memory of a context's allocator, which must outlive it.
class OwnedMemory {
public:
    OwnedMemory() = default;
    OwnedMemory(const DeviceContext& context, const MemoryRequest& request)
        : allocator_(context.allocator.get()), part_(allocator_->allocate(request)) {}
    OwnedMemory(OwnedMemory&& other) noexcept
        : allocator_(std::exchange(other.allocator_, nullptr)), part_(other.part_) {}
    OwnedMemory& operator=(OwnedMemory&& other) noexcept {
        std::swap(allocator_, other.allocator_);
        std::swap(part_, other.part_);
        return *this;
    }
    ~OwnedMemory() {
        if (allocator_) allocator_->free(part_);
    }

    const MemoryPart& part() const noexcept { return part_; }

private:
    MemoryAllocator* allocator_ = nullptr;
    MemoryPart part_;
};

/// A buffer with its memory. Every buffer has a device address and can be a uniform buffer, a source and a
/// target of copies, an indirect buffer and an index buffer; where the device has conditional rendering, those that the
/// host writes can hold a FrameCondition.
class Buffer {
public:
    Buffer() = default;
    /// A size below 4 is raised to buffer_bytes(). Throws Error{too_large} if the size exceeds a limit of the
    /// device, or if its memory has run out; the message names `what` and the limit.
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

/// Where `buffer` holds fewer bytes, makes it anew with up to half as many to spare, so that one that needs a little more
/// each frame is not made each frame. No frame may use it, and its content is lost. Returns whether it was made. Throws as
/// Buffer does; then it is empty.
bool grow(Buffer& buffer, const DeviceContext& context, VkDeviceSize size, BufferPlace place,
          const char* what);

/// The address of every buffer is a multiple of it: of the largest alignment of a buffer reference (shaders/layout.h).
constexpr VkDeviceSize k_min_buffer_alignment = 16;

/// The size of a buffer that is made for `size_bytes`: at least 4.
constexpr VkDeviceSize buffer_bytes(VkDeviceSize size_bytes) noexcept {
    return size_bytes > 4 ? size_bytes : 4;
}

/// Makes a device buffer with the content `data`, and waits for the copy.
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
    /// The aspect of its sampled view. Attachments use every aspect of the format.
    VkImageAspectFlags sampled_aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    std::uint32_t mip_levels = 1;  ///< The sampled view has all of them.
    /// Uploaded: shared by both queue families, as buffers of BufferPlace::device are.
    bool is_shared = false;
};

/// The limits of images that are drawn into. A viewport may be as large (VkPhysicalDeviceLimits).
VkExtent2D max_attachment_extent(const VkPhysicalDeviceLimits& limits) noexcept;

class Image {
public:
    Image() = default;
    /// Throws Error{too_large} naming `what` and the limit if the device cannot make it.
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
