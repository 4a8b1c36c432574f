#include "silhouette/field/projected_share.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/field/best_views.h"
#include "silhouette/mesh/shapes/built_in_shape.h"

namespace rimline {

namespace {

Mesh stretched(const char* shape, const glm::vec3& by, const glm::vec3& offset = glm::vec3(0.0f)) {
    MeshSource source = make_built_in_shape(shape, 2000);
    for (glm::vec3& p : source.positions) p = by * p + offset;
    return Mesh(source);
}

}  // namespace

TEST_CASE("the projected share of a ball is 1, of a long box what its moments say") {
    const ProjectedShare ball(stretched("sphere", glm::vec3(3.0f), {5, -7, 2}));
    for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), glm::dvec3(1, 2, 3), glm::dvec3(0, -1, 0.1)})
        CHECK(ball(d) == doctest::Approx(1.0).epsilon(0.01));

    // Moments of the surface of a box with half sides 1, 1 and 5, by hand: over the area, x = 1 on two of the long
    // sides and x²  = 1/3 on all others.
    const ProjectedShare box(stretched("box", {1, 1, 5}, {1000, 0, 0}));
    const double across = (2 * 20.0 * 1.0 + (2 * 20.0 + 2 * 4.0) / 3.0) / 88.0;
    const double along = (2 * 4.0 * 25.0 + 4 * 20.0 * 25.0 / 3.0) / 88.0;
    CHECK(box({0, 3, 0}) == doctest::Approx(1.0).epsilon(1e-4));
    CHECK(box({1, 1, 0}) == doctest::Approx(1.0).epsilon(1e-4));
    const double end_on = std::sqrt(across / along);
    CHECK(box({0, 0, 2}) == doctest::Approx(end_on).epsilon(1e-3));
    CHECK(box({0, 0, -1}) == doctest::Approx(end_on).epsilon(1e-3));
    const glm::dvec3 d = glm::normalize(glm::dvec3(0.0, 0.6, 0.8));
    CHECK(box(d) ==
          doctest::Approx(std::sqrt(d.y * d.y + d.z * d.z * end_on * end_on)).epsilon(1e-3));
}

TEST_CASE("the projected share does not depend on where a surface has many faces") {
    MeshSource source = make_built_in_shape("box", 12);
    for (glm::vec3& p : source.positions) p *= glm::vec3(1, 2, 4);
    const Mesh coarse(source);
    // One face becomes many, in its plane.
    const auto first = source.triangles.front();
    source.triangles.erase(source.triangles.begin());
    const glm::vec3 a = source.positions[first[0]], b = source.positions[first[1]],
                    c = source.positions[first[2]];
    constexpr int k_parts = 64;
    for (int i = 0; i < k_parts; ++i) {
        const auto at = [&](int k) { return b + (c - b) * (float(k) / float(k_parts)); };
        const auto base = static_cast<std::uint32_t>(source.positions.size());
        for (const glm::vec3& p : {a, at(i), at(i + 1)}) source.positions.push_back(p);
        source.triangles.push_back({base, base + 1, base + 2});
    }
    const ProjectedShare few(coarse);
    const ProjectedShare many{Mesh(source)};
    for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), glm::dvec3(1, 2, 3), glm::dvec3(0, -1, 4)})
        CHECK(many(d) == doctest::Approx(few(d)).epsilon(1e-6));
}

TEST_CASE("what lies in a plane is not seen along it, and a line has no direction") {
    const ProjectedShare sheet(stretched("sphere", {1, 0, 1}));
    CHECK(sheet({0, 1, 0}) == doctest::Approx(1.0));
    CHECK(sheet({1, 0, 1}) < 1e-6);
    const ProjectedShare line(stretched("sphere", {0, 3, 0}));
    CHECK(line({1, 0, 0}) == 1.0);
    CHECK(line({0, 1, 0}) == 1.0);
}

TEST_CASE("a long cylinder is seen from its side, a ball from anywhere") {
    CHECK(size_preference(1.0) == 1.0);
    CHECK(size_preference(0.4) == 1.0);
    CHECK(size_preference(0.2) == doctest::Approx(1.0 / 16.0));
    CHECK(size_preference(0.0) == 0.0);
    for (const float length : {6.0f, 15.0f, 50.0f}) {
        const Mesh mesh = stretched("sphere", {1, length, 1});
        const TangentialField field = make_view_field(mesh);
        BestViewsOptions options;
        options.mesh = &mesh;
        const ProjectedShare share(mesh);
        const BestViews best = find_best_views(field, options);
        REQUIRE(best.views.size() == options.count);
        for (const BestView& view : best.views) {
            const glm::dvec3 d = glm::normalize(view.eye - mesh.center());
            CHECK(view.preference == size_preference(share(d)));
        }
        const glm::dvec3 first = glm::normalize(best.views.front().eye - mesh.center());
        CHECK(std::abs(first.y) < 0.95);
    }
}

}  // namespace rimline
