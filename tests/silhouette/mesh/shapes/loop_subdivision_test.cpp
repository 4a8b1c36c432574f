#include "silhouette/mesh/shapes/loop_subdivision.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "silhouette/mesh/edge_visibility.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/shapes/measures.h"
#include "tests/silhouette/mesh/small_meshes.h"

namespace rimline {
namespace {

using tests::Indices;

// A flat grid of n * n squares over [0, n]^2, all diagonals alike.
MeshSource flat_grid(std::uint32_t n) {
    MeshSource source;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x)
            source.positions.emplace_back(float(x), float(y), 0.0f);
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x;
            source.triangles.push_back({a, a + 1, a + n + 2});
            source.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    return source;
}

struct ByCoordinates {
    bool operator()(const glm::vec3& a, const glm::vec3& b) const {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
};
using PointSet = std::set<glm::vec3, ByCoordinates>;

// One step by the textbook, from sets of neighbors; for meshes whose positions all differ.
PointSet textbook_step(const MeshSource& source) {
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    std::map<Pair, std::vector<std::uint32_t>> opposite;
    for (const auto& t : source.triangles)
        for (std::size_t c = 0; c < 3; ++c)
            opposite[std::minmax(t[c], t[(c + 1) % 3])].push_back(t[(c + 2) % 3]);
    const auto at = [&](std::uint32_t v) { return glm::dvec3(source.positions[v]); };
    std::map<std::uint32_t, std::set<std::uint32_t>> all, along_crease;
    PointSet points;
    for (const auto& [ends, others] : opposite) {
        const auto [a, b] = ends;
        all[a].insert(b);
        all[b].insert(a);
        if (others.size() == 2) {
            points.insert(glm::vec3(3.0 / 8.0 * (at(a) + at(b)) +
                                    1.0 / 8.0 * (at(others[0]) + at(others[1]))));
        } else {
            along_crease[a].insert(b);
            along_crease[b].insert(a);
            points.insert(glm::vec3(0.5 * (at(a) + at(b))));
        }
    }
    for (const auto& [v, neighbors] : all) {
        const auto& crease = along_crease[v];
        const auto sum = [&](const std::set<std::uint32_t>& of) {
            glm::dvec3 total(0.0);
            for (const std::uint32_t u : of) total += at(u);
            return total;
        };
        const double n = double(neighbors.size());
        const double beta = neighbors.size() == 3 ? 3.0 / 16.0 : 3.0 / (8.0 * n);
        if (crease.size() == 2)
            points.insert(glm::vec3(0.75 * at(v) + 0.125 * sum(crease)));
        else if (crease.size() > 2)
            points.insert(source.positions[v]);
        else
            points.insert(glm::vec3((1.0 - n * beta) * at(v) + beta * sum(neighbors)));
    }
    return points;
}

// Each point of a lies within `tolerance` of one of b, along the order of their coordinates rounded.
bool same_points(const PointSet& a, const PointSet& b, float tolerance) {
    if (a.size() != b.size()) return false;
    return std::all_of(a.begin(), a.end(), [&](const glm::vec3& p) {
        auto at = b.lower_bound(glm::vec3(p.x - tolerance, -1e30f, -1e30f));
        for (; at != b.end() && at->x <= p.x + tolerance; ++at)
            if (glm::length(*at - p) <= tolerance) return true;
        return false;
    });
}

PointSet points_of(const MeshSource& source) {
    return {source.positions.begin(), source.positions.end()};
}

PointSet border_points(const Mesh& mesh) {
    PointSet points;
    const Mesh::EdgeRange border = mesh.edges_of_class(EdgeClass::border);
    for (std::uint32_t e = border.first; e < border.last; ++e)
        for (const VertexId v : mesh.edges()[e].vertices) points.insert(mesh.positions()[index(v)]);
    return points;
}

bool all_finite(const MeshSource& source) {
    return std::all_of(source.positions.begin(), source.positions.end(), [](const glm::vec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
}

}  // namespace

TEST_CASE("no steps give the source itself, and nothing stays nothing") {
    const MeshSource source = tests::book(3);
    const MeshSource same = subdivide_loop(source, 0);
    CHECK(same.positions == source.positions);
    CHECK(same.triangles == source.triangles);
    CHECK(subdivide_loop({}, 3).triangles.empty());
    CHECK(subdivide_loop({{{1, 2, 3}}, {}}, 40).triangles.empty());
}

TEST_CASE("closed shapes stay closed, oriented and of their genus, with four times the faces") {
    for (const std::string_view name : {"sphere", "torus", "knot", "box", "spring"}) {
        CAPTURE(name);
        const MeshSource source = make_built_in_shape(name, 200);
        const Mesh coarse(source);
        for (const std::uint32_t steps : {1u, 2u, 3u}) {
            CAPTURE(steps);
            const Mesh fine(subdivide_loop(source, steps));
            CHECK(fine.face_count() == coarse.face_count() << 2 * steps);
            CHECK(fine.is_closed());
            CHECK(fine.is_oriented());
            CHECK(fine.edges_of_class(EdgeClass::nonmanifold).size() == 0);
            CHECK(fine.degenerate_face_count() == 0);
            CHECK(tests::euler_characteristic(fine) == tests::euler_characteristic(coarse));
            CHECK(tests::signed_volume(fine) > 0.0);
            CHECK(tests::signed_volume(fine) < tests::signed_volume(coarse) * 1.001);
        }
    }
}

TEST_CASE("one step is the textbook's") {
    std::vector<MeshSource> sources{tests::tetrahedron(),
                                    tests::octahedron(),
                                    flat_grid(4),
                                    tests::book(3),
                                    tests::book(5),
                                    tests::band(5, true),
                                    tests::closed_grid(4, 5, true),
                                    make_built_in_shape("terrain", 128),
                                    make_built_in_shape("spring", 200),
                                    make_built_in_shape("sphere", 80)};
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {  // Soups with creases that end and cross.
        tests::Random random(seed);
        Indices triangles;
        while (triangles.size() < 25) {
            const std::uint32_t a = random.below(12), b = random.below(12), c = random.below(12);
            if (a != b && b != c && c != a) triangles.push_back({a, b, c});
        }
        sources.push_back(tests::with_any_positions(12, triangles));
    }
    for (std::size_t i = 0; i < sources.size(); ++i) {
        CAPTURE(i);
        CHECK(same_points(textbook_step(sources[i]), points_of(subdivide_loop(sources[i], 1)),
                          1e-6f));
    }
}

TEST_CASE("two steps are one step twice") {
    for (const std::string_view name : {"knot", "terrain", "scene"}) {
        CAPTURE(name);
        const MeshSource source = make_built_in_shape(name, 300);
        const MeshSource twice = subdivide_loop(subdivide_loop(source, 1), 1);
        const MeshSource both = subdivide_loop(source, 2);
        CHECK(twice.positions == both.positions);
        CHECK(twice.triangles == both.triangles);
    }
}

TEST_CASE("corners converge to their limits, tetrahedron and octahedron") {
    // The limit of a vertex is (1 - n x) v + x (u_1 + ... + u_n), x = 1 / (3 / (8 beta) + n):
    // v / 5 for the tetrahedron's, v / 2 for the octahedron's, whose neighbors cancel.
    const MeshSource tetrahedron = subdivide_loop(tests::tetrahedron(), 7);
    const MeshSource octahedron = subdivide_loop(tests::octahedron(), 7);
    for (std::size_t v = 0; v < 4; ++v)
        CHECK(glm::length(tetrahedron.positions[v] - 0.2f * tests::tetrahedron().positions[v]) <
              1e-4f);
    for (std::size_t v = 0; v < 6; ++v)
        CHECK(glm::length(octahedron.positions[v] - 0.5f * tests::octahedron().positions[v]) <
              3e-3f);
}

TEST_CASE("solids become smooth: the sharpest bend falls with every step") {
    for (const MeshSource& solid :
         {tests::tetrahedron(), tests::octahedron(), make_built_in_shape("box", 12)}) {
        double bend = tests::sharpest_bend(Mesh(solid));
        for (std::uint32_t steps = 1; steps <= 6; ++steps) {
            CAPTURE(steps);
            const double finer = tests::sharpest_bend(Mesh(subdivide_loop(solid, steps)));
            CHECK(finer < (steps < 3 ? 0.95 : 0.75) * bend);
            bend = finer;
        }
        CHECK(bend < 0.2);
    }
}

TEST_CASE("borders follow the cubic B-spline of the border alone") {
    const MeshSource source = make_built_in_shape("terrain", 200);
    const Mesh mesh(source);
    // Each border vertex has two border neighbors.
    std::map<std::uint32_t, std::vector<glm::dvec3>> neighbors;
    PointSet expected;
    const Mesh::EdgeRange border = mesh.edges_of_class(EdgeClass::border);
    for (std::uint32_t e = border.first; e < border.last; ++e) {
        const auto [a, b] = mesh.edges()[e].vertices;
        const glm::dvec3 p(mesh.positions()[index(a)]);
        const glm::dvec3 q(mesh.positions()[index(b)]);
        neighbors[index(a)].push_back(q);
        neighbors[index(b)].push_back(p);
        expected.insert(glm::vec3(0.5 * (p + q)));
    }
    for (const auto& [v, around] : neighbors) {
        REQUIRE(around.size() == 2);
        expected.insert(
            glm::vec3((around[0] + around[1] + 6.0 * glm::dvec3(mesh.positions()[v])) / 8.0));
    }
    CHECK(same_points(expected, border_points(Mesh(subdivide_loop(source, 1))), 1e-7f));
}

TEST_CASE("a flat grid stays flat, its straight borders in place and its inner points even") {
    constexpr float n = 8.0f;
    const Mesh mesh(subdivide_loop(flat_grid(8), 2));
    CHECK(mesh.bounds().low == glm::vec3(0, 0, 0));
    CHECK(mesh.bounds().high == glm::vec3(n, n, 0));
    for (const Plane& plane : mesh.planes()) CHECK(plane.nz == 1.0f);
    // A step moves border points only next to a corner, and inner points only next to those.
    const auto far_from_corners = [&](const glm::vec3& p) {
        return std::min(p.x, n - p.x) + std::min(p.y, n - p.y) > 3.0f;
    };
    for (const glm::vec3& p : border_points(mesh)) {
        if (!far_from_corners(p)) continue;
        CHECK((p.x == 0.0f || p.x == n || p.y == 0.0f || p.y == n));
    }
    std::uint32_t even = 0;
    for (const glm::vec3& p : mesh.positions())
        even += p.x > 3 && p.x < 5 && p.y > 3 && p.y < 5 && 4 * p.x == std::floor(4 * p.x) &&
                4 * p.y == std::floor(4 * p.y);
    CHECK(even == 7 * 7);
}

TEST_CASE("a spine of more than two faces stays one straight crease") {
    for (const std::uint32_t wings : {3u, 4u}) {
        CAPTURE(wings);
        const Mesh mesh(subdivide_loop(tests::book(wings), 3));
        const Mesh::EdgeRange spine = mesh.edges_of_class(EdgeClass::nonmanifold);
        CHECK(spine.size() == 8);
        CHECK(mesh.component_count() == 1);
        for (std::uint32_t e = spine.first; e < spine.last; ++e) {
            CHECK(mesh.faces_of(EdgeId{e}).size() == wings);
            for (const VertexId v : mesh.edges()[e].vertices) {
                CHECK(mesh.positions()[index(v)].x == 0.0f);
                CHECK(mesh.positions()[index(v)].y == 0.0f);
            }
        }
    }
}

TEST_CASE("split vertices do not open a seam") {
    // A tetrahedron as STL would write it, each face with its own three vertices.
    const MeshSource welded = tests::tetrahedron();
    MeshSource split;
    for (const auto& t : welded.triangles) {
        const auto first = static_cast<std::uint32_t>(split.positions.size());
        for (const std::uint32_t v : t) split.positions.push_back(welded.positions[v]);
        split.triangles.push_back({first, first + 1, first + 2});
    }
    CHECK(Mesh(subdivide_loop(split, 2)).is_closed());
    CHECK(same_points(points_of(subdivide_loop(split, 2)), points_of(subdivide_loop(welded, 2)),
                      1e-6f));
}

TEST_CASE("an affine map before is the map after, a power of two exactly") {
    const MeshSource source = make_built_in_shape("knot", 300);
    const MeshSource refined = subdivide_loop(source, 2);
    MeshSource doubled = source;
    MeshSource mapped = source;
    const auto map = [](const glm::vec3& p) {
        return glm::vec3(2.0f * p.x - 0.5f * p.z + 3.0f, 0.25f * p.y + p.x, p.z - p.y - 7.0f);
    };
    for (std::size_t v = 0; v < source.positions.size(); ++v) {
        doubled.positions[v] *= 0x1p40f;
        mapped.positions[v] = map(source.positions[v]);
    }
    doubled = subdivide_loop(doubled, 2);
    mapped = subdivide_loop(mapped, 2);
    CHECK(doubled.triangles == refined.triangles);
    CHECK(mapped.triangles == refined.triangles);
    for (std::size_t v = 0; v < refined.positions.size(); ++v) {
        REQUIRE(doubled.positions[v] == refined.positions[v] * 0x1p40f);
        REQUIRE(glm::length(mapped.positions[v] - map(refined.positions[v])) < 4e-6f);
    }
}

TEST_CASE("the order of faces and vertices does not matter but for rounding") {
    const MeshSource source = make_built_in_shape("terrain", 300);
    const PointSet expected = points_of(subdivide_loop(source, 2));
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        CAPTURE(seed);
        CHECK(same_points(points_of(subdivide_loop(tests::shuffled(source, seed), 2)), expected,
                          1e-6f));
    }
}

TEST_CASE("degenerate triangles survive, without NaN, and keep the count") {
    const MeshSource source{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}, {7, 7, 7}},
                            {{0, 1, 2}, {1, 0, 3}, {0, 2, 4}, {1, 1, 3}, {5, 5, 5}}};
    for (const std::uint32_t steps : {1u, 2u, 4u}) {
        CAPTURE(steps);
        const MeshSource refined = subdivide_loop(source, steps);
        CHECK(refined.triangles.size() == source.triangles.size() << 2 * steps);
        CHECK(all_finite(refined));
        CHECK(Mesh(refined).degenerate_face_count() >= 2u << 2 * steps);
    }
}

TEST_CASE("face f's children are at 4 f on and look its way") {
    const MeshSource source = make_built_in_shape("torus", 2000);
    const Mesh coarse(source);
    const Mesh fine(subdivide_loop(source, 1));
    for (std::uint32_t f = 0; f < fine.face_count(); ++f) {
        const Plane& child = fine.planes()[f];
        const Plane& parent = coarse.planes()[f / 4];
        REQUIRE(child.nx * parent.nx + child.ny * parent.ny + child.nz * parent.nz > 0.8f);
    }
}

TEST_CASE("results stay within the bounds of the source, the largest coordinates too") {
    MeshSource source = tests::octahedron();
    for (glm::vec3& p : source.positions) p *= k_max_coordinate;
    source.up = UpAxis::z;
    const MeshSource refined = subdivide_loop(source, 4);
    CHECK(refined.up == UpAxis::z);
    for (const glm::vec3& p : refined.positions)
        for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(p[axis]) <= k_max_coordinate);
}

TEST_CASE("edges are drawn as before, and what else the file says is kept") {
    // Two triangles at an edge that is hard; one side is a silhouette, and the others are never drawn.
    MeshSource source{.positions = {{0, 0, 0}, {4, 0, 0}, {4, 4, 1}, {0, 4, 0}},
                      .triangles = {{0, 1, 2}, {0, 2, 3}}};
    source.edge_codes = {0 | 1 << 2 | 2 << 4, 3};
    source.warnings = {"a warning"};
    source.files = {"a.mtl"};
    const MeshSource refined = subdivide_loop(source, 2);
    CHECK(refined.warnings == source.warnings);
    CHECK(refined.files == source.files);
    REQUIRE(refined.edge_codes.size() == refined.triangles.size());
    const Mesh mesh(refined);
    const std::vector<EdgeVisibility> classes = edge_visibility_of_codes(mesh, refined.edge_codes);
    CHECK(count_classes(classes).hard == 4);
    CHECK(count_classes(classes).silhouette == 4);
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
        const Edge& edge = mesh.edge(EdgeId{e});
        const auto all = [&](auto&& holds) {
            return std::ranges::all_of(
                edge.vertices, [&](VertexId v) { return holds(mesh.positions()[index(v)]); });
        };
        // The diagonal is the only edge of two triangles that is drawn. Its ends lie in the plane x = y.
        if (mesh.edge_class(EdgeId{e}) != EdgeClass::border)
            CHECK((classes[e] == EdgeVisibility::hard) ==
                  all([](const glm::vec3& p) { return std::abs(p.x - p.y) < 1e-5f; }));
    }
    CHECK(subdivide_loop(make_built_in_shape("box", 12), 1).edge_codes.empty());
}

TEST_CASE("more faces than fit are refused before anything is done") {
    const MeshSource source = tests::tetrahedron();  // 4^13 * 4 = 2^28 would still be made.
    for (const std::uint32_t steps : {14u, 15u, 31u, 32u, 64u, 0xffffffffu}) {
        CAPTURE(steps);
        try {
            subdivide_loop(source, steps);
            FAIL("not refused");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::too_large);
        }
    }
}

TEST_CASE("progress rises from 0 to 1, and a stop is heeded") {
    const MeshSource source = make_built_in_shape("terrain", 20'000);
    std::vector<double> shares;
    LongCall call;
    call.progress = [&](double share) { shares.push_back(share); };
    subdivide_loop(source, 3, call);
    REQUIRE(shares.size() > 10);
    CHECK(std::is_sorted(shares.begin(), shares.end()));
    CHECK(shares.front() == 0.0);
    CHECK(shares.back() == 1.0);

    std::stop_source stop;
    std::size_t calls = 0;
    call.stop = stop.get_token();
    call.progress = [&](double) {
        if (++calls == 5) stop.request_stop();
    };
    try {
        subdivide_loop(source, 3, call);
        FAIL("not stopped");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::cancelled);
    }
    CHECK(calls == 5);
}

}  // namespace rimline
