#pragma once

// Silhouette, border and crease lines, and lines of a caller, with a width in pixels and round ends, as
// coverage in the surfaces' alpha. The ink and composite passes put color there (ink_pass.h, composite_pass.h).

#include "engine/line_path.h"
#include "engine/passes/draw_list.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/pipeline.h"
#include "engine/vulkan/sampled_images.h"

namespace rimline {

class LinePass {
public:
    /// Draws into the alpha of one color attachment of `surface_format`, one sample a pixel, by the path that
    /// choose_line_path() takes for `path` (line_path_choice.h). Throws what it does.
    LinePass(const DeviceContext& context, VkDescriptorSetLayout draw_data, VkFormat surface_format,
             LinePath path = LinePath::automatic);

    /// Not automatic.
    LinePath path() const noexcept { return path_; }

    /// Make the pipelines of lines of meshes, and of lines of a caller, if there are none yet. Needed before a list
    /// with such lines is recorded.
    void prepare_edges(const DeviceContext& context);
    void prepare_segments(const DeviceContext& context);
    bool has_edges() const noexcept { return edges_ != VK_NULL_HANDLE; }
    bool has_segments() const noexcept { return segments_ != VK_NULL_HANDLE; }

    /// The finished depth of the surfaces, one sample a pixel.
    void set_surface_depth(const Image& depth) { depth_.set({&depth}); }

    /// Draws the lines of one color. Inside a rendering scope whose alpha is zero, or holds lines of this
    /// color.
    void record(Commands commands, const DrawList& list, std::size_t ink) const;

private:
    void record_list(Commands commands, std::uint32_t edge_count) const;
    void record_edges(Commands commands, const DrawList& list, const DrawnInstance& instance,
                      std::uint32_t material_ink) const;
    void record_every_edge(Commands commands, const DrawList& list,
                           const DrawnInstance& instance) const;

    VkFormat surface_format_;
    LinePath path_;
    SampledImages depth_;
    OwnedPipelineLayout layout_;
    OwnedPipeline edges_;
    OwnedPipeline segments_;   // Needs no geometry shaders.
    OwnedPipeline adjacency_;  // Only with LinePath::adjacency.
};

}  // namespace rimline
