#pragma once

// The visible ratio (thesis 4.5.3) by rays, without a device: which part of the pixels that a mesh's silhouette covers
// shows it.
//
// The ratio is that of engine/measure/visible_ratio.h, pixel by pixel: of the lines that pass through a pixel the
// nearest counts, and it is hidden if a ray through the pixel's center meets a face before it that lies farther in
// front of it than the depth bias there. A concave edge of a solid is hidden. What differs is rounding at the corners
// of faces: over 1,800 viewpoints of nine meshes the ratios differ by 0.002 at most.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "silhouette/hough/hough_octree.h"

namespace rimline {

class RayRatios {
public:
    /// As VisibleRatioOptions of the engine.
    struct Options {
        std::uint32_t side_px = 256;  ///< Not 0.
        double fov_deg = 70.6;        ///< Between 0 and 180.
        bool has_borders = true;
    };

    /// `octree` and its mesh must outlive this object. O(faces log faces). Throws Error{cancelled}.
    RayRatios(const HoughOctree& octree, const Options& options, const LongCall& call = {});
    explicit RayRatios(const HoughOctree& octree) : RayRatios(octree, {}) {}
    RayRatios(HoughOctree&&, const Options&,
              const LongCall& = {}) = delete;  // A temporary would dangle.
    explicit RayRatios(HoughOctree&&) = delete;
    ~RayRatios();

    /// One ratio for each viewpoint, in order; 0 where there is no line. Viewpoints are in the mesh's coordinates,
    /// within k_max_coordinate, and look at the mesh's center, with its up axis upwards. Lines end at the near plane, a
    /// ten-thousandth of the mesh's radius before the viewer. O(pixels of lines x log faces): one to three milliseconds
    /// for each on one thread. Uses all threads of oneTBB. Throws Error{cancelled}. Thread-safe.
    std::vector<double> measure(std::span<const glm::dvec3> eyes,
                                const std::stop_token& stop = {}) const;

private:
    struct Faces;
    struct View;
    struct Scratch;

    View view_from(const glm::dvec3& eye) const;
    void cover_pixels(const View& view, Scratch& scratch) const;
    bool is_visible(const View& view, std::uint32_t pixel, float line_nearness) const;

    const HoughOctree& octree_;
    const Mesh& mesh_;
    Options options_;
    std::unique_ptr<const Faces> faces_;
};

}  // namespace rimline
