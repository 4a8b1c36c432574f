#include "silhouette/lines/smooth_contour.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <vector>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/creases.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/lines/against_oracle.h"
#include "tests/silhouette/lines/difficult_meshes.h"

namespace rimline {
namespace {

// Far more than rounding errors, far less than any tolerance here.
constexpr double k_rounding = 1e-12;

// The drawings of one view without and with smooth contours.
class SmoothPair {
public:
    SmoothPair(const Mesh& mesh, const LineView& view, LineOptions options)
        : surface_(mesh), mesh_drawer_(surface_), smooth_drawer_(surface_) {
        const std::vector<EdgeId> silhouette = brute_force_silhouette(mesh, view.point());
        smooth_ = &smooth_drawer_.draw(view, silhouette, options);
        options.smooth = options.simplify = 0.0;
        mesh_ = &mesh_drawer_.draw(view, silhouette, options);
    }
    const LineDrawing& of_mesh() const { return *mesh_; }
    const LineDrawing& smooth() const { return *smooth_; }

private:
    LineSurface surface_;
    LineDrawer mesh_drawer_, smooth_drawer_;
    const LineDrawing *mesh_, *smooth_;
};

template <typename Visit>
void each_smooth_view(Visit&& visit) {
    const std::array<MeshSource, 6> sources{
        make_built_in_shape("knot", 3000),  make_built_in_shape("torus", 2000),
        make_built_in_shape("scene", 5000), make_built_in_shape("terrain", 2000),
        tests::crossing_knots(3000),        tests::broken_knot(8)};
    for (std::size_t shape = 0; shape < sources.size(); ++shape) {
        CAPTURE(shape);
        const Mesh mesh(sources[shape]);
        for (const bool is_orthographic : {false, true})
            for (const glm::dvec3& direction : {glm::dvec3(1, 2, 3), glm::dvec3(-3, 1, 0.5)}) {
                CAPTURE(is_orthographic);
                CAPTURE(direction.x);
                visit(mesh, tests::view_of(mesh, direction, is_orthographic),
                      is_orthographic ? mesh.radius() : 0.35);
            }
    }
}

LineOptions smooth_by(double tolerance) {
    LineOptions options;
    options.smooth = tolerance;
    options.keeps_coincident = true;
    return options;
}

TEST_CASE("smooth contours leave chains and visibility as they are and move no point far") {
    std::size_t moved = 0, limited = 0;
    each_smooth_view([&](const Mesh& mesh, const LineView& view, double size) {
        for (const double tolerance : {0.0005 * size, 0.004 * size}) {
            CAPTURE(tolerance);
            const SmoothPair pair(mesh, view, smooth_by(tolerance));
            const LineDrawing &from = pair.of_mesh(), &to = pair.smooth();
            REQUIRE(from.chains.size() == to.chains.size());
            REQUIRE(from.runs.size() == to.runs.size());
            REQUIRE(from.points.size() == to.points.size());
            for (std::size_t c = 0; c < from.chains.size(); ++c) {
                CHECK(from.chains[c].first_run == to.chains[c].first_run);
                CHECK(from.chains[c].last_run == to.chains[c].last_run);
                CHECK(from.chains[c].kind == to.chains[c].kind);
                CHECK(from.chains[c].is_closed == to.chains[c].is_closed);
                CHECK(from.chains[c].id == to.chains[c].id);
            }
            for (std::size_t r = 0; r < from.runs.size(); ++r) {
                const LineRun &a = from.runs[r], &b = to.runs[r];
                CHECK(a.hidden_by == b.hidden_by);
                CHECK(a.first_point == b.first_point);
                CHECK(a.last_point == b.last_point);
                for (std::uint32_t i = a.first_point; i < a.last_point; ++i) {
                    REQUIRE(from.sources[i].edge == to.sources[i].edge);
                    REQUIRE(from.sources[i].share == to.sources[i].share);
                    const double way =
                        glm::distance(from.points[i].position, to.points[i].position);
                    CHECK(way <= tolerance + k_rounding);
                    if (from.chains[a.chain].kind != LineKind::silhouette) CHECK(way == 0.0);
                    moved += way > 0.0;
                    limited += way > 0.99 * tolerance;
                }
            }
        }
    });
    CHECK(moved > 1000);
    CHECK(limited > 100);
}

TEST_CASE("visible lines have the same shape where hidden ones have none") {
    std::size_t seen = 0, unshaped = 0;
    each_smooth_view([&](const Mesh& mesh, const LineView& view, double size) {
        const LineSurface surface(mesh);
        const std::vector<EdgeId> silhouette = brute_force_silhouette(mesh, view.point());
        LineOptions options = smooth_by(0.004 * size);
        LineDrawer drawer(surface), other_drawer(surface);
        const LineDrawing& all = drawer.draw(view, silhouette, options);
        options.shapes_hidden = false;
        const LineDrawing& visible = other_drawer.draw(view, silhouette, options);
        REQUIRE(all.runs.size() == visible.runs.size());
        REQUIRE(all.points.size() == visible.points.size());
        for (const LineRun& run : all.runs)
            for (std::uint32_t i = run.first_point; i < run.last_point; ++i) {
                const bool is_same = all.points[i].position == visible.points[i].position;
                if (run.is_visible()) REQUIRE(is_same);
                seen += run.is_visible();
                unshaped += !is_same;
            }
    });
    CHECK(seen > 1000);
    CHECK(unshaped > 1000);
}

TEST_CASE("points where visibility changes and ends of lines stay") {
    std::size_t changes = 0, moved_neighbors = 0;
    each_smooth_view([&](const Mesh& mesh, const LineView& view, double size) {
        const SmoothPair pair(mesh, view, smooth_by(0.004 * size));
        const LineDrawing &from = pair.of_mesh(), &to = pair.smooth();
        REQUIRE(from.points.size() == to.points.size());
        const auto stays = [&](std::uint32_t i) {
            return from.points[i].position == to.points[i].position;
        };
        for (const LineChain& chain : from.chains) {
            if (chain.kind != LineKind::silhouette) continue;
            const LineRun &first = from.runs[chain.first_run],
                          &last = from.runs[chain.last_run - 1];
            // A closed chain begins at a change if it has one.
            const bool is_fixed_at_seam = !chain.is_closed || chain.last_run - chain.first_run > 1;
            if (is_fixed_at_seam) {
                CHECK(stays(first.first_point));
                CHECK(stays(last.last_point - 1));
            }
            for (std::uint32_t r = chain.first_run; r + 1 < chain.last_run; ++r) {
                REQUIRE(from.runs[r].is_visible() != from.runs[r + 1].is_visible());
                CHECK(stays(from.runs[r].last_point - 1));
                CHECK(stays(from.runs[r + 1].first_point));
                ++changes;
                moved_neighbors += !stays(from.runs[r + 1].first_point + 1);
            }
        }
    });
    CHECK(changes > 200);
    CHECK(moved_neighbors > 100);
}

// Creases are not drawn here: then nothing but their angle says that they are there.
TEST_CASE("silhouettes stay at the vertices of creases") {
    std::size_t at_creases = 0, moved = 0;
    each_smooth_view([&](const Mesh& mesh, const LineView& view, double size) {
        LineOptions options = smooth_by(0.004 * size);
        options.draws[std::size_t(LineKind::crease)] = false;
        std::vector<std::uint8_t> is_at_crease(mesh.vertex_count(), 0);
        for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
            if (bend_of(mesh, EdgeId{e}) >= double{options.crease_angle_rad})
                for (const VertexId v : mesh.edge(EdgeId{e}).vertices) is_at_crease[index(v)] = 1;
        const SmoothPair pair(mesh, view, options);
        const LineDrawing &from = pair.of_mesh(), &to = pair.smooth();
        REQUIRE(from.points.size() == to.points.size());
        for (std::size_t i = 0; i < from.points.size(); ++i) {
            const auto& [edge, share] = from.sources[i];
            if (edge == k_no_edge || (share != 0.0f && share != 1.0f)) continue;
            const bool stays = from.points[i].position == to.points[i].position;
            moved += !stays;
            if (is_at_crease[index(mesh.edge(edge).vertices[share == 0.0f ? 0 : 1])] == 0) continue;
            CHECK(stays);
            ++at_creases;
        }
    });
    CHECK(at_creases > 100);
    CHECK(moved > 1000);
}

TEST_CASE("a tolerance of zero moves nothing") {
    each_smooth_view([&](const Mesh& mesh, const LineView& view, double) {
        const SmoothPair pair(mesh, view, smooth_by(0.0));
        REQUIRE(pair.smooth().points.size() == pair.of_mesh().points.size());
        for (std::size_t i = 0; i < pair.smooth().points.size(); ++i)
            REQUIRE(pair.smooth().points[i].position == pair.of_mesh().points[i].position);
    });
}

struct FlatSegment {
    glm::dvec2 from, to;
};

double distance_to_segments(const glm::dvec2& p, std::span<const FlatSegment> segments) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : segments) {
        const glm::dvec2 way = to - from;
        const double square = glm::dot(way, way);
        const double share =
            square > 0.0 ? std::clamp(glm::dot(p - from, way) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, glm::distance(p, from + share * way));
    }
    return least;
}

// Where the faces of a mesh meet a plane, in the picture.
std::vector<FlatSegment> section_of(const Mesh& mesh, const glm::dvec3& normal, double offset,
                                    const LineView& view) {
    std::vector<FlatSegment> segments;
    for (const Triangle& t : mesh.triangles()) {
        std::vector<glm::dvec2> ends;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 p(mesh.positions()[index(t[k])]);
            const glm::dvec3 q(mesh.positions()[index(t[(k + 1) % 3])]);
            const double f = glm::dot(normal, p) - offset, g = glm::dot(normal, q) - offset;
            if ((f > 0.0) != (g > 0.0))
                ends.push_back(view.project(glm::mix(p, q, f / (f - g))).position);
        }
        if (ends.size() == 2) segments.push_back({ends[0], ends[1]});
    }
    return segments;
}

// The normals at the vertices of a sphere are exact, and its contour is a plane curve: p · eye = 1, in an orthographic
// view p · direction = 0. Both are linear in p, so the interpolated contour is the section of the mesh by that plane.
TEST_CASE("the smooth contour of a sphere lies in the plane of the true contour") {
    std::size_t points = 0;
    double of_mesh = 0.0;
    for (const std::uint32_t faces : {320u, 1280u, 5000u}) {
        CAPTURE(faces);
        const Mesh mesh(make_built_in_shape("sphere", faces));
        LineOptions options;
        options.smooth = 0.2;
        options.draws = {true, false, false, false};
        for (const bool is_orthographic : {false, true})
            for (const glm::dvec3& direction :
                 {glm::dvec3(1, 2, 3), glm::dvec3(-3, 1, 0.5), glm::dvec3(2, -5, 1)}) {
                const glm::dvec3 eye = 3.0 * glm::normalize(direction);
                const LineView view = is_orthographic
                                          ? LineView::orthographic(eye, glm::dvec3(0.0), {0, 1, 0})
                                          : LineView::perspective(eye, glm::dvec3(0.0), {0, 1, 0});
                const std::vector<FlatSegment> section =
                    section_of(mesh, eye, is_orthographic ? 0.0 : 1.0, view);
                const SmoothPair pair(mesh, view, options);
                for (std::size_t i = 0; i < pair.smooth().points.size(); ++i) {
                    // 2^-20 is the distance between the eye and the view's point.
                    CHECK(distance_to_segments(pair.smooth().points[i].position, section) <
                          0x1p-20);
                    of_mesh += distance_to_segments(pair.of_mesh().points[i].position, section);
                    ++points;
                }
            }
    }
    REQUIRE(points > 1000);
    CHECK(of_mesh / double(points) > 5e-4);
}

double distance_to_points(const glm::dvec2& p, std::span<const LinePoint> line) {
    double least = glm::distance(p, line.front().position);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const glm::dvec2 from = line[i].position, way = line[i + 1].position - from;
        const double square = glm::dot(way, way);
        const double share =
            square > 0.0 ? std::clamp(glm::dot(p - from, way) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, glm::distance(p, from + share * way));
    }
    return least;
}

TEST_CASE("smoothing and simplifying together move nothing by more than both tolerances") {
    std::size_t near_both = 0;
    each_smooth_view([&](const Mesh& mesh, const LineView& view, double size) {
        LineOptions options = smooth_by(0.003 * size);
        options.simplify = 0.002 * size;
        const SmoothPair pair(mesh, view, options);
        const LineDrawing &from = pair.of_mesh(), &to = pair.smooth();
        REQUIRE(from.runs.size() == to.runs.size());
        CHECK(to.points.size() < from.points.size());
        for (std::size_t r = 0; r < from.runs.size(); ++r)
            for (const LinePoint& point : from.points_of(from.runs[r])) {
                const double way = distance_to_points(point.position, to.points_of(to.runs[r]));
                CHECK(way <= options.smooth + options.simplify + k_rounding);
                near_both += way > options.smooth;
            }
    });
    CHECK(near_both > 10);
}

}  // namespace
}  // namespace rimline
