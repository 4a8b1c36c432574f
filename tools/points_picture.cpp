#include "tools/points_picture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "engine/splat_renderer.h"
#include "silhouette/points/pca_normals.h"
#include "silhouette/points/point_silhouette.h"
#include "tools/command.h"
#include "tools/contact_sheet.h"
#include "tools/disc_pieces.h"
#include "tools/disc_radii.h"
#include "tools/drawing_device.h"
#include "tools/hidden_points.h"
#include "tools/label_output.h"
#include "tools/picture_file.h"
#include "tools/picture_scene.h"

namespace rimline::tools {

namespace {

constexpr PointColor k_clay{222, 219, 211};
constexpr PointColor k_feature{44, 62, 112};
constexpr PointColor k_ink{24, 24, 28};
constexpr Color k_paper{248, 244, 236};
constexpr float k_line_radius = 1.1f;  // Pixels.
// A line is moved towards the camera by so many radii of the discs at its ends.
constexpr double k_lift = 1.5;
// Of points that are drawn by themselves, in radii of the discs that would close the surface.
constexpr float k_dot = 0.35f;
constexpr float k_mark = 0.5f;

std::uint32_t packed(const PointColor& color, bool is_shaded) {
    return color[0] | std::uint32_t{color[1]} << 8 | std::uint32_t{color[2]} << 16 |
           (is_shaded ? 0u : 0xff000000u);
}

PointColor mixed(const PointColor& a, const PointColor& b, float share) {
    PointColor color;
    for (std::size_t c = 0; c < 3; ++c)
        color[c] = static_cast<std::uint8_t>(std::lround(static_cast<float>(a[c]) * (1.0f - share) +
                                                         static_cast<float>(b[c]) * share));
    return color;
}

class PointsDrawing {
public:
    explicit PointsDrawing(const PointsPicture& picture)
        : picture_(picture), camera_(make_camera()), radii_(disc_radii(picture.surface)) {
        for (double& radius : radii_) radius *= picture.umbrellas.scale();
        scene_.camera = camera_;
        scene_.background = linear_from_srgb(picture.options.background.value_or(k_paper));
        scene_.center = picture.umbrellas.mesh().center();
        scene_.radius = picture.umbrellas.mesh().radius();
        point_ = picture.silhouette_point.value_or(
            camera_.is_orthographic()
                ? HomogeneousPoint::direction(glm::vec3(camera_.eye - camera_.target))
                : HomogeneousPoint::viewpoint(glm::vec3(camera_.eye)));
        const PointSilhouette silhouette(picture.umbrellas, point_);
        silhouette_ = silhouette.points();
        consensus_ = silhouette.consensus_edges();
    }

    const HomogeneousPoint& silhouette_point() const { return point_; }

    SplatScene drawn() const {
        SplatScene scene = scene_;
        add_discs(scene, [&](std::uint32_t p) { return weighed_color(p); });
        add_borders(scene);
        add_strokes(scene, consensus_, k_ink);
        return scene;
    }

    std::vector<SplatScene> compared() const {
        const std::vector<glm::dvec3> pca = pca_normals(picture_.surface.positions(), picture_.k);
        return {
            dots(),          drawn(), marked(thresholded()), marked(silhouette_), with_normals(pca),
            with_umbrellas()};
    }

private:
    Camera make_camera() const {
        const Mesh& mesh = picture_.umbrellas.mesh();
        if (mesh.vertex_count() == 0)
            throw Error(ErrorCode::bad_input,
                        picture_.name + ": no point has an umbrella; there is nothing to draw");
        PictureOptions options = picture_.options;
        if (picture_.eye) options.eye = picture_.umbrellas.to_index(*picture_.eye);
        if (picture_.target) options.target = picture_.umbrellas.to_index(*picture_.target);
        if (options.ortho_height) *options.ortho_height *= picture_.umbrellas.scale();
        if (!options.up && picture_.cloud.up() == UpAxis::z) options.up = glm::vec3(0, 0, 1);
        return tools::make_camera(mesh, picture_.name, options);
    }

    glm::dvec3 place(std::uint32_t p) const {
        return glm::dvec3(picture_.umbrellas.to_index(picture_.surface.positions()[p]));
    }

    PointColor own_color(std::uint32_t p) const {
        return picture_.cloud.colors().empty() ? k_clay : picture_.cloud.colors()[p];
    }

    PointColor weighed_color(std::uint32_t p) const {
        const PointLabel label = picture_.surface.label(PointId{p});
        if (label == PointLabel::undecided) return label_color(label);
        return mixed(own_color(p), k_feature, picture_.weights[p]);
    }

    void add_discs_of(SplatScene& scene, std::uint32_t p, const PointColor& color) const {
        for (const DiscPiece& piece : disc_pieces(picture_.surface, PointId{p})) {
            gpu::SplatRecord record = disc(p, piece.normal, color);
            for (std::size_t c = 0; c < 2; ++c)
                if (piece.cuts[c] != glm::dvec3(0.0))
                    record.cuts[c] = glm::vec3(glm::normalize(piece.cuts[c]));
            scene.splats.push_back(record);
        }
    }

    gpu::SplatRecord disc(std::uint32_t p, const glm::dvec3& normal, const PointColor& color,
                          bool is_shaded = true) const {
        return {.position = glm::vec3(place(p)),
                .radius = static_cast<float>(radii_[p]),
                .normal = glm::vec3(normal),
                .color = packed(color, is_shaded),
                .cuts = {}};
    }

    template <typename ColorOf>
    void add_discs(SplatScene& scene, ColorOf&& color_of) const {
        for (std::uint32_t p = 0; p < picture_.surface.size(); ++p)
            add_discs_of(scene, p, color_of(p));
    }

    SplatScene with_normals(std::span<const glm::dvec3> normals) const {
        SplatScene scene = scene_;
        for (std::uint32_t p = 0; p < picture_.surface.size(); ++p)
            scene.splats.push_back(disc(p, normals[p], own_color(p)));
        return scene;
    }

    SplatScene with_umbrellas() const {
        SplatScene scene = scene_;
        add_discs(scene, [&](std::uint32_t p) { return own_color(p); });
        return scene;
    }

    // The points that the hull says are seen, and nothing of the surface.
    SplatScene dots() const {
        SplatScene scene = scene_;
        std::vector<glm::dvec3> places;
        for (std::uint32_t p = 0; p < picture_.surface.size(); ++p) places.push_back(place(p));
        for (const std::uint32_t p : visible_points(places, camera_.eye)) {
            scene.splats.push_back(disc(p, glm::dvec3(0.0), k_ink, false));
            scene.splats.back().radius *= k_dot;
        }
        return scene;
    }

    SplatScene marked(const std::vector<PointId>& points) const {
        SplatScene scene = with_umbrellas();
        for (const PointId point : points) {
            const std::uint32_t p = index(point);
            gpu::SplatRecord dot = disc(p, glm::dvec3(0.0), k_ink, false);
            dot.radius *= k_mark;
            dot.position = glm::vec3(lifted(p));
            scene.splats.push_back(dot);
        }
        return scene;
    }

    // The points whose normals are nearest to perpendicular to the view, as many as the silhouette has.
    std::vector<PointId> thresholded() const {
        std::vector<std::pair<double, PointId>> order;
        for (std::uint32_t p = 0; p < picture_.surface.size(); ++p) {
            const glm::dvec3 normal = picture_.surface.normal(PointId{p});
            if (normal == glm::dvec3(0.0)) continue;
            const glm::dvec3 to = glm::dvec3(point_.xyz()) - double{point_.w} * place(p);
            order.emplace_back(std::abs(glm::dot(normal, glm::normalize(to))), PointId{p});
        }
        const std::size_t count = std::min(silhouette_.size(), order.size());
        std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count),
                         order.end());
        std::vector<PointId> points;
        for (std::size_t i = 0; i < count; ++i) points.push_back(order[i].second);
        return points;
    }

    glm::dvec3 lifted(std::uint32_t p) const {
        const glm::dvec3 back =
            camera_.is_orthographic() ? camera_.eye - camera_.target : camera_.eye - place(p);
        const double length = glm::length(back);
        // Never as far as the camera.
        const double lift = std::min(k_lift * radii_[p], 0.5 * length);
        return length > 0.0 ? place(p) + back * (lift / length) : place(p);
    }

    void add_strokes(SplatScene& scene, std::span<const PointEdge> edges,
                     const PointColor& color) const {
        for (const auto& [a, b] : edges)
            scene.strokes.push_back({.from = glm::vec3(lifted(index(a))),
                                     .radius = k_line_radius,
                                     .to = glm::vec3(lifted(index(b))),
                                     .color = packed(color, false)});
    }

    // Edges at gaps that both their points have.
    void add_borders(SplatScene& scene) const {
        const PointSurface& surface = picture_.surface;
        std::vector<PointEdge> directed;
        for (std::uint32_t p = 0; p < surface.size(); ++p) {
            if (surface.label(PointId{p}) != PointLabel::border) continue;
            const auto range = surface.umbrellas_of(PointId{p});
            for (std::uint32_t u = range.first; u < range.last; ++u) {
                const Umbrella umbrella = surface.umbrella(UmbrellaId{u});
                const std::size_t size = umbrella.ring.size();
                for (std::size_t j = 0; j < size; ++j)
                    if (umbrella.is_gap(j) != umbrella.is_gap((j + size - 1) % size))
                        directed.push_back({PointId{p}, umbrella.ring[j]});
            }
        }
        std::ranges::sort(directed);
        std::vector<PointEdge> edges;
        for (const PointEdge& edge : directed)
            if (edge[0] < edge[1] &&
                std::ranges::binary_search(directed, PointEdge{edge[1], edge[0]}))
                edges.push_back(edge);
        add_strokes(scene, edges, label_color(PointLabel::border));
    }

    const PointsPicture& picture_;
    Camera camera_;
    std::vector<double> radii_;  // Of discs, in the index's units.
    SplatScene scene_;           // Without points.
    HomogeneousPoint point_{};
    std::vector<PointId> silhouette_;
    std::vector<PointEdge> consensus_;
};

}  // namespace

PointsPictureReport draw_points(const PointsPicture& picture, OutputFile& file) {
    const DrawingDevice device(picture.options);
    const PointsDrawing drawing(picture);
    SplatRenderer renderer(device.context());
    const ImageSize size = picture.options.size;
    const auto start = std::chrono::steady_clock::now();
    if (picture.mode == PointsMode::drawn) {
        write_png(file, renderer.render(drawing.drawn(), size.width, size.height));
    } else {
        std::vector<Picture> pictures;
        for (const SplatScene& scene : drawing.compared())
            pictures.push_back(renderer.render(scene, size.width, size.height));
        constexpr std::uint32_t k_columns = 2;
        constexpr std::uint32_t k_gap = 8;
        write_png(file, make_contact_sheet(pictures, k_columns, k_gap,
                                           picture.options.background.value_or(k_paper)));
    }
    return {
        .silhouette_point = drawing.silhouette_point(),
        .device = device.device.facts().name,
        .driver = device.device.facts().driver,
        .validation_messages = device.instance.validation_message_count(),
        .ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                  .count()};
}

}  // namespace rimline::tools
