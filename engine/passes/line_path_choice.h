#pragma once

// Which line path a device takes. All paths that draw slots give the same picture (line_path.h); they differ in time.
//
// On the CPU (Mesa's lavapipe) the geometry shader is measured to be faster: 1.9 ms against 2.3 ms of pulling, for
// 2,193 edges at 1024 x 1024. On GPUs nothing has been measured yet. Their vendors advise against geometry shaders:
// Arm's guide to best practices says to use none, and Apple's GPUs have none. Pulling costs four runs of a
// short vertex shader an edge and writes nothing between stages. So it is the default on everything that is no
// CPU. `rimline bench frames` compares both on the device at hand.

#include <vulkan/vulkan.h>

#include "engine/line_path.h"

namespace rimline {

/// The path to draw by, where `wanted` is asked for: never automatic. Without geometry shaders, geometry is replaced
/// by pulling. Throws Error{no_device} for another path that needs geometry shaders where there are none.
LinePath choose_line_path(LinePath wanted, VkPhysicalDeviceType type, bool has_geometry_shader);

}  // namespace rimline
