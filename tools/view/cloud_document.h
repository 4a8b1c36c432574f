#pragma once

// A point cloud as the window shows it: what was found about it, what is drawn of it, and its silhouette,
// which follows the viewer.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/options/cloud_argument.h"
#include "tools/output/cloud_drawing.h"

namespace rimline::tools {

/// Of the silhouette's last move.
struct CloudReport {
    std::uint32_t silhouette_points = 0;
    std::uint32_t consensus_edges = 0;
    std::uint32_t joined = 0, left = 0;  ///< Points.
    TraversalCounters counters;
    double move_ms = 0.0;
};

/// Stays where it is: a renderer knows what is drawn by its address.
class CloudDocument {
public:
    /// Takes as long as reading, umbrellas and index do; `begin` is told of the parts (model_argument.h).
    /// Throws Error naming the cloud, also where no point has an umbrella.
    CloudDocument(const CloudArgument& cloud, const BeginCall& begin);
    CloudDocument(const CloudDocument&) = delete;
    CloudDocument& operator=(const CloudDocument&) = delete;

    const std::string& name() const noexcept { return name_; }
    const PointCloud& cloud() const noexcept { return cloud_; }
    const PointSurface& surface() const noexcept { return surface_; }
    /// All that is shown is in its coordinates.
    const UmbrellaIndex& umbrellas() const noexcept { return umbrellas_; }
    Subject subject() const { return subject_of(umbrellas_, cloud_.up()); }

    /// What stays, with the points' own colors or one for all. Made again where that or the width has
    /// changed: O(points).
    const SplatCloud& drawn(const std::optional<glm::vec3>& color, float line_width_px);
    /// The consensus edges seen from `point`, as lines. Moves the silhouette there.
    std::vector<gpu::StrokeRecord> follow(const HomogeneousPoint& point,
                                          const std::optional<glm::vec3>& ink, float line_width_px);
    const CloudReport& report() const noexcept { return report_; }

private:
    std::string name_;
    PointCloud cloud_;
    PointSurface surface_;
    std::vector<float> weights_;
    UmbrellaIndex umbrellas_;
    CloudDrawing drawing_;
    SplatCloud drawn_;
    std::optional<glm::vec3> drawn_color_;
    float drawn_width_px_ = 0.0f;  // None: nothing is drawn yet.
    std::optional<PointSilhouette> silhouette_;
    CloudReport report_;
};

}  // namespace rimline::tools
