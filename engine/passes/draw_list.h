#pragma once

// The input of the passes of one frame: everything to draw, as places in buffers. Passes know nothing of
// scenes, trackers or streams.

#include <vulkan/vulkan.h>

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/shadow_choice.h"
#include "engine/stream/every_edge_draw.h"
#include "engine/stream/textured_faces.h"
#include "engine/vulkan/functions.h"
#include "shaders/layout.h"

namespace rimline {

/// Draw arguments in a buffer (gpu::SlotArguments), as in ChangeStream::arguments().
struct IndirectDraw {
    VkBuffer arguments = VK_NULL_HANDLE;
    static constexpr VkDeviceSize k_points = offsetof(gpu::SlotArguments, points);
    static constexpr VkDeviceSize k_strips = offsetof(gpu::SlotArguments, strips);
    static constexpr VkDeviceSize k_pointed_sides = offsetof(gpu::SlotArguments, pointed_sides);
    static constexpr VkDeviceSize k_sides = offsetof(gpu::SlotArguments, sides);
};

/// How the surfaces of an instance are drawn.
enum class SurfaceOutput {
    picture,   ///< Color, and no coverage by lines yet.
    layer,     ///< Premultiplied color and opacity.
    held_out,  ///< No color; shadows as opacity.
};

/// What gives the surfaces of an instance their color.
enum class SurfaceColors {
    one,       ///< InstanceData.color
    mesh,      ///< Its materials and the colors of its corners.
    textures,  ///< These and its textures.
};

/// How the lights of a frame reach its surfaces.
enum class SurfaceLights {
    together,  ///< One light without shadows: with the surface, in one draw.
    /// One light with shadows: likewise, and the surface in shadow into an image of its own, from which shadows take
    /// their color (shadow_color_pass.h).
    beside_shadow,
    apart,  ///< Each in a draw of its own, after the surface in shadow.
};

/// What lights that fill (Light::fills) keep of the surface in the other lights and of that in theirs. Only with lights
/// apart.
enum class SurfaceFilling {
    none,     ///< No light fills.
    lighter,  ///< The lighter one.
    darker,   ///< The darker one: light takes away strokes, which are lighter than the surface.
    left_out,  ///< Nothing: strokes of one color may be lighter than one surface and darker than another.
};

/// Surfaces that the same pipelines draw.
struct SurfaceKind {
    std::uint32_t style = RIMLINE_STYLE_INK;  ///< A RIMLINE_STYLE_ value.
    SurfaceColors colors = SurfaceColors::one;
    SurfaceOutput output = SurfaceOutput::picture;
    bool fades = false;
    SurfaceLights lights = SurfaceLights::apart;
    /// The surface in shadow is computed once for each vertex, not for each corner of a face. Only with lights apart.
    bool shades_vertices = false;
    SurfaceFilling filling = SurfaceFilling::none;
    auto operator<=>(const SurfaceKind&) const = default;
};

/// One instance as seen from one light.
struct DrawnLight {
    std::uint32_t data = 0;  ///< Offset of its gpu::LightData in DrawData.
    bool casts_shadow = false;
    bool fills = false;                        ///< Light::fills.
    bool ends_in_one_point = false;            ///< ShadowChoice::ends_in_one_point.
    bool clamps_depth = false;                 ///< Its volumes are not clipped at the near plane.
    IndirectDraw sides;                        ///< Draws its silhouette slots; only for casters.
    ShadowMethod method = ShadowMethod::fail;  ///< Not automatic.
    ShadowForm form = ShadowForm::general;     ///< Not automatic.
    bool shades_all = false;  ///< All surfaces are in its shadow, as if it were counted once.
    /// Where its volume is counted, in pixels of the pass, and at which stored depths. No extent: nowhere.
    VkRect2D rect{};
    float min_depth = 0.0f, max_depth = 1.0f;
};

/// The lines of an instance that have one color.
struct DrawnInk {
    std::size_t ink = 0;  ///< Index in DrawList::inks.
    /// Only lines of faces whose materials have this ink (InstanceData.face_inks).
    std::uint32_t material_ink = RIMLINE_ANY_INK;
    std::uint32_t first_segment = 0, segment_count = 0;  ///< Of an instance that draws segments.
};

struct DrawnInstance {
    std::uint32_t data = 0;             ///< Offset of its gpu::InstanceData in DrawData.
    VkBuffer indices = VK_NULL_HANDLE;  ///< Of its triangles' vertices, 32 bits each; three a face.
    std::uint32_t face_count = 0;
    std::uint32_t border_count = 0;
    std::uint32_t crease_count = 0;  ///< Creases drawn as lines.
    std::uint32_t loose_count = 0;
    bool has_lines = false;
    /// Its lines are segments, instead of its silhouette, borders and creases.
    bool has_segments = false;
    SurfaceKind surface;
    /// Of SurfaceColors::textures: ranges that hold all faces.
    std::span<const TexturedFaces> textured_faces;
    bool shows_backs = true;  ///< False: back faces are hidden behind front faces.
    /// Where backs are not shown: the faces to draw, as a range of DrawList::corners. None: all faces, by number.
    std::uint32_t first_corner = 0, corner_count = 0;
    std::vector<DrawnInk> inks;  ///< Only if has_lines.
    IndirectDraw silhouette;     ///< Draws its slots; only if has_lines and the path draws slots.
    EveryEdgeDraw every_edge;    ///< Only if has_lines and the path draws no slots.
    std::vector<DrawnLight> lights;  ///< One for each light of the frame.
};

/// The volume of a caster, or of a part of its faces.
struct ShadowDraw {
    /// Places in the lists of the caster's gpu::LightData.
    struct Part {
        std::uint32_t first_face, face_count;
        std::uint32_t first_side, side_count;
    };
    std::uint32_t instance = 0;
    std::optional<Part> part;
    /// With depth pass: what it counts before the near plane (near_count.h).
    std::uint32_t near_count = 0;
    bool has_volume = true;  ///< False: the near count is all of it.
};

/// The volumes counted between two folds of the stencil (shadow_volume_pass.h).
struct ShadowBatch {
    std::vector<ShadowDraw> draws;
};

struct DrawList {
    VkDescriptorSet data = VK_NULL_HANDLE;  ///< DrawData's.
    std::size_t light_count = 0;
    bool shadows = false;
    SurfaceLights surface_lights = SurfaceLights::apart;
    std::vector<DrawnInstance> instances;
    VkBuffer corners = VK_NULL_HANDLE;  ///< Numbers of corners, 32 bits each.
    /// The colors of lines, each once, in linear light. Lines of a later color lie over those of earlier
    /// ones.
    std::vector<glm::vec3> inks;
    /// The batches of each light, each of which counts up to 254.
    std::vector<std::vector<ShadowBatch>> shadow_batches;
};

constexpr VkShaderStageFlags k_draw_stages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_GEOMETRY_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

/// Selects the instance and the light of the next draws: binds set 0, and pushes the constants.
inline void set_draw(Commands commands, VkPipelineLayout layout, const DrawList& list,
                     const DrawnInstance& instance, const DrawnLight* light, std::uint32_t choice,
                     std::uint32_t material_ink = RIMLINE_ANY_INK) {
    const std::array<std::uint32_t, 2> offsets{instance.data, light ? light->data : 0};
    commands->CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1,
                                    &list.data, offsets.size(), offsets.data());
    const gpu::DrawConstants constants{choice, material_ink};
    commands->CmdPushConstants(commands, layout, k_draw_stages, 0, sizeof constants, &constants);
}

}  // namespace rimline
