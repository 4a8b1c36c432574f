#pragma once

// Memory barriers in one line. Each one drains lavapipe, so a frame has few, each for everything at once.

#include <vulkan/vulkan.h>

#include "engine/vulkan/functions.h"

namespace rimline {

struct StageAccess {
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 access;
};

/// Orders `from` before `to`, for all memory.
inline void record_barrier(Commands commands, StageAccess from, StageAccess to) {
    const VkMemoryBarrier2 memory{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                  .srcStageMask = from.stages,
                                  .srcAccessMask = from.access,
                                  .dstStageMask = to.stages,
                                  .dstAccessMask = to.access};
    const VkDependencyInfo dependency{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                      .memoryBarrierCount = 1,
                                      .pMemoryBarriers = &memory};
    commands->CmdPipelineBarrier2(commands, &dependency);
}

}  // namespace rimline
