#pragma once

// The visible ratio (thesis 4.5.3): the part of the pixels covered by a mesh's silhouette that show it.
//
//     ratio = |pixels of lines drawn with the depth test| / |pixels of lines drawn without|
//
// Each pixel counts once, however many edges cross it. If nothing is drawn the ratio is 0.
//
//   Lines cover every pixel that an edge passes through. They are drawn as triangles: Vulkan defines the
//     pixels of triangles up to the rounding of corners, and leaves those of lines to the device.
//   Depth. The center of a line's pixel lies up to 1/sqrt(2) pixel beside the edge, over a surface that
//     bulges towards the viewer there. So surfaces are drawn farther away, by twice the change of their
//     depth from a pixel to the next (Vulkan's slope-scaled bias). A sphere needs that much: t inside the
//     rim of a sphere of radius R the surface is sqrt(2Rt) nearer. Its slope is sqrt(R/2t), the larger
//     component of the slope at least 1/sqrt(2) of it, and sqrt(2Rt) <= 2 sqrt(R/2t) / sqrt(2) where
//     t <= 1/sqrt(2). Lines are moved nearer by 1e-5 of their distance, for borders of surfaces without a
//     slope. A surface that lies less than this in front of a line does not hide it.
//   Valleys, the concave silhouette edges of solids, need no test (ratio_view.h).
//
// Each viewpoint of a batch has its own depth image, so a batch needs one barrier. Only faces that may hide
// a line are drawn (occluder_clusters.h). While the GPU draws a batch, the CPU finds the silhouettes of the
// next one, on all threads that oneTBB gives. The stencil counts each pixel once (ratio_drawing.h).

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/measure/ratio_drawing.h"
#include "engine/measure/ratio_view.h"
#include "engine/measure/visible_ratio_options.h"
#include "engine/vulkan/device_context.h"
#include "silhouette/hough/hough_octree.h"

namespace rimline {

struct VisibleRatio {
    std::uint32_t visible_pixels = 0;
    std::uint32_t total_pixels = 0;

    double ratio() const noexcept {
        return total_pixels == 0 ? 0.0 : double(visible_pixels) / total_pixels;
    }
    bool operator==(const VisibleRatio&) const noexcept = default;
};

/// What a pixel shows of the lines.
enum class LinePixel : std::uint8_t { none, hidden, visible };

/// For one mesh. One thread at a time; that thread must be the only user of the device's queue.
class VisibleRatioPass {
public:
    /// Finds out whether the mesh is solid, uploads it and waits. The device, and the octree with its mesh,
    /// must outlive the pass. Throws Error{too_large} where the device's memory does not suffice and for a
    /// mesh of more than 2^24 vertices; Error{cancelled} where `stop` is requested, which is checked while
    /// the mesh is tested for being solid.
    VisibleRatioPass(const DeviceContext& context, const HoughOctree& octree,
                     const VisibleRatioOptions& options = {}, const std::stop_token& stop = {});

    /// One ratio for each viewpoint, in order. Viewpoints are in the mesh's coordinates, within
    /// k_max_coordinate, any number, and anywhere, also inside the mesh. They look at the mesh's center (a
    /// viewpoint at the center along -z), with its up axis upwards. Where `call` is cancelled, throws
    /// Error{cancelled} when the drawing in progress is done. After that and any other error the next call
    /// works as the first.
    std::vector<VisibleRatio> measure(std::span<const glm::dvec3> eyes, const LongCall& call = {});

    /// The pixels of one viewpoint, row by row from the upper left corner. Waits.
    std::vector<LinePixel> mask(const glm::dvec3& eye);

    /// Number of faces and lines drawn by the last call of measure().
    struct Work {
        std::uint64_t faces = 0;
        std::uint64_t lines = 0;
    };
    const Work& work() const noexcept { return work_; }

private:
    // A batch of viewpoints. The GPU is done with it when the timeline reaches `end`.
    struct Batch {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        RatioTargets targets;
        std::size_t first_view = 0;
        std::size_t view_count = 0;  // 0: not in progress.
        std::uint64_t end = 0;
    };

    bool counts_by_query() const noexcept;
    std::size_t views_a_batch() const noexcept;
    std::size_t build_views(std::span<const glm::dvec3> eyes);
    std::size_t submit(Batch& batch, std::span<const glm::dvec3> eyes, bool keeps_stencil);
    void enqueue(Batch& batch);
    void wait_for(const Batch& batch) const;
    void finish(Batch& batch, std::span<VisibleRatio> ratios) const;

    DeviceContext context_;
    const HoughOctree& octree_;
    VisibleRatioOptions options_;
    RatioViewBuilder builder_;
    RatioDrawing drawing_;
    OwnedSemaphore timeline_;
    OwnedCommandPool command_pool_;
    std::array<Batch, 2> batches_;  // One drawn by the GPU, one prepared by the CPU.
    std::vector<RatioView> views_;
    std::uint64_t submitted_ = 0;
    Work work_;
};

}  // namespace rimline
