#include "engine/passes/composite_pass.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "composite_frag.h"
#include "composite_vert.h"

namespace rimline {

namespace {

struct Constants {
    glm::vec3 color;
    VkOffset2D corner;
};

}  // namespace

std::optional<VkClearColorValue> composite_of(const glm::vec3& background, VkFormat format) {
    if (format != VK_FORMAT_R8G8B8A8_UNORM && format != VK_FORMAT_B8G8R8A8_UNORM) return {};
    VkClearColorValue value{.float32 = {0.0f, 0.0f, 0.0f, 1.0f}};
    for (int channel = 0; channel < 3; ++channel) {
        const double linear = std::clamp(double(background[channel]), 0.0, 1.0);
        const double steps =
            255.0 *
            (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
        const double step = std::round(steps);
        // The surfaces' half floats round by less than a twentieth of a step; colors given as 8-bit
        // sRGB lie at the center of a step.
        if (!(std::abs(steps - step) <= 0.4)) return {};
        value.float32[channel] = static_cast<float>(step / 255.0);
    }
    return value;
}

CompositePass::CompositePass(const DeviceContext& context)
    : surfaces_(context, "surfaces for the picture", 1),
      layout_(make_pipeline_layout(context, "picture", sizeof(Constants),
                                   VK_SHADER_STAGE_FRAGMENT_BIT, {surfaces_.layout()})) {}

void CompositePass::prepare(const DeviceContext& context, const CompositeKind& kind) {
    if (pipelines_.contains(kind)) return;
    const PictureEncoding encoding = encoding_of(kind.format);
    VkFormatProperties properties;
    context.vk->GetPhysicalDeviceFormatProperties(context.physical_device, kind.format,
                                                  &properties);
    const VkFormatFeatureFlags needed = kind.use == PictureUse::over
                                            ? VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT
                                            : VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT;
    if (encoding == PictureEncoding::impossible || (properties.optimalTilingFeatures & needed) == 0)
        throw Error(ErrorCode::bad_input,
                    "pictures cannot be drawn in VkFormat " + std::to_string(kind.format));
    RIMLINE_CHECK(kind.is_layer || kind.use == PictureUse::whole);
    const std::array<std::uint32_t, 5> constants{kind.scale, encoding == PictureEncoding::srgb,
                                                 kind.is_layer, kind.use == PictureUse::whole,
                                                 kind.use == PictureUse::straight};
    pipelines_.emplace(
        kind, make_graphics_pipeline(
                  context, "picture",
                  {.vertex = composite_vert,
                   .geometry = {},
                   .fragment = composite_frag,
                   .fragment_constants = constants,
                   .formats = {.color = kind.format},
                   .blend = kind.use == PictureUse::over ? Blend::premultiplied : Blend::replace,
                   .layout = layout_}));
}

void CompositePass::record(Commands commands, const CompositeKind& kind, const glm::vec3& color,
                           VkOffset2D corner) const {
    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.at(kind));
    const Constants constants{color, corner};
    const VkDescriptorSet set = surfaces_.get();
    commands->CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set,
                                    0, nullptr);
    commands->CmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                               &constants);
    commands->CmdDraw(commands, 3, 1, 0, 0);
}

}  // namespace rimline
