// Best views against drawing every candidate, against what a few planes must choose, and against the same
// mesh moved, scaled and turned inside out.

#include "silhouette/field/best_views.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <vector>

#include "silhouette/field/discounted_field.h"
#include "silhouette/field/named_functions.h"
#include "silhouette/mesh/ground_axes.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "silhouette/mesh/winding.h"
#include "tests/silhouette/field/reference_sum.h"
#include "tests/silhouette/mesh/random.h"
#include "tests/silhouette/mesh/small_meshes.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

BestViews views_of(const Mesh& mesh, std::uint32_t count, const VisibleRatios& ratios = {},
                   bool draws_all = false) {
    const TangentialField field = make_view_field(mesh);
    BestViewsOptions options;
    options.count = count;
    options.visible_ratios = ratios;
    options.draws_all = draws_all;
    return find_best_views(field, options);
}

bool in_shell(const Mesh& mesh, const glm::dvec3& eye) {
    const double distance = glm::distance(eye, mesh.center()) / mesh.radius();
    return distance >= std::sqrt(3.0) - 1e-9 && distance <= 2.0 + 1e-9;
}

// Anything that depends on the place alone, and hardly ever is the same twice.
double made_up_ratio(const glm::dvec3& eye) {
    return 0.55 + 0.4 * std::sin(3.0 * eye.x + 1.0) * std::cos(2.0 * eye.y - eye.z);
}

TEST_CASE("views lie in the shell and have falling scores without ratios") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const BestViews best = views_of(mesh, 5);
    REQUIRE(best.views.size() == 5);
    CHECK(best.renders == 0);
    double last = best.views[0].score();
    for (const BestView& view : best.views) {
        CHECK(in_shell(mesh, view.eye));
        CHECK(view.visible_ratio == 1.0);
        CHECK(view.score() <= last);
        last = view.score();
    }
}

TEST_CASE("the first view has the votes of all planes there and nearly the most of anywhere") {
    const Mesh mesh(make_built_in_shape("spring", 2000));
    const BestView first = views_of(mesh, 1).views.at(0);
    const UnitPlanes planes(mesh);
    const TangentialFunction f = view_function();
    const auto votes_at = [&](const glm::dvec3& p) {
        return reference_sum(planes, f, FieldOptions::Weight::count, p);
    };
    CHECK(first.votes ==
          doctest::Approx(votes_at(planes.frame().from_model(first.eye))).epsilon(1e-3));
    Random random(11);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 direction = glm::normalize(glm::dvec3(random.in_cube()));
        const double radius = 1.7321 + 0.26 * std::abs(double{random.signed_unit()});
        CHECK(votes_at(radius * direction) <= 1.01 * first.votes);
    }
}

TEST_CASE("drawing candidates lazily chooses what drawing all of them chooses" *
          doctest::test_suite("plain")) {
    for (const char* name : {"knot", "spring", "scene", "box"}) {
        CAPTURE(name);
        const Mesh mesh(make_built_in_shape(name, 1500));
        const UnitFrame frame = unit_frame(mesh);
        std::uint64_t drawn = 0;
        const VisibleRatios ratios = [&](std::span<const glm::dvec3> eyes) {
            std::vector<double> all;
            for (const glm::dvec3& eye : eyes) all.push_back(made_up_ratio(frame.from_model(eye)));
            drawn += eyes.size();
            return all;
        };
        const BestViews lazy = views_of(mesh, 3, ratios);
        CHECK(drawn == lazy.renders);
        const BestViews all = views_of(mesh, 3, ratios, true);
        CHECK(lazy.renders < all.renders);
        REQUIRE(lazy.views.size() == all.views.size());
        for (std::size_t i = 0; i < all.views.size(); ++i) {
            CHECK(lazy.views[i].eye == all.views[i].eye);
            CHECK(lazy.views[i].votes == all.views[i].votes);
            CHECK(lazy.views[i].visible_ratio == all.views[i].visible_ratio);
            CHECK(lazy.views[i].visible_ratio ==
                  made_up_ratio(frame.from_model(lazy.views[i].eye)));
        }
    }
}

TEST_CASE("what cannot be seen from anywhere is not chosen for its votes") {
    // The half space x > 0 shows nothing.
    const Mesh mesh(make_built_in_shape("knot", 1500));
    const BestViews best = views_of(mesh, 4, [](std::span<const glm::dvec3> eyes) {
        std::vector<double> ratios;
        for (const glm::dvec3& eye : eyes) ratios.push_back(eye.x > 0.0 ? 0.0 : 0.5);
        return ratios;
    });
    REQUIRE(best.views.size() == 4);
    for (const BestView& view : best.views) CHECK(view.eye.x <= 0.0);
}

TEST_CASE("one plane has one view and meshes without planes have none") {
    const MeshSource triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const Mesh mesh(triangle);
    const BestViews best = views_of(mesh, 4);
    REQUIRE(best.views.size() == 1);
    CHECK(best.views[0].votes == doctest::Approx(1.0).epsilon(1e-6));
    CHECK(in_shell(mesh, best.views[0].eye));

    MeshSource square = triangle;
    square.positions.emplace_back(1, 1, 0);
    square.triangles.push_back({1, 3, 2});
    CHECK(views_of(Mesh(square), 4).views.size() == 1);

    CHECK(views_of(Mesh(MeshSource{}), 4).views.empty());
    const MeshSource needle{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}};
    CHECK(views_of(Mesh(needle), 4).views.empty());
}

TEST_CASE("a mesh moved far away and scaled by a power of two has the same views there") {
    const MeshSource source = make_built_in_shape("scene", 1500);
    const BestViews expected = views_of(Mesh(source), 3);
    for (const float scale : {0x1p-20f, 0x1p30f}) {
        CAPTURE(scale);
        MeshSource scaled = source;
        for (glm::vec3& position : scaled.positions) position *= scale;
        const BestViews found = views_of(Mesh(scaled), 3);
        REQUIRE(found.views.size() == expected.views.size());
        for (std::size_t i = 0; i < expected.views.size(); ++i) {
            CHECK(glm::distance(found.views[i].eye / double{scale}, expected.views[i].eye) < 1e-9);
            CHECK(found.views[i].votes == doctest::Approx(expected.views[i].votes));
        }
    }
}

TEST_CASE("a closed mesh that is wound inside out has the same views") {
    const Mesh mesh(make_built_in_shape("knot", 2000));
    const BestViews expected = views_of(mesh, 3);
    const BestViews found = views_of(turned_inside_out(mesh), 3);
    REQUIRE(found.views.size() == expected.views.size());
    for (std::size_t i = 0; i < expected.views.size(); ++i)
        CHECK(glm::distance(found.views[i].eye, expected.views[i].eye) < 1e-6 * mesh.radius());
}

BestViews preferred_views(const Mesh& mesh, std::uint32_t count, const glm::dvec3& up,
                          const VisibleRatios& ratios = {}, bool draws_all = false) {
    const TangentialField field = make_view_field(mesh);
    BestViewsOptions options;
    options.count = count;
    options.up = up;
    options.visible_ratios = ratios;
    options.draws_all = draws_all;
    return find_best_views(field, options);
}

TEST_CASE("for people the first view is in the middle of a plateau and no other view is there" *
          doctest::test_suite("plain")) {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const TangentialField field = make_view_field(mesh);
    BestViewsOptions options;
    options.count = 5;
    options.up = glm::dvec3(0, 1, 0);
    options.visible_ratios = [](std::span<const glm::dvec3> eyes) {
        std::vector<double> values;
        for (const glm::dvec3& eye : eyes)
            values.push_back(0.7 + 0.2 * std::sin(eye.x) * std::cos(eye.y));
        return values;
    };
    const BestViews chosen = find_best_views(field, options);
    options.for_people = true;
    const BestViews best = find_best_views(field, options);
    options.draws_all = true;
    const BestViews all = find_best_views(field, options);
    REQUIRE(best.views.size() == 5);
    REQUIRE(all.views.size() == 5);
    CHECK(best.renders < all.renders);
    CHECK(best.views[0].eye != chosen.views[0].eye);
    CHECK(best.views[0].score() > 0.8 * chosen.views[0].score());
    const auto score_alone = [&](const BestView& view) {
        return field.value((view.eye - field.frame().center) / field.frame().radius) *
               view.visible_ratio * view.preference;
    };
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(best.views[i].eye == all.views[i].eye);
        CHECK(in_shell(mesh, best.views[i].eye));
        if (i > 0)
            CHECK(glm::dot(glm::normalize(best.views[0].eye - mesh.center()),
                           glm::normalize(best.views[i].eye - mesh.center())) < 0.8661);
        if (i > 1) CHECK(score_alone(best.views[i]) <= score_alone(best.views[i - 1]) * (1 + 1e-9));
    }
}

TEST_CASE("views from below count less, down to a half at 60 degrees") {
    const glm::dvec3 up(0, 0, 3);
    CHECK(height_preference({1, 2, 0}, up) == 1.0);
    CHECK(height_preference({1, 2, 5}, up) == 1.0);
    const double below_30 = height_preference({std::sqrt(3.0), 0, -1}, up);
    CHECK(below_30 == doctest::Approx(0.75));
    CHECK(height_preference({1, 0, -std::sqrt(3.0)}, up) == doctest::Approx(0.5));
    CHECK(height_preference({0, 0, -1}, up) == doctest::Approx(0.5));
}

TEST_CASE("views from behind count a fifth less than three-quarter views in front") {
    for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), {0, 0, 1}, {0, -1, 0}}) {
        const glm::dvec3 right = three_quarter_direction(up);
        const glm::dvec3 level = glm::normalize(right - glm::dot(right, up) * up);
        const glm::dvec3 left =
            right - 2.0 * glm::dot(right, ground_axes(up).first) * ground_axes(up).first;
        CHECK(view_preference(3.0 * right, up) == 1.0);
        CHECK(view_preference(left, up) == doctest::Approx(1.0));
        // Opposite to the right one, and 38 degrees above.
        const double behind = view_preference(right - 2.0 * glm::dot(right, level) * level, up);
        CHECK(behind > 0.8);
        CHECK(behind < 0.92);
        CHECK(view_preference(-right, up) < 0.85 * height_preference(-right, up));
    }
}

TEST_CASE("with an up direction the scores have the preference and drawing all changes nothing" *
          doctest::test_suite("plain")) {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const VisibleRatios ratios = [](std::span<const glm::dvec3> eyes) {
        std::vector<double> values;
        for (const glm::dvec3& eye : eyes) values.push_back(made_up_ratio(eye));
        return values;
    };
    for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), {0, -1, 0}, {1, 0, 2}}) {
        const BestViews best = preferred_views(mesh, 4, up, ratios);
        const BestViews all = preferred_views(mesh, 4, up, ratios, true);
        REQUIRE(best.views.size() == 4);
        REQUIRE(all.views.size() == 4);
        CHECK(best.renders < all.renders);
        for (std::size_t i = 0; i < 4; ++i) {
            const BestView& view = best.views[i];
            CHECK(view.eye == all.views[i].eye);
            CHECK(in_shell(mesh, view.eye));
            CHECK(view.visible_ratio == made_up_ratio(view.eye));
            CHECK(view.preference ==
                  doctest::Approx(view_preference(view.eye - mesh.center(), up)).epsilon(1e-9));
        }
        const BestViews by_votes = preferred_views(mesh, 2, up);
        CHECK(by_votes.renders == 0);
        CHECK(by_votes.candidates == 0);
        for (const BestView& view : by_votes.views) CHECK(view.visible_ratio == 1.0);
    }
}

TEST_CASE("of a shape without a best side, the first view is a three-quarter view from above") {
    const Mesh sphere(make_built_in_shape("sphere", 5000));
    for (const glm::dvec3 up : {glm::dvec3(0, 1, 0), {0, 0, 1}, {0, -1, 0}}) {
        const BestView first = preferred_views(sphere, 1, up).views.at(0);
        const glm::dvec3 direction = glm::normalize(first.eye - sphere.center());
        CHECK(glm::dot(direction, three_quarter_direction(up)) > 0.88);  // The lattice is coarse.
    }
}

// Symmetric across x alone.
Mesh two_knots() {
    MeshSource source = make_built_in_shape("knot", 2000);
    const auto count = static_cast<std::uint32_t>(source.positions.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 p = source.positions[i] + glm::vec3(3, 0, 0);
        source.positions[i] = p;
        source.positions.emplace_back(-p.x, p.y, p.z);
    }
    const std::size_t faces = source.triangles.size();
    for (std::size_t i = 0; i < faces; ++i) {
        const auto [a, b, c] = source.triangles[i];
        source.triangles.push_back({a + count, c + count, b + count});
    }
    return Mesh(source);
}

TEST_CASE(
    "of two halves, the steady first view sees the same one though the other has a little more") {
    const Mesh mesh = two_knots();
    const TangentialField field = make_view_field(mesh);
    const auto first_x = [&](double ratio_at_plus_x, std::optional<int> mirror_axis) {
        BestViewsOptions options;
        options.count = 1;
        options.for_people = true;
        options.mirror_axis = mirror_axis;
        options.visible_ratios = [&](std::span<const glm::dvec3> eyes) {
            std::vector<double> ratios;
            for (const glm::dvec3& eye : eyes) {
                const double x = eye.x - mesh.center().x;
                ratios.push_back(0.9 * (x > 0.0 ? ratio_at_plus_x : 1.0) * std::abs(x) /
                                 glm::distance(eye, mesh.center()));
            }
            return ratios;
        };
        return find_best_views(field, options).views.at(0).eye.x;
    };
    CHECK(first_x(0.96, 0) > 0.0);
    CHECK(first_x(0.96, std::nullopt) < 0.0);
    CHECK(first_x(0.85, 0) < 0.0);
}

TEST_CASE("the mirror image of a chosen view has no votes left where the mirror is known") {
    CHECK(symmetry_axis(two_knots()) == 0);
    CHECK(symmetry_axis(Mesh(make_built_in_shape("sphere", 2000))) == std::nullopt);
    CHECK(symmetry_axis(Mesh(make_built_in_shape("knot", 2000))) == std::nullopt);
    const Mesh knot(make_built_in_shape("knot", 2000));
    const TangentialField field = make_view_field(knot);
    BestViewsOptions options;
    options.count = 2;
    const BestViews without = find_best_views(field, options);
    int fewer = 0;
    for (const int axis : {0, 1, 2}) {
        options.mirror_axis = axis;
        const BestViews with = find_best_views(field, options);
        REQUIRE(with.views.size() == 2);
        CHECK(with.views[0].eye == without.views[0].eye);
        // It counts what the first view and its image leave.
        DiscountedField left(field);
        glm::dvec3 seen = field.frame().from_model(with.views[0].eye);
        left.discount(seen);
        seen[axis] = -seen[axis];
        left.discount(seen);
        CHECK(left.value(seen) < 1e-3 * field.value(seen));
        const double votes = left.value(field.frame().from_model(with.views[1].eye));
        CHECK(with.views[1].votes == doctest::Approx(votes));
        CHECK(with.views[1].votes < 1.01 * without.views[1].votes);
        fewer += with.views[1].votes < 0.95 * without.views[1].votes ? 1 : 0;
    }
    CHECK(fewer > 0);
}

}  // namespace
