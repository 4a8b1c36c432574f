#include "tools/output/cloud_drawing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "engine/clouds/disc_pieces.h"
#include "engine/clouds/disc_radii.h"
#include "silhouette/mesh/any_perpendicular.h"
#include "silhouette/points/border_edges.h"
#include "silhouette/srgb.h"
#include "tools/output/label_output.h"

namespace rimline::tools {

namespace {

constexpr CloudColors k_on_pale_paper{.ink = {24, 24, 28},
                                      .clay = {222, 219, 211},
                                      .feature = {44, 62, 112},
                                      .dot = {150, 150, 152},
                                      .feature_dot = {24, 38, 96},
                                      .crease = {40, 80, 180}};
constexpr CloudColors k_on_dark_paper{.ink = {238, 236, 230},
                                      .clay = {112, 113, 118},
                                      .feature = {20, 30, 62},
                                      .dot = {118, 118, 122},
                                      .feature_dot = {166, 186, 255},
                                      .crease = {112, 152, 255}};
// The width of a dot, in widths of lines.
constexpr float k_dot_width = 1.6f;
// Lines on opaque discs are moved towards the camera by this many radii of the discs at their ends.
constexpr double k_lift = 1.5;
// Among paper discs, dots and lines are moved by this many of the greatest radii around them: dots are between discs
// and lines. Of 300 random points of a sphere a fiftieth to a ninth of the silhouette is hidden, and at most one dot of
// the front. With the radius of their own disc and discs on the surface a fifth is, and a tenth of the dots.
constexpr double k_dot_lift = 0.8;
constexpr double k_line_lift = 1.2;
// By at most this many of its radii a paper disc sinks into the surface. Seen from the hollow side it rises instead,
// and with 0.5 hides lines there.
constexpr double k_max_sink = 0.15;

PointColor mixed(const PointColor& a, const PointColor& b, float share) {
    PointColor color;
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = static_cast<std::uint8_t>(std::lround(static_cast<float>(a[c]) * (1.0f - share) +
                                                         static_cast<float>(b[c]) * share));
    return color;
}

glm::vec3 linear_of_bytes(const PointColor& color) {
    return rimline::linear_from_srgb(glm::vec3(color[0], color[1], color[2]) / 255.0f);
}

// The ratio of the brighter luminance to the darker one, as WCAG 2 defines it. Both are linear.
float contrast(const glm::vec3& a, const glm::vec3& b) {
    constexpr glm::vec3 k_luminance(0.2126f, 0.7152f, 0.0722f);
    const float ratio = (0.05f + glm::dot(a, k_luminance)) / (0.05f + glm::dot(b, k_luminance));
    return std::max(ratio, 1.0f / ratio);
}

}  // namespace

const CloudColors& cloud_colors(const glm::vec3& paper) {
    const auto stands_out = [&](const CloudColors& colors) {
        return contrast(linear_of_bytes(colors.ink), paper);
    };
    return stands_out(k_on_dark_paper) > stands_out(k_on_pale_paper) ? k_on_dark_paper
                                                                     : k_on_pale_paper;
}

std::uint32_t packed(const PointColor& color, bool is_shaded) {
    return color[0] | std::uint32_t{color[1]} << 8 | std::uint32_t{color[2]} << 16 |
           (is_shaded ? 0u : 0xff000000u);
}

HomogeneousPoint silhouette_point_of(const Camera& camera) {
    return camera.is_orthographic()
               ? HomogeneousPoint::direction(glm::vec3(glm::normalize(camera.eye - camera.target)))
               : HomogeneousPoint::viewpoint(glm::vec3(camera.eye));
}

CloudDrawing::CloudDrawing(const PointCloud& cloud, const PointSurface& surface,
                           const UmbrellaIndex& umbrellas, std::span<const float> weights,
                           CloudLook look)
    : cloud_(&cloud),
      surface_(&surface),
      umbrellas_(&umbrellas),
      weights_(weights),
      look_(look),
      radii_(disc_radii(surface)) {
    for (double& radius : radii_) radius *= umbrellas.scale();
    find_reaches();
    add_extents();
}

// A point on no surface may lie far from all others: the picture does not go out to it.
bool CloudDrawing::is_framed(std::uint32_t point) const {
    return surface_->reason(PointId{point}) != UndecidedReason::outlier;
}

void CloudDrawing::add_extents() {
    for (std::uint32_t p = 0; p < surface_->size(); ++p) {
        if (!is_framed(p)) continue;
        if (look_ == CloudLook::dots)
            extents_.push_back(glm::vec3(position(p)));
        else
            for (const DiscPiece& piece : disc_pieces(*surface_, PointId{p}))
                add_extent(p, piece.normal);
    }
}

void CloudDrawing::include_discs(std::span<const glm::dvec3> normals) {
    for (std::uint32_t p = 0; p < surface_->size(); ++p) {
        if (!is_framed(p)) continue;
        add_extent(p, normals[p]);
        for (const DiscPiece& piece : disc_pieces(*surface_, PointId{p}))
            add_extent(p, piece.normal);
    }
}

void CloudDrawing::add_extent(std::uint32_t point, const glm::dvec3& normal) {
    max_radius_ = std::max(max_radius_, radii_[point]);
    // A disc without a normal faces the camera, wherever that is.
    const bool has_normal = normal != glm::dvec3(0.0);
    const glm::dvec3 u = has_normal ? any_perpendicular(normal) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 v = has_normal ? glm::cross(normal, u) : glm::dvec3(0.0, 1.0, 0.0);
    for (const double depth : has_normal ? std::vector{0.0} : std::vector{-1.0, 1.0})
        for (const auto& [a, b] : {std::pair(-1, -1), {-1, 1}, {1, -1}, {1, 1}}) {
            const glm::dvec3 w(0.0, 0.0, depth);
            extents_.push_back(
                glm::vec3(position(point) + radii_[point] * (double(a) * u + double(b) * v + w)));
        }
}

void CloudDrawing::find_reaches() {
    reaches_ = radii_;
    for (std::uint32_t p = 0; p < surface_->size(); ++p) {
        const PointSurface::UmbrellaRange range = surface_->umbrellas_of(PointId{p});
        for (std::uint32_t u = range.first; u < range.last; ++u)
            for (const PointId neighbor : surface_->umbrella(UmbrellaId{u}).ring) {
                const std::uint32_t q = index(neighbor);
                reaches_[q] = std::max(reaches_[q], radii_[p]);
                reaches_[p] = std::max(reaches_[p], radii_[q]);
            }
    }
}

// The center of the point's disc, moved to the inner side of a bent surface until the disc's rim is on the surface.
glm::dvec3 CloudDrawing::sunk(std::uint32_t point) const {
    const PointSurface::UmbrellaRange range = surface_->umbrellas_of(PointId{point});
    const glm::dvec3 at = position(point);
    if (range.size() != 1) return at;
    const Umbrella umbrella = surface_->umbrella(UmbrellaId{range.first});
    double bend = 0.0;
    for (const PointId neighbor : umbrella.ring) {
        const glm::dvec3 to = position(index(neighbor)) - at;
        bend += glm::dot(to, umbrella.normal) / glm::dot(to, to);
    }
    bend /= static_cast<double>(umbrella.ring.size());
    const double depth = std::clamp(bend * radii_[point], -k_max_sink, k_max_sink);
    return at + depth * radii_[point] * umbrella.normal;
}

double CloudDrawing::lift(std::uint32_t point) const {
    return look_ == CloudLook::dots ? k_line_lift * reaches_[point] : k_lift * radii_[point];
}

PointColor CloudDrawing::own_color(std::uint32_t point, const PointColor& clay) const {
    return cloud_->colors().empty() ? clay : cloud_->colors()[point];
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
        for (std::size_t c = 0; c < piece.cuts.size(); ++c)
            if (piece.cuts[c] != glm::dvec3(0.0))
                record.cuts[c] = glm::vec3(glm::normalize(piece.cuts[c]));
        splats.push_back(record);
    }
}

SplatCloud CloudDrawing::drawn(const PointColor& paper, const std::optional<PointColor>& clay,
                               float line_width_px) const {
    const CloudColors& colors = cloud_colors(linear_of_bytes(paper));
    SplatCloud drawn =
        look_ == CloudLook::dots ? dots(paper, colors, clay, line_width_px) : discs(colors, clay);
    const std::vector<gpu::StrokeRecord> borders =
        strokes(border_edges(*surface_), label_color(PointLabel::border), line_width_px);
    drawn.strokes.insert(drawn.strokes.end(), borders.begin(), borders.end());
    return drawn;
}

SplatCloud CloudDrawing::plain(const PointColor& paper) const {
    const CloudColors& colors = cloud_colors(linear_of_bytes(paper));
    if (look_ == CloudLook::dots) {
        SplatCloud drawn = paper_discs(paper);
        for (std::uint32_t p = 0; p < surface_->size(); ++p)
            drawn.strokes.push_back(dot(p, own_color(p, colors.dot), k_cloud_line_width_px));
        return drawn;
    }
    SplatCloud drawn;
    for (std::uint32_t p = 0; p < surface_->size(); ++p)
        add_discs(p, own_color(p, colors.clay), drawn.splats);
    return drawn;
}

SplatCloud CloudDrawing::discs(const CloudColors& colors,
                               const std::optional<PointColor>& clay) const {
    SplatCloud drawn;
    drawn.splats.reserve(surface_->size());
    for (std::uint32_t p = 0; p < surface_->size(); ++p) {
        const PointLabel label = surface_->label(PointId{p});
        const PointColor own = clay.value_or(own_color(p, colors.clay));
        add_discs(p,
                  label == PointLabel::undecided ? label_color(label)
                                                 : mixed(own, colors.feature, weights_[p]),
                  drawn.splats);
    }
    return drawn;
}

SplatCloud CloudDrawing::dots(const PointColor& paper, const CloudColors& colors,
                              const std::optional<PointColor>& clay, float line_width_px) const {
    SplatCloud drawn = paper_discs(paper);
    for (std::uint32_t p = 0; p < surface_->size(); ++p)
        drawn.strokes.push_back(dot(p, dot_color(p, colors, clay), line_width_px));
    return drawn;
}

SplatCloud CloudDrawing::paper_discs(const PointColor& paper) const {
    SplatCloud drawn;
    for (std::uint32_t p = 0; p < surface_->size(); ++p)
        // Discs of points without a surface hide nothing.
        if (surface_->normal(PointId{p}) != glm::dvec3(0.0)) {
            const std::size_t first = drawn.splats.size();
            add_discs(p, paper, drawn.splats);
            const glm::vec3 center(sunk(p));
            for (std::size_t i = first; i < drawn.splats.size(); ++i) {
                drawn.splats[i].position = center;
                drawn.splats[i].color = packed(paper, false);
            }
        }
    return drawn;
}

gpu::StrokeRecord CloudDrawing::dot(std::uint32_t point, const PointColor& color,
                                    float line_width_px) const {
    gpu::StrokeRecord record = mark(point, color, k_dot_width * line_width_px);
    record.lifts = glm::vec2(glm::dvec2(k_dot_lift * reaches_[point]));
    return record;
}

gpu::StrokeRecord CloudDrawing::mark(std::uint32_t point, const PointColor& color,
                                     float width_px) const {
    const glm::vec3 at(position(point));
    return {.from = at,
            .radius = 0.5f * width_px,
            .to = at,
            .color = packed(color),
            .lifts = glm::vec2(glm::dvec2(lift(point)))};
}

PointColor CloudDrawing::dot_color(std::uint32_t point, const CloudColors& colors,
                                   const std::optional<PointColor>& clay) const {
    const PointLabel label = surface_->label(PointId{point});
    if (label == PointLabel::undecided || label == PointLabel::border) return label_color(label);
    if (clay) return mixed(*clay, colors.feature_dot, weights_[point]);
    if (!cloud_->colors().empty()) return cloud_->colors()[point];
    return mixed(colors.dot, colors.feature_dot, weights_[point]);
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

Camera make_cloud_camera(const CloudDrawing& drawing, const UmbrellaIndex& umbrellas,
                         const std::string& name, const std::optional<glm::dvec3>& eye,
                         const std::optional<glm::dvec3>& target, PictureOptions options) {
    if (umbrellas.positions().empty())
        throw Error(ErrorCode::bad_input,
                    name + ": no point has an umbrella; there is nothing to draw");
    if (eye) options.eye = umbrellas.to_index(*eye);
    if (target) options.target = umbrellas.to_index(*target);
    if (options.ortho_height) *options.ortho_height *= umbrellas.scale();
    return make_camera(drawing.subject(), name, options);
}

}  // namespace rimline::tools
