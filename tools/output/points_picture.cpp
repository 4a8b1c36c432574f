#include "tools/output/points_picture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "silhouette/points/border_edges.h"
#include "silhouette/points/pca_normals.h"
#include "tools/options/drawing_device.h"
#include "tools/output/cloud_drawing.h"
#include "tools/output/contact_sheet.h"
#include "tools/output/hidden_points.h"
#include "tools/output/label_output.h"
#include "tools/output/picture_file.h"

namespace rimline::tools {

namespace {

// Widths of single points and of silhouette points: in radii of the discs that cover the surface, and at most in
// pixels.
constexpr double k_point_width = 0.7, k_max_point_width_px = 4.0;
constexpr double k_mark_width = 1.0, k_max_mark_width_px = 6.0;

PointColor bytes_of(const Color& color) { return {color.red, color.green, color.blue}; }

class PointsDrawing {
public:
    explicit PointsDrawing(const PointsPicture& picture)
        : picture_(picture),
          drawing_(picture.cloud, picture.surface, picture.umbrellas, picture.weights,
                   picture.look),
          colors_(cloud_colors(linear_from_srgb(paper()))) {
        if (picture.mode == PointsMode::compare) {
            pca_ = pca_normals(picture.surface.positions(), picture.k);
            drawing_.include_discs(pca_);
        }
        scene_.camera = make_cloud_camera(drawing_, picture.umbrellas, picture.name, picture.eye,
                                          picture.target, picture.options);
        scene_.background = linear_from_srgb(paper());
        scene_.center = drawing_.subject().center;
        scene_.radius = drawing_.subject().radius;
        point_ = picture.silhouette_point.value_or(silhouette_point_of(scene_.camera));
        const PointSilhouette silhouette(picture.umbrellas, point_);
        silhouette_ = silhouette.points();
        consensus_ = silhouette.consensus_edges();
    }

    const HomogeneousPoint& silhouette_point() const { return point_; }
    /// In the coordinates of the umbrellas.
    const Camera& camera() const { return scene_.camera; }
    /// The scene of a cloud that drawn() or compared() returned. `cloud` must outlive it.
    SplatScene scene_of(const SplatCloud& cloud) const {
        SplatScene scene = scene_;
        scene.cloud = &cloud;
        return scene;
    }

    SplatCloud featured() const {
        SplatCloud cloud = drawing_.plain(bytes_of(paper()));
        const auto add = [&](std::span<const PointEdge> edges, const PointColor& color) {
            const std::vector<gpu::StrokeRecord> lines = drawing_.strokes(edges, color);
            cloud.strokes.insert(cloud.strokes.end(), lines.begin(), lines.end());
        };
        // Of lines on one edge the first is seen.
        add(consensus_, colors_.ink);
        add(crease_edges(picture_.surface), colors_.crease);
        add(border_edges(picture_.surface), label_color(PointLabel::border));
        return cloud;
    }

    SplatCloud drawn() const {
        SplatCloud cloud = drawing_.drawn(bytes_of(paper()));
        const std::vector<gpu::StrokeRecord> ink = drawing_.strokes(consensus_, colors_.ink);
        cloud.strokes.insert(cloud.strokes.end(), ink.begin(), ink.end());
        return cloud;
    }

    std::vector<SplatCloud> compared() const {
        return {dots(),
                drawn(),
                marked(thresholded()),
                marked(silhouette_),
                with_normals(pca_),
                with_umbrellas()};
    }

private:
    Color paper() const { return picture_.options.background.value_or(k_cloud_paper); }

    SplatCloud with_normals(std::span<const glm::dvec3> normals) const {
        SplatCloud cloud;
        for (std::uint32_t p = 0; p < picture_.surface.size(); ++p)
            cloud.splats.push_back(
                drawing_.disc(p, normals[p], drawing_.own_color(p, colors_.clay)));
        return cloud;
    }

    SplatCloud with_umbrellas() const {
        SplatCloud cloud;
        for (std::uint32_t p = 0; p < picture_.surface.size(); ++p)
            drawing_.add_discs(p, drawing_.own_color(p, colors_.clay), cloud.splats);
        return cloud;
    }

    // The points that the convex hull classifies as visible, without the surface.
    SplatCloud dots() const {
        SplatCloud cloud;
        std::vector<glm::dvec3> positions;
        for (std::uint32_t p = 0; p < picture_.surface.size(); ++p)
            positions.push_back(drawing_.position(p));
        for (const std::uint32_t p : visible_points(positions, scene_.camera.eye)) {
            cloud.strokes.push_back(
                drawing_.mark(p, colors_.ink, width_px(p, k_point_width, k_max_point_width_px)));
        }
        return cloud;
    }

    SplatCloud marked(const std::vector<PointId>& points) const {
        SplatCloud cloud = drawing_.plain(bytes_of(paper()));
        for (const PointId point : points)
            cloud.strokes.push_back(
                drawing_.mark(index(point), colors_.ink,
                              width_px(index(point), k_mark_width, k_max_mark_width_px)));
        return cloud;
    }

    // `share` radii of the point's disc, as wide as it would be if it faced the camera.
    float width_px(std::uint32_t p, double share, double max_px) const {
        const Camera& camera = scene_.camera;
        const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
        const double height =
            camera.is_orthographic()
                ? camera.ortho_height
                : 2.0 * std::tan(glm::radians(0.5 * camera.fov_y_deg)) *
                      std::max(glm::dot(camera.eye - drawing_.position(p), back), 0.0);
        const double width = share * drawing_.radius(p) * picture_.options.size.height;
        return static_cast<float>(width < max_px * height ? width / height : max_px);
    }

    // As many points as the silhouette has: those whose normals are closest to perpendicular to the view
    // ray.
    std::vector<PointId> thresholded() const {
        std::vector<std::pair<double, PointId>> order;
        for (std::uint32_t p = 0; p < picture_.surface.size(); ++p) {
            const glm::dvec3 normal = picture_.surface.normal(PointId{p});
            if (normal == glm::dvec3(0.0)) continue;
            const glm::dvec3 to =
                glm::dvec3(point_.xyz()) - double{point_.w} * drawing_.position(p);
            order.emplace_back(std::abs(glm::dot(normal, glm::normalize(to))), PointId{p});
        }
        const std::size_t count = std::min(silhouette_.size(), order.size());
        std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                         order.end());
        std::vector<PointId> points;
        for (std::size_t i = 0; i < count; ++i) points.push_back(order[i].second);
        return points;
    }

    const PointsPicture& picture_;
    CloudDrawing drawing_;
    const CloudColors& colors_;
    SplatScene scene_;  // Without points.
    HomogeneousPoint point_{};
    std::vector<PointId> silhouette_;
    std::vector<PointEdge> consensus_;
    std::vector<glm::dvec3> pca_;  // Of compare.
};

}  // namespace

PointsPictureReport draw_points(const PointsPicture& picture, OutputFile& file) {
    const DrawingDevice device(picture.options);
    const PointsDrawing drawing(picture);
    SplatRenderer renderer(device.context());
    const ImageSize size = picture.options.size;
    const auto start = std::chrono::steady_clock::now();
    if (picture.mode != PointsMode::compare) {
        const SplatCloud cloud =
            picture.mode == PointsMode::features ? drawing.featured() : drawing.drawn();
        write_png(file, renderer.render(drawing.scene_of(cloud), size.width, size.height));
    } else {
        std::vector<Picture> pictures;
        for (const SplatCloud& cloud : drawing.compared())
            pictures.push_back(renderer.render(drawing.scene_of(cloud), size.width, size.height));
        constexpr std::uint32_t k_columns = 2;
        constexpr std::uint32_t k_gap = 8;
        write_png(file, make_contact_sheet(pictures, k_columns, k_gap,
                                           picture.options.background.value_or(k_cloud_paper)));
    }
    const bool is_orthographic = drawing.camera().is_orthographic();
    return {
        .silhouette_point = drawing.silhouette_point(),
        .eye = picture.umbrellas.from_index(drawing.camera().eye),
        .target = picture.umbrellas.from_index(drawing.camera().target),
        .fov_deg = is_orthographic ? std::nullopt : std::optional(drawing.camera().fov_y_deg),
        .ortho_height = is_orthographic ? std::optional(drawing.camera().ortho_height /
                                                        picture.umbrellas.scale())
                                        : std::nullopt,
        .device = device.device.facts().name,
        .driver = device.device.facts().driver,
        .validation_messages = device.instance.validation_message_count(),
        .ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                  .count()};
}

}  // namespace rimline::tools
