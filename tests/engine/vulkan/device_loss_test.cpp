#include "engine/vulkan/device_loss.h"

#include <doctest/doctest.h>

#include "engine/vulkan/vulkan_handle.h"

namespace rimline {
namespace {

TEST_CASE("a call on a device that is lost is made again on a new one, and not for ever") {
    for (int losses = 0; losses <= k_max_device_losses + 1; ++losses) {
        CAPTURE(losses);
        int calls = 0;
        int made = 0;
        const auto lose = [&] {
            if (calls++ < losses) vk_check(VK_ERROR_DEVICE_LOST, "vkQueueSubmit2");
            return calls;
        };
        const auto make_again = [&] { ++made; };
        if (losses > k_max_device_losses) {
            CHECK_THROWS_WITH_AS(
                surviving_device_loss(lose, make_again),
                "the device was lost: vkQueueSubmit2 failed with VK_ERROR_DEVICE_LOST", Error);
            CHECK(made == k_max_device_losses);
        } else {
            CHECK(surviving_device_loss(lose, make_again) == losses + 1);
            CHECK(made == losses);
        }
    }
}

TEST_CASE("a device that is lost while it is made is made again") {
    int calls = 0;
    int made = 0;
    surviving_device_loss(
        [&] {
            if (calls++ == 0) vk_check(VK_ERROR_DEVICE_LOST, "vkWaitSemaphores");
        },
        [&] {
            if (made++ == 0) vk_check(VK_ERROR_DEVICE_LOST, "vkCreateDevice");
        });
    CHECK(made == 2);
    CHECK(calls == 2);
}

TEST_CASE("errors other than a lost device are passed on at once") {
    int made = 0;
    CHECK_THROWS_AS(
        surviving_device_loss([] { vk_check(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkAllocateMemory"); },
                              [&] { ++made; }),
        Error);
    CHECK(made == 0);
}

TEST_CASE("every failure of Vulkan has a name and one of three codes") {
    const auto code_of = [](VkResult result) { return error_of(result, "vkCall").code(); };
    CHECK(code_of(VK_ERROR_DEVICE_LOST) == ErrorCode::device_lost);
    for (const VkResult result :
         {VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_MEMORY_MAP_FAILED,
          VK_ERROR_TOO_MANY_OBJECTS, VK_ERROR_FRAGMENTED_POOL, VK_ERROR_OUT_OF_POOL_MEMORY}) {
        CAPTURE(name_of(result));
        CHECK(code_of(result) == ErrorCode::too_large);
        CHECK(name_of(result).starts_with("VK_ERROR_"));
    }
    CHECK(code_of(VK_ERROR_INITIALIZATION_FAILED) == ErrorCode::no_device);
    CHECK(code_of(VK_ERROR_FORMAT_NOT_SUPPORTED) == ErrorCode::no_device);
    CHECK(name_of(VK_SUBOPTIMAL_KHR) == "VK_SUBOPTIMAL_KHR");
    CHECK(name_of(static_cast<VkResult>(-12345)) == "VkResult -12345");
}

TEST_CASE("a list that grows while it is read is read again") {
    int calls = 0;
    // Three items when counted, four when listed, then four.
    const std::vector<int> items = enumerate<int>(
        [&](std::uint32_t* count, int* list) {
            const std::uint32_t present = ++calls == 1 ? 3 : 4;
            if (!list) {
                *count = present;
                return VK_SUCCESS;
            }
            const std::uint32_t room = *count;
            *count = std::min(room, present);
            for (std::uint32_t i = 0; i < *count; ++i) list[i] = static_cast<int>(i);
            return room < present ? VK_INCOMPLETE : VK_SUCCESS;
        },
        "vkEnumerate");
    CHECK(items == std::vector{0, 1, 2, 3});
    CHECK(calls == 4);
}

TEST_CASE("a wait that fails for want of memory is made again, one for a lost device is not") {
    int calls = 0;
    CHECK(repeat_wait([&] { return ++calls < 4 ? VK_ERROR_OUT_OF_HOST_MEMORY : VK_SUCCESS; }) ==
          VK_SUCCESS);
    CHECK(calls == 4);
    CHECK(repeat_wait([&] { return ++calls, VK_ERROR_DEVICE_LOST; }) == VK_ERROR_DEVICE_LOST);
    CHECK(calls == 5);
}

}  // namespace
}  // namespace rimline
