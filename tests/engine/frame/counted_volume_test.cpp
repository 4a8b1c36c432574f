#include "engine/frame/counted_volume.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "tests/engine/support/shadow_scenes.h"
#include "tests/engine/support/tracked_volume.h"
#include "tests/models.h"
#include "tests/rounds.h"

using namespace rimline;
using namespace rimline::tests;

namespace {

// Which faces a ray from the light meets, in double: a bit for each.
std::vector<bool> faces_on_ray(const Mesh& mesh, const glm::dvec3& from,
                               const glm::dvec3& direction) {
    std::vector<bool> met;
    for (const Triangle& triangle : mesh.triangles()) {
        glm::dvec3 v[3];
        for (std::size_t i = 0; i < 3; ++i)
            v[i] = glm::dvec3(mesh.positions()[index(triangle[i])]) - from;
        const double a = glm::dot(direction, glm::cross(v[0], v[1]));
        const double b = glm::dot(direction, glm::cross(v[1], v[2]));
        const double c = glm::dot(direction, glm::cross(v[2], v[0]));
        const bool crosses = (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
        const glm::dvec3 n = glm::cross(v[1] - v[0], v[2] - v[0]);
        met.push_back(crosses && glm::dot(n, v[0]) / glm::dot(n, direction) > 0.0);
    }
    return met;
}

// A light before a model, and random rays to its faces.
class Rays {
public:
    Rays(const TrackedVolume& volume, int count, Random& random) {
        const Mesh& mesh = volume.mesh();
        const HomogeneousPoint& light = volume.light();
        for (int ray = 0; ray < count; ++ray) {
            glm::dvec3 target(0.0);
            double sum = 0.0;
            for (const VertexId vertex : mesh.triangles()[random.below(mesh.face_count())]) {
                const double weight = 1.01 + random.signed_unit();
                target += weight * glm::dvec3(mesh.positions()[index(vertex)]);
                sum += weight;
            }
            target /= sum;
            const glm::dvec3 from =
                light.is_direction()
                    ? target + 10.0 * mesh.radius() * glm::normalize(glm::dvec3(light.xyz()))
                    : glm::dvec3(light.xyz());
            met_.push_back(faces_on_ray(mesh, from, target - from));
        }
    }

    // The greatest number of these faces on a ray.
    std::uint32_t most(std::span<const std::uint32_t> faces) const {
        std::uint32_t most = 0;
        for (const std::vector<bool>& met : met_) {
            std::uint32_t count = 0;
            for (const std::uint32_t face : faces) count += met[face] ? 1 : 0;
            most = std::max(most, count);
        }
        return most;
    }

private:
    std::vector<std::vector<bool>> met_;
};

constexpr std::array k_forms{ShadowForm::general, ShadowForm::single};

// Radii from the center, and 0 for a direction.
constexpr std::array k_distances{0.0, 0.02, 0.3, 0.7, 0.95, 1.2, 2.0, 7.0, 40.0, 200.0, 1000.0};

HomogeneousPoint light_at(const Mesh& mesh, double distance, const glm::dvec3& towards) {
    if (distance == 0.0) return HomogeneousPoint::direction(glm::vec3(towards));
    return HomogeneousPoint::viewpoint(
        glm::vec3(mesh.center() + distance * mesh.radius() * glm::normalize(towards)));
}

}  // namespace

TEST_CASE("no ray meets more triangles than the bound, of a volume and of each of its parts") {
    constexpr std::uint64_t k_seed = 3;
    CAPTURE(k_seed);
    Random random(k_seed);
    std::deque<Model> models;
    for (const char* name : {"box", "torus", "knot", "spring", "terrain", "scene"})
        models.emplace_back(make_built_in_shape(name, 600));
    models.emplace_back(half_turned_sheet(40));
    models.emplace_back(floating_soup(60, k_seed));
    models.emplace_back(floating_soup(400, k_seed));
    models.emplace_back(figure_eight(24, 12));
    models.emplace_back(boxes_on_an_edge());
    models.emplace_back(upper_half(make_built_in_shape("knot", 600)));
    models.emplace_back(partly_turned_over(make_built_in_shape("sphere", 300)));
    models.emplace_back(moved(make_built_in_shape("knot", 400), {1000.0, -30.0, 5.0}));
    models.emplace_back(square(1.0, 0.0));
    double tightness = 0.0;
    int cases = 0;
    std::size_t parts = 0;
    for (const Model& model : models)
        for (std::size_t i = 0; i < tests::rounds(std::size_t{3}) * k_distances.size(); ++i) {
            const Mesh& mesh = model.mesh;
            glm::dvec3 towards(random.in_cube());
            // On the axes' planes, and on an axis.
            if (i % 4 == 1) towards[static_cast<int>(random.below(3))] = 0.0;
            if (i % 8 == 3) towards = glm::dvec3(0, 1, 0);
            const double distance = k_distances[i % k_distances.size()];
            const TrackedVolume volume(model, light_at(mesh, distance, towards));
            const Rays rays(volume, 60, random);
            INFO(mesh.face_count(), " faces, ", distance, " radii towards ", towards.x, ", ",
                 towards.y, ", ", towards.z);
            for (const ShadowForm form : k_forms) {
                VolumeCounter counter;
                VolumeCount count;
                counter.update(volume.counted(form), 127, count);
                std::vector<std::uint32_t> casting;
                for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
                    if (form == ShadowForm::general ||
                        face_bit(volume.counted(form).face_words, FaceId{f}))
                        casting.push_back(f);
                const std::uint32_t most = rays.most(casting);
                CHECK(most <= count.bound);
                CHECK(count.bound <= mesh.face_count());
                tightness += double(count.bound) / std::max(1u, most);
                ++cases;
                const std::uint32_t limit = 1 + random.below(12);
                counter.divide(volume.counted(form), limit, count);
                std::uint32_t next = 0, next_side = 0;
                for (const VolumePart& part : count.parts) {
                    REQUIRE(part.first_face == next);
                    REQUIRE(part.first_side == next_side);
                    REQUIRE(part.face_count > 0);
                    next += part.face_count;
                    next_side += part.side_count;
                    CHECK(part.bound <= limit);
                    CHECK(rays.most(
                              std::span(count.faces).subspan(part.first_face, part.face_count)) <=
                          part.bound);
                }
                CHECK(next == count.faces.size());
                CHECK(next_side == count.sides.size());
                std::ranges::sort(count.faces);
                CHECK(count.faces == casting);  // Each once.
                parts += count.parts.size();
            }
        }
    std::printf("the bound is %.2f times what was met, on average; %.1f parts a volume\n",
                tightness / cases, double(parts) / cases);
    CHECK(tightness / cases < 8.0);
}

TEST_CASE("the bound does not grow with the distance of the light" * doctest::test_suite("plain")) {
    std::deque<Model> models;
    for (const char* name : {"box", "torus", "knot", "spring", "terrain", "scene"})
        models.emplace_back(make_built_in_shape(name, 20'000));
    for (const char* name :
         {"igea.ply", "stanford-bunny.obj", "ogre.obj", "fandisk.obj", "horse.ply", "nefertiti.obj",
          "beetle-alt.obj", "rocker-arm.obj", "alligator.obj"})
        if (const auto path = find_model(name)) models.emplace_back(read_mesh_file(*path));
    double worst = 0.0;
    for (const Model& model : models)
        for (const glm::dvec3& towards :
             {glm::dvec3(1, 1, 1), {0.3, 1, 0.2}, {1, 0.05, -0.4}, {0, 0, 1}}) {
            const auto bound_at = [&](double distance) {
                const TrackedVolume volume(model, light_at(model.mesh, distance, towards));
                VolumeCounter counter;
                VolumeCount count;
                counter.update(volume.counted(ShadowForm::general), 0, count);
                return count.bound;
            };
            const std::uint32_t sun = bound_at(0.0);
            for (const double distance : {10.0, 30.0, 100.0, 300.0, 1000.0}) {
                const std::uint32_t bound = bound_at(distance);
                INFO(model.mesh.face_count(), " faces, ", distance, " radii, sun ", sun);
                CHECK(bound <= 1.5 * sun + 8.0);
                worst = std::max(worst, double(bound) / sun);
            }
            for (const double distance : {1.0, 1.5, 3.0}) CHECK(bound_at(distance) <= 255);
        }
    std::printf("%zu models: at most %.2f times the bound of the sun\n", models.size(), worst);
}

TEST_CASE("a light that moves is counted as one that was there from the start") {
    constexpr std::uint64_t k_seed = 11;
    CAPTURE(k_seed);
    Random random(k_seed);
    const Model knot(make_built_in_shape("knot", 2000));
    SilhouetteTracker tracker(knot.octree, HomogeneousPoint::viewpoint({2, 3, 1}));
    CasterMesh caster(knot.mesh);
    VolumeCounter counter;
    VolumeCount followed;
    for (int step = 0; step < 60; ++step) {
        // Small steps within the bounds, and some far jumps.
        const glm::dvec3 place(step % 10 == 9 ? 40.0f * random.in_cube()
                                              : 0.9f * static_cast<float>(knot.mesh.radius()) *
                                                    random.in_cube());
        tracker.move_to(HomogeneousPoint::viewpoint(place));
        const CountedVolume volume{
            .caster = &caster,
            .silhouette = tracker.silhouette(),
            .face_words = tracker.face_words(),
            .light = tracker.point(),
            .form = k_forms[static_cast<std::size_t>(step) % k_forms.size()]};
        VolumeCount fresh;
        counter.update(volume, 127, fresh);
        counter.update(volume, 127, followed);
        CHECK(followed.bound == fresh.bound);
        for (std::size_t i = 0; i < tracker.silhouette().size(); ++i)
            REQUIRE(followed.places[i].edge == tracker.silhouette()[i]);
        if (step % 7 == 6) counter.divide(volume, 3, followed);
    }
}

TEST_CASE("a mesh that deforms is counted where its vertices are now") {
    constexpr std::uint64_t k_seed = 12;
    CAPTURE(k_seed);
    Random random(k_seed);
    const Model knot(make_built_in_shape("knot", 600));
    const SilhouetteTracker tracker(knot.octree, HomogeneousPoint::viewpoint({2, 3, 1}));
    CasterMesh caster(knot.mesh);
    VolumeCounter counter;
    VolumeCount followed;
    std::vector<glm::vec3> positions(knot.mesh.positions().begin(), knot.mesh.positions().end());
    std::set<std::uint32_t> bounds;
    for (int step = 0; step < 20; ++step) {
        // The silhouette stays the same, so that only its places tell.
        Bounds box{positions[0], positions[0]};
        for (glm::vec3& p : positions) {
            p += 0.3f * random.in_cube();
            box.low = glm::min(box.low, p);
            box.high = glm::max(box.high, p);
        }
        const CountedVolume volume{.caster = &caster,
                                   .silhouette = tracker.silhouette(),
                                   .face_words = tracker.face_words(),
                                   .light = HomogeneousPoint::viewpoint(3.0f * random.in_cube()),
                                   .form = k_forms[static_cast<std::size_t>(step) % k_forms.size()],
                                   .moved = MovedGeometry{positions, box}};
        VolumeCount fresh;
        counter.update(volume, 0, fresh);
        counter.update(volume, 0, followed);
        CHECK(followed.bound == fresh.bound);
        bounds.insert(fresh.bound);
    }
    CHECK(bounds.size() > 10);
}

TEST_CASE("a light that rests is not counted again") {
    const Model knot(make_built_in_shape("knot", 600));
    const TrackedVolume first(knot, HomogeneousPoint::viewpoint({2, 3, 1}));
    const TrackedVolume second(knot, HomogeneousPoint::viewpoint({-2, 0.5f, 1}));
    VolumeCounter counter;
    VolumeCount count;
    counter.update(first.counted(ShadowForm::general), 127, count);
    const std::uint32_t bound = count.bound;
    counter.divide(first.counted(ShadowForm::general), 3, count);
    const std::size_t parts = count.parts.size();
    CHECK(parts > 1);
    count.bound = 12345;  // Stays where nothing is counted.
    counter.update(first.counted(ShadowForm::general), 127, count);
    counter.divide(first.counted(ShadowForm::general), 3, count);
    CHECK(count.bound == 12345);
    CHECK(count.parts.size() == parts);
    for (const TrackedVolume* other : {&second, &first}) {
        counter.update(other->counted(ShadowForm::general), 127, count);
        CHECK(count.bound != 12345);
        CHECK(count.parts.empty());
        CHECK(count.faces.empty());
        CHECK(count.sides.empty());
    }
    CHECK(count.bound == bound);
    counter.update(first.counted(ShadowForm::single), 127, count);
    CHECK(count.bound < bound);
}
