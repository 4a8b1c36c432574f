#pragma once

// The depth of what another renderer has drawn already (BackdropDepth, picture_target.h), as the surface and
// shadow passes see it: copied into their depth before anything is drawn, and shaded by the shadows that fall on
// it. The copy lies a little farther away than what it copies, so that a surface of the scene that the other
// renderer has drawn too lies before its own copy, whatever the two round differently.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/vulkan/descriptor_sets.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/picture_target.h"
#include "engine/vulkan/pipeline.h"

namespace rimline {

/// From a depth of the backdrop to one of the surface pass: scale * depth + offset, less a slack.
struct BackdropMap {
    float scale, offset;
    float far;             ///< The backdrop's depth where nothing was drawn.
    float relative_slack;  ///< Of the result.
    float absolute_slack;
};

class BackdropPass {
public:
    /// `ring_slots` as RendererOptions::frames_in_flight.
    BackdropPass(const DeviceContext& context, const AttachmentFormats& formats,
                 std::uint32_t ring_slots);

    /// Makes the pipelines, if there are none yet. Throws Error{bad_input} for a backdrop with another number of
    /// samples than the passes.
    void prepare(const DeviceContext& context, const BackdropDepth& backdrop);
    bool is_prepared() const noexcept { return !depth_.empty(); }

    /// Sets what the frame in `ring_slot` reads.
    void set(std::uint32_t ring_slot, const BackdropDepth& backdrop) const;

    /// Inside the scope of the surfaces, with nothing drawn. The frame begins at `corner` of the backdrop.
    void record_depth(Commands commands, std::uint32_t ring_slot, const BackdropMap& map,
                      VkOffset2D corner) const;
    /// Adds `opacity` to alpha where the backdrop is seen, and where the stencil is not zero.
    void record_shade(Commands commands, std::uint32_t ring_slot, const BackdropMap& map,
                      VkOffset2D corner, float opacity) const;

private:
    struct Constants {
        BackdropMap map;
        float opacity;
        VkOffset2D corner;
    };
    void record(Commands commands, const std::vector<OwnedPipeline>& pipelines,
                std::uint32_t ring_slot, const Constants& constants) const;

    const DeviceFunctions* vk_;
    AttachmentFormats formats_;
    OwnedSampler sampler_;
    DescriptorSets sets_;
    OwnedPipelineLayout layout_;
    std::vector<OwnedPipeline> depth_, shade_;  // One for each sample.
};

}  // namespace rimline
