#include "silhouette/field/ray_ratios.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "silhouette/mesh/edge_convexity.h"
#include "silhouette/mesh/face_tree.h"
#include "silhouette/mesh/line_hit.h"
#include "silhouette/mesh/solid.h"

namespace rimline {

namespace {

constexpr double k_near_radii = 1e-4;
// Lines are followed beside the picture over this many of its sides, and not farther: a cut at the picture itself would
// round otherwise.
constexpr double k_pictures_beside = 64.0;

// As in shaders/visible_line.vert and engine/measure/ratio_drawing.cpp.
constexpr double k_nearer = 1e-5;
constexpr double k_bias_slopes = 2.0;

// The nearness of pixels that only hidden lines cover. 0: of those without a line.
constexpr float k_hidden = -1.0f;

struct ScreenPoint {
    glm::vec2 px;
    float nearness;  // 1 / distance, which is linear on the screen.
};

// Cuts a line at the sides of the square from `low` to `high`. Returns whether something is left of it. A line that
// lies inside keeps its bits.
bool cut_at_square(ScreenPoint& a, ScreenPoint& b, double low, double high) {
    const glm::dvec2 from(a.px), way = glm::dvec2(b.px) - from;
    double begin = 0.0, end = 1.0;
    for (int axis = 0; axis < 2; ++axis) {
        const double at = from[axis], last = at + way[axis];
        if (!(std::min(at, last) <= high && std::max(at, last) >= low)) return false;
        if (at < low) begin = std::max(begin, (low - at) / way[axis]);
        if (at > high) begin = std::max(begin, (high - at) / way[axis]);
        if (last < low) end = std::min(end, (low - at) / way[axis]);
        if (last > high) end = std::min(end, (high - at) / way[axis]);
    }
    if (!(begin <= end)) return false;
    const auto point_at = [&](double share) {
        return ScreenPoint{glm::vec2(glm::clamp(from + share * way, low, high)),
                           float(glm::mix(double{a.nearness}, double{b.nearness}, share))};
    };
    const ScreenPoint first = begin > 0.0 ? point_at(begin) : a;
    if (end < 1.0) b = point_at(end);
    a = first;
    return true;
}

// Calls visit(x, y, nearness) for each pixel that the line passes through, in its order. Lines of equal depth are
// oblique, because visible_line.vert sweeps a pixel along the line.
template <typename Visit>
void each_pixel(const ScreenPoint& a, const ScreenPoint& b, Visit&& visit) {
    const glm::vec2 along = b.px - a.px;
    const glm::ivec2 step(along.x < 0.0f ? -1 : 1, along.y < 0.0f ? -1 : 1);
    glm::ivec2 pixel(glm::floor(a.px));
    const glm::ivec2 last(glm::floor(b.px));
    // Where along the line it leaves the pixel's column, and its row; and how wide they are there.
    const glm::vec2 width = 1.0f / glm::max(glm::abs(along), 1e-12f);
    glm::vec2 leave = glm::abs(glm::vec2(pixel + glm::max(step, glm::ivec2(0))) - a.px) * width;
    const float length = std::abs(along.x) + std::abs(along.y);
    for (int left = std::abs(last.x - pixel.x) + std::abs(last.y - pixel.y);; --left) {
        const float swept = glm::dot(glm::vec2(step), glm::vec2(pixel) + 0.5f - a.px);
        const float share = length > 0.0f ? std::clamp(swept / length, 0.0f, 1.0f) : 0.0f;
        visit(pixel.x, pixel.y, std::lerp(a.nearness, b.nearness, share));
        if (left == 0) return;
        const int i = leave.x < leave.y ? 0 : 1;
        pixel[i] += step[i];
        leave[i] += width[i];
    }
}

}  // namespace

// What does not depend on the viewpoint.
struct RayRatios::Faces {
    Faces(const Mesh& mesh, const LongCall& call)
        : tree(mesh, call.part(0.0, 0.5)),
          is_solid(rimline::is_solid(mesh, tree, call.part(0.5, 1.0))),
          concave_bits(concave_edge_bits(mesh)) {}

    FaceTree tree;
    bool is_solid;
    std::vector<std::uint32_t> concave_bits;
};

struct RayRatios::View {
    HomogeneousPoint point;
    glm::dvec3 eye;
    glm::dmat3 eye_from_object;  // x right, y down, z towards the viewer.
    double focal_px;
    double near;
    bool hides_valleys;
};

struct RayRatios::Scratch {
    BlockScratch blocks;
    std::vector<EdgeId> edges;
    std::vector<float> nearest;          // The nearness of the nearest line in each pixel.
    std::vector<std::uint32_t> covered;  // Pixels with a line.
};

RayRatios::RayRatios(const HoughOctree& octree, const Options& options, const LongCall& call)
    : octree_(octree),
      mesh_(octree.mesh()),
      options_(options),
      faces_(std::make_unique<const Faces>(mesh_, call)) {
    RIMLINE_CHECK(options.side_px > 0 && options.fov_deg > 0.0 && options.fov_deg < 180.0);
}

RayRatios::~RayRatios() = default;

RayRatios::View RayRatios::view_from(const glm::dvec3& eye) const {
    const HomogeneousPoint point = HomogeneousPoint::viewpoint(glm::vec3(eye));
    const glm::dvec3 from(point.xyz());
    const glm::dvec3 center = mesh_.center();
    const glm::dvec3 back = from != center ? glm::normalize(from - center) : glm::dvec3(0, 0, 1);
    const glm::dvec3 up = mesh_.up() == UpAxis::z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    glm::dvec3 right = glm::cross(up, back);
    if (glm::length(right) < 1e-9)
        right =
            glm::cross(std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1), back);
    right = glm::normalize(right);
    return {.point = point,
            .eye = from,
            .eye_from_object = glm::transpose(glm::dmat3(right, glm::cross(right, back), back)),
            .focal_px = 0.5 * options_.side_px / std::tan(0.5 * glm::radians(options_.fov_deg)),
            .near = k_near_radii * mesh_.radius(),
            .hides_valleys = faces_->is_solid && glm::distance(from, center) > mesh_.radius()};
}

// Finds the pixels of all lines.
void RayRatios::cover_pixels(const View& view, Scratch& scratch) const {
    const auto side = static_cast<int>(options_.side_px);
    scratch.nearest.resize(std::size_t(side) * std::size_t(side));
    for (const std::uint32_t pixel : scratch.covered) scratch.nearest[pixel] = 0.0f;
    scratch.covered.clear();

    const auto seen_from_eye = [&](VertexId vertex) {
        return view.eye_from_object * (glm::dvec3(mesh_.positions()[index(vertex)]) - view.eye);
    };
    const auto on_screen = [&](const glm::dvec3& p) {
        const double nearness = -1.0 / p.z;
        return ScreenPoint{
            glm::vec2(view.focal_px * nearness * glm::dvec2(p) + 0.5 * options_.side_px),
            float(nearness)};
    };
    const auto add = [&](EdgeId edge, bool is_hidden) {
        const auto& [from, to] = mesh_.edge(edge).vertices;
        glm::dvec3 a = seen_from_eye(from), b = seen_from_eye(to);
        if (std::max(-a.z, -b.z) <= view.near) return;
        const glm::dvec3 crossing = glm::mix(a, b, (-a.z - view.near) / (b.z - a.z));
        if (-a.z < view.near) a = crossing;
        if (-b.z < view.near) b = crossing;
        ScreenPoint first = on_screen(a), last = on_screen(b);
        // Lines that end at the near plane may be millions of pixels long.
        const double beside = k_pictures_beside * options_.side_px;
        if (!cut_at_square(first, last, -beside, options_.side_px + beside)) return;
        each_pixel(first, last, [&](int x, int y, float nearness) {
            if (x < 0 || y < 0 || x >= side || y >= side) return;
            const auto pixel = static_cast<std::uint32_t>(y * side + x);
            float& nearest = scratch.nearest[pixel];
            if (nearest == 0.0f) {
                scratch.covered.push_back(pixel);
                nearest = is_hidden ? k_hidden : nearness;
            } else if (!is_hidden) {
                nearest = std::max(nearest, nearness);
            }
        });
    };
    const auto is_valley = [&](EdgeId edge) {
        return view.hides_valleys && is_concave(faces_->concave_bits, edge);
    };
    TraversalCounters counters;
    octree_.extract(view.point, scratch.edges, counters, scratch.blocks);
    for (const EdgeId edge : scratch.edges) add(edge, is_valley(edge));
    const Mesh::EdgeRange borders = mesh_.edges_of_class(EdgeClass::border);
    if (options_.has_borders)
        for (std::uint32_t e = borders.first; e < borders.last; ++e) add(EdgeId{e}, false);
}

// Whether no face lies in front of a line of this nearness at the pixel's center.
bool RayRatios::is_visible(const View& view, std::uint32_t pixel, float line_nearness) const {
    if (line_nearness == k_hidden) return false;
    const glm::dvec2 beside = glm::dvec2(pixel % options_.side_px, pixel / options_.side_px) + 0.5 -
                              0.5 * options_.side_px;
    const glm::dvec3 ray =
        glm::transpose(view.eye_from_object) * glm::dvec3(beside / view.focal_px, -1.0);
    const double line = double{line_nearness} * (1.0 + k_nearer);
    return !faces_->tree.any_along(view.eye, view.eye + ray / line, [&](std::uint32_t face) {
        const std::array<glm::dvec3, 3> corners = corners_of(mesh_, face);
        const std::optional<LineHit> hit = meet(corners, view.eye, ray);
        if (!hit || hit->distance < view.near) return false;
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double height = glm::dot(normal, view.eye - corners[0]);
        // The change of nearness from a pixel to the next.
        const glm::dvec2 change(view.eye_from_object * normal);
        const double slope =
            std::max(std::abs(change.x), std::abs(change.y)) / (view.focal_px * std::abs(height));
        return 1.0 / hit->distance - k_bias_slopes * slope > line;
    });
}

std::vector<double> RayRatios::measure(std::span<const glm::dvec3> eyes,
                                       const std::stop_token& stop) const {
    tbb::enumerable_thread_specific<Scratch> scratches([&] {
        return Scratch{octree_.make_scratch(), {}, {}, {}};
    });
    std::vector<double> ratios(eyes.size(), 0.0);
    tbb::parallel_for(std::size_t{0}, eyes.size(), [&](std::size_t i) {
        if (stop.stop_requested()) return;
        Scratch& scratch = scratches.local();
        const View view = view_from(eyes[i]);
        cover_pixels(view, scratch);
        const auto visible = std::ranges::count_if(scratch.covered, [&](std::uint32_t pixel) {
            return is_visible(view, pixel, scratch.nearest[pixel]);
        });
        if (visible > 0) ratios[i] = double(visible) / double(scratch.covered.size());
    });
    LongCall{stop, {}}.checkpoint(1.0);
    return ratios;
}

}  // namespace rimline
