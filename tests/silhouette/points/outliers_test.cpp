#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/points/point_surface.h"
#include "tests/silhouette/points/sample_clouds.h"
#include "tests/silhouette/points/soundness.h"

namespace rimline {
namespace {

// `points` with others evenly distributed in a box from -0.2 to 1.2, but none nearer to z = 0 than 0.1: four spacings.
std::vector<glm::dvec3> with_stray_points(std::vector<glm::dvec3> points, std::uint32_t count) {
    tests::Random random(7);
    while (count > 0) {
        const glm::dvec3 p(0.5 + 0.7 * tests::jitter(random), 0.5 + 0.7 * tests::jitter(random),
                           0.7 * tests::jitter(random));
        if (std::abs(p.z) < 0.1) continue;
        points.push_back(p);
        --count;
    }
    return points;
}

PointSurfaceOptions without_outliers() {
    PointSurfaceOptions options;
    options.drops_outliers = true;
    return options;
}

std::uint32_t count_outliers(const PointSurface& surface) {
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < surface.size(); ++i)
        count += surface.reason(PointId{i}) == UndecidedReason::outlier;
    return count;
}

struct Errors {
    std::uint32_t missed = 0, extra = 0;
};
Errors errors(const tests::Patch& patch, const PointSurface& surface) {
    Errors errors;
    for (std::uint32_t i = 0; i < patch.points.size(); ++i) {
        const bool is_found = surface.label(PointId{i}) == PointLabel::border;
        errors.missed += patch.is_border[i] && !is_found;
        errors.extra += !patch.is_border[i] && is_found;
    }
    return errors;
}

TEST_CASE("without its outliers a patch has the border that it has without them") {
    const tests::Patch patch = tests::make_patch(40, 0.3, 3);
    for (const std::uint32_t count : {1u, 16u, 48u}) {
        CAPTURE(count);
        const std::vector<glm::dvec3> points = with_stray_points(patch.points, count);
        const PointSurface surface(points, without_outliers());
        tests::check_sound(surface);
        CHECK(errors(patch, surface).missed == 0);
        CHECK(errors(patch, surface).extra == 0);
        for (std::uint32_t i = 0; i < points.size(); ++i)
            CHECK((surface.reason(PointId{i}) == UndecidedReason::outlier) ==
                  (i >= patch.points.size()));
    }
    // With them it loses a fifth of it, or this tests nothing.
    CHECK(errors(patch, PointSurface(with_stray_points(patch.points, 48))).missed > 30);
}

TEST_CASE("strays that are each other's neighbors form no surface, however many they are") {
    const std::vector<glm::dvec3> sphere = tests::make_sphere(10'000);
    const double spacing = 2.0 / std::sqrt(10'000.0);
    for (const double half : {1.2, 2.0, 6.0})
        for (const std::uint32_t count : {10u, 200u, 1000u}) {
            CAPTURE(half);
            CAPTURE(count);
            std::vector<glm::dvec3> points = sphere;
            tests::Random random(count);
            for (std::uint32_t i = 0; i < count; ++i)
                points.push_back(half * glm::dvec3(tests::jitter(random), tests::jitter(random),
                                                   tests::jitter(random)));
            const PointSurface surface(points, without_outliers());
            for (std::uint32_t i = 0; i < points.size(); ++i) {
                const double away = std::abs(glm::length(points[i]) - 1.0);
                if (i >= sphere.size() && away < 4.0 * spacing) continue;
                CHECK((surface.reason(PointId{i}) == UndecidedReason::outlier) ==
                      (i >= sphere.size()));
            }
        }
}

TEST_CASE("objects of other sizes and spacings beside strays are surfaces") {
    std::vector<glm::dvec3> points = tests::make_sphere(5000);
    for (const glm::dvec3& p : tests::make_sphere(60)) points.push_back(0.1 * p + 3.0);
    for (const glm::dvec3& p : tests::make_sphere(300)) points.push_back(5.0 * p - 20.0);
    // What is seen of a surface through a gap.
    for (const glm::dvec3& p : tests::make_patch(6, 0.3, 8).points)
        points.push_back(0.2 * p + glm::dvec3(-3.0, 4.0, 0.0));
    const std::size_t on_surfaces = points.size();
    tests::Random random(5);
    for (std::uint32_t i = 0; i < 300; ++i)
        points.push_back(
            30.0 * glm::dvec3(tests::jitter(random), tests::jitter(random), tests::jitter(random)));
    const PointSurface surface(points, without_outliers());
    std::uint32_t found = 0;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const bool is_outlier = surface.reason(PointId{i}) == UndecidedReason::outlier;
        if (i < on_surfaces)
            CHECK_FALSE(is_outlier);
        else
            found += is_outlier;
    }
    CHECK(found > 250);
}

TEST_CASE("surfaces have no outliers, and too many are none") {
    const auto count = [](const std::vector<glm::dvec3>& points) {
        return count_outliers(PointSurface(points, without_outliers()));
    };
    CHECK(count({}) == 0);
    CHECK(count({{1, 2, 3}, {4, 5, 6}}) == 0);
    CHECK(count(tests::make_sphere(3000)) == 0);
    const std::vector<glm::dvec3> patch = tests::make_patch(40, 0.3, 3).points;
    CHECK(count(patch) == 0);
    // More than a tenth: 40 of 265.
    const std::vector<glm::dvec3> small = tests::make_patch(15, 0.3, 3).points;
    CHECK(count(with_stray_points(small, 20)) > 10);
    CHECK(count(with_stray_points(small, 40)) == 0);

    std::vector<glm::dvec3> noisy = tests::make_sphere(3000);
    tests::add_noise(noisy, 0.1 * 2.0 / std::sqrt(3000.0), 11);
    CHECK(count(noisy) == 0);
}

TEST_CASE("two sheets of different spacing are both surfaces") {
    std::vector<glm::dvec3> points = tests::make_patch(60, 0.3, 5).points;
    for (const glm::dvec3& p : tests::make_patch(10, 0.3, 6).points)
        points.push_back(p + glm::dvec3(0, 0, 0.5));
    CHECK(count_outliers(PointSurface(points, without_outliers())) == 0);
}

TEST_CASE("outliers do not depend on the order of points or the number of threads") {
    const std::vector<glm::dvec3> points =
        with_stray_points(tests::make_patch(40, 0.3, 3).points, 40);
    const PointSurface surface(points, without_outliers());
    std::vector<glm::dvec3> reversed = points;
    std::ranges::reverse(reversed);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const PointSurface other(reversed, without_outliers());
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        const PointId a{i}, b{surface.size() - 1 - i};
        CHECK(surface.label(a) == other.label(b));
        CHECK(surface.reason(a) == other.reason(b));
        CHECK(surface.scale(a) == other.scale(b));
    }
}

TEST_CASE("the search for outliers can be stopped, and its progress does not go back") {
    const std::vector<glm::dvec3> points =
        with_stray_points(tests::make_patch(100, 0.3, 3).points, 100);
    double last = 0.0;
    const PointSurface surface(points, without_outliers(), {{}, [&](double done) {
                                                                CHECK(done >= last);
                                                                last = done;
                                                            }});
    CHECK(last > 0.99);
    std::stop_source stop;
    CHECK_THROWS_AS(PointSurface(points, without_outliers(),
                                 {stop.get_token(),
                                  [&](double done) {
                                      if (done > 0.49) stop.request_stop();
                                  }}),
                    Error);
}

}  // namespace
}  // namespace rimline
