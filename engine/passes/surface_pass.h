#pragma once

// Depth and shading. First the color of every surface in shadow, with depth; then, for each light, the light
// it adds where the stencil is zero. Both in one draw where SurfaceLights says so.
//
// Each style has its own pipelines, for surfaces in one color, in the colors of their mesh, and with textures. With
// a common one that branches on the style in the fragment stage, lavapipe computed the strokes of hatch for
// every pixel and discarded them: two thirds of a frame's time.

#include <map>

#include "engine/passes/draw_list.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline.h"

namespace rimline {

class SurfacePass {
public:
    /// Draws into attachments of `formats`; record_whole() with SurfaceLights::beside_shadow into a second color
    /// attachment besides.
    SurfacePass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
                const AttachmentFormats& formats);

    /// Makes the pipelines of `kind`, if there are none yet. Needed before a list with an instance of that
    /// kind is recorded.
    void prepare(const DeviceContext& context, const SurfaceKind& kind);

    bool is_prepared(const SurfaceKind& kind) const { return pipelines_.contains(kind); }

    /// Writes color and depth. Inside a rendering scope with cleared attachments.
    void record_unlit(Commands commands, const DrawList& list) const;
    /// Where lights are not apart: equals record_unlit() and record_lit() of the only light with a stencil of zero
    /// everywhere. With SurfaceLights::beside_shadow the second color is what record_unlit() writes.
    void record_whole(Commands commands, const DrawList& list) const;
    /// Where the depth equals that of record_unlit(): adds light `light` where the stencil is zero. For surfaces
    /// that are held out, adds opacity where it is not, if there are shadows. For a light that fills, see
    /// SurfaceFilling.
    void record_lit(Commands commands, const DrawList& list, std::size_t light) const;

private:
    // Of one kind: the first two where lights are apart, and the third if some fill; else the last.
    struct Pipelines {
        OwnedPipeline unlit, lit, filled, whole;
    };

    void record(Commands commands, const DrawList& list, OwnedPipeline Pipelines::*pipeline,
                std::size_t light) const;
    void draw_corners(Commands commands, const DrawList& list, const DrawnInstance& instance) const;

    AttachmentFormats formats_;
    OwnedDescriptorSetLayout texture_;
    OwnedPipelineLayout layout_;
    std::map<SurfaceKind, Pipelines> pipelines_;
};

}  // namespace rimline
