#pragma once

// What a point cloud and what was found about it look like: discs that hide one another, darker the more a
// point weighs; borders in a color of their own; edges as ink. In the coordinates of its UmbrellaIndex,
// the same from wherever it is seen.

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/clouds/splat_renderer.h"
#include "silhouette/points/point_cloud.h"
#include "silhouette/points/point_silhouette.h"
#include "silhouette/points/point_surface.h"
#include "silhouette/points/umbrella_index.h"
#include "tools/options/picture_options.h"
#include "tools/options/picture_scene.h"

namespace rimline::tools {

/// Of lines, in pixels, where nobody says otherwise.
constexpr float k_cloud_line_width_px = 2.5f;
constexpr PointColor k_cloud_ink{24, 24, 28};
/// Of points without a color of their own.
constexpr PointColor k_cloud_clay{222, 219, 211};
constexpr Color k_cloud_paper{248, 244, 236};

/// A disc's or a line's color, as records have it; `is_shaded` for discs that the camera lights.
std::uint32_t packed(const PointColor& color, bool is_shaded = false);

/// The points that have umbrellas, to look at.
Subject subject_of(const UmbrellaIndex& umbrellas, UpAxis up);

/// The camera of the options, brought there from the cloud's own coordinates; `eye` and `target` take the
/// place of theirs. Throws Error where no point has an umbrella, UsageError as make_camera() does.
Camera make_cloud_camera(const UmbrellaIndex& umbrellas, UpAxis up, const std::string& name,
                         const std::optional<glm::dvec3>& eye,
                         const std::optional<glm::dvec3>& target, PictureOptions options);

/// The silhouette point of who looks through `camera`.
HomogeneousPoint silhouette_point_of(const Camera& camera);

class CloudDrawing {
public:
    /// All of them must outlive it. O(points).
    CloudDrawing(const PointCloud& cloud, const PointSurface& surface,
                 const UmbrellaIndex& umbrellas, std::span<const float> weights);

    /// Discs, with features and what is undecided in their colors, and borders; `clay` takes the place of
    /// the points' own colors. O(points).
    SplatCloud drawn(const std::optional<PointColor>& clay = {},
                     float line_width_px = k_cloud_line_width_px) const;
    /// Edges between points as lines.
    std::vector<gpu::StrokeRecord> strokes(std::span<const PointEdge> edges,
                                           const PointColor& color,
                                           float line_width_px = k_cloud_line_width_px) const;

    // The parts.
    glm::dvec3 place(std::uint32_t point) const {
        return glm::dvec3(umbrellas_->to_index(surface_->positions()[point]));
    }
    double radius(std::uint32_t point) const { return radii_[point]; }
    /// So far a line's end is moved towards the camera.
    double lift(std::uint32_t point) const;
    PointColor own_color(std::uint32_t point) const;
    gpu::SplatRecord disc(std::uint32_t point, const glm::dvec3& normal, const PointColor& color,
                          bool is_shaded = true) const;
    /// As many as faces meet in it, cut where the others begin.
    void add_discs(std::uint32_t point, const PointColor& color,
                   std::vector<gpu::SplatRecord>& splats) const;

private:
    const PointCloud* cloud_;
    const PointSurface* surface_;
    const UmbrellaIndex* umbrellas_;
    std::span<const float> weights_;
    std::vector<double> radii_;  // Of discs, in the index's units.
};

}  // namespace rimline::tools
