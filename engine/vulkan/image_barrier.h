#pragma once

// Barriers for images that change their layout, several in one barrier.

#include <vulkan/vulkan.h>

#include <initializer_list>
#include <span>
#include <vector>

#include "engine/vulkan/barrier.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/picture_target.h"

namespace rimline {

struct ImageTransition {
    /// Of the first `levels` mip levels of a color image.
    ImageTransition(VkImage color, std::uint32_t levels, VkImageLayout from, VkImageLayout to)
        : image(color),
          range{VK_IMAGE_ASPECT_COLOR_BIT, 0, levels, 0, 1},
          old_layout(from),
          new_layout(to) {}
    ImageTransition(const Image& moved, VkImageLayout from, VkImageLayout to)
        : image(moved.handle()),
          range{moved.aspects(), 0, 1, 0, 1},
          old_layout(from),
          new_layout(to) {}
    ImageTransition(const PictureTarget& target, VkImageLayout from, VkImageLayout to)
        : image(target.image),
          range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, target.layer, 1},
          old_layout(from),
          new_layout(to) {}

    VkImage image;
    VkImageSubresourceRange range;
    VkImageLayout old_layout;
    VkImageLayout new_layout;
};

/// Orders `from` before `to` for these images, and moves them to their new layouts.
inline void record_barrier(Commands commands, StageAccess from, StageAccess to,
                           std::span<const ImageTransition> transitions) {
    std::vector<VkImageMemoryBarrier2> images;
    for (const ImageTransition& t : transitions)
        images.push_back({.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                          .srcStageMask = from.stages,
                          .srcAccessMask = from.access,
                          .dstStageMask = to.stages,
                          .dstAccessMask = to.access,
                          .oldLayout = t.old_layout,
                          .newLayout = t.new_layout,
                          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                          .image = t.image,
                          .subresourceRange = t.range});
    const VkDependencyInfo dependency{
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .imageMemoryBarrierCount = static_cast<std::uint32_t>(images.size()),
        .pImageMemoryBarriers = images.data()};
    commands->CmdPipelineBarrier2(commands, &dependency);
}
inline void record_barrier(Commands commands, StageAccess from, StageAccess to,
                           std::initializer_list<ImageTransition> transitions) {
    record_barrier(commands, from, to,
                   std::span<const ImageTransition>(transitions.begin(), transitions.size()));
}

}  // namespace rimline
