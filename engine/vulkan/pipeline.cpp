#include "engine/vulkan/pipeline.h"

#include <array>
#include <span>
#include <vector>

#include "engine/vulkan/debug_names.h"
#include "engine/vulkan/picture_target.h"

namespace rimline {

namespace {

OwnedShaderModule make_module(const DeviceContext& context, const std::string& name,
                              SpirvCode code) {
    const VkShaderModuleCreateInfo info{.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                        .codeSize = code.size_bytes(),
                                        .pCode = code.data()};
    VkShaderModule module = VK_NULL_HANDLE;
    vk_check(context.vk->CreateShaderModule(context.device, &info, nullptr, &module),
             "vkCreateShaderModule");
    set_name(*context.vk, VK_OBJECT_TYPE_SHADER_MODULE, module, name);
    return {context, module};
}

VkPipelineShaderStageCreateInfo stage_of(VkShaderStageFlagBits stage, VkShaderModule module) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
            .stage = stage,
            .module = module,
            .pName = "main"};
}

VkPipelineColorBlendAttachmentState blend_state(Blend blend) {
    constexpr VkColorComponentFlags k_color =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT;
    constexpr VkColorComponentFlags k_alpha = VK_COLOR_COMPONENT_A_BIT;
    VkPipelineColorBlendAttachmentState state{.blendEnable = VK_TRUE,
                                              .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                              .dstColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                              .colorBlendOp = VK_BLEND_OP_ADD,
                                              .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                              .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                              .alphaBlendOp = VK_BLEND_OP_ADD,
                                              .colorWriteMask = k_color | k_alpha};
    switch (blend) {
        case Blend::replace: state.blendEnable = VK_FALSE; break;
        case Blend::add: break;
        case Blend::lighter:
        case Blend::darker:
            state.colorBlendOp = blend == Blend::lighter ? VK_BLEND_OP_MAX : VK_BLEND_OP_MIN;
            state.alphaBlendOp = VK_BLEND_OP_MAX;
            break;
        case Blend::over:
            state.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
            state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
            state.colorWriteMask = k_color;
            break;
        case Blend::maximum_alpha:
            state.alphaBlendOp = VK_BLEND_OP_MAX;
            state.colorWriteMask = k_alpha;
            break;
        case Blend::over_by_target:
            state.srcColorBlendFactor = VK_BLEND_FACTOR_DST_ALPHA;
            state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA;
            state.srcAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
            state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ZERO;
            break;
        case Blend::premultiplied:
            state.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
            state.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
            break;
        case Blend::none_written:
            state.blendEnable = VK_FALSE;
            state.colorWriteMask = 0;
            break;
    }
    return state;
}

VkStencilOpState stencil_state(const GraphicsPipelineDescription& description) {
    if (description.stencil == StencilUse::given) return description.stencil_state;
    const bool counts = description.stencil == StencilUse::count;
    const VkCompareOp not_counting =
        description.stencil == StencilUse::not_zero ? VK_COMPARE_OP_NOT_EQUAL : VK_COMPARE_OP_EQUAL;
    return {.failOp = VK_STENCIL_OP_KEEP,
            .passOp = VK_STENCIL_OP_KEEP,
            .depthFailOp = VK_STENCIL_OP_KEEP,
            .compareOp = counts ? VK_COMPARE_OP_ALWAYS : not_counting,
            .compareMask = 0xff,
            .writeMask = counts ? 0xffu : 0u,
            .reference = 0};
}

// The modules and the specialization constants of a pipeline's stages.
class ShaderStages {
public:
    ShaderStages(const DeviceContext& context, const std::string& name,
                 const GraphicsPipelineDescription& description) {
        const auto add = [&](VkShaderStageFlagBits stage, SpirvCode code) {
            if (code.empty()) return;
            modules_.push_back(make_module(context, name, code));
            stages_.push_back(stage_of(stage, modules_.back()));
        };
        add(VK_SHADER_STAGE_VERTEX_BIT, description.vertex);
        add(VK_SHADER_STAGE_GEOMETRY_BIT, description.geometry);
        add(VK_SHADER_STAGE_FRAGMENT_BIT, description.fragment);
        for (std::uint32_t i = 0; i < description.fragment_constants.size(); ++i)
            entries_.push_back({.constantID = i, .offset = 4 * i, .size = 4});
        constants_ = {.mapEntryCount = static_cast<std::uint32_t>(entries_.size()),
                      .pMapEntries = entries_.data(),
                      .dataSize = description.fragment_constants.size_bytes(),
                      .pData = description.fragment_constants.data()};
        if (!entries_.empty()) stages_.back().pSpecializationInfo = &constants_;
    }
    ShaderStages(const ShaderStages&) = delete;
    ShaderStages& operator=(const ShaderStages&) = delete;

    std::span<const VkPipelineShaderStageCreateInfo> all() const noexcept { return stages_; }

private:
    std::vector<OwnedShaderModule> modules_;
    std::vector<VkSpecializationMapEntry> entries_;
    VkSpecializationInfo constants_{};
    std::vector<VkPipelineShaderStageCreateInfo> stages_;
};

// The formats and the blending of a pipeline's color attachments.
class ColorAttachments {
public:
    explicit ColorAttachments(const GraphicsPipelineDescription& description)
        : count_(description.formats.color == VK_FORMAT_UNDEFINED
                     ? 0
                     : description.formats.color_count) {
        RIMLINE_CHECK(count_ <= AttachmentFormats::k_max_colors);
        states_.fill(blend_state(description.blend));
        formats_.fill(description.formats.color);
    }

    // The structures point into this object.
    VkPipelineColorBlendStateCreateInfo blend() const noexcept {
        return {.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                .attachmentCount = count_,
                .pAttachments = states_.data()};
    }
    VkPipelineRenderingCreateInfo rendering(VkFormat depth_stencil) const noexcept {
        const bool has_stencil = (depth_aspects(depth_stencil) & VK_IMAGE_ASPECT_STENCIL_BIT) != 0;
        return {.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                .colorAttachmentCount = count_,
                .pColorAttachmentFormats = formats_.data(),
                .depthAttachmentFormat = depth_stencil,
                .stencilAttachmentFormat = has_stencil ? depth_stencil : VK_FORMAT_UNDEFINED};
    }

private:
    std::uint32_t count_;
    std::array<VkPipelineColorBlendAttachmentState, AttachmentFormats::k_max_colors> states_;
    std::array<VkFormat, AttachmentFormats::k_max_colors> formats_;
};

VkPipelineRasterizationStateCreateInfo raster_state(
    const GraphicsPipelineDescription& description) {
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
            .depthClampEnable = description.depth_clamp,
            .polygonMode = VK_POLYGON_MODE_FILL,
            .cullMode = description.cull,
            .frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE,
            .depthBiasEnable = description.depth_bias_slopes != 0.0f,
            .depthBiasSlopeFactor = description.depth_bias_slopes,
            .lineWidth = 1.0f};
}

VkPipelineDepthStencilStateCreateInfo depth_stencil_state(
    const GraphicsPipelineDescription& description) {
    const VkStencilOpState stencil = stencil_state(description);
    return {.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
            .depthTestEnable = description.formats.depth_stencil != VK_FORMAT_UNDEFINED,
            .depthWriteEnable = description.depth_write,
            .depthCompareOp = description.depth_compare,
            .depthBoundsTestEnable = description.depth_bounds,
            .stencilTestEnable = description.stencil != StencilUse::off,
            .front = stencil,
            .back = stencil};
}

std::vector<VkDynamicState> dynamic_states_of(const GraphicsPipelineDescription& description) {
    std::vector<VkDynamicState> states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    if (description.stencil == StencilUse::count) states.push_back(VK_DYNAMIC_STATE_STENCIL_OP);
    if (description.depth_bounds) states.push_back(VK_DYNAMIC_STATE_DEPTH_BOUNDS);
    if (description.sets_cull) states.push_back(VK_DYNAMIC_STATE_CULL_MODE);
    return states;
}

}  // namespace

OwnedPipelineLayout make_pipeline_layout(const DeviceContext& context, const std::string& name,
                                         std::uint32_t size_bytes, VkShaderStageFlags stages,
                                         std::initializer_list<VkDescriptorSetLayout> sets) {
    const VkPushConstantRange range{.stageFlags = stages, .size = size_bytes};
    const VkPipelineLayoutCreateInfo info{.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                          .setLayoutCount = static_cast<std::uint32_t>(sets.size()),
                                          .pSetLayouts = sets.begin(),
                                          .pushConstantRangeCount = size_bytes > 0 ? 1u : 0u,
                                          .pPushConstantRanges = &range};
    VkPipelineLayout layout = VK_NULL_HANDLE;
    vk_check(context.vk->CreatePipelineLayout(context.device, &info, nullptr, &layout),
             "vkCreatePipelineLayout");
    set_name(*context.vk, VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout, name);
    return {context, layout};
}

OwnedPipeline make_compute_pipeline(const DeviceContext& context, const std::string& name,
                                    SpirvCode code, VkPipelineLayout layout) {
    const OwnedShaderModule module = make_module(context, name, code);
    const VkComputePipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                           .stage = stage_of(VK_SHADER_STAGE_COMPUTE_BIT, module),
                                           .layout = layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    vk_check(context.vk->CreateComputePipelines(context.device, context.pipeline_cache, 1, &info,
                                                nullptr, &pipeline),
             "vkCreateComputePipelines");
    set_name(*context.vk, VK_OBJECT_TYPE_PIPELINE, pipeline, name);
    return {context, pipeline};
}

OwnedPipeline make_graphics_pipeline(const DeviceContext& context, const std::string& name,
                                     const GraphicsPipelineDescription& description) {
    const ShaderStages stages(context, name, description);
    const VkPipelineVertexInputStateCreateInfo no_vertices{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
    const VkPipelineInputAssemblyStateCreateInfo assembly{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = description.topology};
    const VkPipelineViewportStateCreateInfo viewport{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1};
    const VkPipelineRasterizationStateCreateInfo raster = raster_state(description);
    const AttachmentFormats& formats = description.formats;
    const VkPipelineMultisampleStateCreateInfo multisample{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = static_cast<VkSampleCountFlagBits>(formats.samples),
        .pSampleMask = &description.sample_mask};
    const VkPipelineDepthStencilStateCreateInfo depth_stencil = depth_stencil_state(description);
    const ColorAttachments colors(description);
    const std::vector<VkDynamicState> dynamic_states = dynamic_states_of(description);
    const VkPipelineDynamicStateCreateInfo dynamic{
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size()),
        .pDynamicStates = dynamic_states.data()};
    const VkPipelineColorBlendStateCreateInfo blend = colors.blend();
    const VkPipelineRenderingCreateInfo rendering = colors.rendering(formats.depth_stencil);
    const VkGraphicsPipelineCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext = &rendering,
        .stageCount = static_cast<std::uint32_t>(stages.all().size()),
        .pStages = stages.all().data(),
        .pVertexInputState = &no_vertices,
        .pInputAssemblyState = &assembly,
        .pViewportState = &viewport,
        .pRasterizationState = &raster,
        .pMultisampleState = &multisample,
        .pDepthStencilState = &depth_stencil,
        .pColorBlendState = &blend,
        .pDynamicState = &dynamic,
        .layout = description.layout};
    VkPipeline pipeline = VK_NULL_HANDLE;
    vk_check(context.vk->CreateGraphicsPipelines(context.device, context.pipeline_cache, 1, &info,
                                                 nullptr, &pipeline),
             "vkCreateGraphicsPipelines");
    set_name(*context.vk, VK_OBJECT_TYPE_PIPELINE, pipeline, name);
    return {context, pipeline};
}

}  // namespace rimline
