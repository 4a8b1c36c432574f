#include "engine/passes/backdrop_pass.h"

#include <array>
#include <string>

#include "backdrop_frag.h"
#include "backdrop_samples_frag.h"
#include "composite_vert.h"
#include "engine/vulkan/sampled_images.h"

namespace rimline {

namespace {

constexpr const char* k_name = "depth of the backdrop";

}  // namespace

BackdropPass::BackdropPass(const DeviceContext& context, const AttachmentFormats& formats,
                           std::uint32_t ring_slots)
    : vk_(context.vk.get()),
      formats_(formats),
      sampler_(make_sampler(context, k_name, VK_FILTER_NEAREST)),
      sets_(make_image_sets(context, k_name, sampler_.get(), 1, ring_slots)),
      layout_(make_pipeline_layout(context, k_name, sizeof(Constants), VK_SHADER_STAGE_FRAGMENT_BIT,
                                   {sets_.layout()})) {}

void BackdropPass::prepare(const DeviceContext& context, const BackdropDepth& backdrop) {
    if (backdrop.samples != formats_.samples)
        throw Error(ErrorCode::bad_input, "the backdrop's depth has " +
                                              std::to_string(backdrop.samples) +
                                              " samples a pixel, and the renderer takes " +
                                              std::to_string(formats_.samples));
    if (is_prepared()) return;
    // A draw for each sample, instead of a shader that runs for each: that needs a device feature.
    std::vector<OwnedPipeline> depth, shade;
    for (std::uint32_t sample = 0; sample < formats_.samples; ++sample) {
        const std::array<std::uint32_t, 1> constants{sample};
        GraphicsPipelineDescription description{.vertex = composite_vert,
                                                .geometry = {},
                                                .fragment = formats_.samples > 1
                                                                ? SpirvCode(backdrop_samples_frag)
                                                                : SpirvCode(backdrop_frag),
                                                .fragment_constants = constants,
                                                .formats = formats_,
                                                .blend = Blend::none_written,
                                                .depth_compare = VK_COMPARE_OP_ALWAYS,
                                                .depth_write = true,
                                                .sample_mask = 1u << sample,
                                                .layout = layout_};
        depth.push_back(make_graphics_pipeline(context, k_name, description));
        // Where the copied depth is still there, no surface has been drawn before it.
        description.blend = Blend::add;
        description.depth_compare = VK_COMPARE_OP_EQUAL;
        description.depth_write = false;
        description.stencil = StencilUse::not_zero;
        shade.push_back(make_graphics_pipeline(context, "shadow on the backdrop", description));
    }
    depth_ = std::move(depth);
    shade_ = std::move(shade);
}

void BackdropPass::set(std::uint32_t ring_slot, const BackdropDepth& backdrop) const {
    const VkDescriptorImageInfo image{.imageView = backdrop.view, .imageLayout = backdrop.layout};
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = sets_[ring_slot],
                                     .dstBinding = 0,
                                     .descriptorCount = 1,
                                     .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                     .pImageInfo = &image};
    vk_->UpdateDescriptorSets(vk_->device, 1, &write, 0, nullptr);
}

void BackdropPass::record_depth(Commands commands, std::uint32_t ring_slot, const BackdropMap& map,
                                VkOffset2D corner) const {
    record(commands, depth_, ring_slot, {map, 0.0f, corner});
}

void BackdropPass::record_shade(Commands commands, std::uint32_t ring_slot, const BackdropMap& map,
                                VkOffset2D corner, float opacity) const {
    record(commands, shade_, ring_slot, {map, opacity, corner});
}

void BackdropPass::record(Commands commands, const std::vector<OwnedPipeline>& pipelines,
                          std::uint32_t ring_slot, const Constants& constants) const {
    const VkDescriptorSet set = sets_[ring_slot];
    commands->CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set,
                                    0, nullptr);
    commands->CmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                               &constants);
    for (const OwnedPipeline& pipeline : pipelines) {
        commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        commands->CmdDraw(commands, 3, 1, 0, 0);
    }
}

}  // namespace rimline
