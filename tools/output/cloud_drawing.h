#pragma once

// The picture of a point cloud with its umbrellas: opaque discs, darker with a higher feature weight; or, of a
// coarse cloud, dots, and discs in the color of the paper that hide what lies behind them. Borders in their own
// color; edges as ink lines. All is in the coordinates of the UmbrellaIndex and independent of the camera.

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
#include "tools/output/cloud_look.h"

namespace rimline::tools {

/// Default width of lines.
constexpr float k_cloud_line_width_px = 2.5f;
constexpr Color k_cloud_paper{248, 244, 236};

/// Colors that stand out from the paper.
struct CloudColors {
    PointColor ink;
    PointColor clay;     ///< Of discs without their own color.
    PointColor feature;  ///< Of discs whose feature weight is 1.
    PointColor dot;      ///< Of dots without their own color.
    PointColor feature_dot;
    PointColor crease;  ///< Of lines.
};
/// Dark ink on pale paper and pale ink on dark paper: the one with the higher contrast. Discs are as pale or dark as
/// the paper, because ink is drawn on them too. `paper` is linear.
const CloudColors& cloud_colors(const glm::vec3& paper);

/// The color of a disc or a line as in its GPU record. `is_shaded`: the disc is lit from the camera.
std::uint32_t packed(const PointColor& color, bool is_shaded = false);

/// The eye of `camera`, or its direction if it is orthographic.
HomogeneousPoint silhouette_point_of(const Camera& camera);

class CloudDrawing {
public:
    /// All arguments must outlive this object. O(points).
    CloudDrawing(const PointCloud& cloud, const PointSurface& surface,
                 const UmbrellaIndex& umbrellas, std::span<const float> weights, CloudLook look);

    CloudLook look() const noexcept { return look_; }
    /// Extends subject() by all discs, and by those with other normals, one for each point.
    void include_discs(std::span<const glm::dvec3> normals);
    /// What a camera shows: all that is drawn, except the widths of dots and lines. This object must outlive it.
    Subject subject() const {
        return {extents_, umbrellas_->center(), umbrellas_->radius() + max_radius_, cloud_->up()};
    }

    /// The points and the lines of the borders. Features and undecided points have their own colors. `clay`
    /// replaces the colors of the points, `paper` is the background of dots. O(points).
    SplatCloud drawn(const PointColor& paper, const std::optional<PointColor>& clay = {},
                     float line_width_px = k_cloud_line_width_px) const;
    /// The points alone, without features.
    SplatCloud plain(const PointColor& paper) const;
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
    /// A round mark that is before the point's disc, and as wide on the screen at any distance.
    gpu::StrokeRecord mark(std::uint32_t point, const PointColor& color, float width_px) const;
    /// The color of the file, or `clay` if it has none.
    PointColor own_color(std::uint32_t point, const PointColor& clay) const;
    gpu::SplatRecord disc(std::uint32_t point, const glm::dvec3& normal, const PointColor& color,
                          bool is_shaded = true) const;
    /// One disc for each surface sheet that meets in the point. Discs are cut along their intersection.
    void add_discs(std::uint32_t point, const PointColor& color,
                   std::vector<gpu::SplatRecord>& splats) const;

private:
    bool is_framed(std::uint32_t point) const;
    void add_extents();
    void find_reaches();
    glm::dvec3 sunk(std::uint32_t point) const;
    void add_extent(std::uint32_t point, const glm::dvec3& normal);
    PointColor dot_color(std::uint32_t point, const CloudColors& colors,
                         const std::optional<PointColor>& clay) const;
    SplatCloud discs(const CloudColors& colors, const std::optional<PointColor>& clay) const;
    /// Discs that hide what lies behind them.
    SplatCloud paper_discs(const PointColor& paper) const;
    gpu::StrokeRecord dot(std::uint32_t point, const PointColor& color, float line_width_px) const;
    SplatCloud dots(const PointColor& paper, const CloudColors& colors,
                    const std::optional<PointColor>& clay, float line_width_px) const;

    const PointCloud* cloud_;
    const PointSurface* surface_;
    const UmbrellaIndex* umbrellas_;
    std::span<const float> weights_;
    CloudLook look_;
    std::vector<double> radii_;  // Of discs, in units of the index.
    std::vector<double>
        reaches_;  // The greatest radius of the discs around a point, its own included.
    // Of dots the points, of discs the corners of squares around them.
    std::vector<glm::vec3> extents_;
    double max_radius_ = 0.0;  // By which a drawing exceeds the points.
};

/// The camera of the options, converted from the cloud's coordinates to those of `umbrellas`. `eye` and
/// `target` replace those of the options. Throws Error if no point has an umbrella, and UsageError as
/// make_camera().
Camera make_cloud_camera(const CloudDrawing& drawing, const UmbrellaIndex& umbrellas,
                         const std::string& name, const std::optional<glm::dvec3>& eye,
                         const std::optional<glm::dvec3>& target, PictureOptions options);

}  // namespace rimline::tools
