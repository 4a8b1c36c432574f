#pragma once

// A point cloud that the window shows: its umbrellas and features, its picture, and its silhouette, which
// follows the viewer.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/options/cloud_argument.h"
#include "tools/output/cloud_drawing.h"
#include "tools/view/document_base.h"

namespace rimline::tools {

/// Describes the last move of the silhouette.
struct CloudReport {
    std::uint32_t silhouette_points = 0;
    std::uint32_t consensus_edges = 0;
    std::uint32_t added = 0, removed = 0;  ///< Points.
    TraversalCounters counters;
    double move_ms = 0.0;
};

/// Cannot be copied or moved: a renderer refers to splats() by its address.
class CloudDocument final : public DocumentBase {
public:
    /// Loads the cloud, finds its umbrellas and builds their index. `begin` is called before each part of
    /// the work (begin_call.h). Throws Error naming the cloud, also if no point has an umbrella.
    CloudDocument(const CloudArgument& argument, const BeginCall& begin);

    /// What was opened.
    const CloudArgument& argument() const noexcept { return argument_; }
    Subject subject() const override { return drawing_.subject(); }
    const PointCloud& cloud() const noexcept { return cloud_; }
    const PointSurface& surface() const noexcept { return surface_; }
    /// Everything that is shown is in its coordinates.
    const UmbrellaIndex& umbrellas() const noexcept { return umbrellas_; }

    const CloudDrawing& drawing() const noexcept { return drawing_; }

    /// The points and border lines, which do not depend on the viewer. Colors are linear; without `color` the
    /// points keep their own, and `paper` is the background. Rebuilt if an argument differs from the last call:
    /// O(points).
    const SplatCloud& splats(const glm::vec3& paper, const std::optional<glm::vec3>& color,
                             float line_width_px);
    /// Moves the silhouette to `point`. Returns its consensus edges as lines. Colors are linear; without `ink` it
    /// stands out from `paper`.
    std::vector<gpu::StrokeRecord> silhouette_strokes(const HomogeneousPoint& point,
                                                      const glm::vec3& paper,
                                                      const std::optional<glm::vec3>& ink,
                                                      float line_width_px);
    const CloudReport& report() const noexcept { return report_; }

private:
    CloudArgument argument_;
    PointCloud cloud_;
    PointSurface surface_;
    std::vector<float> weights_;
    UmbrellaIndex umbrellas_;
    CloudDrawing drawing_;
    SplatCloud splats_;
    glm::vec3 splat_paper_{0.0f};
    std::optional<glm::vec3> splat_color_;
    float splat_line_width_px_ = 0.0f;  // 0 until splats_ is built.
    std::optional<PointSilhouette> silhouette_;
    CloudReport report_;
};

}  // namespace rimline::tools
