#pragma once

// What the passes of one frame draw, resolved to addresses: they record from this and know nothing of
// scenes, trackers or streams.

#include <vulkan/vulkan.h>

#include <vector>

#include "shaders/layout.h"

namespace rimline {

/// Draw arguments in a buffer (VkDrawIndirectCommand), as a ChangeStream keeps them.
struct IndirectDraw {
    VkBuffer arguments = VK_NULL_HANDLE;
};

/// One instance as seen from one light.
struct DrawnLight {
    VkDeviceAddress data = 0;  ///< gpu::LightData.
    bool casts_shadow = false;
    bool ends_in_one_point = false;  ///< A directional light whose volumes reach infinity.
    IndirectDraw sides;              ///< One point a silhouette slot; only of casters.
};

struct DrawnInstance {
    VkDeviceAddress data = 0;  ///< gpu::InstanceData.
    std::uint32_t face_count = 0;
    std::uint32_t border_count = 0;
    std::uint32_t loose_count = 0;
    bool has_lines = false;
    IndirectDraw silhouette;         ///< One point a silhouette slot; only where has_lines.
    std::vector<DrawnLight> lights;  ///< One for each light of the frame.
};

struct DrawList {
    VkDeviceAddress frame = 0;  ///< gpu::FrameData.
    std::size_t light_count = 0;
    bool shadows = false;
    std::vector<DrawnInstance> instances;
};

constexpr VkShaderStageFlags k_draw_stages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_GEOMETRY_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

inline void push_draw_constants(VkCommandBuffer commands, VkPipelineLayout layout,
                                const DrawList& list, const DrawnInstance& instance,
                                const DrawnLight* light, std::uint32_t choice) {
    const gpu::DrawConstants constants{list.frame, instance.data, light ? light->data : 0, choice,
                                       0};
    vkCmdPushConstants(commands, layout, k_draw_stages, 0, sizeof constants, &constants);
}

}  // namespace rimline
