// What must not change the visibility of lines: turns, the order of faces, and how a mesh names its vertices.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/lines/line_oracle.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/lines/difficult_meshes.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

// A turn that maps the axes to axes: exact in floats.
struct AxisTurn {
    std::array<int, 3> axes;  // Component i of the result is signs[i] times component axes[i].
    std::array<int, 3> signs;

    template <typename Vector>
    Vector operator()(const Vector& v) const {
        Vector result;
        for (int i = 0; i < 3; ++i) {
            const auto part = v[axes[std::size_t(i)]];
            result[i] = signs[std::size_t(i)] > 0 ? part : -part;
        }
        return result;
    }
    AxisTurn inverse() const {
        AxisTurn result{};
        for (int i = 0; i < 3; ++i) {
            result.axes[std::size_t(axes[std::size_t(i)])] = i;
            result.signs[std::size_t(axes[std::size_t(i)])] = signs[std::size_t(i)];
        }
        return result;
    }
};

// The 24 turns of a cube.
std::vector<AxisTurn> axis_turns() {
    std::vector<AxisTurn> turns;
    std::array<int, 3> axes{0, 1, 2};
    do {
        for (int bits = 0; bits < 8; ++bits) {
            const std::array<int, 3> signs{bits & 1 ? -1 : 1, bits & 2 ? -1 : 1, bits & 4 ? -1 : 1};
            const bool is_even =
                axes[(std::size_t(std::ranges::find(axes, 0) - axes.begin()) + 1) % 3] == 1;
            if (is_even == (signs[0] * signs[1] * signs[2] > 0)) turns.push_back({axes, signs});
        }
    } while (std::ranges::next_permutation(axes).found);
    return turns;
}

// The two ends of an edge, by their coordinates, the lesser one first.
using EdgePlace = std::array<std::array<float, 3>, 2>;
struct EdgePiece {
    double begin, end;  // Shares from the lesser end.
    std::uint32_t hidden_by;
};
using EdgeCounts = std::map<EdgePlace, std::vector<EdgePiece>>;

// The pieces of one count along all edges that are drawn, at places before a turn.
EdgeCounts counts_of(const Mesh& mesh, const LineDrawing& drawing, const AxisTurn& turn) {
    // Events whose places are equal but for rounding errors may have another order.
    constexpr double k_no_length = 1e-6;
    const AxisTurn back = turn.inverse();
    const auto place_of = [&](VertexId v) {
        const glm::vec3 p = back(mesh.positions()[index(v)]);
        return std::array<float, 3>{p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
    };
    EdgeCounts counts;
    for (const LineRun& run : drawing.runs)
        for (std::uint32_t i = run.first_point; i + 1 < run.last_point; ++i) {
            const LineSource &from = drawing.sources[i], &to = drawing.sources[i + 1];
            if (from.edge == k_no_edge || from.edge != to.edge) continue;
            const Edge& edge = mesh.edge(from.edge);
            EdgePlace place{place_of(edge.vertices[0]), place_of(edge.vertices[1])};
            double begin = double{from.share}, end = double{to.share};
            if (place[1] < place[0]) {
                std::swap(place[0], place[1]);
                begin = 1.0 - begin, end = 1.0 - end;
            }
            if (begin > end) std::swap(begin, end);
            if (end - begin > k_no_length) counts[place].push_back({begin, end, run.hidden_by});
        }
    for (auto& [place, pieces] : counts) {
        std::ranges::sort(pieces, {}, &EdgePiece::begin);
        std::vector<EdgePiece> joined;
        for (const EdgePiece& piece : pieces)
            if (!joined.empty() && joined.back().hidden_by == piece.hidden_by)
                joined.back().end = piece.end;
            else
                joined.push_back(piece);
        pieces = std::move(joined);
    }
    return counts;
}

struct Camera {
    glm::dvec3 eye, target, up;
    bool is_orthographic;
    LineView view(const AxisTurn& turn) const {
        return is_orthographic ? LineView::orthographic(turn(eye), turn(target), turn(up))
                               : LineView::perspective(turn(eye), turn(target), turn(up));
    }
};

constexpr AxisTurn k_no_turn{{0, 1, 2}, {1, 1, 1}};

EdgeCounts counts_of(const Mesh& mesh, const Camera& camera, const AxisTurn& turn = k_no_turn) {
    const LineSurface surface(mesh);
    LineDrawer drawer(surface);
    const LineView view = camera.view(turn);
    const LineDrawing& drawing =
        drawer.draw(view, brute_force_silhouette(mesh, view.point()), checkable({}));
    CHECK(drawing.report.failed_checks == 0);
    return counts_of(mesh, drawing, turn);
}

void check_equal(const EdgeCounts& a, const EdgeCounts& b) {
    REQUIRE(a.size() == b.size());
    for (auto i = a.begin(), j = b.begin(); i != a.end(); ++i, ++j) {
        REQUIRE(i->first == j->first);
        REQUIRE(i->second.size() == j->second.size());
        for (std::size_t k = 0; k < i->second.size(); ++k) {
            REQUIRE(i->second[k].hidden_by == j->second[k].hidden_by);
            REQUIRE(std::abs(i->second[k].begin - j->second[k].begin) < 1e-5);
        }
    }
}

std::vector<Camera> cameras_of(const Mesh& mesh) {
    std::vector<Camera> cameras;
    for (const bool is_orthographic : {false, true})
        for (const glm::dvec3& way :
             {glm::dvec3(1, 2, 3), glm::dvec3(0, 0, 3), glm::dvec3(0.2, 0.3, -0.1)})
            cameras.push_back(
                {mesh.center() + mesh.radius() * way, mesh.center(), {0, 1, 0}, is_orthographic});
    return cameras;
}

std::vector<MeshSource> meshes_of_invariances() {
    return {tests::broken_knot(5), tests::crossing_knots(2000), make_built_in_shape("scene", 2000)};
}

TEST_CASE("counts along all edges stay when mesh and camera are turned together" *
          doctest::test_suite("plain")) {
    const std::vector<AxisTurn> turns = axis_turns();
    REQUIRE(turns.size() == 24);
    for (const MeshSource& source : meshes_of_invariances()) {
        const Mesh mesh(source);
        for (const Camera& camera : cameras_of(mesh)) {
            const EdgeCounts expected = counts_of(mesh, camera);
            CHECK(expected.size() > 100);
            for (std::size_t t = 0; t < turns.size(); ++t) {
                CAPTURE(t);
                MeshSource turned = source;
                for (glm::vec3& p : turned.positions) p = turns[t](p);
                REQUIRE(camera.view(turns[t]).point().xyz() ==
                        turns[t](camera.view(k_no_turn).point().xyz()));
                check_equal(counts_of(Mesh(turned), camera, turns[t]), expected);
            }
        }
    }
}

TEST_CASE("counts along all edges stay when vertices and faces have another order") {
    for (const MeshSource& source : meshes_of_invariances()) {
        const Mesh mesh(source);
        for (const Camera& camera : cameras_of(mesh)) {
            const EdgeCounts expected = counts_of(mesh, camera);
            for (const std::uint64_t seed : {1u, 2u, 3u}) {
                CAPTURE(seed);
                check_equal(counts_of(Mesh(tests::shuffled(source, seed)), camera), expected);
            }
        }
    }
}

// Each triangle with vertices of its own.
MeshSource apart(const MeshSource& source) {
    MeshSource result;
    for (const auto& t : source.triangles) {
        const auto first = static_cast<std::uint32_t>(result.positions.size());
        for (const std::uint32_t v : t) result.positions.push_back(source.positions[v]);
        result.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

TEST_CASE("counts along all edges stay when each triangle comes with vertices of its own") {
    for (const MeshSource& source : meshes_of_invariances()) {
        const Mesh mesh(source);
        for (const Camera& camera : cameras_of(mesh))
            check_equal(counts_of(Mesh(apart(source)), camera), counts_of(mesh, camera));
    }
}

}  // namespace
}  // namespace rimline
