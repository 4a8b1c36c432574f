// Suns of pictures against a closed form, a linear scan of all faces, and what a picture must be: neither dark
// nor flat.

#include "silhouette/field/picture_sun.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <vector>

#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/mesh/random.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

PictureFrame frame_towards(const Mesh& mesh, const glm::dvec3& direction) {
    const glm::dvec3 back = glm::normalize(direction);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
    return {.eye = mesh.center() + 3.5 * mesh.radius() * back,
            .right = right,
            .up = glm::cross(back, right),
            .back = back,
            .half_size = {0.4, 0.3}};
}

// The share of the disc of a sphere, seen from far away, whose normal is within 81 degrees of the sun (cosine
// 0.155).
double lit_share_of_sphere(double phase_rad) {
    constexpr int k_side = 2000;
    const double x_sun = std::sin(phase_rad), z_sun = std::cos(phase_rad);
    int lit = 0, all = 0;
    for (int row = 0; row < k_side; ++row)
        for (int column = 0; column < k_side; ++column) {
            const double x = 2.0 * (column + 0.5) / k_side - 1.0;
            const double y = 2.0 * (row + 0.5) / k_side - 1.0;
            if (x * x + y * y > 1.0) continue;
            ++all;
            lit += x * x_sun + std::sqrt(1.0 - x * x - y * y) * z_sun > 0.155;
        }
    return double(lit) / all;
}

// By signed volumes, of every face: whether the ray from `from` meets one. Without the plane of face `own`.
bool meets_some_face(const Mesh& mesh, std::uint32_t own, const glm::dvec3& from,
                     const glm::dvec3& to) {
    const auto volume = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                           const glm::dvec3& d) {
        return glm::dot(glm::cross(b - a, c - a), d - a);
    };
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (f == own) continue;
        const Triangle& t = mesh.triangles()[f];
        const glm::dvec3 a(mesh.positions()[index(t[0])]), b(mesh.positions()[index(t[1])]),
            c(mesh.positions()[index(t[2])]);
        if (volume(a, b, c, from) * volume(a, b, c, to) >= 0.0) continue;
        const double u = volume(from, to, a, b), v = volume(from, to, b, c),
                     w = volume(from, to, c, a);
        if ((u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0)) return true;
    }
    return false;
}

TEST_CASE("a sun lights the part of a sphere that the closed form says") {
    const Mesh mesh(make_built_in_shape("sphere", 20000));
    const SunSurvey survey(mesh);
    PictureFrame frame = frame_towards(mesh, {0, 0, 1});
    frame.is_orthographic = true;
    frame.half_size = glm::dvec2(1.1 * mesh.radius());
    const std::vector<SeenPlace> places = survey.places(frame, 4000);
    REQUIRE(places.size() > 2500);
    for (const double phase_deg : {0.0, 30.0, 60.0, 90.0, 120.0, 150.0}) {
        const double phase = phase_deg * std::numbers::pi / 180.0;
        const SunTones tones = survey.tones(places, {std::sin(phase), 0.0, std::cos(phase)});
        CHECK(std::abs(tones.lit - lit_share_of_sphere(phase)) < 0.02);
        CHECK(tones.bright <= tones.lit);
        CHECK(tones.spread <= 1.0 + 1e-9);
    }
}

TEST_CASE("cast shadows are those of a linear scan of all faces") {
    const Mesh mesh(make_built_in_shape("knot", 3000));
    const SunSurvey survey(mesh);
    const PictureFrame frame = frame_towards(mesh, {1, 0.5, 2});
    const std::vector<SeenPlace> places = survey.places(frame, 600);
    REQUIRE(places.size() > 150);
    Random random(11);
    double in_cast_shadow = 0.0;
    for (int i = 0; i < 12; ++i) {
        const glm::dvec3 sun = glm::normalize(glm::dvec3(random.in_cube()) + 1e-3);
        double lit = 0.0;
        for (const SeenPlace& place : places) {
            CHECK(glm::dot(place.face_normal, frame.back) > -0.5);
            if (glm::dot(place.normal, sun) < 0.155 || glm::dot(place.face_normal, sun) <= 0.0)
                continue;
            const glm::dvec3 from = place.position + 1e-4 * mesh.radius() * place.face_normal;
            const bool is_blocked =
                meets_some_face(mesh, place.face, from, from + 3.0 * mesh.radius() * sun);
            lit += is_blocked ? 0.0 : 1.0;
            in_cast_shadow += is_blocked ? 1.0 : 0.0;
        }
        CHECK(survey.tones(places, sun).lit ==
              doctest::Approx(lit / double(places.size())).epsilon(0.01));
    }
    CHECK(in_cast_shadow > 100.0);
}

TEST_CASE("no face lies before a seen place") {
    const Mesh mesh(make_built_in_shape("spring", 2000));
    const PictureFrame frame = frame_towards(mesh, {-2, 1, 1});
    for (const SeenPlace& place : SunSurvey(mesh).places(frame, 500))
        CHECK_FALSE(meets_some_face(mesh, place.face, frame.eye, place.position));
}

TEST_CASE(
    "the chosen sun lights a third to two thirds of round shapes from above and not from behind" *
    doctest::test_suite("plain")) {
    for (const char* shape : {"sphere", "torus", "knot", "spring", "terrain", "scene"}) {
        const Mesh mesh(make_built_in_shape(shape, 8000));
        const SunSurvey survey(mesh);
        for (const glm::dvec3 direction :
             {glm::dvec3(1, 0.8, 2), glm::dvec3(-2, 0.3, 1), glm::dvec3(0.3, 1, -1)}) {
            INFO(shape);
            const PictureFrame frame = frame_towards(mesh, direction);
            const auto sun = choose_picture_sun(survey, frame, {});
            REQUIRE(sun);
            CHECK(sun->tones.lit > 0.33);
            CHECK(sun->tones.lit < 0.68);
            CHECK(sun->tones.spread > 0.8);
            CHECK(sun->direction.y > 0.2);
            CHECK(glm::length(sun->direction) == doctest::Approx(1.0));
            CHECK(glm::dot(sun->direction, frame.back) > -0.2);
        }
    }
}

TEST_CASE("the chosen sun is the best of all candidates" * doctest::test_suite("plain")) {
    for (const char* shape : {"sphere", "box", "knot", "spring", "terrain", "scene"}) {
        const Mesh mesh(make_built_in_shape(shape, 3000));
        const SunSurvey survey(mesh);
        for (const glm::dvec3 direction :
             {glm::dvec3(1, 0.8, 2), glm::dvec3(-2, -1.5, 1), glm::dvec3(0, 0.1, -1)})
            for (const bool has_ground : {false, true}) {
                INFO(shape);
                const PictureFrame frame = frame_towards(mesh, direction);
                const std::vector<SeenPlace> places = survey.places(frame, 2400);
                double best = -1.0;
                glm::dvec3 best_sun(0.0);
                for (const glm::dvec3& sun :
                     picture_sun_candidates(frame, {.has_ground = has_ground})) {
                    const double score = picture_sun_score(survey.tones(places, sun), sun, frame);
                    if (score <= best) continue;
                    best = score;
                    best_sun = sun;
                }
                const auto sun = choose_picture_sun(survey, frame, {.has_ground = has_ground});
                REQUIRE(sun);
                CHECK(sun->score == best);
                CHECK(sun->direction == best_sun);
            }
    }
}

TEST_CASE("a sun turns with camera and mesh, and stands above a ground") {
    const auto turned = [](const glm::dvec3& v) { return glm::dvec3(v.z, v.y, -v.x); };
    MeshSource source = make_built_in_shape("knot", 4000);
    const Mesh mesh(source);
    for (glm::vec3& position : source.positions) position = {position.z, position.y, -position.x};
    const Mesh other(source);
    const glm::dvec3 direction(1, -1.5, 2);
    const PictureFrame frame = frame_towards(mesh, direction);
    const auto sun = choose_picture_sun(SunSurvey(mesh), frame, {});
    const auto other_sun =
        choose_picture_sun(SunSurvey(other), frame_towards(other, turned(direction)), {});
    REQUIRE(sun);
    REQUIRE(other_sun);
    CHECK(glm::distance(turned(sun->direction), other_sun->direction) < 1e-9);
    const auto above = choose_picture_sun(SunSurvey(mesh), frame, {.has_ground = true});
    REQUIRE(above);
    CHECK(above->direction.y > 0.6);
}

TEST_CASE("there is no sun where nothing is seen") {
    const Mesh mesh(make_built_in_shape("box", 100));
    PictureFrame frame = frame_towards(mesh, {0, 0, 1});
    frame.back = -frame.back;
    frame.right = -frame.right;
    CHECK_FALSE(choose_picture_sun(SunSurvey(mesh), frame, {}));
    CHECK_FALSE(choose_picture_sun(SunSurvey(Mesh(MeshSource{})), frame, {}));
}

TEST_CASE("the large face of a box is lit, and not the two small ones alone") {
    const Mesh box(make_built_in_shape("box", 12));
    for (const glm::dvec3& direction : {glm::dvec3(0.45, 0.25, 1), {-1, 0.3, 0.35}}) {
        const auto sun =
            choose_picture_sun(SunSurvey(box), frame_towards(box, direction), {.has_ground = true});
        REQUIRE(sun);
        CHECK(sun->tones.lit > 0.5);
        CHECK(sun->tones.lit < 0.95);
    }
}

TEST_CASE("small parts far apart are seen, and lit as one of them alone") {
    const MeshSource box = make_built_in_shape("box", 12);
    MeshSource apart = box;
    for (const glm::vec3& offset : {glm::vec3(3000, 0, 0), glm::vec3(0, 3000, 0)}) {
        const auto first = static_cast<std::uint32_t>(apart.positions.size());
        for (const glm::vec3& position : box.positions)
            apart.positions.push_back(position + offset);
        for (const auto& [a, b, c] : box.triangles)
            apart.triangles.push_back({first + a, first + b, first + c});
    }
    const Mesh one{box}, three{apart};
    const SunSurvey of_one(one), of_three(three);
    for (const bool is_orthographic : {false, true}) {
        CAPTURE(is_orthographic);
        PictureFrame far = frame_towards(three, {1, 2, 20});
        far.is_orthographic = is_orthographic;
        if (is_orthographic) far.half_size = glm::dvec2(1.1 * three.radius());
        const std::vector<SeenPlace> places = of_three.places(far, 2400);
        CHECK(places.size() > 2300);
        for (const SeenPlace& place : places)
            CHECK_FALSE(meets_some_face(
                three, place.face, far.is_orthographic ? place.position + 9.0 * far.back : far.eye,
                place.position));
        const std::optional<PictureSun> sun = choose_picture_sun(of_three, far, {});
        REQUIRE(sun);
        const std::vector<SeenPlace> near = of_one.places(frame_towards(one, far.back), 2400);
        CHECK(sun->tones.lit ==
              doctest::Approx(of_one.tones(near, sun->direction).lit).epsilon(0.1));
    }
}

TEST_CASE("a moving sun follows the camera turns slowly and comes back and leaves no frame dark" *
          doctest::test_suite("plain")) {
    const Mesh mesh(make_built_in_shape("knot", 8000));
    const SunSurvey survey(mesh);
    constexpr int k_frames = 90;
    std::vector<PictureFrame> frames;
    for (int i = 0; i < k_frames; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / k_frames;
        frames.push_back(frame_towards(mesh, {std::sin(angle), 0.4, std::cos(angle)}));
    }
    const std::vector<glm::dvec3> suns = choose_moving_sun(survey, frames, {});
    REQUIRE(suns.size() == frames.size());
    double total = 0.0;
    for (int i = 0; i < k_frames; ++i) {
        CHECK(glm::length(suns[i]) == doctest::Approx(1.0));
        const double turn = std::acos(std::min(1.0, glm::dot(suns[i], suns[(i + 1) % k_frames])));
        CHECK(turn < 2.0 * 2.0 * std::numbers::pi / k_frames);
        total += turn;
        const SunTones tones = survey.tones(survey.places(frames[i], 600), suns[i]);
        CHECK(tones.lit > 1.0 / 3.0);
        CHECK(tones.lit < 0.75);
    }
    CHECK(total < 1.5 * 2.0 * std::numbers::pi);
    // A camera that does not move has a sun that does not.
    for (const glm::dvec3& sun :
         choose_moving_sun(survey, std::vector<PictureFrame>(5, frames[0]), {}))
        CHECK(sun == choose_moving_sun(survey, {frames.data(), 1}, {}).front());
}

}  // namespace
