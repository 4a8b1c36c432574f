#pragma once

// Stencil shadow volumes: caps and sides of every caster, counted into the stencil as shadow_choice.h
// chose for it.
//
// In the general form every face is a light cap and a dark cap and every edge is extruded as often as
// its faces' bits say. The stencil then counts the triangles between the light and the surface, for any
// mesh: open, non-manifold, inconsistently oriented, self-intersecting, and with the light inside. The
// single form does with front faces and half the sides. By depth fail the camera may be in shadow and
// the near plane inside a volume, for only what lies behind the surface is counted; by depth pass there
// are no caps to draw.
//
// Eight bits count to 255. Where more triangles may lie in a row (shadow_batches.h), volumes are drawn
// in batches that count to 127, each then folded into the top bit: 0 is still just what is lit.
//
//     stencil   [ t | c c c c c c c ]   c: the batch's count, t: a batch before counted something
//
// Caps lie on their own surfaces; depth is compared strictly, so that a surface does not shade itself.
// Both must be clipped alike, for a corner that comes of clipping moves the depths of all its triangle.
// So in perspective volumes end at the near plane as surfaces do: what is nearer is in front of all that
// is seen, where depth fail counts nothing, and depth pass is not chosen for a volume that is there. In
// orthographic views, which no surface is clipped in, volumes end behind the far plane; depth is clamped.
// Where the light lies in a face's plane the sides lie on it too; there the surface pass asks the bit.
// Sources: Everitt, Kilgard, Practical and Robust Stenciled Shadow Volumes, 2002; Kim, Kim, Turk,
// Exact and Robust Shadow Volumes with Signed Multiplicities, 2008; thesis 2.2.1.

#include "engine/frame/draw_list.h"
#include "engine/vulkan/pipeline.h"

namespace rimline {

/// The stage that makes sides of edge records. Both draw the same triangles; where a driver transforms
/// what leaves a geometry stage with other roundings, pixels on a volume's edge can fall between its
/// caps and its sides, about one in ten million, and depth pass and depth fail can differ there.
enum class SideStage : std::uint8_t {
    vertex,    ///< Vertex pulling: on every device, watertight to the last bit.
    geometry,  ///< Geometry shaders, where the device has them.
};

class ShadowVolumePass {
public:
    /// SideStage::geometry becomes vertex where the device has no geometry shaders.
    ShadowVolumePass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
                     const AttachmentFormats& formats, SideStage stage = SideStage::vertex);

    /// Clears the stencil within `area`, to which the scope of rendering is cut, and counts into it.
    /// Depth must be complete; color is left alone.
    void record(VkCommandBuffer commands, const DrawList& list, std::size_t light,
                const VkRect2D& area) const;

private:
    struct Pipelines {
        OwnedPipeline caps;
        OwnedPipeline pulled_sides;
        OwnedPipeline geometry_sides;  // Null where sides are pulled.
    };

    static Pipelines make_pipelines(const DeviceContext& context, const AttachmentFormats& formats,
                                    VkPipelineLayout layout, SideStage stage, bool depth_clamp);
    const Pipelines& pipelines_of(const DrawList& list) const noexcept {
        return list.is_orthographic ? orthographic_ : perspective_;
    }
    void record_caps(VkCommandBuffer commands, const DrawList& list, std::size_t light,
                     const ShadowBatch& batch) const;
    void record_sides(VkCommandBuffer commands, const DrawList& list, std::size_t light,
                      const ShadowBatch& batch) const;

    OwnedPipelineLayout layout_;
    Pipelines perspective_, orthographic_;
    OwnedPipeline fold_;
};

}  // namespace rimline
