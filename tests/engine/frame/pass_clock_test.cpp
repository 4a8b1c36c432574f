#include "engine/frame/pass_clock.h"

#include <memory>
#include <numeric>

#include "engine/picture_readback.h"
#include "engine/renderer.h"
#include "engine/vulkan/commands.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

// A device whose clock is made up: the timestamp of a query is a tick more than three times that of the query
// before, in `valid_bits` bits.
struct MadeUp {
    std::shared_ptr<const DeviceFunctions> vk;  // The device's own.
    std::uint32_t valid_bits = 64;
    bool is_there = true;  // Whether results are.
    std::uint32_t written = 0;
    bool waited = false;
};
MadeUp made_up;

std::uint64_t made_up_ticks(std::uint32_t query) {
    std::uint64_t ticks = ~std::uint64_t{0} - 20;  // Wraps around early in the frame.
    for (std::uint32_t i = 0, step = 1; i < query; ++i, step *= 3) ticks += step;
    return made_up.valid_bits == 64 ? ticks
                                    : ticks & ((std::uint64_t{1} << made_up.valid_bits) - 1);
}

VKAPI_ATTR void VKAPI_CALL families(VkPhysicalDevice physical, std::uint32_t* count,
                                    VkQueueFamilyProperties* properties) {
    made_up.vk->GetPhysicalDeviceQueueFamilyProperties(physical, count, properties);
    if (properties != nullptr)
        for (std::uint32_t i = 0; i < *count; ++i)
            properties[i].timestampValidBits = made_up.valid_bits;
}
VKAPI_ATTR void VKAPI_CALL write_timestamp(VkCommandBuffer commands, VkPipelineStageFlags2 stage,
                                           VkQueryPool pool, std::uint32_t query) {
    ++made_up.written;
    made_up.vk->CmdWriteTimestamp2(commands, stage, pool, query);
}
VKAPI_ATTR VkResult VKAPI_CALL results(VkDevice, VkQueryPool, std::uint32_t first,
                                       std::uint32_t count, std::size_t, void* data, VkDeviceSize,
                                       VkQueryResultFlags flags) {
    made_up.waited |= (flags & VK_QUERY_RESULT_WAIT_BIT) != 0;
    if (!made_up.is_there) return VK_NOT_READY;
    for (std::uint32_t i = 0; i < count; ++i)
        static_cast<std::uint64_t*>(data)[i] = made_up_ticks(first + i);
    return VK_SUCCESS;
}

DeviceContext with_made_up_clock(const DeviceContext& own, std::uint32_t valid_bits) {
    made_up = {.vk = own.vk, .valid_bits = valid_bits};
    auto vk = std::make_shared<DeviceFunctions>(*own.vk);
    vk->GetPhysicalDeviceQueueFamilyProperties = &families;
    vk->CmdWriteTimestamp2 = &write_timestamp;
    vk->GetQueryPoolResults = &results;
    DeviceContext context = own;
    context.vk = vk;
    context.limits.timestampPeriod = 1e6f;  // A millisecond a tick.
    return context;
}

constexpr VkExtent2D k_pass_clock_size{32, 24};

Scene scene_of(const tests::Model& model, std::size_t lights) {
    Scene scene{.camera = {.eye = {0, 1, 4}}};
    scene.instances.push_back({.octree = &model.octree});
    for (std::size_t i = 0; i < lights; ++i)
        scene.lights.push_back({.vector = {1.0 + double(i), 2, 3}});
    return scene;
}

std::vector<std::string> names_of(const FrameReport& report) {
    std::vector<std::string> names;
    for (const PassTime& pass : report.passes) names.push_back(pass.name);
    return names;
}

std::vector<double> times_of(const FrameReport& report) {
    std::vector<double> times;
    for (const PassTime& pass : report.passes) times.push_back(pass.time_ms);
    return times;
}

const std::vector<std::string> k_one_light{
    "silhouettes",         "surfaces", "shadow volumes, light 0",
    "surfaces, in shadow", "lines",    "picture"};
// The steps of the clock. The one before the last, 243, lies between two command buffers.
const std::vector<double> k_one_light_ms{1, 3, 9, 27, 81, 729};

TEST_CASE("a frame's passes have the times between the timestamps around them") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 1000));
    for (const std::uint32_t bits : {64u, 36u}) {
        Renderer renderer(with_made_up_clock(gpu->context(), bits),
                          {.samples = 1, .scale = 1, .pass_times = true});
        renderer.render(scene_of(model, 1), k_pass_clock_size.width, k_pass_clock_size.height);
        CHECK(names_of(renderer.report()) == k_one_light);
        CHECK(times_of(renderer.report()) == k_one_light_ms);
        CHECK_FALSE(made_up.waited);
        // More lights than before: another pool.
        renderer.render(scene_of(model, 3), k_pass_clock_size.width, k_pass_clock_size.height);
        CHECK(renderer.report().passes.size() == 4 + 2 * 3);
        CHECK(renderer.report().passes[6].name == "shadow volumes, light 2");
        Scene scene = scene_of(model, 1);
        scene.shadows = false;
        renderer.render(scene, k_pass_clock_size.width, k_pass_clock_size.height);
        CHECK(names_of(renderer.report()) ==
              std::vector<std::string>{"silhouettes", "surfaces", "lines", "picture"});
    }
}

TEST_CASE("without the option, or without timestamps in the queue, no time is taken") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 1000));
    const Scene scene = scene_of(model, 1);
    for (const auto& [bits, pass_times] : {std::pair{64u, false}, {0u, true}}) {
        Renderer renderer(with_made_up_clock(gpu->context(), bits),
                          {.samples = 1, .scale = 1, .pass_times = pass_times});
        renderer.render(scene, k_pass_clock_size.width, k_pass_clock_size.height);
        CHECK(renderer.report().passes.empty());
        CHECK(made_up.written == 0);
    }
}

TEST_CASE("times that are not there yet are left out, and nobody waits for them") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 1000));
    Renderer renderer(with_made_up_clock(gpu->context(), 64),
                      {.samples = 1, .scale = 1, .pass_times = true});
    made_up.is_there = false;
    renderer.render(scene_of(model, 1), k_pass_clock_size.width, k_pass_clock_size.height);
    CHECK(renderer.report().passes.empty());
    CHECK(made_up.written == 8);
    CHECK_FALSE(made_up.waited);
}

TEST_CASE("a caller that submits learns the passes when the ring slot is used again") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 1000));
    const Scene scene = scene_of(model, 1);
    const DeviceContext context = with_made_up_clock(gpu->context(), 64);
    Renderer renderer(context,
                      {.samples = 1, .scale = 1, .frames_in_flight = 2, .pass_times = true});
    const Image image = make_picture_image(context, k_pass_clock_size);
    const PictureTarget target = picture_target(image);
    const OwnedCommandPool pool = make_command_pool(context, "test", context.queue_family);
    const std::array buffers{make_commands(context, pool), make_commands(context, pool)};
    for (const std::size_t buffer_count : {1u, 2u})
        for (int frame = 0; frame < 4; ++frame) {
            CAPTURE(buffer_count);
            CAPTURE(frame);
            const UploadPoint uploaded = renderer.prepare(scene, target);
            const Commands commands = begin_commands(context, buffers[0]);
            FrameReport report;
            if (buffer_count == 1) {
                report = renderer.record(commands, scene, target);
            } else {
                const Commands picture = begin_commands(context, buffers[1]);
                report = renderer.record(commands, picture, scene, target);
                vk_check(picture->EndCommandBuffer(picture), "vkEndCommandBuffer");
            }
            vk_check(commands->EndCommandBuffer(commands), "vkEndCommandBuffer");
            if (buffer_count == 1 && frame < 2) {
                CHECK(report.passes.empty());
            } else {
                CHECK(names_of(report) == k_one_light);
                CHECK(times_of(report) == k_one_light_ms);
            }
            Submission submission{.queue = context.queue, .commands = commands};
            if (uploaded.value > 0) submission.waits.push_back(uploaded);
            submit_commands(context, submission);
            if (buffer_count == 2)
                submit_commands(context, {.queue = context.queue, .commands = buffers[1]});
            vk_check(context.vk->QueueWaitIdle(context.queue), "vkQueueWaitIdle");
        }
    // The last two frames run no more for the renderer: the times of forgotten frames are not reported.
    const Commands dropped = begin_commands(context, buffers[0]);
    CHECK_FALSE(renderer.record(dropped, scene, target).passes.empty());
    vk_check(dropped->EndCommandBuffer(dropped), "vkEndCommandBuffer");
    renderer.forget_recorded();
    for (const bool is_known : {true, false}) {
        (void)renderer.prepare(scene, target);
        const Commands commands = begin_commands(context, buffers[0]);
        CHECK(renderer.record(commands, scene, target).passes.empty() == !is_known);
        vk_check(commands->EndCommandBuffer(commands), "vkEndCommandBuffer");
        renderer.forget_recorded();
    }
}

TEST_CASE("the device's own times are no longer than the frame, and cost no pixel") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 1000));
    const Scene scene = scene_of(model, 2);
    Renderer timed(gpu->context(), {.pass_times = true});
    Renderer plain(gpu->context());
    for (int frame = 0; frame < 3; ++frame) {
        const Picture picture = timed.render(scene, 64, 64);
        CHECK(picture.rgba == plain.render(scene, 64, 64).rgba);
        const FrameReport& report = timed.report();
        if (timestamp_unit(gpu->context()).valid_bits == 0) {
            CHECK(report.passes.empty());
            continue;
        }
        CHECK(report.passes.size() >= 4 + 2 * 2);
        double sum_ms = 0.0;
        for (const PassTime& pass : report.passes) {
            CHECK(pass.time_ms >= 0.0);
            sum_ms += pass.time_ms;
        }
        CHECK(sum_ms > 0.0);
        CHECK(sum_ms <= report.frame_ms);
    }
}

}  // namespace
}  // namespace rimline
