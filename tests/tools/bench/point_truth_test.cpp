#include "tools/bench/point_truth.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "silhouette/mesh/shapes/built_in_shape.h"

using namespace rimline;
using namespace rimline::tools;

namespace {

using Corners = std::array<std::uint32_t, 3>;

// A sphere whose vertices around the north pole are gone, and with them the faces there.
struct CutSphere {
    MeshSource open;
    std::vector<std::uint32_t> outline;  // In its order around the hole.

    explicit CutSphere(float from_z) {
        const Mesh sphere(make_built_in_shape("sphere", 4000));
        const auto is_kept = [&](VertexId v) {
            return sphere.positions()[index(v)].z / sphere.radius() < from_z;
        };
        std::map<std::uint32_t, std::uint32_t> numbers;
        std::map<std::uint32_t, std::uint32_t> next;
        const auto number = [&](VertexId v) {
            const auto [at, is_new] = numbers.try_emplace(index(v), std::uint32_t(numbers.size()));
            if (is_new) open.positions.push_back(sphere.positions()[index(v)]);
            return at->second;
        };
        for (const Triangle& t : sphere.triangles()) {
            if (!std::ranges::all_of(t, is_kept)) continue;
            const Corners corners{number(t[0]), number(t[1]), number(t[2])};
            open.triangles.push_back(corners);
            for (int c = 0; c < 3; ++c) next[corners[(c + 1) % 3]] = corners[c];
        }
        const Mesh mesh(open, Welding::none);
        const Mesh::EdgeRange borders = mesh.edges_of_class(EdgeClass::border);
        std::map<std::uint32_t, std::vector<std::uint32_t>> beside;
        for (std::uint32_t e = borders.first; e < borders.last; ++e) {
            const auto& ends = mesh.edge(EdgeId{e}).vertices;
            beside[index(ends[0])].push_back(index(ends[1]));
            beside[index(ends[1])].push_back(index(ends[0]));
        }
        outline.push_back(beside.begin()->first);
        for (std::uint32_t before = outline[0], at = beside.begin()->second[0]; at != outline[0];) {
            outline.push_back(at);
            const std::uint32_t onwards = beside[at][beside[at][0] == before ? 1 : 0];
            before = at;
            at = onwards;
        }
        REQUIRE(outline.size() == borders.size());
    }

    // Its hole closed by a fan, no vertex within.
    Mesh closed() const {
        MeshSource source = open;
        const auto is_edge = [&](std::uint32_t a, std::uint32_t b) {
            return std::ranges::any_of(open.triangles, [&](const Corners& t) {
                for (int c = 0; c < 3; ++c)
                    if (t[c] == a && t[(c + 1) % 3] == b) return true;
                return false;
            });
        };
        const bool runs_on = is_edge(outline[1], outline[0]);  // The fan runs the other way.
        for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
            const Corners t{outline[0], outline[i], outline[i + 1]};
            source.triangles.push_back(runs_on ? t : Corners{t[0], t[2], t[1]});
        }
        Mesh mesh(source, Welding::none);
        REQUIRE(mesh.is_closed());
        REQUIRE(mesh.is_oriented());
        return mesh;
    }
    std::vector<std::uint8_t> found() const {
        std::vector<std::uint8_t> found(open.positions.size(), 0);
        for (const std::uint32_t v : outline) found[v] = 1;
        return found;
    }
};

MeshSource lattice(std::uint32_t n, float z, float across = 1.0f) {
    MeshSource source;
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x)
            source.positions.push_back({static_cast<float>(x), across * static_cast<float>(y), z});
    for (std::uint32_t y = 0; y + 1 < n; ++y)
        for (std::uint32_t x = 0; x + 1 < n; ++x) {
            const std::uint32_t a = y * n + x;
            source.triangles.push_back({a, a + 1, a + n + 1});
            source.triangles.push_back({a, a + n + 1, a + n});
        }
    return source;
}

}  // namespace

TEST_CASE("a vertex's true normal does not depend on how its flat faces are split") {
    const Mesh box(make_built_in_shape("box", 12));
    const PointTruth truth = point_truth(box);
    REQUIRE(truth.normals.size() == 8);
    for (std::uint32_t v = 0; v < 8; ++v) {
        const glm::dvec3 outwards = glm::normalize(truth.positions[v] - box.center());
        CHECK(glm::distance(truth.normals[v], outwards) < 1e-6);
    }
    CHECK_FALSE(truth.is_fit);  // Too few vertices.
}

TEST_CASE("a sheet is wide open, a sphere smooth, a slit not wide") {
    const PointTruth whole = point_truth(Mesh(make_built_in_shape("sphere", 4000)));
    CHECK(whole.is_smooth());
    CHECK_FALSE(whole.is_open());

    const PointTruth sheet = point_truth(Mesh(lattice(20, 0.0f)));
    CHECK(sheet.border_count == 4 * 19);
    CHECK(sheet.wide_count == sheet.border_count);
    CHECK(sheet.is_wide());
    CHECK_FALSE(sheet.is_smooth());

    MeshSource slit = lattice(20, 0.0f);
    std::erase_if(slit.triangles,
                  [](const Corners& t) { return t[0] / 20 == 10 && t[0] % 20 < 19; });
    const PointTruth cleft = point_truth(Mesh(slit, Welding::none));
    CHECK(cleft.is_open());
    CHECK(cleft.border_count == 4 * 19 + 2 * 18);
    CHECK(cleft.wide_count <= 4 * 19);
    CHECK_FALSE(cleft.is_wide());
}

TEST_CASE("border points around a hole in the samples are distinguished from all others") {
    const CutSphere cut(0.9f);
    const Mesh closed = cut.closed();
    CHECK(point_truth(closed).border_count == 0);
    const auto count = static_cast<std::uint32_t>(cut.outline.size());
    CHECK(count_around_holes(closed, cut.found()) == count);

    SUBCASE("others do not count with them") {
        std::vector<std::uint8_t> found = cut.found();
        std::uint32_t others = 0;
        for (std::size_t v = 0; v < found.size() && others < 5; v += 97)
            if (closed.positions()[v].z < 0.0f) ++others, found[v] = 1;
        REQUIRE(others == 5);
        CHECK(count_around_holes(closed, found) == count);
    }
    SUBCASE("faces elsewhere do not count with a hole") {
        std::vector<std::uint8_t> found = cut.found();
        std::uint32_t faces = 0;
        for (std::uint32_t f = 0; f < closed.face_count() && faces < 4; f += 100) {
            const Triangle& t = closed.triangles()[f];
            if (closed.positions()[index(t[0])].z > 0.0f) continue;
            ++faces;
            for (const VertexId v : t) found[index(v)] = 1;
        }
        REQUIRE(faces == 4);
        CHECK(count_around_holes(closed, found) == count);
    }
    SUBCASE("part of an outline leaves nothing to take away") {
        std::vector<std::uint8_t> found = cut.found();
        found[cut.outline[0]] = 0;  // Where the fan's faces meet.
        CHECK(count_around_holes(closed, found) == 0);
    }
    SUBCASE("a face here and there is no hole") {
        std::vector<std::uint8_t> found(closed.positions().size(), 0);
        for (std::uint32_t f = 0; f < closed.face_count(); f += 200)
            for (const VertexId v : closed.triangles()[f])
                if (closed.positions()[index(v)].z < 0.0f) found[index(v)] = 1;
        CHECK(count_around_holes(closed, found) == 0);
    }
    SUBCASE("a patch of points is no hole: they are samples") {
        std::vector<std::uint8_t> found(closed.positions().size(), 0);
        for (std::size_t v = 0; v < found.size(); ++v)
            found[v] = closed.positions()[v].z / closed.radius() < -0.8;
        CHECK(count_around_holes(closed, found) == 0);
    }
    SUBCASE("a small hole is none") {
        const CutSphere small(0.998f);
        CHECK(count_around_holes(small.closed(), small.found()) == 0);
    }
}

TEST_CASE("a vertex is crowded where another sheet is nearer than its longest edge") {
    for (const float distance : {0.9f, 1.3f, 1.5f}) {
        MeshSource sheets = lattice(12, 0.0f);
        const MeshSource above = lattice(12, distance);
        const auto first = static_cast<std::uint32_t>(sheets.positions.size());
        sheets.positions.insert(sheets.positions.end(), above.positions.begin(),
                                above.positions.end());
        for (const Corners& t : above.triangles)
            sheets.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        const PointTruth truth = point_truth(Mesh(sheets, Welding::none));
        // Diagonals are the longest edges.
        CHECK(truth.is_crowded(6 * 12 + 6) == (distance < std::sqrt(2.0f)));
    }
    // One sheet alone does not crowd itself, rows or not.
    for (const float across : {1.0f, 8.0f})
        CHECK_FALSE(point_truth(Mesh(lattice(24, 0.0f, across))).is_crowded(12 * 24 + 12));
}
