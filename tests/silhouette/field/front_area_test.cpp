#include "silhouette/field/front_area.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "silhouette/field/best_views.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/random.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

Mesh stretched(const char* shape, const glm::vec3& by, const glm::vec3& offset = glm::vec3(0.0f)) {
    MeshSource source = make_built_in_shape(shape, 2000);
    for (glm::vec3& p : source.positions) p = by * p + offset;
    return Mesh(source);
}

// The sum over all faces, up to a factor.
double area_from(const Mesh& mesh, const glm::dvec3& point, bool both_sides = false) {
    const UnitPlanes planes(mesh);
    double sum = 0.0;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const double distance = planes.distance(i, point);
        const double x = std::clamp((both_sides ? std::abs(distance) : distance) / 0.5, 0.0, 1.0);
        sum += planes.area(i) * x * x * (3.0 - 2.0 * x);
    }
    return sum;
}

BestViews views_with_area(const Mesh& mesh) {
    BestViewsOptions options;
    options.mesh = &mesh;
    return find_best_views(make_view_field(mesh), options);
}

}  // namespace

TEST_CASE("the front area is the sum over all faces in front") {
    const auto check = [](const Mesh& mesh, bool both_sides) {
        const FrontArea front(mesh);
        Random random(7);
        const glm::dvec3 some = 1.87 * glm::normalize(glm::dvec3(1, 2, 3));
        const double unit = area_from(mesh, some, both_sides) / front.share(some);
        double greatest = 0.0;
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 point = 1.87 * glm::normalize(glm::dvec3(random.in_cube()));
            const double share = area_from(mesh, point, both_sides) / unit;
            CHECK(front.share(point) == doctest::Approx(std::min(share, 1.0)).epsilon(0.02));
            greatest = std::max(greatest, share);
        }
        CHECK(greatest == doctest::Approx(1.0).epsilon(0.06));
    };
    check(stretched("box", {1, 2, 4}, {100, 0, 0}), false);
    check(stretched("knot", {1, 1, 1}), false);
    // Of an open surface both sides are seen.
    MeshSource open = make_built_in_shape("sphere", 2000);
    std::erase_if(open.triangles, [&](const auto& t) { return open.positions[t[0]].z > 0.1f; });
    check(Mesh(open), true);
}

TEST_CASE("the front area of a ball is the same from everywhere, inside out too") {
    MeshSource source = make_built_in_shape("sphere", 2000);
    for (auto& t : source.triangles) std::swap(t[0], t[1]);
    const Mesh inside_out(source);
    const FrontArea ball(stretched("sphere", glm::vec3(3.0f), {5, -7, 2})), turned(inside_out);
    for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), glm::dvec3(1, 2, 3), glm::dvec3(0, -1, 0.1)}) {
        CHECK(ball.share(1.87 * glm::normalize(d)) == doctest::Approx(1.0).epsilon(0.02));
        CHECK(turned.share(1.87 * glm::normalize(d)) == doctest::Approx(1.0).epsilon(0.02));
    }
}

TEST_CASE("the front area does not depend on where a surface has many faces") {
    MeshSource source = make_built_in_shape("box", 12);
    for (glm::vec3& p : source.positions) p *= glm::vec3(1, 2, 4);
    const FrontArea few{Mesh(source)};
    // One face becomes many, in its plane, and the mesh stays closed.
    for (std::size_t i = 0; i < 60; ++i) {
        const auto t = source.triangles[i * i % source.triangles.size()];
        const auto middle = static_cast<std::uint32_t>(source.positions.size());
        const auto& p = source.positions;
        source.positions.push_back(0.25f * p[t[0]] + 0.25f * p[t[1]] + 0.5f * p[t[2]]);
        source.triangles[i * i % source.triangles.size()] = {t[0], t[1], middle};
        source.triangles.push_back({t[1], t[2], middle});
        source.triangles.push_back({t[2], t[0], middle});
    }
    const Mesh mesh(source);
    CHECK(mesh.is_closed());
    const FrontArea many(mesh);
    for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), glm::dvec3(1, 2, 3), glm::dvec3(0, -1, 4)}) {
        const glm::dvec3 point = 1.87 * glm::normalize(d);
        CHECK(many.share(point) == doctest::Approx(few.share(point)).epsilon(1e-3));
    }
}

TEST_CASE("a mesh without planes shows all of itself from everywhere") {
    CHECK(FrontArea(Mesh(MeshSource{})).share({0, 0, 1.9}) == 1.0);
    const MeshSource needle{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
    CHECK(FrontArea(Mesh(needle)).share({0, 0, 1.9}) == 1.0);
}

TEST_CASE("a box is seen from its corners") {
    CHECK(area_preference(1.0) == 1.0);
    CHECK(area_preference(0.8) == 1.0);
    CHECK(area_preference(0.4) == doctest::Approx(1.0 / 16.0));
    CHECK(area_preference(0.0) == 0.0);
    CHECK(area_preference(0.4, 1) == doctest::Approx(0.25));
    for (const glm::vec3 sides : {glm::vec3(1, 1, 1), glm::vec3(3, 2, 1), glm::vec3(4, 2, 3)}) {
        const Mesh mesh = stretched("box", sides, {10, 0, 0});
        const FrontArea front(mesh);
        const BestViews best = views_with_area(mesh);
        REQUIRE(best.views.size() == BestViewsOptions().count);
        const UnitPlanes planes(mesh);
        const BestView by_votes = find_best_views(make_view_field(mesh)).views.front();
        CHECK(front.share(planes.frame().from_model(by_votes.eye)) < 0.6);
        for (const BestView& view : best.views) {
            const glm::dvec3 eye = planes.frame().from_model(view.eye);
            const std::size_t chosen = &view == &best.views.front() ? 0 : 1;
            CHECK(view.preference == area_preference(front.share(eye), chosen));
            std::size_t in_front = 0;
            for (std::size_t i = 0; i < planes.size(); ++i)
                in_front += planes.distance(i, eye) > 0.05 ? 1 : 0;
            CHECK(3 * in_front >= planes.size());
            CHECK(front.share(eye) > 0.7);
        }
    }
}

TEST_CASE("a long cylinder is seen from its side") {
    for (const float length : {6.0f, 15.0f, 50.0f}) {
        const Mesh mesh = stretched("sphere", {1, length, 1});
        const BestViews best = views_with_area(mesh);
        REQUIRE(best.views.size() == BestViewsOptions().count);
        const glm::dvec3 first = glm::normalize(best.views.front().eye - mesh.center());
        CHECK(std::abs(first.y) < 0.95);
    }
}
