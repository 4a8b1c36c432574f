#include "engine/passes/ink_pass.h"

#include "composite_vert.h"
#include "fold_ink_frag.h"
#include "grid_frag.h"
#include "ink_frag.h"

namespace rimline {

namespace {

struct GridConstants {
    glm::vec4 color;
    std::int32_t width, height, scale;
};

OwnedPipeline make_pipeline(const DeviceContext& context, const char* name, SpirvCode fragment,
                            VkFormat format, Blend blend, VkPipelineLayout layout) {
    return make_graphics_pipeline(context, name,
                                  {.vertex = composite_vert,
                                   .geometry = {},
                                   .fragment = fragment,
                                   .formats = {.color = format},
                                   .blend = blend,
                                   .layout = layout});
}

template <typename Constants>
void record(Commands commands, VkPipeline pipeline, VkPipelineLayout layout,
            const Constants& constants) {
    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    commands->CmdPushConstants(commands, layout, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                               &constants);
    commands->CmdDraw(commands, 3, 1, 0, 0);
}

}  // namespace

InkPass::InkPass(const DeviceContext& context, VkFormat surface_format)
    : surface_format_(surface_format),
      layout_(make_pipeline_layout(context, "grid and ink", sizeof(GridConstants),
                                   VK_SHADER_STAGE_FRAGMENT_BIT)),
      grid_(make_pipeline(context, "grid", grid_frag, surface_format, Blend::over, layout_)),
      ink_(make_pipeline(context, "ink", ink_frag, surface_format, Blend::over_by_target, layout_)),
      coverage_(context, "coverage of lines", 1),
      fold_layout_(make_pipeline_layout(context, "ink of a layer", sizeof(glm::vec3),
                                        VK_SHADER_STAGE_FRAGMENT_BIT, {coverage_.layout()})) {}

void InkPass::prepare_fold(const DeviceContext& context) {
    if (is_fold_prepared()) return;
    fold_ = make_pipeline(context, "ink of a layer", fold_ink_frag, surface_format_,
                          Blend::premultiplied, fold_layout_);
}

void InkPass::record_fold(Commands commands, const glm::vec3& ink) const {
    const VkDescriptorSet set = coverage_.get();
    commands->CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, fold_layout_, 0, 1,
                                    &set, 0, nullptr);
    record(commands, fold_, fold_layout_, ink);
}

void InkPass::record_grid(Commands commands, const glm::vec4& color, VkExtent2D size,
                          std::uint32_t scale) const {
    record(commands, grid_, layout_,
           GridConstants{color, static_cast<std::int32_t>(size.width),
                         static_cast<std::int32_t>(size.height), static_cast<std::int32_t>(scale)});
}

void InkPass::record_ink(Commands commands, const glm::vec3& ink) const {
    record(commands, ink_, layout_, ink);
}

}  // namespace rimline
