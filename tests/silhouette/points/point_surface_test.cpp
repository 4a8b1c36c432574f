#include "silhouette/points/point_surface.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stop_token>

#include "tests/rounds.h"
#include "tests/silhouette/points/sample_clouds.h"
#include "tests/silhouette/points/soundness.h"

namespace rimline {
namespace {

using tests::check_sound;
using tests::jitter;
using tests::Random;
using Method = PointSurfaceOptions::Method;

// Point i of `a` is point at[i] of `b`, and has the same umbrellas in the same order.
void check_same(const PointSurface& a, const PointSurface& b,
                const std::vector<std::uint32_t>& at) {
    REQUIRE(a.size() == b.size());
    REQUIRE(a.umbrella_count() == b.umbrella_count());
    for (std::uint32_t i = 0; i < a.size(); ++i) {
        const PointId p{i}, q{at[i]};
        REQUIRE(a.label(p) == b.label(q));
        REQUIRE(a.reason(p) == b.reason(q));
        REQUIRE(a.scale(p) == b.scale(q));
        const auto u = a.umbrellas_of(p), v = b.umbrellas_of(q);
        REQUIRE(u.size() == v.size());
        for (std::uint32_t n = 0; n < u.size(); ++n) {
            const Umbrella s = a.umbrella(UmbrellaId{u.first + n});
            const Umbrella t = b.umbrella(UmbrellaId{v.first + n});
            REQUIRE(s.gaps == t.gaps);
            REQUIRE(s.normal == t.normal);
            REQUIRE(s.ring.size() == t.ring.size());
            for (std::size_t j = 0; j < s.ring.size(); ++j)
                REQUIRE(at[index(s.ring[j])] == index(t.ring[j]));
        }
    }
}

std::vector<std::uint32_t> identity(std::size_t count) {
    std::vector<std::uint32_t> at(count);
    std::iota(at.begin(), at.end(), 0u);
    return at;
}

// A wavy sheet with a hole, and a lattice, whose distances tie.
std::vector<glm::dvec3> mixed_points() {
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& p : tests::make_patch(50, 0.35, 7).points)
        if (glm::length(p - glm::dvec3(0.5, 0.5, 0.0)) > 0.15)
            points.push_back({p.x, p.y, 0.1 * std::sin(9.0 * p.x) * std::cos(7.0 * p.y)});
    for (int x = 0; x < 12; ++x)
        for (int y = 0; y < 12; ++y) points.push_back({2.0 + x / 16.0, y / 16.0, 0.0});
    return points;
}

TEST_CASE("a flat patch has its outline for border and exact normals") {
    for (const double amount : {0.0, 0.1, 0.25}) {
        CAPTURE(amount);
        const tests::Patch patch = tests::make_patch(30, amount, 1);
        const PointSurface surface(patch.points);
        check_sound(surface);
        for (std::uint32_t i = 0; i < surface.size(); ++i) {
            CAPTURE(i);
            CHECK((surface.label(PointId{i}) == PointLabel::border) == patch.is_border[i]);
            CHECK(surface.label(PointId{i}) <= PointLabel::interior);
            CHECK(std::abs(surface.normal(PointId{i}).z) > 1.0 - 1e-12);
        }
    }
}

TEST_CASE(
    "a lattice's inner points have their four neighbors for ring and their distance for scale") {
    const tests::Patch patch = tests::make_patch(17, 0.0, 1);
    const PointSurface surface(patch.points);
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        if (patch.is_border[i]) continue;
        const auto range = surface.umbrellas_of(PointId{i});
        REQUIRE(range.size() == 1);
        const Umbrella umbrella = surface.umbrella(UmbrellaId{range.first});
        CHECK(umbrella.ring.size() == 4);
        for (const PointId q : umbrella.ring)
            CHECK(glm::distance(patch.points[index(q)], patch.points[i]) == 1.0 / 16);
        // Half the diagonal of a cell.
        CHECK(surface.scale(PointId{i}) == doctest::Approx(std::sqrt(0.5) / 16).epsilon(1e-12));
    }
}

TEST_CASE("a sphere is interior throughout with normals through its center") {
    for (const std::uint32_t count : {100u, 1000u, 20000u}) {
        CAPTURE(count);
        const auto points = tests::make_sphere(count);
        const PointSurface surface(points);
        check_sound(surface);
        CHECK(surface.count(PointLabel::interior) == count);
        // A triangle's normal is off by about its circumradius, here 1.9 / sqrt(count), at most.
        const double bound = 1.0 - std::cos(2.0 / std::sqrt(count));
        for (std::uint32_t i = 0; i < count; ++i)
            CHECK(1.0 - std::abs(glm::dot(surface.normal(PointId{i}), points[i])) < bound);
    }
}

TEST_CASE("rings turn counterclockwise about their normals") {
    const auto points = mixed_points();
    const PointSurface surface(points);
    check_sound(surface);
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        const auto range = surface.umbrellas_of(PointId{i});
        for (std::uint32_t u = range.first; u < range.last; ++u) {
            const Umbrella umbrella = surface.umbrella(UmbrellaId{u});
            double turn = 0.0;
            for (std::size_t j = 0; j < umbrella.ring.size(); ++j) {
                if (umbrella.is_gap(j)) continue;
                const std::size_t next = j + 1 == umbrella.ring.size() ? 0 : j + 1;
                turn += glm::dot(umbrella.normal,
                                 glm::cross(points[index(umbrella.ring[j])] - points[i],
                                            points[index(umbrella.ring[next])] - points[i]));
            }
            CHECK(turn > 0.0);
        }
    }
}

TEST_CASE("a surface does not depend on the order of its points") {
    const auto points = mixed_points();
    for (const auto method : {Method::robust, Method::thesis}) {
        PointSurfaceOptions options;
        options.method = method;
        const PointSurface surface(points, options);
        check_sound(surface);
        for (const std::uint64_t seed : {1u, 2u, 3u}) {
            CAPTURE(seed);
            std::vector<std::uint32_t> at = identity(points.size());
            Random(seed).shuffle(at);
            std::vector<glm::dvec3> shuffled(points.size());
            for (std::size_t i = 0; i < points.size(); ++i) shuffled[at[i]] = points[i];
            check_same(surface, PointSurface(shuffled, options), at);
        }
    }
}

TEST_CASE("a surface does not depend on the number of threads") {
    // Borders, lattices, rows and noise, each in more points than one thread takes at once.
    std::vector<glm::dvec3> points = tests::make_sphere(5000);
    for (glm::dvec3 offset{3.0, 0.0, 0.0}; offset.y < 20.0; offset.y += 2.0)
        for (const glm::dvec3& p : mixed_points()) points.push_back(p + offset);
    for (int row = 0; row < 12; ++row)
        for (int i = 0; i < 300; ++i) points.push_back({-9.0 + 0.01 * i, 0.1 * row, 0.0});
    std::vector<glm::dvec3> noisy = tests::make_patch(60, 0.2, 12).points;
    tests::add_noise(noisy, 0.1 / 59, 13);
    for (const glm::dvec3& p : noisy) points.push_back(p - glm::dvec3(4.0, 0.0, 0.0));
    for (const auto method : {Method::robust, Method::thesis}) {
        PointSurfaceOptions options;
        options.method = method;
        const PointSurface surface(points, options);
        check_sound(surface);
        CHECK(surface.count(PointLabel::border) > 1000);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        check_same(surface, PointSurface(points, options), identity(points.size()));
    }
}

// Few points, of each kind some that are no surface or no single one.
std::vector<glm::dvec3> make_odd_points(Random& random) {
    std::vector<glm::dvec3> points;
    const int kind = random.between(0, 4), count = random.between(5, 120);
    const int rows = random.between(1, 8);
    const double size = 0.1 + std::abs(jitter(random)), noise = 0.3 * std::abs(jitter(random));
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 move{jitter(random), jitter(random), jitter(random)};
        const double angle = std::numbers::pi * jitter(random), along = size * (i / rows);
        switch (kind) {
            case 0: points.push_back(move); break;
            case 1: points.push_back(glm::round(2.0 * move)); break;
            case 2:  // Bent rows.
                points.push_back(glm::dvec3(std::sin(along), i % rows, 1.0 - std::cos(along)) +
                                 noise * size * move);
                break;
            case 3:  // Circles above each other.
                points.push_back({std::cos(angle), std::sin(angle),
                                  size * random.between(0, 3) + 0.01 * noise * move.z});
                break;
            default: points.push_back({move.x, move.y, 5.0 * size * std::abs(move.x)});
        }
    }
    return points;
}

TEST_CASE("of whatever points, a surface is sound") {
    Random random(5);
    for (int n = 0; n < tests::rounds(1500); ++n) {
        CAPTURE(n);
        PointSurfaceOptions options;
        if (n % 4 == 0) options.method = Method::thesis;
        if (n % 3 == 0) options.k = static_cast<std::uint32_t>(random.between(4, 32));
        check_sound(PointSurface(make_odd_points(random), options));
    }
}

TEST_CASE("the thesis's passes find a sphere whole and a patch's border but for a tenth") {
    PointSurfaceOptions options;
    options.method = Method::thesis;
    const auto points = tests::make_sphere(5000);
    const PointSurface sphere(points, options);
    check_sound(sphere);
    CHECK(sphere.count(PointLabel::interior) == 5000);
    for (std::uint32_t i = 0; i < 5000; ++i)
        CHECK(std::abs(glm::dot(sphere.normal(PointId{i}), points[i])) > std::cos(0.03));

    const tests::Patch patch = tests::make_patch(40, 0.1, 9);
    const PointSurface flat(patch.points, options);
    check_sound(flat);
    int wrong = 0;
    for (std::uint32_t i = 0; i < flat.size(); ++i)
        wrong += (flat.label(PointId{i}) == PointLabel::border) != patch.is_border[i];
    CHECK(wrong <= 16);
}

TEST_CASE("inconsistent edges are the ends of gaps whose own gaps do not end there") {
    for (const Method method : {Method::robust, Method::thesis}) {
        PointSurfaceOptions options;
        options.method = method;
        const auto points = mixed_points();
        const PointSurface surface(points, options);
        std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (std::uint32_t i = 0; i < surface.size(); ++i) {
            const auto range = surface.umbrellas_of(PointId{i});
            for (std::uint32_t u = range.first; u < range.last; ++u) {
                const Umbrella umbrella = surface.umbrella(UmbrellaId{u});
                for (std::size_t j = 0; j < umbrella.ring.size(); ++j)
                    if (umbrella.is_gap(j)) {
                        edges.emplace_back(i, index(umbrella.ring[j]));
                        edges.emplace_back(i, index(umbrella.ring[(j + 1) % umbrella.ring.size()]));
                    }
            }
        }
        std::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
        std::uint32_t inconsistent = 0;
        for (const auto& [from, to] : edges)
            inconsistent +=
                std::find(edges.begin(), edges.end(), std::pair(to, from)) == edges.end();
        CHECK(surface.inconsistent_edge_count() == inconsistent);
        if (method == Method::thesis) CHECK(inconsistent > 0);
    }
    CHECK(PointSurface(tests::make_patch(20, 0.1, 4).points).inconsistent_edge_count() == 0);
}

TEST_CASE("a surface scaled by a power of two keeps all but its scale") {
    const auto points = mixed_points();
    const PointSurface surface(points);
    for (const int exponent : {-900, -30, 12, 900}) {
        CAPTURE(exponent);
        std::vector<glm::dvec3> scaled;
        for (const glm::dvec3& p : points) scaled.push_back(p * std::ldexp(1.0, exponent));
        const PointSurface other(scaled);
        for (std::uint32_t i = 0; i < surface.size(); ++i) {
            const PointId p{i};
            REQUIRE(other.label(p) == surface.label(p));
            REQUIRE(other.normal(p) == surface.normal(p));
            REQUIRE(other.scale(p) == std::ldexp(surface.scale(p), exponent));
        }
    }
}

TEST_CASE("coordinates at a million with a spacing of a thousandth make no difference") {
    const tests::Patch patch = tests::make_patch(25, 0.2, 3);
    std::vector<glm::dvec3> far_away;
    for (const glm::dvec3& p : patch.points)
        far_away.push_back(p * 0.024 + glm::dvec3(1e6, -1e6, 1e6));
    const PointSurface surface(far_away);
    for (std::uint32_t i = 0; i < surface.size(); ++i)
        CHECK((surface.label(PointId{i}) == PointLabel::border) == patch.is_border[i]);
}

TEST_CASE("too few points to have a surface are undecided, each with its reason") {
    const auto reason_of_all = [](const std::vector<glm::dvec3>& points) {
        const PointSurface surface(points);
        check_sound(surface);
        CHECK(surface.count(PointLabel::undecided) == points.size());
        for (std::uint32_t i = 1; i < surface.size(); ++i)
            CHECK(surface.reason(PointId{i}) == surface.reason(PointId{0}));
        return points.empty() ? UndecidedReason::none : surface.reason(PointId{0});
    };
    CHECK(reason_of_all({}) == UndecidedReason::none);
    CHECK(reason_of_all({{1, 2, 3}}) == UndecidedReason::alone);
    CHECK(reason_of_all({{0, 0, 0}, {1, 2, 3}}) == UndecidedReason::collinear);
    std::vector<glm::dvec3> line;
    for (int i = 0; i < 40; ++i) line.push_back(glm::dvec3(1, 2, 3) * (i * i * 0.1));
    CHECK(reason_of_all(line) == UndecidedReason::collinear);
    for (const auto reason :
         {UndecidedReason::alone, UndecidedReason::coincident, UndecidedReason::isolated,
          UndecidedReason::collinear, UndecidedReason::no_normal, UndecidedReason::outlier,
          UndecidedReason::unconfirmed_border})
        CHECK(std::string(describe(reason)).size() > 10);
}

TEST_CASE("a triangle is all border") {
    const PointSurface surface(std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0.4, 0.8, 0}});
    check_sound(surface);
    CHECK(surface.count(PointLabel::border) == 3);
    for (std::uint32_t i = 0; i < 3; ++i) CHECK(std::abs(surface.normal(PointId{i}).z) == 1.0);
}

TEST_CASE("of equal points one counts and the others say so") {
    std::vector<glm::dvec3> points = tests::make_sphere(500);
    points.push_back(points[7]);
    points.push_back(points[7]);
    const PointSurface surface(points);
    check_sound(surface);
    CHECK(surface.count(PointLabel::interior) == 500);
    CHECK(surface.count(PointLabel::undecided) == 2);
    CHECK(surface.reason(PointId{501}) == UndecidedReason::coincident);

    const PointSurface equal(std::vector<glm::dvec3>(20, glm::dvec3(3, 4, 5)));
    CHECK(equal.count(PointLabel::undecided) == 20);
    CHECK(equal.reason(PointId{0}) == UndecidedReason::alone);
}

TEST_CASE("points far from all others are isolated and take nothing from the rest") {
    std::vector<glm::dvec3> points = tests::make_sphere(2000);
    points.push_back({1000, 0, 0});
    points.push_back({0, -1e9, 3});
    const PointSurface surface(points);
    check_sound(surface);
    CHECK(surface.count(PointLabel::interior) == 2000);
    CHECK(surface.reason(PointId{2000}) == UndecidedReason::isolated);
    CHECK(surface.reason(PointId{2001}) == UndecidedReason::isolated);
}

TEST_CASE("a long call reports progress and stops when asked") {
    const auto points = tests::make_sphere(20000);
    for (const Method method : {Method::robust, Method::thesis}) {
        PointSurfaceOptions options;
        options.method = method;
        double last = 0.0;
        std::uint32_t calls = 0;
        const PointSurface surface(points, options, {{}, [&](double done) {
                                                         CHECK(done >= last);
                                                         CHECK(done <= 1.0);
                                                         last = done;
                                                         ++calls;
                                                     }});
        CHECK(last == 1.0);
        CHECK(calls > 5);
        std::stop_source stop;
        stop.request_stop();
        CHECK_THROWS_AS(PointSurface(points, options, {stop.get_token(), {}}), Error);
    }
}

}  // namespace
}  // namespace rimline
