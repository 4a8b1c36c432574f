#pragma once

// Outlines as back faces that stick out behind the surfaces (Raskar and Cohen, Image Precision Silhouette Edges,
// 1999), of one width in pixels. As programs do today, back faces are not widened one by one, but all corners of a
// vertex move along its normal: the hull has no gaps where the mesh has none. It needs closed meshes: of an open
// one, backs that are seen from inside are covered in part. A comparator (Outline).

#include <cstdint>

#include "engine/passes/draw_list.h"
#include "engine/scene.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline.h"

namespace rimline {

class BackPass {
public:
    BackPass(const DeviceContext& context, VkDescriptorSetLayout draw_data,
             const AttachmentFormats& formats);

    /// How far it draws beyond drawn_rect() (drawn_rect.h), in pixels of the picture.
    static std::int32_t reach_px(const Scene& scene);

    /// Draws the outlines of all instances with lines, in their ink, inside the scope of the finished surfaces.
    /// `is_layer`: alpha is opacity.
    void record(Commands commands, const DrawList& list, bool is_layer) const;

private:
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

}  // namespace rimline
