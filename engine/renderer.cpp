#include "engine/renderer.h"

#include "engine/frame/frames_in_flight.h"
#include "engine/frame/scene_check.h"

namespace rimline {

Renderer::Renderer(const DeviceContext& context, const RendererOptions& options)
    : frames_(std::make_unique<FramesInFlight>(checked(context), checked(options))) {}

Renderer::~Renderer() = default;

void Renderer::submit(const Scene& scene, std::uint32_t width, std::uint32_t height) {
    frames_->submit(scene, {width, height});
}

Picture Renderer::finish() { return frames_->finish(); }

void Renderer::announce(const Scene& scene) noexcept { frames_->announce(scene); }

UploadPoint Renderer::prepare(const Scene& scene, const PictureTarget& target) {
    return frames_->prepare(scene, target);
}

FrameReport Renderer::record(VkCommandBuffer commands, const Scene& scene,
                             const PictureTarget& target) {
    return frames_->record(commands, commands, scene, target);
}

FrameReport Renderer::record(VkCommandBuffer commands, VkCommandBuffer picture, const Scene& scene,
                             const PictureTarget& target) {
    return frames_->record(commands, picture, scene, target);
}

void Renderer::forget_recorded() noexcept { frames_->forget_recorded(); }

void Renderer::set_scale(std::uint32_t scale) noexcept { frames_->set_scale(scale); }

const FrameReport& Renderer::report() const noexcept { return frames_->report(); }

std::optional<SilhouetteBuffers> Renderer::silhouette(std::size_t instance,
                                                      std::optional<std::size_t> light) const {
    return frames_->silhouette(instance, light);
}

std::uint64_t Renderer::differences() const noexcept { return frames_->differences(); }

std::uint64_t Renderer::stream_bytes() const noexcept { return frames_->stream_bytes(); }

std::uint64_t Renderer::tracker_bytes() const noexcept { return frames_->tracker_bytes(); }

const RenderTargets* Renderer::targets() const noexcept { return frames_->targets(); }

}  // namespace rimline
