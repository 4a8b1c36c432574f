#pragma once

// How visible ratios are measured (visible_ratio.h).

#include <cstdint>

namespace rimline {

/// Which faces are drawn. They only need to hide the lines (occluder_clusters.h).
enum class Occluders : std::uint8_t {
    automatic,  ///< The cheapest: `faces` on a CPU that stands in for a GPU, else `clusters`.
    all,        ///< Every face.
    clusters,   ///< The clusters of faces that may hide a line.
    faces,      ///< The faces that may hide a line.
};

/// How the ratio is counted. All methods give the same counts. The defaults are the fastest; the others are
/// for comparison and for devices that lack a feature.
struct VisibleRatioMethod {
    /// Counts pixels by occlusion queries, if those of the device are precise. Else the stencil is read
    /// back and counted on the CPU.
    bool counts_by_query = true;
    /// Each viewpoint of a batch has its own depth image. Else all share one, with a barrier between them;
    /// then pixels cannot be counted on the CPU.
    bool has_separate_targets = true;
    Occluders occluders = Occluders::automatic;
};

struct VisibleRatioOptions {
    /// Side of the square picture. 1 to the device's maxImageDimension2D.
    std::uint32_t side_px = 256;
    /// Field of view. 70.6 degrees hold the sphere around the mesh from sqrt(3) times its radius away.
    double fov_deg = 70.6;
    /// Whether the borders of open meshes are lines, as they are where lines are drawn.
    bool has_borders = true;
    /// Limit of the memory for the images and buffers of viewpoints in progress. One viewpoint at a time is
    /// always possible, whatever it takes. Does not include the mesh: 12 bytes a vertex and 24 a face.
    std::uint64_t budget_bytes = std::uint64_t{64} << 20;
    VisibleRatioMethod method;
};

}  // namespace rimline
