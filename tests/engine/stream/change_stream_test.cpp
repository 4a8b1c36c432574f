#include "engine/stream/change_stream.h"

#include <random>

#include "engine/vulkan/commands.h"
#include "shaders/layout.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"

namespace rimline {
namespace {

// What the GPU holds of a stream.
struct GpuState {
    std::vector<EdgeId> slots;
    std::vector<std::uint32_t> face_words;
    gpu::DrawArguments arguments{};
};

GpuState read_state(const DeviceContext& context, const ChangeStream& stream,
                    std::uint32_t silhouette_size, std::size_t word_count) {
    GpuState state;
    state.slots.resize(silhouette_size);
    state.face_words.resize(word_count);
    read_buffer(context, stream.slots(), std::as_writable_bytes(std::span(state.slots)));
    read_buffer(context, stream.face_words(), std::as_writable_bytes(std::span(state.face_words)));
    read_buffer(context, stream.arguments(),
                std::as_writable_bytes(std::span(&state.arguments, 1)));
    return state;
}

void check_equal(const DeviceContext& context, const ChangeStream& stream,
                 const SilhouetteTracker& tracker) {
    const auto size = static_cast<std::uint32_t>(tracker.silhouette().size());
    const GpuState state = read_state(context, stream, size, tracker.face_words().size());
    REQUIRE(state.arguments.vertex_count == size);
    REQUIRE(state.arguments.instance_count == 1);
    REQUIRE(std::ranges::equal(state.slots, tracker.silhouette()));
    REQUIRE(std::ranges::equal(state.face_words, tracker.face_words()));
}

void run(const DeviceContext& context, const ChangeStream& stream, const ScatterPass& pass) {
    run_commands(context, [&](Commands commands) {
        ChangeStream::record_before(commands);
        stream.record(commands, pass);
        ChangeStream::record_after(commands);
    });
}

HomogeneousPoint step(std::mt19937& random, glm::vec3& at) {
    const auto unit = [&] { return float(random() >> 8) * 0x1p-23f - 1.0f; };
    switch (random() % 16) {
        case 0: at = 3.0f * glm::vec3(unit(), unit(), unit()); break;  // Teleport.
        case 1: return HomogeneousPoint::direction({unit(), unit(), unit()});
        default: at += 0.03f * glm::vec3(unit(), unit(), unit());
    }
    return HomogeneousPoint::viewpoint(at);
}

TEST_CASE("slots, face bits and draw arguments equal the tracker's after every streamed change") {
    RIMLINE_OPEN_GPU(gpu);
    constexpr std::uint32_t k_seed = 99;
    CAPTURE(k_seed);
    const ScatterPass pass(gpu->context());
    for (const char* name : {"knot", "terrain", "box"}) {
        CAPTURE(name);
        std::mt19937 random(k_seed);
        const Mesh mesh(make_built_in_shape(name, 6000));
        const HoughOctree octree(mesh);
        glm::vec3 at(2.0f, 0.5f, 1.0f);
        SilhouetteTracker tracker(octree, HomogeneousPoint::viewpoint(at));
        ChangeStream stream(gpu->context(), mesh, 3);
        int resent = 0;
        int applied = 0;
        for (std::uint32_t frame = 0; frame < 300; ++frame) {
            CAPTURE(frame);
            stream.begin_frame(frame % 3);
            if (stream.apply(tracker.move_to(step(random, at)))) {
                ++applied;
            } else {
                stream.resend(tracker.sequence(), tracker.silhouette(), tracker.face_words());
                ++resent;
            }
            CHECK(stream.bytes_streamed() <= stream.bytes_full());
            run(gpu->context(), stream, pass);
            check_equal(gpu->context(), stream, tracker);
        }
        // Both ways were taken.
        CHECK(resent > 0);
        if (std::string(name) != "box") CHECK(applied > 100);
    }
}

VkMemoryBarrier2 stream_barrier{};  // The last one.

VKAPI_ATTR void VKAPI_CALL note_stream_barrier(VkCommandBuffer, const VkDependencyInfo* info) {
    REQUIRE(info->memoryBarrierCount == 1);
    stream_barrier = info->pMemoryBarriers[0];
}

TEST_CASE(
    "changes wait for all earlier reads but those of fragments, and are visible to these too") {
    DeviceFunctions functions{};
    functions.CmdPipelineBarrier2 = &note_stream_barrier;
    const Commands commands(functions, VK_NULL_HANDLE);
    constexpr VkPipelineStageFlags2 k_reading = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT |
                                                VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                                                VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT;
    constexpr VkPipelineStageFlags2 k_fragments = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    constexpr VkPipelineStageFlags2 k_writing =
        VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT;
    ChangeStream::record_before(commands);
    // A caller's copies are reads of the stream.
    CHECK(stream_barrier.srcStageMask == (k_reading | VK_PIPELINE_STAGE_2_COPY_BIT));
    CHECK(stream_barrier.dstStageMask == k_writing);
    ChangeStream::record_after(commands);
    CHECK(stream_barrier.srcStageMask == k_writing);
    CHECK(stream_barrier.dstStageMask == (k_reading | k_fragments));
}

TEST_CASE("a change set without changes queues nothing") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("sphere", 2000));
    const HoughOctree octree(mesh);
    const HomogeneousPoint point = HomogeneousPoint::viewpoint({3.0f, 0.0f, 0.0f});
    SilhouetteTracker tracker(octree, point);
    ChangeStream stream(gpu->context(), mesh, 1);
    CHECK_FALSE(stream.has_changes());
    stream.begin_frame(0);
    stream.resend(tracker.sequence(), tracker.silhouette(), tracker.face_words());
    CHECK(stream.has_changes());
    stream.begin_frame(0);
    CHECK_FALSE(stream.has_changes());
    REQUIRE(stream.apply(tracker.move_to(point)));
    CHECK_FALSE(stream.has_changes());
    REQUIRE(stream.apply(tracker.move_to(HomogeneousPoint::viewpoint({3.0f, 0.05f, 0.0f}))));
    CHECK(stream.has_changes());
}

TEST_CASE("several change sets of one frame end in the last one's state") {
    RIMLINE_OPEN_GPU(gpu);
    const ScatterPass pass(gpu->context());
    const Mesh mesh(make_built_in_shape("torus", 20'000));
    const HoughOctree octree(mesh);
    SilhouetteTracker tracker(octree, HomogeneousPoint::viewpoint({3.0f, 1.0f, 0.0f}));
    ChangeStream stream(gpu->context(), mesh, 2);
    stream.begin_frame(0);
    stream.resend(tracker.sequence(), tracker.silhouette(), tracker.face_words());
    REQUIRE(stream.apply(tracker.move_to(HomogeneousPoint::viewpoint({3.0f, 1.003f, 0.0f}))) ==
            false);  // A whole state is the most that a frame holds.
    stream.resend(tracker.sequence(), tracker.silhouette(), tracker.face_words());
    run(gpu->context(), stream, pass);
    check_equal(gpu->context(), stream, tracker);

    stream.begin_frame(1);
    for (int i = 0; i < 4; ++i)
        REQUIRE(stream.apply(tracker.move_to(
            HomogeneousPoint::viewpoint({3.0f, 1.003f + 0.001f * float(i % 3), 0.0f}))));
    run(gpu->context(), stream, pass);
    check_equal(gpu->context(), stream, tracker);
}

TEST_CASE("a stream whose frame never ran asks for the whole state") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("sphere", 2000));
    const HoughOctree octree(mesh);
    SilhouetteTracker tracker(octree, HomogeneousPoint::viewpoint({3.0f, 0.0f, 0.0f}));
    ChangeStream stream(gpu->context(), mesh, 1);
    stream.begin_frame(0);
    stream.resend(tracker.sequence(), tracker.silhouette(), tracker.face_words());
    stream.begin_frame(0);
    REQUIRE(stream.apply(tracker.move_to(HomogeneousPoint::viewpoint({3.0f, 0.003f, 0.0f}))));
    stream.invalidate();
    stream.begin_frame(0);
    CHECK_FALSE(stream.apply(tracker.move_to(HomogeneousPoint::viewpoint({3.0f, 0.006f, 0.0f}))));
}

TEST_CASE("a gap in the sequence asks for the whole state") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("sphere", 2000));
    const HoughOctree octree(mesh);
    SilhouetteTracker tracker(octree, HomogeneousPoint::viewpoint({3.0f, 0.0f, 0.0f}));
    ChangeStream stream(gpu->context(), mesh, 1);
    stream.begin_frame(0);
    CHECK_FALSE(stream.apply(tracker.move_to(HomogeneousPoint::viewpoint({3.0f, 0.01f, 0.0f}))));
    stream.resend(tracker.sequence(), tracker.silhouette(), tracker.face_words());
    stream.begin_frame(0);
    tracker.move_to(HomogeneousPoint::viewpoint({3.0f, 0.02f, 0.0f}));  // Missed.
    CHECK_FALSE(stream.apply(tracker.move_to(HomogeneousPoint::viewpoint({3.0f, 0.03f, 0.0f}))));
    CHECK(stream.bytes_streamed() == 0);
}

TEST_CASE("a small step streams a fraction of the whole state") {
    RIMLINE_OPEN_GPU(gpu);
    const Mesh mesh(make_built_in_shape("sphere", 100'000));
    const HoughOctree octree(mesh);
    SilhouetteTracker tracker(octree, HomogeneousPoint::viewpoint({3.0f, 0.0f, 0.0f}));
    ChangeStream stream(gpu->context(), mesh, 1);
    stream.begin_frame(0);
    stream.resend(tracker.sequence(), tracker.silhouette(), tracker.face_words());
    CHECK(stream.bytes_streamed() == stream.bytes_full());
    stream.begin_frame(0);
    REQUIRE(stream.apply(tracker.move_to(HomogeneousPoint::viewpoint({3.0f, 0.003f, 0.0f}))));
    CHECK(stream.bytes_streamed() > 0);
    CHECK(stream.bytes_streamed() * 4 < stream.bytes_full());
}

}  // namespace
}  // namespace rimline
