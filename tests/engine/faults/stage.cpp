#include "tests/engine/faults/stage.h"

#include <algorithm>

#include "engine/view_defaults.h"
#include "engine/vulkan/memory_blocks.h"
#include "engine/vulkan/vulkan_handle.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"

namespace rimline::tests {

FaultModels::FaultModels()
    : knot(make_built_in_shape("knot", 200)),
      box(make_built_in_shape("box", 12)),
      sheet(make_built_in_shape("terrain", 50)) {}

Scene Stage::scene() const {
    const glm::vec3 paper(0.9f);
    Scene scene{.camera = fit_camera({}, models_.knot.mesh, default_view_direction({0, 1, 0}), 1.0),
                .palette = default_palette(Style::ink, paper)};
    scene.instances.push_back({.octree = &models_.knot.octree, .material = {.color = paper}});
    scene.instances.push_back(
        {.octree = &models_.sheet.octree,
         .material = {.color = paper, .line_color = glm::vec3(0.5f, 0.1f, 0.0f)}});
    scene.lights.push_back(default_sun(scene.camera));
    scene.lights.push_back({.vector = 2.0 * scene.camera.eye, .directional = false});
    return scene;
}

void Stage::note(const Error& error) {
    const std::string message = error.what();
    CAPTURE(message);
    // One line that says what was asked for.
    CHECK(message.find("vk") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
    errors_.push_back(error.code());
}

namespace {

// More calls than any scenario makes: a count that never ends is a step that is never done.
constexpr std::uint64_t k_max_faults = 20'000;

// Sanitizers make a play several times as long; what is right without them is tested without them.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t k_sparseness = 7;
#else
constexpr std::uint64_t k_sparseness = 1;
#endif

// Strides without a common factor with the periods of what they sample: every buffer makes the same four
// calls, every upload the same two submits.
std::uint64_t stride(Extent extent, std::uint64_t of_sample) {
    return extent == Extent::all ? 1 : of_sample * k_sparseness;
}

ErrorCode code_of(VkResult result) { return error_of(result, "").code(); }

// What an undisturbed play shows, twice: a scenario that does not repeat itself proves nothing.
std::vector<std::byte> undisturbed(Scenario scenario, const Gpu& gpu, const FaultModels& models) {
    Stage first(gpu.instance(), gpu.context(), models);
    scenario(first);
    Stage second(gpu.instance(), gpu.context(), models);
    scenario(second);
    REQUIRE_FALSE(first.shown().empty());
    REQUIRE(first.shown() == second.shown());
    return first.shown();
}

// Checks at its end that what is alive is what was alive.
class LiveObjects {
public:
    explicit LiveObjects(const DeviceContext& context)
        : context_(context), before_((trim(context), live_objects())) {}
    ~LiveObjects() {
        trim(context_);
        for (const std::string& object : live_objects())
            if (!std::ranges::binary_search(before_, object)) FAIL_CHECK("left: ", object);
    }
    LiveObjects(const LiveObjects&) = delete;
    LiveObjects& operator=(const LiveObjects&) = delete;

private:
    // Blocks of memory that are kept for what comes next are no leak.
    static void trim(const DeviceContext& context) {
        dynamic_cast<MemoryBlocks&>(*context.allocator).trim();
    }

    const DeviceContext& context_;
    std::vector<std::string> before_;  // Sorted, as live_objects() is.
};

}  // namespace

void play_with_failures(Scenario scenario, Extent extent) {
    RIMLINE_OPEN_GPU(gpu, &failing_loader);
    const FaultModels models;
    const std::vector<std::byte> expected = undisturbed(scenario, *gpu, models);
    std::uint64_t calls = 0;
    for (;; calls += stride(extent, 17)) {
        REQUIRE(calls < k_max_faults);
        const LiveObjects live(gpu->context());
        Stage stage(gpu->instance(), gpu->context(), models);
        // The results take turns from call to call, so that neighbors of one kind get all.
        arm({.kind = FaultKind::failure, .call = calls, .result = calls});
        scenario(stage);
        const FaultReport report = disarm();
        CAPTURE(calls);
        CAPTURE(report.call);
        CAPTURE(name_of(report.result));
        CHECK(stage.shown() == expected);
        CHECK(stage.bad_allocs() == 0);
        CHECK(stage.errors().size() <= 1);
        if (!stage.errors().empty()) CHECK(stage.errors().front() == code_of(report.result));
        if (!report.injected) break;
    }
    CHECK(calls > 0);
    MESSAGE("faults in up to ", calls, " calls");
}

void play_with_lost_devices(Scenario scenario, Extent extent) {
    RIMLINE_OPEN_GPU(gpu, &failing_loader);
    const FaultModels models;
    const std::vector<std::byte> expected = undisturbed(scenario, *gpu, models);
    std::uint64_t calls = 0;
    for (bool injected = true; injected; calls += stride(extent, 11)) {
        REQUIRE(calls < k_max_faults);
        const LiveObjects live(gpu->context());
        CAPTURE(calls);
        ErrorCode code{};
        FaultReport report;
        bool ended = false;
        {
            const TestedDevice device(gpu->instance(), requested_device());
            Stage stage(gpu->instance(), device.context(), models);
            stage.end_with_device();
            arm({.kind = FaultKind::lost_device, .call = calls, .result = 0});
            try {
                scenario(stage);
                ended = true;
            } catch (const Error& error) {
                code = error.code();
            }
            report = disarm();
            CAPTURE(report.call);
            if (!ended) {
                CHECK(code == ErrorCode::device_lost);
            } else {
                // Destructors wait too, and swallow it, as the empty submissions that they wait for; nobody
                // submits work in vain.
                CHECK(stage.shown() == expected);
                CHECK(std::string(report.call) != "vkQueueSubmit2");
            }
        }
        injected = report.injected;
        if (!injected) break;
        // Another device, and everything anew.
        const TestedDevice device(gpu->instance(), requested_device());
        Stage again(gpu->instance(), device.context(), models);
        scenario(again);
        CHECK(again.shown() == expected);
    }
    CHECK(calls > 0);
    MESSAGE("the device lost in up to ", calls, " submits and waits");
}

void play_with_failing_new(Scenario scenario, Extent extent) {
    RIMLINE_OPEN_GPU(gpu, &failing_loader);
    const FaultModels models;
    const std::vector<std::byte> expected = undisturbed(scenario, *gpu, models);
    std::uint64_t allocations = 0;
    for (;; allocations += stride(extent, 53)) {
        REQUIRE(allocations < k_max_faults);
        const LiveObjects live(gpu->context());
        CAPTURE(allocations);
        Stage stage(gpu->instance(), gpu->context(), models);
        arm_new(allocations);
        scenario(stage);
        const bool failed = disarm_new();
        CHECK(stage.shown() == expected);
        CHECK(stage.errors().empty());
        CHECK(stage.bad_allocs() <= 1);
        if (!failed) break;
    }
    CHECK(allocations > 0);
    MESSAGE("faults in up to ", allocations, " allocations");
}

}  // namespace rimline::tests
