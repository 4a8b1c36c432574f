#include "engine/frame/near_count.h"

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame/ray_bound.h"
#include "engine/frame/shadow_batches.h"
#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "silhouette/mesh/face_bits.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/shadow_scenes.h"
#include "tests/engine/support/tracked_volume.h"
#include "tests/silhouette/exact/exact_numbers.h"

namespace rimline {
namespace {

using namespace rimline::tests;

constexpr std::uint32_t k_near_count_size = 128;
constexpr std::uint32_t k_stacked = 300;

// The triangles between a point and the light, of those that cast, in exact arithmetic. -1 where one is touched at a
// side.
int triangles_to_light(const CountedVolume& volume, const glm::dvec3& from) {
    const Mesh& mesh = volume.caster->mesh();
    const WholeSpacePoint x{whole(from), false};
    const WholeSpacePoint y{whole(glm::dvec3(volume.light.xyz())), volume.light.is_direction()};
    int count = 0;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (volume.form == ShadowForm::single && !face_bit(volume.face_words, FaceId{f})) continue;
        SpaceTriangle corners;
        for (std::size_t c = 0; c < 3; ++c)
            corners[c] = {whole(mesh.positions()[index(mesh.triangles()[f][c])]), false};
        const std::optional<int> crossed = crossing(x, y, corners);
        if (!crossed) return -1;
        count += std::abs(*crossed);
    }
    return count;
}

// Squares over one another, so many that a light below the others is counted in parts.
MeshSource stack(std::uint32_t count) {
    MeshSource all;
    for (std::uint32_t i = 0; i < count; ++i) {
        const MeshSource one = square(1.0, -1.5 + 3.0 * i / count);
        const auto first = static_cast<std::uint32_t>(all.positions.size());
        all.positions.insert(all.positions.end(), one.positions.begin(), one.positions.end());
        for (const auto& t : one.triangles)
            all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return all;
}

std::vector<MeshSource> sources() {
    return {make_built_in_shape("knot", 3000),
            make_built_in_shape("torus", 1000),
            figure_eight(32, 14),
            floating_soup(150, 3),
            half_turned_sheet(60),
            boxes_on_an_edge()};
}

TEST_CASE("what is counted before the near plane is what lies between the eye and the light" *
          doctest::test_suite("plain")) {
    constexpr std::uint64_t k_seed = 11;
    CAPTURE(k_seed);
    Random random(k_seed);
    int known = 0, unknown = 0;
    std::uint32_t greatest = 0;
    for (const MeshSource& source : sources()) {
        const Model model(source);
        for (int number = 0; number < 60; ++number) {
            // Lights within the bounds, out of them, and in a direction.
            const glm::vec3 middle = glm::vec3(model.mesh.center());
            const glm::vec3 place =
                number % 3 == 0
                    ? middle + 0.5f * (model.mesh.bounds().high - middle) * random.in_cube()
                    : middle + 2.5f * random.in_cube();
            const TrackedVolume volume(model, number % 3 == 2 ? HomogeneousPoint::direction(place)
                                                              : HomogeneousPoint::viewpoint(place));
            for (const ShadowForm form : {ShadowForm::general, ShadowForm::single}) {
                const CountedVolume counted = volume.counted(form);
                const ShadowView view{.eye = 3.0 * glm::dvec3(random.in_cube()),
                                      .near_reach = 1e-3};
                const auto counts = near_counts(counted, {}, view);
                ++(counts ? known : unknown);
                if (!counts) continue;
                REQUIRE(counts->size() == 1);
                greatest = std::max(greatest, (*counts)[0]);
                // Of all of the near plane.
                for (int k = 0; k < 4; ++k) {
                    const glm::dvec3 off = 0.5e-3 * glm::dvec3(random.in_cube());
                    CHECK(static_cast<int>((*counts)[0]) ==
                          triangles_to_light(counted, view.eye + off));
                }
            }
        }
    }
    std::printf("%d known, up to %u, and %d unknown\n", known, greatest, unknown);
    CHECK(known > 500);
    CHECK(unknown > 0);
    CHECK(greatest > 4);
}

TEST_CASE("there is no one count where an edge or a face of the volume is before the near plane") {
    const Model wall(square(1.0, 0.0));
    const TrackedVolume volume(wall, HomogeneousPoint::viewpoint({0.2f, 1.0f, 0.1f}));
    const auto count = [&](const glm::dvec3& eye) -> int {
        const auto counts =
            near_counts(volume.counted(ShadowForm::general), {}, {.eye = eye, .near_reach = 0.01});
        return counts ? static_cast<int>((*counts)[0]) : -1;
    };
    CHECK(count({0.3, 0.5, 0.1}) == 0);
    CHECK(count({0.3, -0.5, 0.1}) == 1);
    CHECK(count({5.0, -0.5, 0.1}) == 0);
    CHECK(count({0.3, 0.005, 0.1}) == -1);
    CHECK(count({0.3, -0.005, 0.1}) == -1);
    // The way to the light passes the edge at x = 1 at these distances.
    CHECK(count({1.8, -1.0, 0.1}) == -1);
    CHECK(count({1.84, -1.0, 0.1}) == 0);
    CHECK(count({1.76, -1.0, 0.1}) == 1);
}

TEST_CASE("suns count what is before the near plane on all of the way to them") {
    const Model model(stack(k_stacked));
    const TrackedVolume volume(model, HomogeneousPoint::direction({0.02f, 1.0f, 0.01f}));
    const auto count = [&](const glm::dvec3& eye) -> int {
        const auto counts =
            near_counts(volume.counted(ShadowForm::general), {}, {.eye = eye, .near_reach = 1e-4});
        return counts ? static_cast<int>((*counts)[0]) : -1;
    };
    CHECK(count({0.3, 1.7, 0.1}) == 0);
    CHECK(count({0.3, 1.4835, 0.1}) == 1);
    CHECK(count({0.3, -1.7, 0.1}) == int{k_stacked});
    CHECK(count({0.3, -1000.0, 0.1}) == 0);
    CHECK(count({3.0, -1.7, 0.1}) == 0);
}

TEST_CASE(
    "counts are kept while light, form and eye rest, and made again when one of them changes") {
    const Model wall(square(1.0, 0.0));
    const TrackedVolume first(wall, HomogeneousPoint::viewpoint({0.2f, 1.0f, 0.1f}));
    const TrackedVolume second(wall, HomogeneousPoint::viewpoint({0.2f, -1.0f, 0.1f}));
    const CountedVolume above = first.counted(ShadowForm::general);
    ShadowView view{.eye = {0.3, -0.5, 0.1}, .near_reach = 0.01};
    VolumeCount two_parts;
    two_parts.parts.resize(2);
    NearCounter counter;
    using Counts = std::vector<std::uint32_t>;
    CHECK(counter.counts(above, {}, view) == Counts{1});
    CHECK(counter.counts(above, two_parts, view) == Counts{1});
    CHECK(counter.counts(second.counted(ShadowForm::general), {}, view) == Counts{0});
    CHECK(counter.counts(above, {}, view) == Counts{1});
    view.eye.y = 0.5;
    CHECK(counter.counts(above, {}, view) == Counts{0});
    view.near_reach = 1.0;
    CHECK_FALSE(counter.counts(above, {}, view));
    view = {.eye = {0.3, -0.5, 0.1}, .near_reach = 0.01};
    // Seen from the back, a single volume of a front has no triangle of it.
    CHECK(counter.counts(above, {}, view) == Counts{1});
    const auto single = near_counts(first.counted(ShadowForm::single), {}, view);
    CHECK(counter.counts(first.counted(ShadowForm::single), {}, view) == single);
}

TEST_CASE("parts count what is before the near plane for themselves") {
    const Model model(stack(k_stacked));
    const TrackedVolume volume(model, HomogeneousPoint::viewpoint({0.31f, -1.496f, 0.23f}));
    const CountedVolume counted = volume.counted(ShadowForm::general);
    VolumeCounter counter;
    VolumeCount count;
    counter.update(counted, k_batch_limit, count);
    REQUIRE(count.bound > k_batch_limit);
    counter.divide(counted, k_batch_limit, count);
    const ShadowView view{.eye = {2.37, 1.46, 2.71}, .near_reach = 1e-4};
    const auto counts = near_counts(counted, count, view);
    REQUIRE(counts);
    CHECK(counts->size() == count.parts.size());
    int sum = 0;
    for (const std::uint32_t part : *counts) sum += static_cast<int>(part);
    CHECK(sum > 10);
    CHECK(sum == triangles_to_light(counted, view.eye));
}

TEST_CASE("lamps within the bounds of what casts give the same picture by every method" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    constexpr std::uint64_t k_seed = 12;
    CAPTURE(k_seed);
    Random random(k_seed);
    Renderer renderer(gpu->context(), {.samples = 4, .scale = 1});
    const Model ground(square(20.0, -1.6));
    std::vector<MeshSource> meshes = sources();
    meshes.push_back(stack(k_stacked));
    meshes.push_back(turned_inside_out(make_built_in_shape("torus", 600)));
    std::deque<Model> models;
    int passes = 0, dark = 0, singles = 0, divided = 0, number = 0;
    for (const MeshSource& source : meshes) {
        const Model& model = models.emplace_back(source);
        for (int tries = 0; tries < 14; ++tries) {
            const glm::vec3 middle = glm::vec3(model.mesh.center());
            glm::vec3 place =
                middle + 0.8f * (model.mesh.bounds().high - middle) * random.in_cube();
            // In the middle of a face's shell, so that some are inside of thin tubes.
            if (tries % 3 == 0) {
                const auto face = random.below(model.mesh.face_count());
                const Plane& plane = model.mesh.plane(FaceId{face});
                const glm::vec3 corner =
                    model.mesh.positions()[index(model.mesh.triangles()[face][0])];
                place = corner - 0.02f * glm::vec3(plane.nx, plane.ny, plane.nz);
            }
            if (model.mesh.face_count() == 2 * k_stacked)
                place = {0.9f * place.x, -1.496f, 0.9f * place.z};
            Scene scene{
                .instances = {instance_of(model), ground_of(ground)},
                .lights = {lamp(glm::dvec3(place))},
                .camera = looking(3.5 * glm::dvec3(random.in_cube()) + glm::dvec3(0, 2.2, 0),
                                  {0, -0.4, 0}),
                .style = Style::mask,
                .palette = default_palette(Style::mask, {0.02f, 0.1f, 0.5f}),
                .lines = false};
            if (tries % 4 == 1) scene.lights.push_back(sun({0.3, 1.0, 0.2}));
            scene.shadow_method = ShadowMethod::fail;
            scene.shadow_form = ShadowForm::general;
            const Picture expected = renderer.render(scene, k_near_count_size, k_near_count_size);
            scene.shadow_method = ShadowMethod::automatic;
            scene.shadow_form = ShadowForm::automatic;
            const Picture drawn = renderer.render(scene, k_near_count_size, k_near_count_size);
            const ShadowReport& shadow = renderer.report().shadows.at(0);
            passes += shadow.choice.method == ShadowMethod::pass ? 1 : 0;
            singles += shadow.choice.form == ShadowForm::single ? 1 : 0;
            dark += shadow.shades_all ? 1 : 0;
            divided += shadow.runs > 0 && shadow.choice.method == ShadowMethod::pass ? 1 : 0;
            std::vector<Mark> marks;
            for (std::size_t at = 0; at < drawn.rgba.size(); at += 4)
                if (!std::equal(&drawn.rgba[at], &drawn.rgba[at] + 4, &expected.rgba[at]))
                    marks.push_back({at / 4, {255, 0, 0}});
            save_picture("near_count_" + std::to_string(number), drawn, marks);
            CAPTURE(number);
            ++number;
            CHECK(marks.size() == 0);
        }
    }
    std::printf("%d pictures: %d by depth pass, %d of them divided, %d single, %d dark\n", number,
                passes, divided, singles, dark);
    CHECK(passes > number / 2);
    CHECK(passes < number);
    CHECK(singles > dark);
    CHECK(dark > 5);
    CHECK(divided > 3);
}

TEST_CASE("a camera in the shadow sees the same picture by every method" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    constexpr std::uint64_t k_seed = 13;
    CAPTURE(k_seed);
    Random random(k_seed);
    Renderer renderer(gpu->context(), {.samples = 4, .scale = 1});
    const Model ground(square(20.0, -1.6));
    std::deque<Model> models;
    int number = 0, counted = 0;
    for (const MeshSource& source : sources()) {
        const Model& model = models.emplace_back(source);
        for (int tries = 0; tries < 6; ++tries) {
            const glm::dvec3 to_light =
                glm::normalize(glm::dvec3(random.in_cube()) + glm::dvec3(0.0, 1.5, 0.0));
            const glm::dvec3 eye = -0.8 * to_light + 0.6 * glm::dvec3(random.in_cube());
            Scene scene{.instances = {instance_of(model), ground_of(ground)},
                        .lights = {tries % 2 == 0 ? sun(to_light) : lamp(3.0 * to_light)},
                        .camera = looking(eye, glm::dvec3(0.5f * random.in_cube())),
                        .style = Style::mask,
                        .palette = default_palette(Style::mask, {0.02f, 0.1f, 0.5f}),
                        .lines = false};
            scene.shadow_method = ShadowMethod::fail;
            scene.shadow_form = ShadowForm::general;
            const Picture expected = renderer.render(scene, k_near_count_size, k_near_count_size);
            scene.shadow_method = ShadowMethod::automatic;
            scene.shadow_form = ShadowForm::automatic;
            const Picture drawn = renderer.render(scene, k_near_count_size, k_near_count_size);
            counted += std::string_view(renderer.report().shadows.at(0).choice.method_reason) ==
                               "the count is the same at all of the near plane"
                           ? 1
                           : 0;
            CAPTURE(number);
            ++number;
            CHECK(drawn.rgba == expected.rgba);
        }
    }
    std::printf("%d pictures, %d counted from the near plane on\n", number, counted);
    CHECK(counted > number / 2);
}

}  // namespace
}  // namespace rimline
