#pragma once

// The visible ratio (thesis 4.5.3): of the pixels that a mesh's silhouette covers, how many show it.
//
//     ratio = |pixels of lines drawn with the depth test| / |pixels of lines drawn without|
//
// Each pixel counts once, however many edges cross it, and nothing drawn counts as 0.
//
//   Lines cover every pixel that an edge passes through. They are drawn as triangles, whose pixels Vulkan
//     fixes up to the rounding of corners, where those of its lines are the device's choice.
//   Depth. The middle of a line's pixel lies up to 1/√2 pixel beside the edge, over a surface that bulges
//     towards the viewer there. So surfaces are drawn farther away, by twice what their depth changes
//     from a pixel to the next (Vulkan's slope-scaled bias). That is what a sphere needs: t inside the
//     rim of a sphere of radius R it is √(2Rt) nearer, its slope is √(R/2t), the larger component of
//     that at least 1/√2 of it, and √(2Rt) <= 2 √(R/2t) / √2 where t <= 1/√2. Lines come nearer by a part
//     in 100,000 of their distance, for borders of surfaces without a slope. What hides a line by less
//     than this does not hide it.
//   Valleys. A concave silhouette edge of a solid (silhouette/mesh/solid.h), seen from outside, is always
//     hidden, by the solid itself (silhouette/mesh/edge_convexity.h), but by little, which the bias would
//     let through. It is drawn as hidden without a test. Nor are the backs of a solid's faces drawn.
//
// Lines are drawn once. The stencil remembers what was hidden and what was seen, and lets every pixel be
// seen once, which one precise occlusion query counts; another counts the pixels that hold either.
// Every viewpoint of a batch has a depth image of its own: one barrier a batch. Of the faces only those
// are drawn that may hide a line (occluder_clusters.h). While the GPU draws one batch, the CPU finds the
// silhouettes of the next, on all threads that oneTBB gives.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/measure/occluder_clusters.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/pipeline.h"
#include "shaders/layout.h"
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

/// Which faces are drawn.
enum class Occluders : std::uint8_t {
    automatic,  ///< By what costs least: `faces` on a CPU that stands in for a GPU, else `clusters`.
    all,
    clusters,  ///< Those in clusters of faces that may hide a line.
    faces,     ///< Those that may hide a line.
};

/// How it is done. All ways give the same counts; the defaults are the fastest, the others for
/// comparison and for devices that lack something.
struct VisibleRatioMethod {
    /// By occlusion query, where the device's are precise. Else the stencil is read back and counted on
    /// the CPU.
    bool counts_by_query = true;
    /// A depth image for each viewpoint of a batch. Else all share one, with a barrier between; they
    /// cannot be counted on the CPU then.
    bool has_separate_targets = true;
    Occluders occluders = Occluders::automatic;
};

/// What a pixel shows of the lines.
enum class LinePixel : std::uint8_t { none, hidden, visible };

struct VisibleRatioOptions {
    /// Of the square picture. 1 to the device's maxImageDimension2D.
    std::uint32_t side_px = 256;
    /// Field of view. 70.6° hold the sphere around the mesh from √3 times its radius away.
    double fov_deg = 70.6;
    /// Whether the borders of open meshes are lines, as they are where lines are drawn.
    bool has_borders = true;
    /// What images and buffers of viewpoints in work may take; those of one viewpoint at a time are made
    /// whatever they take. What the mesh itself takes, 12 bytes a vertex and 24 a face, is not in it.
    std::uint64_t budget_bytes = std::uint64_t{64} << 20;
    VisibleRatioMethod method;
};

/// For one mesh; one thread at a time, which also has the device's queue for itself.
class VisibleRatioPass {
public:
    /// Finds out whether the mesh is solid, uploads it and waits. Device and octree, with its mesh, must
    /// outlive the pass. Throws Error{too_large} where the device has no room, and of more than 2^24
    /// vertices; Error{cancelled} where `stop` is requested, which ends the first of these.
    VisibleRatioPass(const DeviceContext& context, const HoughOctree& octree,
                     const VisibleRatioOptions& options = {}, const std::stop_token& stop = {});
    ~VisibleRatioPass();
    VisibleRatioPass(const VisibleRatioPass&) = delete;
    VisibleRatioPass& operator=(const VisibleRatioPass&) = delete;

    /// Of each viewpoint, in order. They are in the mesh's coordinates, within k_max_coordinate, look at
    /// its center (one at the center along -z), with its up axis upwards, and may lie anywhere: inside
    /// the mesh too. Any number. A cancelled `call` throws Error{cancelled}, once what is being drawn
    /// is done; the next call is as good as the first, after any other error too.
    std::vector<VisibleRatio> measure(std::span<const glm::dvec3> eyes, const LongCall& call = {});

    /// The pixels of one viewpoint, row by row from the upper left corner. Waits.
    std::vector<LinePixel> mask(const glm::dvec3& eye);

    /// What the last call of measure() drew.
    struct Work {
        std::uint64_t faces = 0;
        std::uint64_t lines = 0;
    };
    const Work& work() const noexcept { return work_; }

private:
    // What is drawn of one viewpoint.
    struct View {
        gpu::RatioConstants constants;
        std::vector<gpu::LineEnds> lines;  // Those that are hidden anyway come last.
        std::uint32_t tested_lines;
        std::vector<IndexRun> faces;
        std::vector<Triangle> copied_faces;  // Drawn in place of `faces` where not empty.
        std::uint64_t copied_faces_at;       // In the batch's upload.
        bool culls_backs;

        std::uint64_t upload_bytes() const noexcept {
            return lines.size() * sizeof lines[0] + copied_faces.size() * sizeof copied_faces[0];
        }
    };
    // A batch of viewpoints in work; ends when the timeline reaches `end`.
    struct Batch {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        OwnedQueryPool queries;
        std::vector<Image> targets;
        Buffer upload;    // Lines, copied faces.
        Buffer stencils;  // Only where pixels are counted on the CPU.
        std::size_t first_view = 0;
        std::size_t view_count = 0;  // 0: nothing in work.
        std::uint64_t end = 0;
    };
    struct ThreadRoom;
    struct Room;  // One ThreadRoom a thread.

    bool counts_by_query() const noexcept;
    VkDeviceSize stencil_stride() const noexcept;
    std::size_t views_a_batch() const noexcept;
    void prepare(View& view, const glm::dvec3& eye, ThreadRoom& room) const;
    void prepare_targets(Batch& batch, std::size_t view_count, bool keeps_stencil);
    // Prepares and draws some of `eyes`, from the first on: at least one. Returns how many.
    std::size_t submit(Batch& batch, std::span<const glm::dvec3> eyes, bool keeps_stencil);
    void record(const Batch& batch, std::size_t view_count, bool keeps_stencil) const;
    void record_view(const Batch& batch, std::size_t view, bool keeps_stencil) const;
    void wait_for(const Batch& batch) const;
    void finish(Batch& batch, std::span<VisibleRatio> ratios) const;

    DeviceContext context_;
    const HoughOctree& octree_;
    VisibleRatioOptions options_;
    OccluderClusters clusters_;
    Occluders occluders_;
    bool is_solid_;
    std::vector<std::uint32_t> concave_bits_;
    Buffer positions_;
    Buffer triangles_;
    Buffer line_triangles_;
    OwnedPipelineLayout layout_;
    OwnedPipeline all_faces_, front_faces_;
    OwnedPipeline tested_lines_, hidden_lines_;
    OwnedPipeline count_;
    OwnedSemaphore timeline_;
    OwnedCommandPool command_pool_;
    std::array<Batch, 2> batches_;
    std::vector<View> views_;
    std::unique_ptr<Room> room_;
    std::uint64_t submitted_ = 0;
    Work work_;
};

}  // namespace rimline
