#include "silhouette/lines/line_identity.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/lines/line_drawer.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/lines/against_oracle.h"

namespace rimline {
namespace {

// A camera on an orbit, with a tracker of its silhouette and a drawer.
class OrbitDrawing {
public:
    explicit OrbitDrawing(const Mesh& mesh, const LineOptions& options = {})
        : mesh_(mesh),
          options_(options),
          octree_(mesh),
          tracker_(octree_, view_at(0.0).point()),
          surface_(mesh),
          drawer_(surface_) {}

    const LineDrawing& first() {
        return drawer_.draw(view_at(0.0), tracker_.silhouette(), options_);
    }
    /// The drawing at an angle by a drawer that knows no frame before.
    LineDrawing fresh(double angle_degrees) {
        const LineView view = view_at(angle_degrees);
        return LineDrawer(surface_).draw(view, tracker_.silhouette(), options_);
    }
    const LineDrawing& next(double angle_degrees) {
        const LineView view = view_at(angle_degrees);
        const ChangeSet& changes = tracker_.move_to(view.point());
        return drawer_.draw_next(view, tracker_.silhouette(), changes, options_);
    }

private:
    LineView view_at(double angle_degrees) const {
        const double angle_rad = angle_degrees * std::numbers::pi / 180.0;
        return tests::view_of(mesh_, {std::cos(angle_rad), 0.35, std::sin(angle_rad)}, false);
    }

    const Mesh& mesh_;
    LineOptions options_;
    HoughOctree octree_;
    SilhouetteTracker tracker_;
    LineSurface surface_;
    LineDrawer drawer_;
};

std::set<std::uint32_t> ids_of(const LineDrawing& drawing) {
    std::set<std::uint32_t> ids;
    for (const LineChain& chain : drawing.chains) ids.insert(chain.id);
    return ids;
}

std::map<EdgeId, std::uint32_t> ids_by_edge(const LineDrawing& drawing) {
    std::map<EdgeId, std::uint32_t> ids;
    for (const LineRun& run : drawing.runs)
        for (std::uint32_t i = run.first_point; i + 1 < run.last_point; ++i)
            ids[drawing.sources[i].edge] = drawing.chains[run.chain].id;
    return ids;
}

TEST_CASE("the outline of a sphere keeps its id on an orbit") {
    const Mesh mesh(make_built_in_shape("sphere", 5000));
    LineOptions options;
    options.draws = {true, true, false, true};
    OrbitDrawing orbit(mesh, options);
    REQUIRE(orbit.first().chains.size() == 1);
    for (int frame = 1; frame <= 180; ++frame) {
        CAPTURE(frame);
        const LineDrawing& drawing = orbit.next(2.0 * frame);
        REQUIRE(drawing.chains.size() == 1);
        CHECK(drawing.chains[0].id == 0);
    }
}

TEST_CASE("edges that stay lines keep their ids") {
    MeshSource source = make_built_in_shape("box", 12);
    source.triangles.resize(10);
    const Mesh mesh(source);
    LineOptions options;
    options.draws = {true, true, true, false};
    options.keeps_coincident = true;
    OrbitDrawing orbit(mesh, options);
    const std::map<EdgeId, std::uint32_t> first = ids_by_edge(orbit.first());
    REQUIRE(first.size() >= 10);
    // No face turns within a degree.
    for (int frame = 1; frame < 8; ++frame) {
        CAPTURE(frame);
        for (const auto& [edge, id] : ids_by_edge(orbit.next(0.1 * frame)))
            if (first.contains(edge)) CHECK(first.at(edge) == id);
    }
}

TEST_CASE("every id is of one chain, and a camera that rests changes none") {
    const Mesh mesh(make_built_in_shape("scene", 20'000));
    OrbitDrawing orbit(mesh);
    orbit.first();
    for (int frame = 1; frame <= 40; ++frame) {
        CAPTURE(frame);
        const LineDrawing& drawing = orbit.next(0.5 * (frame / 2));
        const std::set<std::uint32_t> ids = ids_of(drawing);
        CHECK(ids.size() == drawing.chains.size());
        if (frame % 2 != 0) {
            const std::map<EdgeId, std::uint32_t> before = ids_by_edge(drawing);
            CHECK(ids_by_edge(orbit.next(0.5 * (frame / 2))) == before);
        }
    }
}

// By length, of the edges that are lines in two frames.
TEST_CASE("nine tenths of the lines of a moving knot keep their ids") {
    const Mesh mesh(make_built_in_shape("knot", 20'000));
    OrbitDrawing orbit(mesh);
    std::map<EdgeId, std::uint32_t> before = ids_by_edge(orbit.first());
    std::size_t stayed = 0, kept = 0;
    for (int frame = 1; frame <= 60; ++frame) {
        const std::map<EdgeId, std::uint32_t> now = ids_by_edge(orbit.next(0.5 * frame));
        for (const auto& [edge, id] : now) {
            const auto past = before.find(edge);
            if (past == before.end()) continue;
            ++stayed;
            kept += past->second == id;
        }
        before = now;
    }
    CHECK(stayed > 10'000);
    CHECK(static_cast<double>(kept) >= 0.9 * static_cast<double>(stayed));
}

TEST_CASE("the next frame differs from a fresh drawing by its ids alone") {
    const Mesh mesh(make_built_in_shape("scene", 20'000));
    OrbitDrawing orbit(mesh);
    orbit.first();
    for (int frame = 1; frame <= 5; ++frame) {
        const LineDrawing& next = orbit.next(3.0 * frame);
        const LineDrawing fresh = orbit.fresh(3.0 * frame);
        REQUIRE(next.points.size() == fresh.points.size());
        REQUIRE(next.chains.size() == fresh.chains.size());
        for (std::size_t i = 0; i < next.points.size(); ++i)
            REQUIRE(next.points[i].position == fresh.points[i].position);
        for (std::size_t i = 0; i < next.runs.size(); ++i)
            REQUIRE(next.runs[i].hidden_by == fresh.runs[i].hidden_by);
    }
}

// From one side of the mesh to the other: few edges stay, and most of the mesh is one patch.
TEST_CASE("a camera that jumps gets a drawing with an id for each chain") {
    const Mesh mesh(make_built_in_shape("knot", 20'000));
    OrbitDrawing orbit(mesh);
    orbit.first();
    for (const double angle_degrees : {180.0, 90.0, 271.0, 0.0}) {
        const LineDrawing& drawing = orbit.next(angle_degrees);
        CHECK(ids_of(drawing).size() == drawing.chains.size());
    }
}

TEST_CASE("a drawing that is no next one numbers its chains from zero") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    OrbitDrawing orbit(mesh);
    orbit.first();
    for (int frame = 1; frame <= 20; ++frame) orbit.next(3.0 * frame);
    const LineDrawing& drawing = orbit.first();
    for (std::uint32_t i = 0; i < drawing.chains.size(); ++i) CHECK(drawing.chains[i].id == i);
}

}  // namespace
}  // namespace rimline
