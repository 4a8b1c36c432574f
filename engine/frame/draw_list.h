#pragma once

// What the passes of one frame draw, resolved to places in buffers: they record from this and know nothing of
// scenes, trackers or streams.

#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/shadow_choice.h"
#include "shaders/layout.h"

namespace rimline {

/// Draw arguments in a buffer (gpu::SlotArguments), as a ChangeStream keeps them.
struct IndirectDraw {
    VkBuffer arguments = VK_NULL_HANDLE;
    static constexpr VkDeviceSize k_points = offsetof(gpu::SlotArguments, points);
    static constexpr VkDeviceSize k_strips = offsetof(gpu::SlotArguments, strips);
    static constexpr VkDeviceSize k_pointed_sides = offsetof(gpu::SlotArguments, pointed_sides);
    static constexpr VkDeviceSize k_sides = offsetof(gpu::SlotArguments, sides);
};

/// One instance as seen from one light.
struct DrawnLight {
    std::uint32_t data = 0;  ///< Where DrawData has its gpu::LightData.
    bool casts_shadow = false;
    bool ends_in_one_point = false;  ///< A directional light whose volumes reach infinity.
    IndirectDraw sides;              ///< Of the silhouette slots; only of casters.
    ShadowMethod method = ShadowMethod::fail;  ///< Not automatic.
    ShadowForm form = ShadowForm::general;     ///< Not automatic.
};

/// The whole of an instance's mesh, for line paths without slots (line_path.h).
struct EveryEdgeDraw {
    std::uint32_t regular_edge_count = 0;
    std::uint32_t irregular_pair_count = 0;
    std::uint32_t adjacency_index_count = 0;
    VkBuffer adjacency = VK_NULL_HANDLE;  ///< 32-bit indices, six a face.
};

struct DrawnInstance {
    std::uint32_t data = 0;             ///< Where DrawData has its gpu::InstanceData.
    VkBuffer indices = VK_NULL_HANDLE;  ///< Of its triangles' vertices, 32 bits each; three a face.
    std::uint32_t vertex_count = 0;
    std::uint32_t face_count = 0;
    std::uint32_t border_count = 0;
    std::uint32_t crease_count = 0;  ///< Those drawn as lines.
    std::uint32_t loose_count = 0;
    bool has_lines = false;
    bool fades = false;
    bool shows_backs = true;   ///< Else the backs of its faces are hidden behind fronts.
    std::size_t ink = 0;       ///< Of DrawList::inks: what its lines are drawn with.
    IndirectDraw silhouette;   ///< Of the slots; only where has_lines and the path draws them.
    EveryEdgeDraw every_edge;  ///< Only where has_lines and the path draws no slots.
    std::vector<DrawnLight> lights;  ///< One for each light of the frame.
};

/// A caster's volume, or that of some of its faces.
struct ShadowDraw {
    std::uint32_t instance = 0;
    std::uint32_t first_face = 0;
    std::uint32_t face_count = 0;
    /// Every face casts a volume of its own, in the general form; else all must be drawn.
    bool face_by_face = false;
};

/// What is counted before the stencil is folded (shadow_volume_pass.h).
struct ShadowBatch {
    std::vector<ShadowDraw> draws;
};

struct DrawList {
    VkDescriptorSet data = VK_NULL_HANDLE;  ///< DrawData's.
    std::size_t light_count = 0;
    bool shadows = false;
    bool is_orthographic = false;
    std::uint32_t style = RIMLINE_STYLE_INK;  ///< A RIMLINE_STYLE_ value.
    std::vector<DrawnInstance> instances;
    /// The colors of lines, each once, in linear light. Lines of a later one lie over those of others.
    std::vector<glm::vec3> inks;
    /// Of each light; where there is one batch it counts up to 255, else each up to 127.
    std::vector<std::vector<ShadowBatch>> shadow_batches;
};

constexpr VkShaderStageFlags k_draw_stages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_GEOMETRY_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// Tells the next draws what they draw: binds set 0, and pushes the constants.
inline void set_draw(VkCommandBuffer commands, VkPipelineLayout layout, const DrawList& list,
                     const DrawnInstance& instance, const DrawnLight* light, std::uint32_t choice) {
    const std::array<std::uint32_t, 2> offsets{instance.data, light ? light->data : 0};
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &list.data,
                            offsets.size(), offsets.data());
    const gpu::DrawConstants constants{choice};
    vkCmdPushConstants(commands, layout, k_draw_stages, 0, sizeof constants, &constants);
}

}  // namespace rimline
