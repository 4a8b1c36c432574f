#pragma once

// Stencil shadow volumes: caps and sides of every caster, counted into the stencil by the method and form
// that shadow_choice.h chose.
//
// In the general form every face is a light cap and a dark cap, and every edge is extruded as often as its
// faces' bits require. The stencil then counts the triangles between the light and the surface, for any mesh:
// open, non-manifold, inconsistently oriented, self-intersecting, and with the light inside. The single form
// draws front faces and half of the sides. With depth fail only fragments behind the surface are counted, so
// the camera may be in shadow and the near plane inside a volume. With depth pass no caps are drawn.
//
// Eight bits count to 255. Where a ray may meet more triangles (shadow_batches.h), volumes are drawn in
// batches that count to 254. Between two batches the stencil is folded: everything that was counted becomes
// 1. Lit samples are still exactly those with a stencil of 0.
//
// Each volume is counted only within a rectangle and, where the device tests it, an interval of stored depths
// (shadow_bounds.h).
//
// Caps lie on their own surfaces. Depth is compared strictly, so that a surface does not shade itself. Caps
// and surfaces must be clipped at the same planes, because a new corner from clipping changes the depths of
// its whole triangle. So in perspective volumes are clipped at the near plane, as surfaces are. Parts nearer
// than that lie in front of everything visible: depth fail does not count them, and depth pass is not chosen
// for such a volume, or it begins with what they count to everywhere (near_count.h). In orthographic views no
// surface is clipped; volumes end behind the far plane, and depth is clamped. It is clamped in perspective too where
// the rays of a point light end in one point (shadow_choice.h). Where the light lies in a face's plane, the sides lie
// on the face too; there the surface pass uses the face bit. Sources: Everitt, Kilgard, Practical and Robust Stenciled
// Shadow Volumes, 2002; Kim, Kim, Turk, Exact and Robust Shadow Volumes with Signed Multiplicities, 2008; thesis 2.2.2.

#include "engine/passes/draw_list.h"
#include "engine/shadow_choice.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline.h"

namespace rimline {

class ShadowVolumePass {
public:
    /// SideStage::geometry is replaced by vertex if the device has no geometry shaders.
    ShadowVolumePass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
                     const AttachmentFormats& formats, SideStage stage = SideStage::vertex);

    /// Counts the volumes of `light` into the stencil, within `area`, the render area of the scope: lights one
    /// after the other, from 0 on, into a stencil that the scope has cleared. The pass clears what the light
    /// before has counted. Depth must be complete. Writes no color. Leaves the scissor at `area`.
    void record(Commands commands, const DrawList& list, std::size_t light,
                const VkRect2D& area) const;

    /// The rectangle around all that a light's volumes count, within `area`; no extent where they count nothing.
    static VkRect2D counted_rect(const DrawList& list, std::size_t light, const VkRect2D& area);

private:
    struct Pipelines {
        OwnedPipeline caps;
        OwnedPipeline pulled_sides;
        OwnedPipeline geometry_sides;  // Null if sides are pulled.
    };

    static Pipelines make_pipelines(const DeviceContext& context, const AttachmentFormats& formats,
                                    VkPipelineLayout layout, SideStage stage, bool depth_clamp);
    const Pipelines& pipelines_of(const DrawnLight& drawn) const noexcept {
        return drawn.clamps_depth ? clamping_ : clipping_;
    }
    void record_near_counts(Commands commands, const DrawList& list, std::size_t light,
                            const ShadowBatch& batch, const VkRect2D& area) const;
    void record_caps(Commands commands, const DrawList& list, std::size_t light,
                     const ShadowBatch& batch, const VkRect2D& area) const;
    void record_sides(Commands commands, const DrawList& list, std::size_t light,
                      const ShadowBatch& batch, const VkRect2D& area) const;
    // Limits the next draws to where a volume matters. False: it matters nowhere.
    bool limit(Commands commands, const DrawnLight& drawn, const VkRect2D& area) const;

    bool has_depth_bounds_;
    OwnedPipelineLayout layout_;
    Pipelines clipping_, clamping_;  // At the near plane.
    OwnedPipeline fold_, raise_;
};

}  // namespace rimline
