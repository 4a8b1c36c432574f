#include "silhouette/points/feature_weights.h"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "tests/silhouette/points/sample_clouds.h"

namespace rimline {
namespace {

// Two square lattices that meet in the line x = 0, y = 0 .. n, and turn there by `angle`.
struct Fold {
    std::vector<glm::dvec3> points;
    std::vector<int>
        row;  // Of each point, how far it lies from the fold; negative on the first half.
};
Fold make_fold(int n, double angle) {
    Fold fold;
    for (int x = -n; x <= n; ++x)
        for (int y = 0; y <= 2 * n; ++y) {
            const double turned = x > 0 ? angle : 0.0;
            fold.points.push_back({x * std::cos(turned), double(y), x * std::sin(turned)});
            fold.row.push_back(x);
        }
    return fold;
}

TEST_CASE("a plane weighs nothing") {
    for (const double amount : {0.0, 0.3}) {
        const PointSurface surface(tests::make_patch(25, amount, 2).points);
        for (const float weight : feature_weights(surface)) CHECK(weight < 1e-6f);
    }
}

TEST_CASE("a fold weighs its angle over a right angle, and the flats beside it nothing") {
    for (const double degrees : {30.0, 60.0, 80.0, 90.0}) {
        CAPTURE(degrees);
        const int n = 9;
        const Fold fold = make_fold(n, degrees * std::numbers::pi / 180.0);
        const PointSurface surface(fold.points);
        const std::vector<float> weights = feature_weights(surface);
        for (std::uint32_t p = 0; p < surface.size(); ++p) {
            const double y = fold.points[p].y;
            if (y < 3.0 || y > 2 * n - 3) continue;  // The fold's ends.
            CAPTURE(p);
            if (fold.row[p] == 0)
                CHECK(static_cast<double>(weights[p]) ==
                      doctest::Approx(degrees / 90.0).epsilon(1e-6));
            if (std::abs(fold.row[p]) >= 3) CHECK(weights[p] < 1e-6f);
        }
    }
}

TEST_CASE("a sphere weighs little, and the less the denser it is sampled") {
    float before = 1.0f;
    for (const std::uint32_t count : {1000u, 4000u, 16000u}) {
        std::vector<float> weights = feature_weights(PointSurface(tests::make_sphere(count)));
        std::ranges::sort(weights);
        const float median = weights[weights.size() / 2];
        CHECK(weights.back() <= 1.0f);
        CHECK(median > 0.0f);
        CHECK(median < 0.6f * before);
        before = median;
    }
}

TEST_CASE("a weight is the greatest angle between neighbors' normals over all edges") {
    std::vector<glm::dvec3> points = tests::make_sphere(1500);
    tests::Random random(4);
    for (glm::dvec3& p : points) p *= 1.0 + 0.02 * tests::jitter(random);
    const PointSurface surface(points);
    const std::vector<float> weights = feature_weights(surface);
    int whole = 0;
    for (std::uint32_t i = 0; i < surface.size(); ++i) {
        const PointId p{i};
        const auto is_whole = [&](PointId q) { return surface.umbrellas_of(q).size() == 1; };
        if (surface.label(p) != PointLabel::interior) continue;
        const auto ring = surface.umbrella(UmbrellaId{surface.umbrellas_of(p).first}).ring;
        if (!std::ranges::all_of(ring, is_whole)) continue;
        double most = 0.0;
        for (std::size_t j = 0; j < ring.size(); ++j) {
            const glm::dvec3 before = surface.normal(ring[j]);
            const glm::dvec3 after = surface.normal(ring[(j + 2) % ring.size()]);
            most = std::max(most, std::acos(std::min(std::abs(glm::dot(before, after)), 1.0)));
        }
        CHECK(static_cast<double>(weights[i]) ==
              doctest::Approx(most / (std::numbers::pi / 2)).epsilon(1e-6));
        ++whole;
    }
    CHECK(whole > 1000);
}

TEST_CASE("points without umbrellas weigh nothing, and threads make no difference") {
    CHECK(feature_weights(PointSurface({})).empty());
    const std::vector<glm::dvec3> one{{1, 2, 3}};
    CHECK(feature_weights(PointSurface(one)) == std::vector<float>{0.0f});
    const PointSurface surface(make_fold(20, 1.0).points);
    const std::vector<float> weights = feature_weights(surface);
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(feature_weights(surface) == weights);
}

TEST_CASE("weights report progress and can be stopped") {
    const PointSurface surface(tests::make_sphere(20000));
    double last = 0.0;
    LongCall call;
    call.progress = [&](double done) {
        CHECK(done >= last);
        last = done;
    };
    feature_weights(surface, call);
    CHECK(last == 1.0);
    std::stop_source stop;
    stop.request_stop();
    call.stop = stop.get_token();
    CHECK_THROWS_AS(feature_weights(surface, call), Error);
}

}  // namespace
}  // namespace rimline
