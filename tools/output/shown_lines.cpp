#include "tools/output/shown_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <span>
#include <vector>

#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/lines/line_simplify.h"
#include "silhouette/mesh/clear_creases.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

// Lines are joined over gaps of this length, and points that move a line by less than the other are left out, in
// pixels.
constexpr double k_gap_px = 4.0;
constexpr double k_simplify_px = 0.2;
// Default of --min-length, as a share of the picture's height.
constexpr double k_min_share = 1.0 / 60.0;
// Silhouettes move to the contour of the smooth surface by no more than half a line's width, in pixels.
constexpr double k_smooth_px = 1.0;

LineView view_of(const Camera& camera, const Mesh& mesh) {
    return camera.is_orthographic() ? LineView::orthographic(camera.eye, camera.target, camera.up)
                                    : LineView::perspective(camera.eye, camera.target, camera.up,
                                                            drawn_distance(mesh, camera.eye));
}

// Pixels for each unit of picture coordinates.
double pixels_a_unit(const Camera& camera, ImageSize size) {
    if (camera.is_orthographic()) return size.height / camera.ortho_height;
    return 0.5 * size.height / std::tan(0.5 * glm::radians(camera.fov_y_deg));
}

}  // namespace

ShownLines::ShownLines(const HoughOctree& octree, LineSurface::Contacts contacts,
                       const LongCall& call)
    : octree_(octree),
      own_surface_(std::in_place, octree.mesh(), contacts, call),
      surface_(*own_surface_),
      drawer_(surface_),
      materials_(octree.mesh()) {}

ShownLines::ShownLines(const HoughOctree& octree, const LineSurface& surface)
    : octree_(octree), surface_(surface), drawer_(surface_), materials_(octree.mesh()) {}

const PictureLines* ShownLines::draw(const Camera& camera, ImageSize size, const LineStyle& style,
                                     const LongCall& call) {
    const glm::dvec3 reach = glm::abs(camera.eye) + glm::distance(camera.eye, camera.target);
    if (!HomogeneousPoint::is_valid(glm::vec3(reach))) return nullptr;
    const LineView view = view_of(camera, octree_.mesh());
    const SilhouetteTracker silhouette(octree_, view.point());
    const double pixels = pixels_a_unit(camera, size);
    const double min_length = style.min_length.value_or(k_min_share * size.height) / pixels;
    choose_creases(style);
    LineOptions options{.crease_angle_rad = static_cast<float>(glm::radians(style.crease_degrees)),
                        .shown_creases = creases_,
                        .gap = k_gap_px / pixels,
                        .stubble = min_length,
                        .smooth = k_smooth_px / pixels,
                        .shapes_hidden = style.hidden,
                        // Places where colors change must stay.
                        .simplify = style.material_shades_are_light ? 0.0 : k_simplify_px / pixels};
    options.draws[std::size_t(LineKind::crease)] = style.crease_degrees > 0.0;
    options.draws[std::size_t(LineKind::intersection)] = style.intersections;
    const LineDrawing& drawing = drawer_.draw(view, silhouette.silhouette(), options, call);

    lines_.points.clear();
    lines_.lines.clear();
    points_.clear();
    colors_.clear();
    point_ = view.point();
    simplify_ = k_simplify_px / pixels;
    choose_colors(style);
    add_strokes(drawing);
    if (style.hidden) add_hidden_lines(drawing, min_length);
    silhouette_count_ = static_cast<std::uint32_t>(silhouette.silhouette().size()) +
                        octree_.mesh().edges_of_class(EdgeClass::border).size();
    return &lines_;
}

ShownLines prepare_lines(const HoughOctree& octree, const Context& context) {
    Progress progress(context, "finding contacts of faces");
    return ShownLines(octree, LineSurface::Contacts::found, progress.call());
}

// The same for all pictures of one style.
void ShownLines::choose_creases(const LineStyle& style) {
    if (style.crease_degrees == crease_degrees_ && style.all_creases == all_creases_) return;
    crease_degrees_ = style.crease_degrees;
    all_creases_ = style.all_creases;
    const Mesh& mesh = octree_.mesh();
    std::vector<Crease> creases;
    if (crease_degrees_ > 0.0)
        creases = find_creases(mesh, static_cast<float>(glm::radians(crease_degrees_)));
    if (!all_creases_) creases = clear_creases(mesh, creases);
    creases_.assign(mesh.edge_count(), 0);
    for (const Crease& crease : creases) creases_[index(crease.edge)] = 1;
    crease_count_ = static_cast<std::uint32_t>(creases.size());
}

void ShownLines::choose_colors(const LineStyle& style) {
    has_colors_ = style.material_shades_are_light.has_value();
    lines_.colors.clear();
    if (!has_colors_) return;
    for (const glm::vec3& color : materials_.inks().colors)
        lines_.colors.push_back(line_shade(color, *style.material_shades_are_light));
}

void ShownLines::add_strokes(const LineDrawing& drawing) {
    for (const LineStroke& stroke : drawing.strokes) {
        for (const StrokePart& part : drawing.parts_of(stroke)) add_run(drawing, part);
        end_line(false, stroke.is_closed);
    }
}

// A hidden line is what follows each other of a chain's hidden runs. Stretches that another line covers are missing
// between runs.
void ShownLines::add_hidden_lines(const LineDrawing& drawing, double min_length) {
    const auto goes_on = [&](const LineRun& before, const LineRun& run) {
        return !before.is_visible() && !run.is_visible() &&
               drawing.points_of(before).back().position == drawing.points_of(run).front().position;
    };
    for (const LineChain& chain : drawing.chains) {
        const std::span<const LineRun> runs = drawing.runs_of(chain);
        const auto before = [&](std::size_t i) { return i > 0 ? i - 1 : runs.size() - 1; };
        // A closed chain begins where one of its lines does, unless all of it is one line.
        std::size_t start = 0;
        if (chain.is_closed)
            while (start < runs.size() && goes_on(runs[before(start)], runs[start])) ++start;
        const bool is_loop = start == runs.size();
        for (std::size_t i = 0; i < runs.size(); ++i) {
            const std::size_t run = (start + i) % runs.size();
            if (i > 0 && !goes_on(runs[before(run)], runs[run])) end_hidden_line(false, min_length);
            if (!runs[run].is_visible())
                add_run(drawing,
                        drawing.whole(chain.first_run + static_cast<std::uint32_t>(run), false));
        }
        end_hidden_line(is_loop, min_length);
    }
}

// Runs that follow each other share a place. The source of a point is on the edge that leads to it, in the order of
// the run.
void ShownLines::add_run(const LineDrawing& drawing, const StrokePart& run) {
    const std::uint32_t count = run.last_point - run.first_point;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t at = run.is_reversed ? run.last_point - 1 - i : run.first_point + i;
        const LinePoint& point = drawing.points[at];
        if (!points_.empty() && points_.back().position == point.position) continue;
        const std::uint32_t source = run.is_reversed && i > 0 ? at + 1 : at;
        const std::uint8_t ink = has_colors_
                                     ? materials_.ink_of(drawing.sources[source].edge, point_)
                                     : k_no_material_ink;
        colors_.push_back(ink == k_no_material_ink ? k_own_line_color : ink);
        points_.push_back(point);
    }
}

// Short hidden lines say nothing.
void ShownLines::end_hidden_line(bool is_closed, double min_length) {
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < points_.size(); ++i)
        length += glm::distance(points_[i].position, points_[i + 1].position);
    if (length < min_length) points_.clear();
    end_line(true, is_closed);
}

// Parts of one color each.
void ShownLines::end_line(bool is_hidden, bool is_closed) {
    if (!points_.empty()) {
        const bool is_one_color =
            std::all_of(colors_.begin() + 1, colors_.end(),
                        [&](std::uint32_t color) { return color == colors_.back(); });
        if (is_closed && !is_one_color && points_.back().position != points_.front().position) {
            points_.push_back(points_.front());
            colors_.push_back(colors_.back());
        }
        std::size_t first = 0;
        for (std::size_t i = 2; i < points_.size(); ++i) {
            if (colors_[i] == colors_[i - 1]) continue;
            add_part(first, i - 1, is_hidden, false);
            first = i - 1;
        }
        add_part(first, points_.size() - 1, is_hidden, is_closed && is_one_color);
    }
    points_.clear();
    colors_.clear();
}

// The line from one point to another, both included.
void ShownLines::add_part(std::size_t first, std::size_t last, bool is_hidden, bool is_closed) {
    const auto begin = static_cast<std::uint32_t>(lines_.points.size());
    const std::span<const LinePoint> points(points_.data() + first, last + 1 - first);
    if (has_colors_) {
        simplify(points, simplify_, kept_);
        for (const std::uint32_t i : kept_) lines_.points.push_back(points[i].position);
    } else {
        for (const LinePoint& point : points) lines_.points.push_back(point.position);
    }
    if (is_closed && lines_.points.size() > begin + 1 &&
        lines_.points.back() == lines_.points[begin])
        lines_.points.pop_back();
    lines_.lines.push_back({.first_point = begin,
                            .last_point = static_cast<std::uint32_t>(lines_.points.size()),
                            .is_hidden = is_hidden,
                            .is_closed = is_closed,
                            .color = colors_[last]});
}

}  // namespace rimline::tools
