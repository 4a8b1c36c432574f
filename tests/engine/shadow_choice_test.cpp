#include "engine/shadow_choice.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/shadow_scenes.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

constexpr std::uint32_t k_shadow_choice_size = 256;

Scene mask(Scene scene) {
    scene.style = Style::mask;
    scene.palette = default_palette(Style::mask, {0.02f, 0.1f, 0.5f});
    scene.lines = false;
    return scene;
}

std::size_t differing_pixels(const Picture& a, const Picture& b) {
    std::size_t count = 0;
    for (std::size_t at = 0; at < a.rgba.size(); at += 4)
        count += !std::equal(&a.rgba[at], &a.rgba[at] + 4, &b.rgba[at]);
    return count;
}

struct Variant {
    ShadowMethod method;
    ShadowForm form;
};
constexpr std::array k_variants{Variant{ShadowMethod::fail, ShadowForm::single},
                                Variant{ShadowMethod::pass, ShadowForm::general},
                                Variant{ShadowMethod::automatic, ShadowForm::automatic}};

// Draws scenes every way and demands one picture.
class VariantComparison {
public:
    explicit VariantComparison(const Gpu& gpu)
        : pulled_(gpu.context(), {.samples = 4, .scale = 1}),
          by_geometry_(gpu.context(),
                       {.samples = 4, .scale = 1, .shadow_sides = SideStage::geometry}) {}

    void draw(Scene scene) {
        ++draws_;
        scene = mask(std::move(scene));
        scene.shadow_method = ShadowMethod::fail;
        scene.shadow_form = ShadowForm::general;
        const Picture expected = pulled_.render(scene, k_shadow_choice_size, k_shadow_choice_size);
        for (const Variant& variant : k_variants) {
            scene.shadow_method = variant.method;
            scene.shadow_form = variant.form;
            const Picture drawn = pulled_.render(scene, k_shadow_choice_size, k_shadow_choice_size);
            const Picture by_geometry =
                by_geometry_.render(scene, k_shadow_choice_size, k_shadow_choice_size);
            for (const ShadowReport& shadow : pulled_.report().shadows) {
                casters_ += 1;
                passes_ += shadow.choice.method == ShadowMethod::pass ? 1 : 0;
                singles_ += shadow.choice.form == ShadowForm::single ? 1 : 0;
                const bool is_lamp = !scene.lights[shadow.light].directional;
                lamps_in_one_point_ += is_lamp && shadow.choice.ends_in_one_point ? 1 : 0;
            }
            INFO("draw ", draws_, ", method ", std::string(name_of(variant.method)), ", form ",
                 std::string(name_of(variant.form)));
            CHECK(differing_pixels(drawn, expected) == 0);
            CHECK(differing_pixels(by_geometry, expected) == 0);
        }
    }

    void finish(const char* name) const {
        std::printf(
            "%s: %d draws, %d casters before lights, %d by depth pass, %d in single form, "
            "rays of %d lamps end in one point\n",
            name, draws_, casters_, passes_, singles_, lamps_in_one_point_);
        CHECK(lamps_in_one_point_ > 0);
        CHECK(passes_ > 0);
        CHECK(passes_ < casters_);
        CHECK(singles_ > 0);
        CHECK(singles_ < casters_);
    }

private:
    Renderer pulled_;
    Renderer by_geometry_;
    int draws_ = 0;
    int casters_ = 0;
    int passes_ = 0;
    int singles_ = 0;
    int lamps_in_one_point_ = 0;
};

}  // namespace

TEST_CASE("a chain is closed where every edge is run both ways equally often") {
    const auto closed = [](const MeshSource& source) { return is_closed_chain(Mesh(source)); };
    CHECK(closed(make_built_in_shape("torus", 200)));
    CHECK(closed(turned_inside_out(make_built_in_shape("torus", 200))));
    CHECK(closed(figure_eight(16, 10)));
    CHECK(closed(boxes_on_an_edge()));
    CHECK(!closed(partly_turned_over(make_built_in_shape("sphere", 200))));
    CHECK(!closed(half_turned_sheet(20)));
    CHECK(!closed(make_built_in_shape("terrain", 200)));
    CHECK(!closed(upper_half(make_built_in_shape("sphere", 200))));
    CHECK(!closed(floating_soup(10, 1)));
}

TEST_CASE("the single form is for closed meshes with the light and the camera outside") {
    const Mesh torus(make_built_in_shape("torus", 200));
    const Mesh terrain(make_built_in_shape("terrain", 200));
    const auto form = [&](const Mesh& mesh, glm::vec3 light, const glm::dvec3& eye,
                          ShadowForm wanted = ShadowForm::automatic) {
        const ShadowView view{.eye = eye, .near_reach = 1e-3};
        const ShadowCaster caster{.low = glm::dvec3(mesh.bounds().low),
                                  .high = glm::dvec3(mesh.bounds().high),
                                  .is_closed_chain = is_closed_chain(mesh),
                                  .light = HomogeneousPoint::viewpoint(light)};
        return choose_shadow(ShadowMethod::automatic, wanted, view, caster).form;
    };
    const glm::vec3 high(0.0f, 5.0f, 0.0f);
    CHECK(form(torus, high, {3, 2, 3}) == ShadowForm::single);
    CHECK(form(torus, high, {3, 2, 3}, ShadowForm::general) == ShadowForm::general);
    CHECK(form(terrain, high, {3, 2, 3}, ShadowForm::single) == ShadowForm::general);
    const glm::vec3 inside = 0.5f * (torus.bounds().low + torus.bounds().high);
    CHECK(form(torus, inside, {3, 2, 3}, ShadowForm::single) == ShadowForm::general);
    CHECK(form(torus, high, glm::dvec3(inside), ShadowForm::single) == ShadowForm::general);
    // Where the near plane may cut the mesh, the camera is as good as inside.
    const double side = torus.bounds().high.x;
    CHECK(form(torus, high, {side + 0.9e-3, 0, 0}) == ShadowForm::general);
    CHECK(form(torus, high, {side + 1.2e-3, 0, 0}) == ShadowForm::single);
}

TEST_CASE(
    "a perspective view is outside a box where its near rectangle is, an orthographic one "
    "everywhere") {
    const glm::dvec3 low(-1.0), high(1.0);
    ShadowView view{.near_reach = 0.25};
    for (const glm::dvec3& eye : {glm::dvec3(0.0), glm::dvec3(0.9, -0.9, 0.9),
                                  glm::dvec3(1.2, 0.0, 0.0), glm::dvec3(0.0, -1.2, 1.2)}) {
        view.eye = eye;
        view.orthographic = false;
        CHECK_FALSE(is_outside(view, low, high));
        view.orthographic = true;
        CHECK(is_outside(view, low, high));
    }
    view.orthographic = false;
    for (const glm::dvec3& eye : {glm::dvec3(1.3, 0.0, 0.0), glm::dvec3(0.0, 0.0, -1.3)}) {
        view.eye = eye;
        CHECK(is_outside(view, low, high));
    }
}

TEST_CASE("depth pass is taken just where no volume meets the near plane") {
    constexpr std::uint64_t k_seed = 5;
    CAPTURE(k_seed);
    Random random(k_seed);
    const Mesh box(make_built_in_shape("box", 12));  // From -1 to 1.
    constexpr double k_reach = 0.05;
    int passes = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 eye = 4.0 * glm::dvec3(random.in_cube());
        const glm::vec3 place = 5.0f * random.in_cube();
        const bool directional = i % 2 == 0;
        const ShadowView view{.eye = eye, .near_reach = k_reach};
        const ShadowCaster caster{.low = glm::dvec3(box.bounds().low),
                                  .high = glm::dvec3(box.bounds().high),
                                  .is_closed_chain = true,
                                  .light = directional ? HomogeneousPoint::direction(place)
                                                       : HomogeneousPoint::viewpoint(place)};
        const bool pass =
            choose_shadow(ShadowMethod::pass, ShadowForm::automatic, view, caster).method ==
            ShadowMethod::pass;
        // Points of the ball around the eye are in shadow where the way to the light meets the box.
        int shaded = 0;
        double nearest = 1e9;
        for (int k = 0; k < 40; ++k) {
            const glm::dvec3 off = k_reach * glm::dvec3(random.in_cube()) / std::sqrt(3.0);
            const glm::dvec3 start = eye + off;
            const glm::dvec3 step =
                directional ? 20.0 * glm::normalize(glm::dvec3(place)) : glm::dvec3(place) - start;
            for (int t = 0; t <= 200; ++t) {
                const glm::dvec3 p = glm::abs(start + t / 200.0 * step);
                const double out = std::max({p.x, p.y, p.z}) - 1.0;
                nearest = std::min(nearest, out);
                shaded += out < 0.0 ? 1 : 0;
            }
        }
        INFO("eye ", eye.x, ", ", eye.y, ", ", eye.z, ", light ", place.x, ", ", place.y, ", ",
             place.z, directional ? ", direction" : "");
        if (pass) CHECK(shaded == 0);
        // Nor is it given up where there is room.
        if (nearest > 3.0 * k_reach) CHECK(pass);
        passes += pass ? 1 : 0;
    }
    CHECK(passes > 500);
    CHECK(passes < 2800);
}

TEST_CASE("depth pass in an orthographic view needs the volume's end behind the far plane") {
    const Mesh box(make_built_in_shape("box", 12));
    const auto method = [&](glm::vec3 towards, ShadowMethod wanted) {
        const ShadowView view{.orthographic = true, .back = {0, 0, 1}, .far = -5.0};
        const ShadowCaster caster{.low = glm::dvec3(box.bounds().low),
                                  .high = glm::dvec3(box.bounds().high),
                                  .is_closed_chain = true,
                                  .light = HomogeneousPoint::direction(glm::normalize(towards)),
                                  .extrusion = 20.0};
        return choose_shadow(wanted, ShadowForm::automatic, view, caster).method;
    };
    CHECK(method({0, 0, 1}, ShadowMethod::automatic) == ShadowMethod::pass);
    CHECK(method({0, 0, 1}, ShadowMethod::fail) == ShadowMethod::fail);
    CHECK(method({0, 1, 0.5}, ShadowMethod::automatic) == ShadowMethod::pass);
    CHECK(method({0, 1, 0.1}, ShadowMethod::pass) == ShadowMethod::fail);
    CHECK(method({0, 0, -1}, ShadowMethod::pass) == ShadowMethod::fail);
}

TEST_CASE("a parallel view whose near plane cuts a mesh takes what is always right") {
    const Mesh box(make_built_in_shape("box", 12));  // From -1 to 1.
    for (const double near : {1.1, 0.9, -0.9, -1.1}) {
        CAPTURE(near);
        const ShadowView view{.orthographic = true, .back = {0, 0, 1}, .far = -5.0, .near = near};
        const ShadowCaster caster{.low = glm::dvec3(box.bounds().low),
                                  .high = glm::dvec3(box.bounds().high),
                                  .is_closed_chain = true,
                                  .light = HomogeneousPoint::direction({0, 0, 1}),
                                  .extrusion = 20.0};
        CHECK(is_outside(view, caster.low, caster.high) == (near > 1.0));
        const ShadowChoice choice =
            choose_shadow(ShadowMethod::automatic, ShadowForm::automatic, view, caster);
        CHECK(choice.method == (near > 1.0 ? ShadowMethod::pass : ShadowMethod::fail));
        CHECK(choice.form == (near > 1.0 ? ShadowForm::single : ShadowForm::general));
    }
}

TEST_CASE(
    "rays of lamps end in one point where the lamp is behind the camera and the caster before it") {
    const Mesh box(make_built_in_shape("box", 12));  // From -1 to 1.
    const auto ends_in_one_point = [&](const HomogeneousPoint& light, double eye,
                                       bool orthographic = false) {
        const ShadowView view{.orthographic = orthographic,
                              .eye = {0, 0, eye},
                              .near_reach = 0.05,
                              .back = {0, 0, 1},
                              .far = -5.0};
        const ShadowCaster caster{.low = glm::dvec3(box.bounds().low),
                                  .high = glm::dvec3(box.bounds().high),
                                  .is_closed_chain = true,
                                  .light = light};
        for (const ShadowMethod method : {ShadowMethod::fail, ShadowMethod::automatic})
            for (const ShadowForm form : {ShadowForm::general, ShadowForm::automatic})
                CHECK(choose_shadow(method, form, view, caster).ends_in_one_point ==
                      choose_shadow(ShadowMethod::pass, ShadowForm::single, view, caster)
                          .ends_in_one_point);
        return choose_shadow(ShadowMethod::automatic, ShadowForm::automatic, view, caster)
            .ends_in_one_point;
    };
    const HomogeneousPoint behind = HomogeneousPoint::viewpoint({0, 3, 9});
    CHECK(ends_in_one_point(behind, 5.0));
    CHECK_FALSE(ends_in_one_point(behind, 9.5));                                      // Before it.
    CHECK_FALSE(ends_in_one_point(HomogeneousPoint::viewpoint({10, 0, 5.3f}), 5.0));  // Beside it.
    CHECK(ends_in_one_point(HomogeneousPoint::viewpoint({10, 0, 6}), 5.0));
    CHECK_FALSE(ends_in_one_point(behind, 1.02));  // The near plane is in the box.
    CHECK(ends_in_one_point(behind, 1.1));
    CHECK_FALSE(ends_in_one_point(behind, 0.5));
    CHECK_FALSE(ends_in_one_point(behind, -5.0));  // The box is behind the camera.
    CHECK_FALSE(ends_in_one_point(behind, 5.0, true));
    CHECK(ends_in_one_point(HomogeneousPoint::direction({0, 1, -1}), 0.5));
    CHECK_FALSE(ends_in_one_point(HomogeneousPoint::direction({0, 1, 1}), 5.0, true));
}

TEST_CASE("random scenes are the same picture by every method form and stage" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    constexpr std::uint64_t k_seed = 7;
    constexpr int k_draws = 30;
    CAPTURE(k_seed);
    RandomScenes scenes(k_seed);
    VariantComparison comparison(*gpu);
    for (int draw = 0; draw < k_draws; ++draw) comparison.draw(scenes.next());
    comparison.finish("variants");
}
