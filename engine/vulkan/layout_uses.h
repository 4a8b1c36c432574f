#pragma once

// What an image may be used for in a layout, as the stages and accesses of barriers. For images of callers, whose
// other uses are known by their layouts only.

#include <vulkan/vulkan.h>

#include "engine/vulkan/barrier.h"

namespace rimline {

/// The uses that `layout` allows in Vulkan 1.3 without extensions. Shader stages are those of graphics and compute.
/// None for UNDEFINED, whose content nobody keeps, and for PRESENT_SRC_KHR: semaphores order presentation. Everything
/// for GENERAL and for layouts of extensions.
StageAccess uses_of(VkImageLayout layout) noexcept;

/// Those of both.
constexpr StageAccess operator|(const StageAccess& a, const StageAccess& b) noexcept {
    return {a.stages | b.stages, a.access | b.access};
}

}  // namespace rimline
