#pragma once

// Pipelines for dynamic rendering, described by the properties in which the passes differ.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/vulkan_handle.h"

namespace rimline {

using SpirvCode = std::span<const std::uint32_t>;

// Names are for debug_names.h.

/// Push constants of `size_bytes`, or none, for `stages`, and descriptor sets of `sets`.
OwnedPipelineLayout make_pipeline_layout(const DeviceContext& context, const std::string& name,
                                         std::uint32_t size_bytes, VkShaderStageFlags stages,
                                         std::initializer_list<VkDescriptorSetLayout> sets = {});

OwnedPipeline make_compute_pipeline(const DeviceContext& context, const std::string& name,
                                    SpirvCode code, VkPipelineLayout layout);

enum class Blend {
    replace,
    add,
    lighter,         ///< Each channel of color and alpha keeps its maximum.
    darker,          ///< Each channel of color keeps its minimum, and alpha its maximum.
    over,            ///< By the source's alpha; the target's alpha does not change.
    maximum_alpha,   ///< Alpha keeps its maximum; color does not change.
    over_by_target,  ///< By the target's alpha, which becomes zero.
    premultiplied,   ///< Over the target, color and alpha.
    none_written,    ///< The pass writes no color.
};

/// The limit of vertices in indexed draws. Larger indices need a device feature (fullDrawIndexUint32) that is
/// not required.
constexpr std::uint32_t k_max_indexed_vertices = 1u << 24;

enum class StencilUse {
    off,
    count,     ///< Always passes. Operations are dynamic state.
    zero,      ///< Passes if the stencil is zero. Writes nothing.
    not_zero,  ///< The opposite.
    given,     ///< GraphicsPipelineDescription::stencil_state, for both faces.
};

/// Formats and samples of the attachments a pipeline draws into.
struct AttachmentFormats {
    VkFormat color = VK_FORMAT_UNDEFINED;
    VkFormat depth_stencil = VK_FORMAT_UNDEFINED;
    std::uint32_t samples = 1;
    std::uint32_t color_count = 1;  ///< Attachments of `color`, at most k_max_colors.
    static constexpr std::uint32_t k_max_colors = 2;
};

/// Viewport and scissor are dynamic state. Counter-clockwise on the screen is front.
struct GraphicsPipelineDescription {
    SpirvCode vertex;
    SpirvCode geometry;  ///< Empty: none.
    SpirvCode fragment;  ///< Empty: none.
    /// The fragment stage's specialization constants 0, 1, ...; empty: none.
    std::span<const std::uint32_t> fragment_constants{};
    VkPrimitiveTopology topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    AttachmentFormats formats;
    Blend blend = Blend::replace;
    VkCompareOp depth_compare = VK_COMPARE_OP_ALWAYS;
    bool depth_write = false;
    bool depth_clamp = false;
    bool depth_bounds =
        false;  ///< Tests the stored depth; the bounds are dynamic state. A device feature.
    /// Slope-scaled depth bias: a multiple of the change of depth to the next pixel, right or down.
    float depth_bias_slopes = 0.0f;
    StencilUse stencil = StencilUse::off;
    VkStencilOpState stencil_state{};
    VkCullModeFlags cull = VK_CULL_MODE_NONE;
    std::uint32_t sample_mask = ~0u;  ///< Bit i: draws sample i.
    bool sets_cull = false;           ///< The cull mode is dynamic state instead.
    VkPipelineLayout layout = VK_NULL_HANDLE;
};

OwnedPipeline make_graphics_pipeline(const DeviceContext& context, const std::string& name,
                                     const GraphicsPipelineDescription& description);

}  // namespace rimline
