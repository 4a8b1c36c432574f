#pragma once

// The structures that shaders read of a frame, its instances and its lights (shaders/draw.glsl). Each frame
// in flight has a buffer, in which they follow one another, and a descriptor set. A draw selects an instance
// and a light by their offsets.

#include <vulkan/vulkan.h>

#include <cstring>
#include <span>
#include <vector>

#include "engine/vulkan/descriptor_sets.h"
#include "engine/vulkan/memory.h"
#include "shaders/layout.h"

namespace rimline {

class DrawData {
public:
    DrawData(const DeviceContext& context, std::uint32_t frames_in_flight);

    /// Of set 0 in every drawing pass.
    VkDescriptorSetLayout layout() const noexcept { return sets_.layout(); }
    VkDescriptorSet set(std::uint32_t slot) const noexcept { return sets_[slot]; }

    /// Reserves memory for the structures put next, and begins again at the start of the buffer. Not while a
    /// frame that reads the slot is in flight. Throws Error{too_large} beyond 4 GiB, or where the device's
    /// memory does not suffice.
    void begin_frame(std::uint32_t slot, const gpu::FrameData& frame, std::size_t instances,
                     std::size_t lights);

    /// Copies a structure and returns its offset. At most as many calls as begin_frame() was given.
    std::uint32_t put(const gpu::InstanceData& instance) { return put_bytes(instance); }
    std::uint32_t put(const gpu::LightData& light) { return put_bytes(light); }
    /// Copies the segments of all lines of the frame and returns the address of the first; 0 if there are none.
    /// At most one call for each begin_frame(). Throws as begin_frame().
    VkDeviceAddress put_segments(std::span<const gpu::LineSegment> segments);
    /// Memory for the corners of all instances (DrawList::corners).
    struct CornerList {
        std::span<std::uint32_t> corners;
        VkBuffer buffer = VK_NULL_HANDLE;
    };
    /// At most one call for each begin_frame(). Throws as begin_frame().
    CornerList make_corner_list(std::size_t corners);

    /// Memory for the lists of all parts of shadow volumes of the frame.
    struct PartLists {
        std::span<gpu::EdgeRecord> sides;
        std::span<std::uint32_t> faces;
        VkDeviceAddress sides_address = 0, faces_address = 0;
    };
    /// At most one call for each begin_frame(). Throws as begin_frame().
    PartLists make_part_lists(std::size_t sides, std::size_t faces);

private:
    template <typename T>
    std::uint32_t put_bytes(const T& value) {
        const std::uint32_t offset = end_;
        RIMLINE_CHECK(offset + sizeof value <= buffers_[slot_].size());
        std::memcpy(buffers_[slot_].mapped() + offset, &value, sizeof value);
        end_ = offset + padded(sizeof value);
        return offset;
    }
    std::uint32_t padded(std::size_t size_bytes) const noexcept;

    DeviceContext context_;
    DescriptorSets sets_;
    std::vector<Buffer> buffers_;
    // Of each frame in flight; empty where a frame never had any.
    std::vector<Buffer> segments_, corners_, parts_;
    std::uint32_t slot_ = 0;
    std::uint32_t end_ = 0;  // Bytes used in the slot's buffer.
};

}  // namespace rimline
