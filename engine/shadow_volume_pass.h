#pragma once

// Stencil shadow volumes by depth fail, in the general form: every face is a light cap and a dark cap,
// every edge is extruded as often as its faces' bits say.
//
// The stencil then counts the triangles between the light and the surface, for any mesh: open,
// non-manifold, inconsistently oriented, self-intersecting, and with the light inside. The camera may
// be in shadow and the near plane inside a volume, for only what lies behind the surface is counted.
// The count is kept modulo 256: exactly 256 triangles in a row cast no shadow.
//
// Caps lie on their own surfaces; depth is compared strictly, so that a surface does not shade itself.
// Where the light lies in a face's plane the sides lie on it too; there the surface pass asks the bit.
// Sources: Everitt, Kilgard, Practical and Robust Stenciled Shadow Volumes, 2002; Kim, Kim, Turk,
// Exact and Robust Shadow Volumes with Signed Multiplicities, 2008; thesis 2.2.1.

#include "engine/draw_list.h"
#include "engine/pipeline.h"

namespace rimline {

class ShadowVolumePass {
public:
    ShadowVolumePass(const DeviceContext& context, const AttachmentFormats& formats);

    /// Clears the stencil and counts into it. Depth must be complete; color is left alone.
    void record(VkCommandBuffer commands, const DrawList& list, std::size_t light,
                VkExtent2D extent) const;

private:
    OwnedPipelineLayout layout_;
    OwnedPipeline caps_;
    OwnedPipeline sides_;
};

}  // namespace rimline
