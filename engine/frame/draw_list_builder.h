#pragma once

// From a scene to a draw list: moves the silhouettes to the frame's points, writes what shaders read of
// instances and lights, chooses how each caster's shadow is drawn, and counts all of it for the report.

#include <cstdint>

#include "engine/frame/draw_data.h"
#include "engine/frame/frame_view.h"
#include "engine/frame/instance_states.h"
#include "engine/frame/recorded_frame.h"
#include "engine/frame/render_targets.h"
#include "engine/frame/shadow_batches.h"
#include "engine/line_path.h"
#include "engine/passes/draw_list.h"
#include "engine/renderer_options.h"
#include "engine/vulkan/picture_target.h"

namespace rimline {

/// What a draw list is built with, kept from frame to frame.
struct DrawListParts {
    InstanceStates& instances;  ///< Prepared for the scene, with its silhouettes.
    DrawData& draw_data;
    ShadowBatches& shadow_batches;
    const PictureTarget& target;
    LinePath line_path;  ///< As LinePass::path().
    OutlineMethod outline;
    const RenderTargets& targets;
    bool limits_shadows;  ///< As RendererOptions::limits_shadows.
    bool lists_fronts;    ///< The fronts of solids are drawn by their corners (front_corners.h).
};

/// Builds the draw list of the frame in `ring_slot`, whose draw data begins with `frame_data`. Adds to
/// `frame` its report's counts, the silhouettes followed, and the runs of meshes that deform. Throws
/// Error{too_large} where memory or a budget does not suffice; InstanceStates::invalidate() is to be called
/// then.
DrawList build_draw_list(const FrameView& view, const gpu::FrameData& frame_data,
                         std::uint32_t ring_slot, const DrawListParts& parts, RecordedFrame& frame);

}  // namespace rimline
