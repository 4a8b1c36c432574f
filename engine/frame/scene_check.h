#pragma once

// The limits of what a scene says (scene.h, camera.h), whatever the device.

namespace rimline {

struct RendererOptions;
struct Scene;

/// Stops the program (RIMLINE_CHECK) where a number of the scene is outside of its limits. Meshes are not read.
/// O(instances + lights).
void check_scene(const Scene& scene) noexcept;

/// The same of a renderer's options. Returns them.
const RendererOptions& checked(const RendererOptions& options) noexcept;

}  // namespace rimline
