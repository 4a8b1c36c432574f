#pragma once

// Panels, letters and handles over a finished picture: flat triangles, each inside a scissor, their
// opacity taken from one texture.
//
// Colors are sRGB and are blended as they are stored, not in linear light as surfaces are: interfaces are
// designed for that, and letters keep the weight of their font. So the picture must be an UNORM image that
// holds sRGB values, as the composite pass writes them.
//
// Vertices and indices are pulled by address; only the texture is bound. The types are plain, so that the
// output of any toolkit that makes triangles can be drawn.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline.h"
#include "engine/vulkan/sampled_images.h"
#include "shaders/overlay_layout.h"

namespace rimline {

/// The overlay of one frame, drawn in order.
struct OverlayDrawing {
    /// Triangles of `index_count` / 3 corners from `first_index` on, visible inside `scissor` (pixels).
    struct Part {
        std::uint32_t first_index = 0;
        std::uint32_t index_count = 0;
        VkRect2D scissor{};
    };

    glm::vec2 origin{0.0f};     ///< Of vertices, at the picture's upper left corner.
    glm::vec2 unit_size{1.0f};  ///< The picture's width and height in the units of vertices.
    std::vector<gpu::OverlayVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<Part> parts;

    void clear() noexcept {
        vertices.clear();
        indices.clear();
        parts.clear();
    }
};

class OverlayPass {
public:
    /// Draws into images of `picture_format`, UNORM. `ring_slots` frames may be in flight. The texture
    /// is opaque until set_texture().
    OverlayPass(const DeviceContext& context, VkFormat picture_format, std::uint32_t ring_slots);

    /// `opacity` holds width * height bytes, rows from the top. Uploads and waits; not while a frame
    /// that draws is in flight.
    void set_texture(std::uint32_t width, std::uint32_t height,
                     std::span<const std::uint8_t> opacity);

    /// Inside a rendering scope over the picture of size `extent`. Scissors are cut to it. The frame
    /// that used `ring_slot` last must be done.
    void record(Commands commands, std::uint32_t ring_slot, const OverlayDrawing& drawing,
                VkExtent2D extent);

private:
    DeviceContext context_;
    SampledImages images_;
    Image texture_;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
    std::vector<Buffer> ring_;
};

}  // namespace rimline
