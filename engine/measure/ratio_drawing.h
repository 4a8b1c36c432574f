#pragma once

// Draws batches of viewpoints for visible ratios: surfaces into a depth image, lines against them, and the
// pixels of lines counted by the stencil.
//
//     stencil   0x01 nothing    0x00 a hidden line    0x80 a visible line, which stays
//
// Hidden lines decrement the stencil, visible ones replace it, and a pixel that is visible is drawn no more.
// So whatever the order of lines, each pixel passes the test of visible lines at most once, and one precise
// occlusion query counts visible pixels. A second query counts the pixels that hold either value.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

#include "engine/measure/ratio_view.h"
#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/pipeline.h"
#include "engine/vulkan/query_pool.h"

namespace rimline {

/// Stencil values of a finished view, beside 0.
constexpr std::uint8_t k_stencil_nothing = 1;
constexpr std::uint8_t k_stencil_visible = 0x80;

/// What a batch of viewpoints is drawn from and into.
struct RatioTargets {
    std::vector<Image> images;  ///< Depth and stencil: one for each viewpoint, or one for all.
    QueryPool
        queries;      ///< Two for each viewpoint; none without RatioDrawing::Options::has_queries.
    Buffer upload;    ///< Lines and copied faces.
    Buffer stencils;  ///< For pixels that are counted on the CPU.
};

class RatioDrawing {
public:
    struct Options {
        std::uint32_t side_px;
        std::uint32_t max_views;  ///< In a batch.
        bool has_queries;         ///< Pixels are counted by queries. The device's must be precise.
        bool has_separate_targets;  ///< As VisibleRatioMethod.
    };

    /// Uploads the mesh and waits. `triangles` are RatioViewBuilder::triangles(). The context's device must
    /// outlive the drawing. Throws Error{too_large} where the device's memory does not suffice.
    RatioDrawing(const DeviceContext& context, const Mesh& mesh,
                 std::span<const Triangle> triangles, const Options& options);

    /// Reserves memory for `views`, and copies their lines and faces there. `keeps_stencil`: the stencils
    /// are read back too. Throws Error{too_large} where the device's memory does not suffice.
    void prepare(RatioTargets& targets, std::span<const RatioView> views, bool keeps_stencil) const;

    /// Records everything of prepared views into `commands`, which have begun. Results are in the queries
    /// (visible pixels and all pixels of lines, for each view in turn) and the stencils.
    void record(Commands commands, const RatioTargets& targets, std::span<const RatioView> views,
                bool keeps_stencil) const;

    /// Bytes from one view's stencil to the next: side_px * side_px, rounded up to a multiple of 4.
    VkDeviceSize stencil_stride() const noexcept;

private:
    struct Places;

    void record_view(Commands commands, const RatioTargets& targets, const RatioView& view,
                     const Places& places, bool keeps_stencil) const;
    void record_faces(Commands commands, const RatioTargets& targets, const RatioView& view,
                      const Places& places) const;
    void record_lines(Commands commands, VkPipeline pipeline, std::uint32_t first,
                      std::uint32_t end) const;
    void record_stencil_copies(Commands commands, const RatioTargets& targets,
                               std::size_t view_count) const;

    DeviceContext context_;
    Options options_;
    Buffer positions_;
    Buffer triangles_;
    Buffer line_triangles_;
    OwnedPipelineLayout layout_;
    OwnedPipeline all_faces_, front_faces_;
    OwnedPipeline tested_lines_, hidden_lines_;
    OwnedPipeline count_;
};

}  // namespace rimline
