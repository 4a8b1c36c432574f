#pragma once

// The limits of what callers say of scenes, options and targets, whatever the device. What is outside of them stops
// the program (RIMLINE_CHECK).

namespace rimline {

struct DeviceContext;
struct PictureTarget;
struct RendererOptions;
struct Scene;

/// Of all numbers in scene.h and camera.h. Meshes and points of lines are not read.
/// O(instances + lights + picture lines).
void check_scene(const Scene& scene) noexcept;

/// Of a target that a frame is recorded for: it has an image, a view and a place, and so has its backdrop.
void check_target(const PictureTarget& target) noexcept;

/// Of a renderer's options. Returns them.
const RendererOptions& checked(const RendererOptions& options) noexcept;

/// Of a context: it has a device. Returns it.
const DeviceContext& checked(const DeviceContext& context) noexcept;

}  // namespace rimline
