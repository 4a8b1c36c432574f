#pragma once

// What is drawn to measure the visible ratio of one viewpoint: the silhouette's edges and the faces that may
// hide them, found on the CPU.
//
// A concave silhouette edge of a solid (silhouette/mesh/solid.h), seen from outside, is always hidden by the
// solid itself (silhouette/mesh/edge_convexity.h), but by less than the depth bias of visible_ratio.h. So it
// is drawn as hidden, without a depth test. The backs of a solid's faces are not drawn.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/measure/occluder_clusters.h"
#include "engine/measure/visible_ratio_options.h"
#include "shaders/layout.h"
#include "silhouette/hough/hough_octree.h"

namespace rimline {

/// What is drawn of one viewpoint.
struct RatioView {
    gpu::RatioConstants constants;       ///< Without addresses.
    std::vector<gpu::LineEnds> lines;    ///< Edges that are hidden without a test come last.
    std::uint32_t tested_lines;          ///< How many of the lines are drawn with the depth test.
    std::vector<IndexRun> faces;         ///< Of RatioViewBuilder::triangles().
    std::vector<Triangle> copied_faces;  ///< Drawn in place of `faces` if not empty.
    bool culls_backs;

    std::uint64_t upload_bytes() const noexcept {
        return lines.size() * sizeof lines[0] + copied_faces.size() * sizeof copied_faces[0];
    }
};

class RatioViewBuilder {
public:
    /// Finds out whether the mesh is solid. `octree` and its mesh must outlive the builder; `occluders` is
    /// not automatic. Throws Error{too_large} for a mesh of more than 2^24 vertices; Error{cancelled} where
    /// `stop` is requested.
    RatioViewBuilder(const HoughOctree& octree, const VisibleRatioOptions& options,
                     Occluders occluders, const std::stop_token& stop);
    ~RatioViewBuilder();
    RatioViewBuilder(const RatioViewBuilder&) = delete;
    RatioViewBuilder& operator=(const RatioViewBuilder&) = delete;

    /// The faces in the order in which RatioView::faces counts them.
    std::span<const Triangle> triangles() const noexcept { return clusters_.triangles(); }

    /// Makes views[i] the view from eyes[i], on all threads that oneTBB gives. Both spans have the same
    /// size. O(faces) a viewpoint at most; O(silhouette) expected with Occluders::all.
    void build(std::span<const glm::dvec3> eyes, std::span<RatioView> views) const;

private:
    struct ThreadScratch;
    struct Scratch;  // One ThreadScratch for each thread.

    void build_view(const glm::dvec3& eye, RatioView& view, ThreadScratch& scratch) const;
    void select_lines(const HomogeneousPoint& point, RatioView& view, ThreadScratch& scratch) const;
    void select_faces(RatioView& view, ThreadScratch& scratch) const;

    const HoughOctree& octree_;
    VisibleRatioOptions options_;
    OccluderClusters clusters_;
    Occluders occluders_;
    bool is_solid_;
    std::vector<std::uint32_t> concave_bits_;
    std::unique_ptr<Scratch> scratch_;
};

}  // namespace rimline
