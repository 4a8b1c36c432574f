#pragma once

// Pictures of point clouds: discs and lines (splat_pass.h), with the same targets and composite pass as
// pictures of meshes.
//
// The constant part of a cloud is uploaded once. Lines that depend on the camera, such as a silhouette, are
// uploaded in each frame. As in Renderer, render() draws for the host, and record() writes the same commands
// into a caller's command buffer and draws into a caller's image.

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "engine/camera.h"
#include "engine/vulkan/picture_target.h"
#include "engine/vulkan/upload_point.h"
#include "shaders/splat_layout.h"
#include "silhouette/picture.h"

namespace rimline {

struct DeviceContext;

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
    /// Pixels drawn for each pixel along each side, as in RendererOptions, on every device with one sample each:
    /// discs and strokes end where a pixel is discarded, and more samples leave such edges as they are. 0: 2.
    std::uint32_t scale = 0;
    std::uint32_t frames_in_flight = 2;  ///< At least 1, as in RendererOptions.
};

class SplatRenderer {
public:
    /// The context's device must outlive the renderer.
    explicit SplatRenderer(const DeviceContext& context, const SplatRendererOptions& options = {});
    ~SplatRenderer();
    SplatRenderer(SplatRenderer&&) noexcept;
    SplatRenderer& operator=(SplatRenderer&&) noexcept;

    /// Draws and waits. Throws Error{too_large} naming the limit if the device cannot hold the records or the
    /// picture. No recorded frame may be running.
    Picture render(const SplatScene& scene, std::uint32_t width, std::uint32_t height);

    /// Makes what record() needs, as Renderer::prepare(): call it when the scene has another cloud or revision, or when
    /// the target or the scale changes. A cloud is identified by its address and revision: it must not be replaced by
    /// another at the same address. Throws as render(), and Error{bad_input} if a target of another size or scale needs
    /// other images while recorded frames still use these; nothing has changed then.
    [[nodiscard]] UploadPoint prepare(const SplatScene& scene, const PictureTarget& target);

    /// Records a frame into `commands`, as Renderer::record(). Everything must be prepared, and the GPU be done with
    /// the frame recorded frames_in_flight before (RIMLINE_CHECK). Throws Error{too_large} if there is no memory for
    /// the strokes; `commands` must then not be submitted.
    void record(VkCommandBuffer commands, const SplatScene& scene, const PictureTarget& target) {
        record(commands, commands, scene, target);
    }
    /// The same in two parts, as Renderer's.
    void record(VkCommandBuffer commands, VkCommandBuffer picture, const SplatScene& scene,
                const PictureTarget& target);
    /// For command buffers that were dropped, and after a lost device: recorded frames that are not done count as done.
    void forget_recorded() noexcept;
    /// Sets SplatRendererOptions::scale of the following frames.
    void set_scale(std::uint32_t scale) noexcept;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace rimline
