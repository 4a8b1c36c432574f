#include "engine/vulkan/memory_budget.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/memory_blocks.h"

#include <algorithm>
#include <numeric>
#include <random>

#include "engine/renderer.h"
#include "engine/stream/change_stream.h"
#include "engine/stream/gpu_silhouette.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

template <typename Call>
std::string too_large_message(Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::too_large);
        return error.what();
    }
    return "nothing was thrown";
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_CASE("a budget gives what it has, takes back what goes, and refuses the rest by name") {
    MemoryBudget budget(1000, "the budget of this test");
    MemoryBudget::Share a(&budget);
    a.resize(600, "a");
    {
        MemoryBudget::Share b(&budget);
        const std::string message = too_large_message([&] { b.resize(401, "b"); });
        CHECK(message ==
              "b needs 401 bytes more, and of the budget of this test of 1000 bytes "
              "400 bytes are left");
        CHECK(budget.used_bytes() == 600);
        b.resize(400, "b");
        CHECK(budget.used_bytes() == 1000);
        a.resize(500, "a");
        a = std::move(b);
        CHECK(budget.used_bytes() == 900);
    }
    CHECK(budget.used_bytes() == 400);
    a = MemoryBudget::Share();
    CHECK(budget.used_bytes() == 0);
    MemoryBudget::Share endless;
    endless.resize(~std::uint64_t{0}, "all");
}

TEST_CASE("sizes are written to be read") {
    CHECK(size_text(0) == "0 bytes");
    CHECK(size_text(1023) == "1023 bytes");
    CHECK(size_text(1536) == "1.5 KiB");
    CHECK(size_text(std::uint64_t{12} << 20) == "12 MiB");
    CHECK(size_text(std::uint64_t{3} << 30) == "3.0 GiB");
}

TEST_CASE("a stream costs what its size says, and no more than that after any silhouette") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("sphere", 30'000));
    const StreamSize size = StreamSize::of(model.mesh);
    MemoryBudget budget(size.first_bytes(2) + 3 * size.last_ring_bytes(), "the budget");
    ChangeStream stream(gpu->context(), size, 2, &budget, "a sphere");
    CHECK(stream.size_bytes() == size.first_bytes(2));
    CHECK(budget.used_bytes() == size.first_bytes(2));
    // No silhouette of a sphere has all its edges; a stream must not rely on that.
    std::vector<EdgeId> all(size.slots);
    std::iota(reinterpret_cast<std::uint32_t*>(all.data()),
              reinterpret_cast<std::uint32_t*>(all.data() + all.size()), 0u);
    const std::vector<std::uint32_t> words(size.words, 7);
    const ScatterPass pass(gpu->context());
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        std::ranges::rotate(all, all.begin() + 1);
        stream.begin_frame(frame % 2);
        stream.resend(frame, all, words);
        run_commands(gpu->context(), [&](Commands commands) {
            ChangeStream::record_before(commands);
            stream.record(commands, pass);
            ChangeStream::record_after(commands);
        });
        std::vector<EdgeId> read(all.size());
        read_buffer(gpu->context(), stream.slots(), std::as_writable_bytes(std::span(read)));
        CHECK(read == all);
    }
    CHECK(stream.size_bytes() == size.state_bytes() + 2 * size.last_ring_bytes());
    CHECK(budget.used_bytes() == stream.size_bytes());
}

TEST_CASE("a ring slot that grows in the middle of a frame keeps what the frame has") {
    RIMLINE_OPEN_GPU(gpu);
    const ScatterPass pass(gpu->context());
    constexpr std::uint32_t k_slots = 100'000;
    const StreamSize size{.slots = k_slots, .words = 1};
    const std::vector<std::uint32_t> words{0};
    std::vector<SlotWrite> first, second;
    for (std::uint32_t i = 0; i < 12'000; ++i) first.push_back({i, EdgeId{i + 1}});
    for (std::uint32_t i = 6'000; i < 36'000; ++i) second.push_back({i, EdgeId{i + 5}});
    ChangeStream fresh(gpu->context(), size, 1);
    const std::uint64_t before = fresh.size_bytes();
    fresh.begin_frame(0);
    fresh.resend(0, {}, words);
    run_commands(gpu->context(), [&](Commands commands) {
        ChangeStream::record_before(commands);
        fresh.record(commands, pass);
    });
    fresh.begin_frame(0);
    REQUIRE(fresh.apply({.sequence = 1, .silhouette_size = k_slots, .slots = first}));
    REQUIRE(fresh.apply({.sequence = 2, .silhouette_size = k_slots, .slots = second}));
    CHECK(fresh.size_bytes() > before);
    run_commands(gpu->context(), [&](Commands commands) {
        ChangeStream::record_before(commands);
        fresh.record(commands, pass);
    });
    std::vector<EdgeId> read(36'000);
    read_buffer(gpu->context(), fresh.slots(), std::as_writable_bytes(std::span(read)));
    for (std::uint32_t i = 0; i < read.size(); ++i)
        REQUIRE(index(read[i]) == (i < 6'000 ? i + 1 : i + 5));
}

TEST_CASE("streams beyond 128 MiB are written and read to their last slot") {
    RIMLINE_OPEN_GPU(gpu);
    const ScatterPass pass(gpu->context());
    // Slots and face bits are reached by address; a storage buffer's range ends at 128 MiB here.
    constexpr std::uint32_t k_slots = 36'000'000;
    static_assert(std::uint64_t{4} * k_slots > (128u << 20));
    const StreamSize size{.slots = k_slots, .words = 100};
    ChangeStream stream(gpu->context(), size, 1);
    std::vector<std::uint32_t> numbers(k_slots);
    std::iota(numbers.begin(), numbers.end(), 0u);
    const std::vector<std::uint32_t> words(size.words);
    const auto run = [&] {
        run_commands(gpu->context(), [&](Commands commands) {
            ChangeStream::record_before(commands);
            stream.record(commands, pass);
            ChangeStream::record_after(commands);
        });
    };
    stream.begin_frame(0);
    stream.resend(0, {reinterpret_cast<const EdgeId*>(numbers.data()), numbers.size()}, words);
    run();
    constexpr std::uint32_t k_seed = 8;
    CAPTURE(k_seed);
    std::mt19937 random(k_seed);
    std::vector<SlotWrite> writes{{k_slots - 1, EdgeId{5}}};
    for (int i = 0; i < 10'000; ++i) {
        const auto slot = static_cast<std::uint32_t>(33'000'000 + random() % 2'900'000);
        if (numbers[slot] != slot) continue;
        numbers[slot] = static_cast<std::uint32_t>(random());
        writes.push_back({slot, EdgeId{numbers[slot]}});
    }
    numbers.back() = 5;
    stream.begin_frame(0);
    REQUIRE(stream.apply({.sequence = 1, .silhouette_size = k_slots, .slots = writes}));
    run();
    std::vector<std::uint32_t> read(k_slots);
    read_buffer(gpu->context(), stream.slots(), std::as_writable_bytes(std::span(read)));
    CHECK(read == numbers);
}

TEST_CASE("a limit of the device is named with the model that exceeds it") {
    RIMLINE_OPEN_GPU(gpu);
    const StreamSize size{.slots = 1'000'000, .words = 1000};
    DeviceContext context = gpu->context();
    context.max_buffer_bytes = 1 << 20;
    std::string message =
        too_large_message([&] { ChangeStream(context, size, 2, nullptr, "bunny.obj"); });
    CHECK(contains(message, "the silhouette slots of bunny.obj"));
    CHECK(contains(message, "maxBufferSize of 1.0 MiB"));
    context = gpu->context();
    context.allocator = std::make_shared<MemoryBlocks>(context.vk, context.memory, 2 << 20);
    message = too_large_message([&] { ChangeStream(context, size, 2, nullptr, "bunny.obj"); });
    CHECK(contains(message, "the silhouette slots of bunny.obj"));
    CHECK(contains(message, "maxMemoryAllocationSize of 2.0 MiB"));
    // No device has so much, and none is asked for it.
    const StreamSize endless{.slots = std::uint64_t{1} << 60, .words = 1000};
    CHECK(contains(
        too_large_message([&] { ChangeStream(gpu->context(), endless, 2, nullptr, "bunny.obj"); }),
        "bunny.obj"));
}

TEST_CASE("what deforms counts in the budget with its silhouettes, and is refused by name") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("knot", 3000));
    Uploads uploads(gpu->context());
    UploadBatch batch(gpu->context(), uploads);
    const SilhouetteTopology topology(batch, mesh);
    const std::uint64_t one = GpuSilhouette::size_bytes(topology);
    for (const auto changes : {GpuSilhouette::Changes::counted, GpuSilhouette::Changes::listed}) {
        const GpuSilhouette silhouette(batch, topology, {}, changes);
        CHECK(silhouette.size_bytes() == GpuSilhouette::size_bytes(topology, changes));
    }
    Scene scene{.camera = {.eye = {0, 1, 4}}};
    scene.instances.push_back(
        {.name = "eel.ply", .deforming = &mesh, .deformation = default_wave(mesh, {0, 1, 0}, 0.0)});
    scene.lights = {{.vector = {1, 1, 1}}, {.vector = {0, 1, 1}}};
    const RendererOptions plain{.samples = 1, .scale = 1};
    Renderer free(gpu->context(), plain);
    const Picture expected = free.render(scene, 64, 64);
    const std::uint64_t all = free.stream_bytes();
    CHECK(all > 3 * one + topology.size_bytes());
    RendererOptions bounded_options = plain;
    bounded_options.stream_memory_bytes = all + one / 2;
    Renderer bounded(gpu->context(), bounded_options);
    CHECK(bounded.render(scene, 64, 64).rgba == expected.rgba);
    CHECK(bounded.stream_bytes() == all);
    Scene larger = scene;
    larger.lights.push_back({.vector = {0, 1, -1}});
    const std::string message = too_large_message([&] { bounded.render(larger, 64, 64); });
    CHECK(contains(message, "eel.ply"));
    CHECK(contains(message, "RendererOptions::stream_memory_bytes"));
    for (int i = 0; i < 3; ++i) CHECK(bounded.render(scene, 64, 64).rgba == expected.rgba);
    CHECK(bounded.stream_bytes() == all);
    // Positions of the caller's want a ring.
    const std::vector<glm::vec3> moved(mesh.positions().begin(), mesh.positions().end());
    Scene given = scene;
    given.instances[0].deformation = MovedPositions{.positions = moved};
    CHECK(contains(too_large_message([&] { bounded.render(given, 64, 64); }), "eel.ply"));
    CHECK(bounded.stream_bytes() == all);
    // A light that leaves gives its silhouette's memory back, the mesh all of it.
    scene.lights.resize(1);
    for (int i = 0; i < 3; ++i) bounded.render(scene, 64, 64);
    CHECK(bounded.stream_bytes() == all - one);
    scene.instances.clear();
    for (int i = 0; i < 3; ++i) bounded.render(scene, 64, 64);
    CHECK(bounded.stream_bytes() == 0);
}

TEST_CASE("trackers beyond their budget are refused by name, and give it back when they go") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 3000));
    const std::uint64_t one =
        SilhouetteTracker(model.octree, HomogeneousPoint::viewpoint({0, 1, 4})).size_bytes();
    Renderer renderer(gpu->context(),
                      {.samples = 1, .scale = 1, .tracker_memory_bytes = 2 * one + one / 2});
    Scene scene{.camera = {.eye = {0, 1, 4}}};
    scene.instances.push_back({.octree = &model.octree, .name = "knot.ply"});
    scene.lights = {{.vector = {1, 1, 1}}};
    renderer.render(scene, 32, 32);
    CHECK(renderer.tracker_bytes() == 2 * one);
    scene.lights.push_back({.vector = {0, 1, 1}});
    const std::string message = too_large_message([&] { renderer.render(scene, 32, 32); });
    CHECK(contains(message, "the tracker of knot.ply"));
    CHECK(contains(message, "RendererOptions::tracker_memory_bytes"));
    scene.lights.clear();
    for (int i = 0; i < 3; ++i) renderer.render(scene, 32, 32);
    CHECK(renderer.tracker_bytes() == one);
}

TEST_CASE("a scene that needs less than the one before fits in the same budgets") {
    RIMLINE_OPEN_GPU(gpu);
    std::vector<std::unique_ptr<tests::Model>> models;
    Scene scene{.camera = {.eye = {0, 1, 4}}};
    scene.lights = {{.vector = {1, 1, 1}}};
    for (int i = 0; i < 5; ++i) {
        models.push_back(
            std::make_unique<tests::Model>(make_built_in_shape("knot", 2000 + 100 * i)));
        scene.instances.push_back({.octree = &models.back()->octree});
    }
    Renderer free(gpu->context(), {.samples = 1, .scale = 1});
    free.render(scene, 32, 32);
    Renderer bounded(gpu->context(), {.samples = 1,
                                      .scale = 1,
                                      .stream_memory_bytes = free.stream_bytes(),
                                      .tracker_memory_bytes = free.tracker_bytes()});
    bounded.render(scene, 32, 32);
    // Another takes the place of each.
    const SceneInstance spare = scene.instances.back();
    scene.instances.pop_back();
    while (!scene.instances.empty()) {
        scene.instances.erase(scene.instances.begin());
        bounded.render(scene, 32, 32);
        CHECK(bounded.tracker_bytes() < free.tracker_bytes());
    }
    scene.instances.push_back(spare);
    bounded.render(scene, 32, 32);
}

TEST_CASE("a scene beyond the renderer's budget is refused by name, and a smaller one then drawn") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 3000));
    const std::uint64_t one =
        StreamSize::of(model.mesh).first_bytes(RendererOptions{}.frames_in_flight);
    const RendererOptions plain{.samples = 1, .scale = 1};
    Renderer free(gpu->context(), plain);
    Renderer bounded(gpu->context(),
                     {.samples = 1, .scale = 1, .stream_memory_bytes = 3 * one + one / 2});
    Scene scene{.camera = {.eye = {0, 1, 4}}};
    scene.instances.push_back({.octree = &model.octree, .name = "knot.ply"});
    scene.lights = {{.vector = {1, 1, 1}}, {.vector = {0, 1, 1}}};
    const Picture expected = free.render(scene, 64, 64);
    CHECK(bounded.render(scene, 64, 64).rgba == expected.rgba);
    CHECK(bounded.stream_bytes() == 3 * one);
    Scene larger = scene;
    larger.lights.push_back({.vector = {0, 1, -1}});
    const std::string message = too_large_message([&] { bounded.render(larger, 64, 64); });
    CHECK(contains(message, "knot.ply"));
    CHECK(contains(message, "RendererOptions::stream_memory_bytes"));
    for (int i = 0; i < 3; ++i) CHECK(bounded.render(scene, 64, 64).rgba == expected.rgba);
    // What leaves gives its memory back, for others to have.
    scene.lights.resize(1);
    for (int i = 0; i < 3; ++i) bounded.render(scene, 64, 64);
    CHECK(bounded.stream_bytes() == 2 * one);
}

}  // namespace
}  // namespace rimline
