#include "engine/stream/consistency_check.h"

#include <array>
#include <deque>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "engine/renderer.h"
#include "engine/vulkan/commands.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"
#include "tests/rounds.h"
#include "tests/silhouette/hough/support/random_walk.h"

namespace rimline {
namespace {

// Frames on the device without pictures, one after the other.
class StreamFrames {
public:
    explicit StreamFrames(const DeviceContext& context)
        : context_(context), scatter_(context), check_(context, 1) {}

    /// Runs the frame and returns what differs.
    std::uint64_t run(std::span<TrackedSilhouette* const> silhouettes) {
        run_commands(context_, [&](Commands commands) {
            ChangeStream::record_before(commands);
            for (const TrackedSilhouette* silhouette : silhouettes)
                silhouette->stream().record(commands, scatter_);
            ChangeStream::record_after(commands);
            check_.record(commands, 0, silhouettes);
        });
        return check_.take_differences(0);
    }

private:
    DeviceContext context_;
    ScatterPass scatter_;
    ConsistencyCheck check_;
};

TEST_CASE("over 10,000 random frames the GPU holds exactly what the trackers say") {
    RIMLINE_OPEN_GPU(gpu);
    constexpr std::uint32_t k_seed = 2026;
    constexpr int k_frames = tests::rounds(10'000);
    CAPTURE(k_seed);
    std::mt19937 random(k_seed);
    SilhouetteService service({.workers = 1});
    MemoryBudget budget(std::uint64_t{64} << 20, "the budget of this test");
    struct Walked {
        Walked(const DeviceContext& context, SilhouetteService& service, MemoryBudget& budget,
               const tests::Model& model, std::uint64_t seed)
            : walk(model.mesh, seed),
              silhouette(context, service, model.octree, walk.point(), 1, budget, budget,
                         "a model") {}
        tests::RandomWalk walk;
        TrackedSilhouette silhouette;
    };
    // Closed, open, and with edges of three faces; one model is there twice, as from camera and light.
    const tests::Model knot(make_built_in_shape("knot", 1500));
    const tests::Model terrain(make_built_in_shape("terrain", 900));
    const tests::Model sphere(make_built_in_shape("sphere", 300));
    std::deque<Walked> walked;
    for (const tests::Model* model : {&knot, &knot, &terrain, &sphere})
        walked.emplace_back(gpu->context(), service, budget, *model, k_seed + walked.size());
    StreamFrames frames(gpu->context());
    std::uint64_t whole = 0;
    std::uint64_t in_part = 0;
    for (int frame = 0; frame < k_frames; ++frame) {
        CAPTURE(frame);
        std::vector<TrackedSilhouette*> silhouettes;
        for (Walked& w : walked) {
            if (random() % 64 == 0) w.silhouette.invalidate();  // As after a frame that never ran.
            if (random() % 4 == 0) w.silhouette.announce(w.walk.next());
            w.silhouette.follow(w.walk.next(), 0);
            silhouettes.push_back(&w.silhouette);
            const ChangeStream& stream = w.silhouette.stream();
            whole += stream.bytes_streamed() == stream.bytes_full();
            in_part += stream.bytes_streamed() > 0 && stream.bytes_streamed() < stream.bytes_full();
        }
        REQUIRE(frames.run(silhouettes) == 0);
    }
    CHECK(whole > tests::rounds(1000u));
    CHECK(in_part > tests::rounds(1000u));
}

TEST_CASE("a word that is wrong on the GPU is counted") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 1500));
    SilhouetteService service({.workers = 1});
    MemoryBudget budget(std::uint64_t{64} << 20, "the budget of this test");
    const HomogeneousPoint point = HomogeneousPoint::viewpoint({3, 1, 0.5f});
    TrackedSilhouette silhouette(gpu->context(), service, model.octree, point, 1, budget, budget,
                                 "a knot");
    StreamFrames frames(gpu->context());
    const std::array all{&silhouette};
    silhouette.follow(point, 0);
    CHECK(frames.run(all) == 0);
    const auto spoil = [&](const Buffer& buffer, VkDeviceSize at, std::uint32_t value) {
        run_commands(gpu->context(), [&](Commands commands) {
            commands->CmdFillBuffer(commands, buffer.handle(), 4 * at, 4, value);
        });
    };
    const ChangeStream& stream = silhouette.stream();
    spoil(stream.slots(), 3, 0xfffffff0u);
    spoil(stream.face_words(), 1, 0x12345678u);
    spoil(stream.arguments(), 5, 1u);
    // Nothing changes, so nothing is written over it.
    silhouette.follow(point, 0);
    CHECK(stream.bytes_streamed() == 0);
    CHECK(frames.run(all) == 3);
    silhouette.invalidate();
    silhouette.follow(point, 0);
    CHECK(frames.run(all) == 0);
}

TEST_CASE("the renderer's check finds nothing while camera, lights and objects all move") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model knot(make_built_in_shape("knot", 1200));
    const tests::Model box(make_built_in_shape("box", 108));
    Renderer checked(gpu->context(), {.samples = 1, .scale = 1, .check_silhouettes = true});
    constexpr std::uint32_t k_seed = 5;
    CAPTURE(k_seed);
    std::mt19937 random(k_seed);
    const auto unit = [&] { return double(random() >> 8) * 0x1p-23 - 1.0; };
    Scene scene{.camera = {.eye = {0, 1, 5}}};
    scene.instances = {{.octree = &knot.octree}, {.octree = &box.octree}, {.octree = &knot.octree}};
    scene.lights = {{.vector = {1, 1, 1}}, {.vector = {2, 3, 1}, .directional = false}};
    for (int frame = 0; frame < 120; ++frame) {
        CAPTURE(frame);
        const double step = frame % 10 == 9 ? 2.0 : 0.02;
        scene.camera.eye += step * glm::dvec3(unit(), unit(), unit());
        for (SceneInstance& instance : scene.instances) {
            instance.translation += step * glm::dvec3(unit(), unit(), unit());
            instance.rotation =
                glm::dmat3(glm::rotate(glm::dmat4(1.0), step, glm::dvec3(unit(), 1.1, unit()))) *
                instance.rotation;
        }
        for (Light& light : scene.lights) light.vector += step * glm::dvec3(unit(), unit(), unit());
        checked.submit(scene, 24, 16);
        Scene next = scene;
        next.camera.eye.x += 0.01;
        checked.announce(next);
        checked.finish();
        REQUIRE(checked.report().differences == 0);
        REQUIRE(checked.report().silhouette > 0);
    }
    CHECK(checked.differences() == 0);
}

}  // namespace
}  // namespace rimline
