#pragma once

// Pictures of point clouds, for the host: discs and lines (splat_pass.h) through the targets and the
// composite pass of every other picture.

#include <vector>

#include "engine/camera.h"
#include "engine/composite_pass.h"
#include "engine/png.h"
#include "engine/render_targets.h"
#include "engine/splat_pass.h"

namespace rimline {

struct SplatScene {
    std::vector<gpu::SplatRecord> splats;
    std::vector<gpu::StrokeRecord> strokes;
    glm::vec3 background{1.0f};  ///< Linear light.
    Camera camera;
    /// A sphere that holds everything.
    glm::dvec3 center{0.0};
    double radius = 1.0;
};

struct SplatRendererOptions {
    std::uint32_t samples = 4;  ///< As RendererOptions has them.
    std::uint32_t scale = 2;
};

class SplatRenderer {
public:
    /// The context's device must outlive the renderer.
    explicit SplatRenderer(const DeviceContext& context, const SplatRendererOptions& options = {});

    /// Draws and waits. Throws Error{too_large} naming the limit where the device cannot hold the records
    /// or the picture.
    Picture render(const SplatScene& scene, std::uint32_t width, std::uint32_t height);

private:
    DeviceContext context_;
    SplatRendererOptions options_;
    SplatPass splat_pass_;
    CompositePass composite_pass_;
};

}  // namespace rimline
