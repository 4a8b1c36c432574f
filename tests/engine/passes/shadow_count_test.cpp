// What the stencil counts, against rays: at random pixels of meshes of every class, the number of
// triangles between the light and the surface, or in the single form of front faces among them.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame/render_targets.h"
#include "engine/renderer.h"
#include "engine/vulkan/memory.h"
#include "tests/engine/support/depth_readback.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/ray_reference.h"
#include "tests/engine/support/shadow_scenes.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

constexpr std::uint32_t k_shadow_count_size = 256;

// Counts along rays in double, triangle by triangle.
class Counts {
public:
    Counts(const Scene& scene, const std::vector<ShadowReport>& shadows)
        : scene_(scene), rays_(scene), single_(scene.instances.size(), false), dark_(single_) {
        for (const ShadowReport& shadow : shadows) {
            single_[shadow.instance] =
                shadow.choice.form == ShadowForm::single && !shadow.shades_all;
            dark_[shadow.instance] = shadow.shades_all;
        }
    }

    /// Between the light and the viewer's side of what is seen there; nothing where nothing is.
    std::optional<int> at(glm::dvec2 place) const {
        const Ray ray = rays_.camera_ray(place, glm::dvec2(k_shadow_count_size));
        const std::optional<SurfacePoint> surface = rays_.first_surface(ray);
        if (!surface) return std::nullopt;
        const Light& light = scene_.lights[0];
        const glm::dvec3 to_light =
            light.directional ? light.vector : light.vector - surface->position;
        int count = 0;
        for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
            if (!scene_.instances[i].casts_shadows) continue;
            const Mesh& mesh = scene_.instances[i].octree->mesh();
            const int before = count;
            for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
                glm::dvec3 v[3];
                for (std::size_t c = 0; c < 3; ++c)
                    v[c] = rays_.vertex(i, mesh.triangles()[f][c]) - surface->position;
                const glm::dvec3 n = glm::cross(v[1] - v[0], v[2] - v[0]);
                const bool front = glm::dot(n, to_light) > 0.0;
                if (single_[i] && !front) continue;
                if (i == surface->instance && FaceId{f} == surface->face) {
                    // The surface itself, where it is between its light and its viewer.
                    count += front == (glm::dot(n, ray.direction) > 0.0) ? 1 : 0;
                    continue;
                }
                const double a = glm::dot(to_light, glm::cross(v[0], v[1]));
                const double b = glm::dot(to_light, glm::cross(v[1], v[2]));
                const double c = glm::dot(to_light, glm::cross(v[2], v[0]));
                if (!((a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0))) continue;
                const double along = glm::dot(n, v[0]) / glm::dot(n, to_light);
                count += along > 0.0 && (light.directional || along < 1.0) ? 1 : 0;
            }
            if (dark_[i]) count = std::min(count, before + 1);
        }
        return count;
    }

    /// The same, where it is the same all around.
    std::optional<int> clearly_at(glm::dvec2 place) const {
        const std::optional<int> count = at(place);
        if (!count) return std::nullopt;
        for (int k = 0; k < 8; ++k) {
            const double angle = 0.25 * glm::pi<double>() * k;
            const glm::dvec2 off(std::cos(angle), std::sin(angle));
            if (at(place + (k % 2 == 0 ? 0.03 : 0.3) * off) != count) return std::nullopt;
        }
        return count;
    }

private:
    const Scene& scene_;
    RayReference rays_;
    std::vector<bool> single_;
    std::vector<bool> dark_;  // Counted once, if at all.
};

}  // namespace

TEST_CASE("the stencil counts the triangles between light and surface of every class of mesh" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    constexpr std::uint64_t k_seed = 8;
    constexpr int k_points = 60;
    CAPTURE(k_seed);
    Random random(k_seed);
    const Model ground(square(20.0, -1.6));
    std::deque<Model> models;  // A renderer may keep what it has drawn.
    Renderer renderer(gpu->context(), {.samples = 1, .scale = 1, .keeps_stencil = true});
    struct Class {
        const char* name;
        MeshSource source;
    };
    std::vector<Class> classes;
    classes.push_back({"closed", make_built_in_shape("knot", 400)});
    classes.push_back({"open", make_built_in_shape("terrain", 300)});
    classes.push_back({"non-manifold", boxes_on_an_edge()});
    classes.push_back({"inconsistent", partly_turned_over(make_built_in_shape("sphere", 200))});
    classes.push_back({"not orientable", half_turned_sheet(40)});
    classes.push_back({"self-intersecting", figure_eight(24, 12)});
    classes.push_back({"inside out", turned_inside_out(make_built_in_shape("torus", 300))});
    classes.push_back({"soup", floating_soup(60, k_seed)});
    for (const Class& of : classes) {
        const Model& model = models.emplace_back(of.source);
        int points = 0, greatest = 0, singles = 0;
        // From without, from within, and as directions; the last camera is in shadow.
        for (const Light& light : {lamp({1.5, 2.6, 0.9}), lamp({0.04, 0.31, -0.07}),
                                   sun({0.4, 1.0, 0.3}), sun({-0.9, 0.5, 0.2})})
            for (const ShadowForm form : {ShadowForm::general, ShadowForm::automatic})
                for (const glm::dvec3& eye : {glm::dvec3(2.5, 2.2, 3.1), {0.4, -1.2, 2.2}}) {
                    Scene scene{.instances = {instance_of(model, turned({1, 2, 0}, 0.3)),
                                              ground_of(ground, true)},
                                .lights = {light},
                                .camera = looking(eye, {0.0, -0.5, 0.0}),
                                .lines = false};
                    scene.shadow_form = form;
                    // Depth pass counts the same: auto draws by it where it can.
                    renderer.render(scene, k_shadow_count_size, k_shadow_count_size);
                    const std::vector<std::uint8_t> stencil =
                        read_stencil(gpu->context(), renderer.targets()->depth());
                    const Counts counts(scene, renderer.report().shadows);
                    for (const ShadowReport& shadow : renderer.report().shadows)
                        singles += shadow.choice.form == ShadowForm::single ? 1 : 0;
                    for (int tries = 0; tries < k_points; ++tries) {
                        const std::uint32_t x = random.below(k_shadow_count_size);
                        const std::uint32_t y = random.below(k_shadow_count_size);
                        const std::optional<int> expected = counts.clearly_at({x + 0.5, y + 0.5});
                        if (!expected) continue;
                        ++points;
                        greatest = std::max(greatest, *expected);
                        INFO(of.name, ", at ", x, ", ", y);
                        CHECK(int{stencil[y * k_shadow_count_size + x]} == *expected);
                    }
                }
        std::printf("%s: %d points, up to %d in a row, %d times in the single form\n", of.name,
                    points, greatest, singles);
        CHECK(points > 100);
        CHECK(greatest > 1);
        CHECK((singles > 0) == is_closed_chain(model.mesh));
    }
}
