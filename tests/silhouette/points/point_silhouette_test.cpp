#include "silhouette/points/point_silhouette.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <new>
#include <numeric>
#include <set>
#include <stop_token>

#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/plane.h"
#include "silhouette/points/umbrella_triangles.h"
#include "tests/models.h"
#include "tests/silhouette/hough/service/allocation_faults.h"
#include "tests/silhouette/points/sample_clouds.h"
#include "tests/skip.h"

namespace rimline {
namespace {

using tests::Random;

// The definition, umbrella by umbrella: no mesh, no tree.
class BruteForce {
public:
    BruteForce(const PointSurface& surface, const UmbrellaIndex& index) {
        for (std::uint32_t p = 0; p < surface.size(); ++p) {
            const auto range = surface.umbrellas_of(PointId{p});
            for (std::uint32_t u = range.first; u < range.last; ++u) {
                const Umbrella umbrella = surface.umbrella(UmbrellaId{u});
                for (std::size_t j = 0; j < umbrella.ring.size(); ++j) {
                    if (umbrella.is_gap(j)) continue;
                    const PointId from = umbrella.ring[j];
                    const PointId to = umbrella.ring[(j + 1) % umbrella.ring.size()];
                    const auto at = [&](PointId point) {
                        return index.to_index(surface.positions()[rimline::index(point)]);
                    };
                    const Plane plane = supporting_plane({at(PointId{p}), at(from), at(to)});
                    spokes_[{PointId{p}, from}].push_back({plane, false});
                    spokes_[{PointId{p}, to}].push_back({plane, true});
                }
            }
        }
    }

    // Directed: the spoke of the first point's umbrellas to the second.
    std::set<PointEdge> silhouette(const HomogeneousPoint& point) const {
        std::set<PointEdge> found;
        for (const auto& [spoke, sides] : spokes_) {
            if (sides.size() < 2) continue;
            const bool first = is_front(sides[0].plane, point);
            bool is_on = false;
            if (sides.size() == 2)
                is_on = (first != is_front(sides[1].plane, point)) ==
                        (sides[0].turns_in != sides[1].turns_in);
            else
                for (const Side& side : sides)
                    is_on = is_on || is_front(side.plane, point) != first;
            if (is_on) found.insert(spoke);
        }
        return found;
    }

private:
    struct Side {
        Plane plane;
        bool turns_in;
    };
    std::map<PointEdge, std::vector<Side>> spokes_;
};

void check_same(const PointSilhouette& silhouette, const std::set<PointEdge>& expected) {
    std::set<PointId> points;
    std::vector<PointEdge> consensus;
    for (const auto& [from, to] : expected) {
        points.insert(from);
        if (from < to && expected.contains({to, from})) consensus.push_back({from, to});
    }
    const std::vector<PointId> found = silhouette.points();
    REQUIRE(std::ranges::equal(found, points));
    REQUIRE(silhouette.size() == points.size());
    REQUIRE(silhouette.consensus_edges() == consensus);
}

// What is said to have changed is what did.
void check_change(const std::vector<PointId>& before, const PointSilhouette::Change& change,
                  const std::vector<PointId>& after) {
    std::set<PointId> expected(before.begin(), before.end());
    for (const PointId p : change.added) REQUIRE(expected.insert(p).second);
    for (const PointId p : change.removed) REQUIRE(expected.erase(p) == 1);
    REQUIRE(std::ranges::equal(after, expected));
}

void check_against_brute_force(std::span<const glm::dvec3> positions, int moves,
                               const PointSurfaceOptions& options = {}) {
    const PointSurface surface(positions, options);
    const UmbrellaIndex index(surface);
    const BruteForce brute(surface, index);
    glm::dvec3 low(0.0), high(0.0);
    if (!positions.empty()) low = high = positions[0];
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 center = 0.5 * (low + high);
    const double size = std::max(glm::length(high - low), 1e-3);
    Random random(11);
    const auto step = [&](double length) {
        return glm::dvec3(tests::jitter(random), tests::jitter(random), tests::jitter(random)) *
               length;
    };
    glm::dvec3 eye = center + step(2.0 * size);
    PointSilhouette silhouette(index, index.viewpoint(eye));
    check_same(silhouette, brute.silhouette(silhouette.point()));
    for (int move = 0; move < moves; ++move) {
        CAPTURE(move);
        HomogeneousPoint to = index.viewpoint(eye);
        switch (move % 8) {
            case 0: eye = center + step(3.0 * size); break;               // Anywhere.
            case 1: eye = positions.empty() ? eye : positions[0]; break;  // On a point.
            case 2: break;                                                // A direction.
            default: eye += step(0.02 * size);
        }
        to = move % 8 == 2 ? index.direction(step(1.0)) : index.viewpoint(eye);
        std::vector<PointId> before = silhouette.points();
        const PointSilhouette::Change change = silhouette.move_to(to);
        check_same(silhouette, brute.silhouette(to));
        check_change(before, change, silhouette.points());
        const PointSilhouette fresh(index, to);
        REQUIRE(fresh.points() == silhouette.points());
        REQUIRE(fresh.consensus_edges() == silhouette.consensus_edges());
    }
}

// The surface of a cube, n + 1 points an edge.
std::vector<glm::dvec3> make_cube(int n) {
    std::vector<glm::dvec3> points;
    for (int x = 0; x <= n; ++x)
        for (int y = 0; y <= n; ++y)
            for (int z = 0; z <= n; ++z)
                if (x % n == 0 || y % n == 0 || z % n == 0) points.emplace_back(x, y, z);
    return points;
}

std::vector<PointEdge> edges_of(std::initializer_list<std::array<std::uint32_t, 2>> pairs) {
    std::vector<PointEdge> edges;
    for (const auto& [a, b] : pairs) edges.push_back({PointId{a}, PointId{b}});
    return edges;
}

std::vector<std::vector<std::uint32_t>> numbers(const std::vector<std::vector<PointId>>& lines) {
    std::vector<std::vector<std::uint32_t>> numbers;
    for (const auto& line : lines) {
        numbers.emplace_back();
        for (const PointId p : line) numbers.back().push_back(index(p));
    }
    return numbers;
}

TEST_CASE("extraction and every update of point silhouettes equal a scan of all umbrellas") {
    check_against_brute_force(tests::make_sphere(1500), 60);
    check_against_brute_force(tests::make_patch(30, 0.3, 3).points, 60);
    check_against_brute_force(make_cube(8), 60);
    PointSurfaceOptions options;
    options.k = 9;
    check_against_brute_force(make_cube(7), 40, options);
}

TEST_CASE(
    "so they do where umbrellas overlap: spokes of three triangles, or of two on the same side") {
    PointSurfaceOptions options;
    options.method = PointSurfaceOptions::Method::thesis;
    // Noise as wide as the spacing.
    Random random(7);
    std::vector<glm::dvec3> points = tests::make_sphere(1500);
    for (glm::dvec3& p : points)
        p += 0.05 * glm::dvec3(tests::jitter(random), tests::jitter(random), tests::jitter(random));
    std::size_t three = 0;
    std::size_t same_side = 0;
    const PointSurface surface(points, options);
    for (std::uint32_t p = 0; p < surface.size(); ++p) {
        std::map<PointId, std::vector<bool>> spokes;
        for_each_triangle(surface, PointId{p}, [&](PointId from, PointId to, UmbrellaId) {
            spokes[from].push_back(false);
            spokes[to].push_back(true);
        });
        for (const auto& [target, turns_in] : spokes) {
            three += turns_in.size() > 2;
            same_side += turns_in.size() == 2 && turns_in[0] == turns_in[1];
        }
    }
    REQUIRE(three > 10);
    REQUIRE(same_side > 10);
    check_against_brute_force(points, 60, options);
}

TEST_CASE("a move for which memory was missing leaves the next one right") {
    const PointSurface surface(tests::make_sphere(1500));
    const UmbrellaIndex index(surface);
    const BruteForce brute(surface, index);
    const HomogeneousPoint from = index.viewpoint({3, 0, 0}), missed = index.viewpoint({0, 2, 1});
    const HomogeneousPoint to = index.viewpoint({2.5, 1, 0});
    int thrown = 0;
    for (std::uint64_t spared = 0;; spared += 1 + spared / 4) {
        CAPTURE(spared);
        PointSilhouette silhouette(index, from);
        const std::vector<PointId> before = silhouette.points();
        bool is_missed = false;
        try {
            const tests::AllocationFaults faults(spared);
            silhouette.move_to(missed);
        } catch (const std::bad_alloc&) {
            is_missed = true;
        }
        if (!is_missed) break;
        ++thrown;
        CHECK(silhouette.point() == from);
        const PointSilhouette::Change change = silhouette.move_to(to);
        check_same(silhouette, brute.silhouette(to));
        check_change(before, change, silhouette.points());
    }
    CHECK(thrown > 3);
}

TEST_CASE("point silhouettes equal a scan far from the origin and at any scale") {
    for (const double spacing : {1e-3, 1e3, 1e-20}) {
        std::vector<glm::dvec3> points = tests::make_sphere(800);
        for (glm::dvec3& p : points) {
            p *= 20.0 * spacing;
            if (spacing == 1e-3) p += glm::dvec3(1e6, -1e6, 1e6);
        }
        check_against_brute_force(points, 24);
    }
}

TEST_CASE("point silhouettes follow past triangles that have no plane in floats") {
    // Two flat pieces, so small beside what lies between them that their points coincide in the index.
    for (const double spacing : {3e-8, 2e-7}) {
        CAPTURE(spacing);
        Random random(5);
        std::vector<glm::dvec3> points;
        for (const double side : {-1.0, 1.0})
            for (int x = 0; x < 30; ++x)
                for (int y = 0; y < 30; ++y)
                    points.push_back({0.7 * side + spacing * (x + 0.2 * tests::jitter(random)),
                                      0.6 * side + spacing * (y + 0.2 * tests::jitter(random)),
                                      0.7 * side});
        const PointSurface surface(points);
        const UmbrellaIndex index(surface);
        PointSilhouette silhouette(index, index.viewpoint({0, 0, 3}));
        for (int move = 0; move < 20; ++move) {
            CAPTURE(move);
            const double height = (move % 2 == 0 ? 1.0 : -1.0) * (0.9 + 0.1 * move);
            const HomogeneousPoint to =
                index.viewpoint({0.3 * tests::jitter(random), 0.3 * tests::jitter(random), height});
            silhouette.move_to(to);
            const PointSilhouette fresh(index, to);
            CHECK(silhouette.points() == fresh.points());
            CHECK(silhouette.consensus_edges() == fresh.consensus_edges());
        }
    }
}

TEST_CASE("no points and points without umbrellas have no silhouette") {
    check_against_brute_force({}, 8);
    check_against_brute_force(std::vector<glm::dvec3>{{1, 2, 3}}, 8);
    std::vector<glm::dvec3> line;
    for (int i = 0; i < 40; ++i) line.push_back({double(i), 2.0 * i, 0.0});
    check_against_brute_force(line, 8);
    line.resize(3);
    check_against_brute_force(line, 8);
}

TEST_CASE("point silhouettes of real models equal a scan of all umbrellas") {
    std::string missing;
    for (const char* name : {"fandisk.obj", "alligator.obj"}) {
        const auto path = tests::find_model(name);
        if (!path) {
            missing += std::string(" ") + name;
            continue;
        }
        const MeshSource mesh = read_mesh_file(*path);
        std::vector<glm::dvec3> points;
        for (const glm::vec3& p : mesh.positions) points.emplace_back(p);
        check_against_brute_force(points, 24);
    }
    if (!missing.empty()) RIMLINE_SKIP("RIMLINE_MODELS names no folder that holds" + missing);
}

TEST_CASE("silhouette points do not depend on where a cloud lies and how large it is") {
    // On a lattice on which the sums below are exact.
    std::vector<glm::dvec3> points = tests::make_sphere(2000);
    for (glm::dvec3& p : points) p = glm::round(p * 0x1p20) * 0x1p-20;
    const glm::dvec3 eye(2.0, 1.5, -1.0);
    const PointSurface surface(points);
    const UmbrellaIndex index(surface);
    const PointSilhouette here(index, index.viewpoint(eye));
    CHECK(here.size() > 50);
    for (const glm::dvec3 offset : {glm::dvec3(0.0), glm::dvec3(0x1p25, -0x1p26, 0x1p24)})
        for (const double scale : {0x1p-30, 1.0, 0x1p30}) {
            std::vector<glm::dvec3> moved;
            for (const glm::dvec3& p : points) moved.push_back((p + offset) * scale);
            const PointSurface other(moved);
            const UmbrellaIndex other_index(other);
            const PointSilhouette there(other_index, other_index.viewpoint((eye + offset) * scale));
            CHECK(there.points() == here.points());
            CHECK(there.consensus_edges() == here.consensus_edges());
        }
}

TEST_CASE("a stray point far away costs a silhouette nothing") {
    std::vector<glm::dvec3> points = tests::make_sphere(2000);
    const glm::dvec3 eye(2.0, 1.5, -1.0);
    const PointSurface surface(points);
    const UmbrellaIndex index(surface);
    const PointSilhouette alone(index, index.viewpoint(eye));
    CHECK(alone.consensus_edges().size() > 50);
    points.push_back({1e7, 0.0, 0.0});
    const PointSurface with_stray(points);
    const PointId stray{static_cast<std::uint32_t>(points.size() - 1)};
    REQUIRE(with_stray.umbrellas_of(stray).size() == 0);
    const UmbrellaIndex other_index(with_stray);
    const PointSilhouette other(other_index, other_index.viewpoint(eye));
    CHECK(other.consensus_edges() == alone.consensus_edges());
}

TEST_CASE("an index tells how far it is, and stops where it is asked to") {
    const PointSurface surface(tests::make_sphere(20000));
    std::vector<double> shares;
    const UmbrellaIndex index(surface, {{}, [&](double share) { shares.push_back(share); }});
    REQUIRE(shares.size() > 10);
    CHECK(std::ranges::is_sorted(shares));
    CHECK(shares.front() == 0.0);
    CHECK(shares.back() == 1.0);
    for (const double at : {0.0, 0.3, 0.55, 0.7}) {
        std::stop_source stop;
        const LongCall call{stop.get_token(), [&](double share) {
                                if (share >= at) stop.request_stop();
                            }};
        try {
            const UmbrellaIndex stopped(surface, call);
            FAIL("it went on");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::cancelled);
        }
    }
}

TEST_CASE("index and silhouette of a sphere take less than 200 bytes a point together") {
    const PointSurface surface(tests::make_sphere(20000));
    const UmbrellaIndex index(surface);
    const PointSilhouette silhouette(index, index.viewpoint({3.0, 0.0, 0.0}));
    CHECK(index.patch_count() == 20000);
    CHECK(index.size_bytes() + silhouette.size_bytes() < 200 * 20000);
}

TEST_CASE("a sphere's silhouette is a band one umbrella wide around its contour") {
    const std::uint32_t count = 6000;
    const std::vector<glm::dvec3> points = tests::make_sphere(count);
    const double spacing = std::sqrt(4.0 * std::numbers::pi / count);
    const PointSurface surface(points);
    const UmbrellaIndex index(surface);
    const glm::dvec3 toward = glm::normalize(glm::dvec3(1.0, 2.0, 0.5));
    const PointSilhouette silhouette(index, index.direction(toward));
    const glm::dvec3 right = glm::normalize(glm::cross(toward, glm::dvec3(0.0, 0.0, 1.0)));
    const glm::dvec3 up = glm::cross(right, toward);
    std::set<int> sectors;
    for (const PointId p : silhouette.points()) {
        const glm::dvec3& x = points[rimline::index(p)];
        CHECK(std::abs(glm::dot(x, toward)) < spacing);
        sectors.insert(static_cast<int>(std::floor(
            36.0 * (std::atan2(glm::dot(x, up), glm::dot(x, right)) / std::numbers::pi))));
    }
    CHECK(sectors.size() >= 72);
    // Points whose contour runs through the middle of their cell are all there.
    for (std::uint32_t p = 0; p < count; ++p)
        if (std::abs(glm::dot(points[p], toward)) < 0.05 * spacing)
            CHECK(silhouette.contains(PointId{p}));
    // Twice the circumference holds the zigzag of edges that both ends agree on.
    double length = 0.0;
    for (const auto& [a, b] : silhouette.consensus_edges())
        length += glm::distance(points[rimline::index(a)], points[rimline::index(b)]);
    CHECK(length > 0.9 * 2.0 * std::numbers::pi);
    CHECK(length < 2.0 * 2.0 * std::numbers::pi);
}

TEST_CASE("a flat patch has no silhouette from anywhere") {
    const PointSurface surface(tests::make_patch(20, 0.3, 5).points);
    const UmbrellaIndex index(surface);
    for (const glm::dvec3 eye :
         {glm::dvec3(0.3, 0.4, 2.0), glm::dvec3(5.0, 0.1, 0.01), glm::dvec3(-3.0, 2.0, -0.5)})
        CHECK(PointSilhouette(index, index.viewpoint(eye)).size() == 0);
}

TEST_CASE("the inside of a cube's faces is never on its silhouette") {
    const int n = 10;
    const std::vector<glm::dvec3> points = make_cube(n);
    const PointSurface surface(points);
    const UmbrellaIndex index(surface);
    const PointSilhouette silhouette(index, index.direction({3.0, 2.0, 5.0}));
    int deep = 0;
    int outline = 0;
    for (const PointId p : silhouette.points()) {
        const glm::dvec3& x = points[rimline::index(p)];
        int near = 0;  // Sides of the cube that are at most one row away.
        for (int axis = 0; axis < 3; ++axis) near += x[axis] <= 1.0 || x[axis] >= n - 1.0;
        deep += near < 2;
    }
    CHECK(deep == 0);
    // Along the six edges between a face that is seen and one that is not.
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        const glm::dvec3& x = points[p];
        int at_low = 0, at_high = 0, between = 0;
        for (int axis = 0; axis < 3; ++axis) {
            at_low += x[axis] == 0.0;
            at_high += x[axis] == n;
            between += x[axis] > 1.0 && x[axis] < n - 1.0;
        }
        if (at_low != 1 || at_high != 1 || between != 1) continue;
        ++outline;
        CAPTURE(p);
        CHECK(silhouette.contains(PointId{p}));
    }
    CHECK(outline == 6 * (n - 3));
}

TEST_CASE("edges are chained into lines that hold each edge once") {
    CHECK(chain({}).empty());
    CHECK(numbers(chain(edges_of({{0, 1}}))) == std::vector<std::vector<std::uint32_t>>{{0, 1}});
    CHECK(numbers(chain(edges_of({{0, 1}, {1, 2}, {2, 3}}))) ==
          std::vector<std::vector<std::uint32_t>>{{0, 1, 2, 3}});
    CHECK(numbers(chain(edges_of({{0, 1}, {1, 2}, {0, 2}}))) ==
          std::vector<std::vector<std::uint32_t>>{{0, 1, 2, 0}});
    // A fork: three lines meet at 5.
    CHECK(numbers(chain(edges_of({{1, 5}, {2, 3}, {3, 5}, {5, 9}}))) ==
          std::vector<std::vector<std::uint32_t>>{{1, 5}, {2, 3, 5}, {5, 9}});
    // A loop that hangs on a fork, and one by itself.
    CHECK(numbers(chain(edges_of({{0, 1}, {1, 2}, {1, 3}, {2, 3}, {7, 8}, {7, 9}, {8, 9}}))) ==
          std::vector<std::vector<std::uint32_t>>{{0, 1}, {1, 2, 3, 1}, {7, 8, 9, 7}});
    Random random(3);
    std::set<PointEdge> set;
    while (set.size() < 400) {
        const auto a = static_cast<std::uint32_t>(random.below(300));
        const auto b = static_cast<std::uint32_t>(random.below(300));
        if (a != b) set.insert({PointId{std::min(a, b)}, PointId{std::max(a, b)}});
    }
    const std::vector<PointEdge> edges(set.begin(), set.end());
    std::multiset<PointEdge> chained;
    for (const auto& line : chain(edges))
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            chained.insert({std::min(line[i], line[i + 1]), std::max(line[i], line[i + 1])});
    CHECK(std::ranges::equal(chained, edges));
}

}  // namespace
}  // namespace rimline
