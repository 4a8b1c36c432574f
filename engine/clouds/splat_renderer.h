#pragma once

// Pictures of point clouds: discs and lines (splat_pass.h), with the same targets and composite pass as
// pictures of meshes.
//
// The constant part of a cloud is uploaded once. Lines that depend on the camera, such as a silhouette, are
// uploaded in each frame. As in Renderer, render() draws for the host, and record() writes the same commands
// into a caller's command buffer and draws into a caller's image.

#include <array>
#include <memory>
#include <vector>

#include "engine/camera.h"
#include "engine/clouds/splat_pass.h"
#include "engine/frame/render_targets.h"
#include "engine/passes/composite_pass.h"
#include "engine/vulkan/picture_target.h"
#include "silhouette/picture.h"

namespace rimline {

/// The part of a cloud that is the same in every frame.
struct SplatCloud {
    std::vector<gpu::SplatRecord> splats;
    std::vector<gpu::StrokeRecord> strokes;
    std::uint64_t revision = 0;  ///< To be changed with the two: then they are uploaded again.
};

struct SplatScene {
    const SplatCloud* cloud = nullptr;       ///< Null: an empty cloud.
    std::vector<gpu::StrokeRecord> strokes;  ///< Lines of this frame alone.
    glm::vec3 background{1.0f};              ///< Linear light.
    Camera camera;
    /// A sphere around everything.
    glm::dvec3 center{0.0};
    double radius = 1.0;
};

struct SplatRendererOptions {
    std::uint32_t samples = 4;  ///< As in RendererOptions.
    std::uint32_t scale = 2;
};

class SplatRenderer {
public:
    static constexpr std::uint32_t k_frames_in_flight = 2;

    /// The context's device must outlive the renderer.
    explicit SplatRenderer(const DeviceContext& context, const SplatRendererOptions& options = {});

    /// Draws and waits. Throws Error{too_large} naming the limit if the device cannot hold the records or the
    /// picture. No recorded frame may be running.
    Picture render(const SplatScene& scene, std::uint32_t width, std::uint32_t height);

    /// Records a frame into `commands`, which are outside a render pass. The caller records it only when the
    /// GPU is done with the frame recorded k_frames_in_flight before; one into a target of another size, or
    /// after set_scale(), only when it is done with all. A cloud is identified by its address and revision:
    /// it must not be replaced by another at the same address. Waits if the cloud is a new one. Throws as
    /// render(); `commands` must then not be submitted.
    void record(VkCommandBuffer commands, const SplatScene& scene, const PictureTarget& target);
    void set_scale(std::uint32_t scale) noexcept { options_.scale = scale; }

private:
    // On the device.
    struct Uploaded {
        const SplatCloud* cloud = nullptr;
        std::uint64_t revision = 0;
        Buffer splats, strokes;
        std::uint32_t splat_count = 0, stroke_count = 0;
    };
    // The objects that a frame uses until it is done.
    struct Frame {
        Buffer strokes;
        std::unique_ptr<Uploaded>
            replaced;  // The previous cloud: the previous frame may still use it.
    };

    void prepare_targets(VkExtent2D size);
    void prepare_cloud(const SplatCloud* cloud, Frame& frame);

    DeviceContext context_;
    SplatRendererOptions options_;
    SplatPass splat_pass_;
    CompositePass composite_pass_;
    std::unique_ptr<RenderTargets> targets_;
    std::unique_ptr<Uploaded> uploaded_;
    std::array<Frame, k_frames_in_flight> frames_;
    std::uint64_t recorded_ = 0;
};

}  // namespace rimline
