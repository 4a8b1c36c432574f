#include "tools/output/cloud_drawing.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "engine/clouds/disc_pieces.h"
#include "engine/clouds/disc_radii.h"
#include "silhouette/points/border_edges.h"
#include "tools/output/label_output.h"

namespace rimline::tools {

namespace {

constexpr PointColor k_feature{44, 62, 112};
// Lines are moved towards the camera by this many radii of the discs at their ends.
constexpr double k_lift = 1.5;

PointColor mixed(const PointColor& a, const PointColor& b, float share) {
    PointColor color;
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = static_cast<std::uint8_t>(std::lround(static_cast<float>(a[c]) * (1.0f - share) +
                                                         static_cast<float>(b[c]) * share));
    return color;
}

}  // namespace

std::uint32_t packed(const PointColor& color, bool is_shaded) {
    return color[0] | std::uint32_t{color[1]} << 8 | std::uint32_t{color[2]} << 16 |
           (is_shaded ? 0u : 0xff000000u);
}

Subject subject_of(const UmbrellaIndex& umbrellas, UpAxis up) {
    return {umbrellas.positions(), umbrellas.center(), umbrellas.radius(), up};
}

Camera make_cloud_camera(const UmbrellaIndex& umbrellas, UpAxis up, const std::string& name,
                         const std::optional<glm::dvec3>& eye,
                         const std::optional<glm::dvec3>& target, PictureOptions options) {
    if (umbrellas.positions().empty())
        throw Error(ErrorCode::bad_input,
                    name + ": no point has an umbrella; there is nothing to draw");
    if (eye) options.eye = umbrellas.to_index(*eye);
    if (target) options.target = umbrellas.to_index(*target);
    if (options.ortho_height) *options.ortho_height *= umbrellas.scale();
    return make_camera(subject_of(umbrellas, up), name, options);
}

HomogeneousPoint silhouette_point_of(const Camera& camera) {
    return camera.is_orthographic()
               ? HomogeneousPoint::direction(glm::vec3(glm::normalize(camera.eye - camera.target)))
               : HomogeneousPoint::viewpoint(glm::vec3(camera.eye));
}

CloudDrawing::CloudDrawing(const PointCloud& cloud, const PointSurface& surface,
                           const UmbrellaIndex& umbrellas, std::span<const float> weights)
    : cloud_(&cloud),
      surface_(&surface),
      umbrellas_(&umbrellas),
      weights_(weights),
      radii_(disc_radii(surface)) {
    for (double& radius : radii_) radius *= umbrellas.scale();
}

double CloudDrawing::lift(std::uint32_t point) const { return k_lift * radii_[point]; }

PointColor CloudDrawing::own_color(std::uint32_t point) const {
    return cloud_->colors().empty() ? k_cloud_clay : cloud_->colors()[point];
}

gpu::SplatRecord CloudDrawing::disc(std::uint32_t point, const glm::dvec3& normal,
                                    const PointColor& color, bool is_shaded) const {
    return {.position = glm::vec3(position(point)),
            .radius = static_cast<float>(radii_[point]),
            .normal = glm::vec3(normal),
            .color = packed(color, is_shaded),
            .cuts = {}};
}

void CloudDrawing::add_discs(std::uint32_t point, const PointColor& color,
                             std::vector<gpu::SplatRecord>& splats) const {
    for (const DiscPiece& piece : disc_pieces(*surface_, PointId{point})) {
        gpu::SplatRecord record = disc(point, piece.normal, color);
        for (std::size_t c = 0; c < 2; ++c)
            if (piece.cuts[c] != glm::dvec3(0.0))
                record.cuts[c] = glm::vec3(glm::normalize(piece.cuts[c]));
        splats.push_back(record);
    }
}

SplatCloud CloudDrawing::drawn(const std::optional<PointColor>& clay, float line_width_px) const {
    SplatCloud drawn;
    drawn.splats.reserve(surface_->size());
    for (std::uint32_t p = 0; p < surface_->size(); ++p) {
        const PointLabel label = surface_->label(PointId{p});
        const PointColor own = clay.value_or(own_color(p));
        add_discs(p,
                  label == PointLabel::undecided ? label_color(label)
                                                 : mixed(own, k_feature, weights_[p]),
                  drawn.splats);
    }
    drawn.strokes =
        strokes(border_edges(*surface_), label_color(PointLabel::border), line_width_px);
    return drawn;
}

std::vector<gpu::StrokeRecord> CloudDrawing::strokes(std::span<const PointEdge> edges,
                                                     const PointColor& color,
                                                     float line_width_px) const {
    std::vector<gpu::StrokeRecord> strokes;
    strokes.reserve(edges.size());
    for (const auto& [a, b] : edges)
        strokes.push_back({.from = glm::vec3(position(index(a))),
                           .radius = 0.5f * line_width_px,
                           .to = glm::vec3(position(index(b))),
                           .color = packed(color),
                           .lifts = glm::vec2(lift(index(a)), lift(index(b)))});
    return strokes;
}

}  // namespace rimline::tools
