#pragma once

// The passes of a frame over its draw list, in order, and the images they draw into.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "engine/frame/frame_view.h"
#include "engine/frame/pass_clock.h"
#include "engine/frame/render_targets.h"
#include "engine/passes/back_pass.h"
#include "engine/passes/backdrop_pass.h"
#include "engine/passes/composite_pass.h"
#include "engine/passes/draw_list.h"
#include "engine/passes/ink_pass.h"
#include "engine/passes/line_pass.h"
#include "engine/passes/shadow_color_pass.h"
#include "engine/passes/shadow_volume_pass.h"
#include "engine/passes/shape_pass.h"
#include "engine/passes/sobel_pass.h"
#include "engine/passes/surface_pass.h"
#include "engine/renderer_options.h"
#include "engine/sampling.h"
#include "engine/vulkan/functions.h"

namespace rimline {

class FramePasses {
public:
    /// `draw_data` is DrawData::layout(). Throws what the passes do.
    FramePasses(const DeviceContext& context, const RendererOptions& options,
                VkDescriptorSetLayout draw_data);

    LinePath line_path() const noexcept { return line_pass_.path(); }
    OutlineMethod outline() const noexcept { return outline_.method; }

    /// As Renderer::set_scale() and Renderer::targets().
    void set_scale(std::uint32_t scale) noexcept {
        sampling_ = sampling_of(context_, sampling_.samples, scale);
    }
    const RenderTargets* targets() const noexcept { return targets_.get(); }

    /// Whether the images fit, at the scale set.
    bool has_targets_for(const Scene& scene, const PictureTarget& target) const;
    /// Frees the images and makes others. The GPU must be done with all frames. Throws Error{too_large} naming
    /// the limit where the device cannot hold them.
    void make_targets(const Scene& scene, const PictureTarget& target);

    /// Makes the pipelines that `scene` and `target` need. There must be targets. Throws Error{bad_input} for a
    /// target that cannot be drawn into, and for a backdrop that cannot be read.
    void prepare(const Scene& scene, const PictureTarget& target);

    bool is_prepared(const Scene& scene, const PictureTarget& target) const;

    /// Records all passes: those that use `target` into `picture`, which may be `commands` or others that are
    /// submitted after them. Face bits, slots and draw arguments must be complete for all stages. There must
    /// be targets for `target`, and everything must be prepared. The passes end on `clock`, at most
    /// max_passes() of them.
    void record(Commands commands, Commands picture, const FrameView& view, const DrawList& list,
                const PictureTarget& target, std::uint32_t ring_slot, PassClock& clock) const;
    static std::uint32_t max_passes(const Scene& scene) noexcept {
        return 5 + 2 * static_cast<std::uint32_t>(scene.lights.size());
    }

private:
    // What the steps of one frame share.
    struct Frame {
        const FrameView& view;
        const DrawList& list;
        const PictureTarget& target;
        DrawnArea area;
        std::uint32_t ring_slot;
        PassClock& clock;
        BackdropMap backdrop{};  // Only where the target has one.
    };

    std::uint32_t scale_for(const PictureTarget& target) const;
    // Whether targets have the image, needed or not: to make it when shadows come, the GPU would have to be done with
    // all frames.
    bool has_shadow_colors() const noexcept { return sampling_.samples == 1; }
    CompositeKind composite_kind(const Scene& scene, const PictureTarget& target) const;
    bool draws_edges(const Scene& scene, const SceneInstance& instance) const;
    bool draws_lines(const DrawList& list) const;
    bool draws_segments(const Scene& scene, const SceneInstance& instance) const;
    // The color that surfaces are drawn over.
    static glm::vec3 under_surfaces(const Frame& frame);
    void record_shapes(Commands commands, const Frame& frame) const;
    void record_surfaces(Commands commands, const Frame& frame) const;
    void record_surfaces_beside_shadow(Commands commands, const Frame& frame) const;
    void record_backs(Commands commands, const Frame& frame) const;
    void record_volumes(Commands commands, const Frame& frame, std::size_t light) const;
    void record_sobel(Commands commands, const Frame& frame) const;
    void record_light(Commands commands, const Frame& frame, std::size_t light) const;
    void record_lines(Commands commands, const Frame& frame) const;
    void record_layer_lines(Commands commands, const Frame& frame) const;
    void record_picture(Commands commands, const Frame& frame) const;

    DeviceContext context_;
    Sampling sampling_;
    bool keeps_stencil_;
    Outline outline_;
    SurfacePass surface_pass_;
    ShadowVolumePass shadow_pass_;
    ShadowColorPass shadow_color_pass_;
    LinePass line_pass_;
    InkPass ink_pass_;
    BackdropPass backdrop_pass_;
    CompositePass composite_pass_;
    std::optional<ShapePass> shape_pass_;  // Both only with OutlineMethod::sobel.
    std::optional<SobelPass> sobel_pass_;
    std::optional<BackPass> back_pass_;  // Only with OutlineMethod::backs.
    std::unique_ptr<RenderTargets> targets_;
};

}  // namespace rimline
