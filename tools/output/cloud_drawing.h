#pragma once

// The picture of a point cloud with its umbrellas: opaque discs, darker with a higher feature weight;
// borders in their own color; edges as ink lines. All is in the coordinates of the UmbrellaIndex and
// independent of the camera.

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

/// Default width of lines.
constexpr float k_cloud_line_width_px = 2.5f;
constexpr PointColor k_cloud_ink{24, 24, 28};
/// Color of points without their own color.
constexpr PointColor k_cloud_clay{222, 219, 211};
constexpr Color k_cloud_paper{248, 244, 236};

/// The color of a disc or a line as in its GPU record. `is_shaded`: the disc is lit from the camera.
std::uint32_t packed(const PointColor& color, bool is_shaded = false);

/// The points that have umbrellas, as the subject of a camera.
Subject subject_of(const UmbrellaIndex& umbrellas, UpAxis up);

/// The camera of the options, converted from the cloud's coordinates to those of `umbrellas`. `eye` and
/// `target` replace those of the options. Throws Error if no point has an umbrella, and UsageError as
/// make_camera().
Camera make_cloud_camera(const UmbrellaIndex& umbrellas, UpAxis up, const std::string& name,
                         const std::optional<glm::dvec3>& eye,
                         const std::optional<glm::dvec3>& target, PictureOptions options);

/// The eye of `camera`, or its direction if it is orthographic.
HomogeneousPoint silhouette_point_of(const Camera& camera);

class CloudDrawing {
public:
    /// All arguments must outlive this object. O(points).
    CloudDrawing(const PointCloud& cloud, const PointSurface& surface,
                 const UmbrellaIndex& umbrellas, std::span<const float> weights);

    /// The discs of all points and the lines of the borders. Features and undecided points have their own
    /// colors. `clay` replaces the colors of the points. O(points).
    SplatCloud drawn(const std::optional<PointColor>& clay = {},
                     float line_width_px = k_cloud_line_width_px) const;
    /// Lines along edges between points.
    std::vector<gpu::StrokeRecord> strokes(std::span<const PointEdge> edges,
                                           const PointColor& color,
                                           float line_width_px = k_cloud_line_width_px) const;

    // Parts of the drawing.
    glm::dvec3 position(std::uint32_t point) const {
        return glm::dvec3(umbrellas_->to_index(surface_->positions()[point]));
    }
    double radius(std::uint32_t point) const { return radii_[point]; }
    /// Distance by which the end of a line is moved towards the camera.
    double lift(std::uint32_t point) const;
    PointColor own_color(std::uint32_t point) const;
    gpu::SplatRecord disc(std::uint32_t point, const glm::dvec3& normal, const PointColor& color,
                          bool is_shaded = true) const;
    /// One disc for each surface sheet that meets in the point. Discs are cut along their intersection.
    void add_discs(std::uint32_t point, const PointColor& color,
                   std::vector<gpu::SplatRecord>& splats) const;

private:
    const PointCloud* cloud_;
    const PointSurface* surface_;
    const UmbrellaIndex* umbrellas_;
    std::span<const float> weights_;
    std::vector<double> radii_;  // Of discs, in units of the index.
};

}  // namespace rimline::tools
