#pragma once

// Which part of an image of the engine's own a pass that clears takes as its render area.
//
// A frame draws only a rectangle around the scene (drawn_rect.h). On the CPU less area is less work. A GPU that
// clears by metadata (a "fast clear") does so only where the whole image is cleared: RADV and others fall back to
// drawing a rectangle. There the render area is the image, and a scissor limits what is drawn. Samples are then
// resolved everywhere, too. GPUs that work tile by tile clear a tile for nothing, and write every tile of the render
// area back to memory: there the rectangle stays.
// Nothing of this is measured on a GPU. The picture is the same either way: what is outside is never read.

#include <vulkan/vulkan.h>

#include <cstdint>

namespace rimline {

enum class ClearArea : std::uint8_t {
    drawn,  ///< The rectangle that is drawn.
    whole,  ///< The image.
};

/// `driver` 0: unknown.
ClearArea choose_clear_area(VkPhysicalDeviceType type, VkDriverId driver) noexcept;

}  // namespace rimline
