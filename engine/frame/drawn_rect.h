#pragma once

// The part of a picture that a scene covers: passes are limited to it.

#include <vulkan/vulkan.h>

#include "engine/frame/frame_view.h"

namespace rimline {

/// The rectangle of the picture, in pixels, that holds everything of the scene, with the pixels around
/// lines that their shader reads. It is the rectangle around the instances (InstanceView::screen); the whole picture
/// where one of them reaches behind the near plane. Where nothing is in the picture it is one pixel,
/// because a pass needs one. O(instances).
VkRect2D drawn_rect(const FrameView& view);

}  // namespace rimline
