#include "tools/output/shown_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <vector>

#include "silhouette/hough/silhouette_tracker.h"
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

LineView view_of(const Camera& camera) {
    return camera.is_orthographic() ? LineView::orthographic(camera.eye, camera.target, camera.up)
                                    : LineView::perspective(camera.eye, camera.target, camera.up);
}

// Pixels for each unit of picture coordinates.
double pixels_a_unit(const Camera& camera, ImageSize size) {
    if (camera.is_orthographic()) return size.height / camera.ortho_height;
    return 0.5 * size.height / std::tan(0.5 * glm::radians(camera.fov_y_deg));
}

}  // namespace

ShownLines::ShownLines(const HoughOctree& octree, LineSurface::Contacts contacts,
                       const LongCall& call)
    : octree_(octree), surface_(octree.mesh(), contacts, call), drawer_(surface_) {}

const PictureLines* ShownLines::draw(const Camera& camera, ImageSize size, const LineStyle& style,
                                     const LongCall& call) {
    const glm::dvec3 reach = glm::abs(camera.eye) + glm::distance(camera.eye, camera.target);
    if (!HomogeneousPoint::is_valid(glm::vec3(reach))) return nullptr;
    const LineView view = view_of(camera);
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
                        .simplify = k_simplify_px / pixels};
    options.draws[std::size_t(LineKind::crease)] = style.crease_degrees > 0.0;
    options.draws[std::size_t(LineKind::intersection)] = style.intersections;
    const LineDrawing& drawing = drawer_.draw(view, silhouette.silhouette(), options, call);

    lines_.points.clear();
    lines_.lines.clear();
    first_point_ = 0;
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

void ShownLines::add_strokes(const LineDrawing& drawing) {
    for (const LineStroke& stroke : drawing.strokes) {
        for (const StrokePart& part : drawing.parts_of(stroke))
            add_run(drawing, part.run, part.is_reversed);
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
                add_run(drawing, chain.first_run + static_cast<std::uint32_t>(run), false);
        }
        end_hidden_line(is_loop, min_length);
    }
}

// Runs that follow each other share a place.
void ShownLines::add_run(const LineDrawing& drawing, std::uint32_t run, bool is_reversed) {
    const std::span<const LinePoint> points = drawing.points_of(drawing.runs[run]);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec2& place = points[is_reversed ? points.size() - 1 - i : i].position;
        if (lines_.points.size() == first_point_ || lines_.points.back() != place)
            lines_.points.push_back(place);
    }
}

// Short hidden lines say nothing.
void ShownLines::end_hidden_line(bool is_closed, double min_length) {
    double length = 0.0;
    for (std::size_t i = first_point_; i + 1 < lines_.points.size(); ++i)
        length += glm::distance(lines_.points[i], lines_.points[i + 1]);
    if (length < min_length) lines_.points.resize(first_point_);
    end_line(true, is_closed);
}

void ShownLines::end_line(bool is_hidden, bool is_closed) {
    if (is_closed && lines_.points.size() > first_point_ + 1 &&
        lines_.points.back() == lines_.points[first_point_])
        lines_.points.pop_back();
    const auto end = static_cast<std::uint32_t>(lines_.points.size());
    if (end > first_point_)
        lines_.lines.push_back({.first_point = first_point_,
                                .last_point = end,
                                .is_hidden = is_hidden,
                                .is_closed = is_closed});
    first_point_ = end;
}

}  // namespace rimline::tools
