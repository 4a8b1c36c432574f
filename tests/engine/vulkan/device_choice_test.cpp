#include "engine/vulkan/device_choice.h"

#include <doctest/doctest.h>

#include "silhouette/error.h"

namespace rimline {
namespace {

DeviceFacts complete(std::string name, VkPhysicalDeviceType type) {
    return {.name = std::move(name),
            .driver = "made up",
            .type = type,
            .api_version = VK_API_VERSION_1_3,
            .geometry_shader = true,
            .depth_clamp = true,
            .buffer_device_address = true,
            .scalar_block_layout = true,
            .timeline_semaphore = true,
            .dynamic_rendering = true,
            .synchronization2 = true,
            .maintenance4 = true,
            .graphics_and_compute_queue = true,
            .depth_stencil_format = true};
}

const DeviceFacts k_cpu = complete("llvmpipe", VK_PHYSICAL_DEVICE_TYPE_CPU);
const DeviceFacts k_integrated = complete("Iris Xe", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU);
const DeviceFacts k_discrete = complete("GeForce", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU);

TEST_CASE("a discrete GPU is chosen before an integrated one before a CPU, in any order") {
    CHECK(choose_device(std::vector{k_cpu, k_integrated, k_discrete}).index == 2);
    CHECK(choose_device(std::vector{k_discrete, k_integrated, k_cpu}).index == 0);
    CHECK(choose_device(std::vector{k_cpu, k_integrated}).index == 1);
    CHECK(choose_device(std::vector{k_cpu}).index == 0);
}

TEST_CASE("of equal devices the first is chosen") {
    CHECK(choose_device(std::vector{k_discrete, k_discrete}).index == 0);
}

TEST_CASE("a device that lacks something is passed over and the reason names all of it") {
    DeviceFacts lame = k_discrete;
    lame.synchronization2 = false;
    lame.depth_clamp = false;
    const DeviceChoice choice = choose_device(std::vector{lame, k_cpu});
    CHECK(choice.index == 1);
    CHECK(choice.reasons[0] == "GeForce (discrete GPU): lacks depth clamping, synchronization2");
    CHECK(choice.reasons[1] == "llvmpipe (CPU): chosen");
}

TEST_CASE("a device without geometry shaders will do") {
    DeviceFacts plain = k_cpu;
    plain.geometry_shader = false;
    CHECK(judge_device(plain).usable());
}

TEST_CASE(
    "a device that cannot round to even in shaders will do: only meshes that deform need it") {
    DeviceFacts plain = k_cpu;
    plain.round_to_nearest_float32 = false;
    CHECK(judge_device(plain).usable());
}

TEST_CASE("for a window a device that cannot show pictures in it is passed over, however fast") {
    DeviceFacts blind = k_discrete;
    blind.shows_window = false;
    DeviceFacts seen = k_integrated;
    seen.shows_window = true;
    const DeviceChoice choice = choose_device(std::vector{blind, seen});
    CHECK(choice.index == 1);
    CHECK(choice.reasons[0] ==
          "GeForce (discrete GPU): lacks a queue that can show pictures in this window");
    // Asked for by name, it is an error that says so, and no other is taken in its place.
    CHECK_THROWS_WITH_AS(choose_device(std::vector{blind, seen}, "GeForce"),
                         doctest::Contains("can show pictures in this window"), Error);
    CHECK(choose_device(std::vector{k_discrete, k_integrated}).index == 0);
}

TEST_CASE("every requirement is looked at") {
    CHECK(judge_device(k_cpu).usable());
    CHECK(judge_device({}).lacks.size() == 10);
    const auto lacks_one = [](auto spoil) {
        DeviceFacts facts = k_cpu;
        spoil(facts);
        return judge_device(facts).lacks.size() == 1;
    };
    CHECK(lacks_one([](DeviceFacts& f) { f.api_version = VK_API_VERSION_1_2; }));
    CHECK(lacks_one([](DeviceFacts& f) { f.graphics_and_compute_queue = false; }));
    CHECK(lacks_one([](DeviceFacts& f) { f.depth_clamp = false; }));
    CHECK(lacks_one([](DeviceFacts& f) { f.buffer_device_address = false; }));
    CHECK(lacks_one([](DeviceFacts& f) { f.scalar_block_layout = false; }));
    CHECK(lacks_one([](DeviceFacts& f) { f.timeline_semaphore = false; }));
    CHECK(lacks_one([](DeviceFacts& f) { f.dynamic_rendering = false; }));
    CHECK(lacks_one([](DeviceFacts& f) { f.synchronization2 = false; }));
    CHECK(lacks_one([](DeviceFacts& f) { f.maintenance4 = false; }));
    CHECK(lacks_one([](DeviceFacts& f) { f.depth_stencil_format = false; }));
    CHECK(lacks_one([](DeviceFacts& f) { f.shows_window = false; }));
}

TEST_CASE("a request chooses by kind, by index and by part of the name") {
    const std::vector devices{k_cpu, k_integrated, k_discrete};
    CHECK(choose_device(devices, "cpu").index == 0);
    CHECK(choose_device(devices, "gpu").index == 2);
    CHECK(choose_device(devices, "1").index == 1);
    CHECK(choose_device(devices, "iris").index == 1);
    CHECK(choose_device(devices, "LLVM").index == 0);
    CHECK(choose_device(std::vector{k_cpu, complete("RTX 4090", k_discrete.type)}, "4090").index ==
          1);
    CHECK(choose_device(devices, "cpu").reasons[2] == "GeForce (discrete GPU): is not 'cpu'");
}

TEST_CASE("where none fits the error says why of each") {
    const auto message = [](const std::vector<DeviceFacts>& devices, const DeviceRequest& request) {
        try {
            choose_device(devices, request);
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::no_device);
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(message({}, "").find("no Vulkan device") != std::string::npos);
    CHECK(message({k_cpu}, "gpu").find("llvmpipe (CPU): is not 'gpu'") != std::string::npos);
    DeviceFacts old = k_discrete;
    old.api_version = VK_API_VERSION_1_1;
    CHECK(message({old}, "").find("lacks Vulkan 1.3") != std::string::npos);
    CHECK(message({k_cpu}, "7").find("'7'") != std::string::npos);
}

}  // namespace
}  // namespace rimline
