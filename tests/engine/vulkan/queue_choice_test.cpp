#include "engine/vulkan/queue_choice.h"

#include <doctest/doctest.h>

#include <vector>

namespace rimline {
namespace {

constexpr VkQueueFlags k_graphics = VK_QUEUE_GRAPHICS_BIT;
constexpr VkQueueFlags k_compute = VK_QUEUE_COMPUTE_BIT;
constexpr VkQueueFlags k_transfer = VK_QUEUE_TRANSFER_BIT;
constexpr VkQueueFlags k_sparse = VK_QUEUE_SPARSE_BINDING_BIT;
constexpr VkQueueFlags k_video = 0x20;  // VK_QUEUE_VIDEO_DECODE_BIT_KHR.
constexpr VkQueueFlags k_flow = 0x100;  // VK_QUEUE_OPTICAL_FLOW_BIT_NV.

VkQueueFamilyProperties family(VkQueueFlags flags, std::uint32_t queue_count = 1) {
    return {.queueFlags = flags, .queueCount = queue_count};
}

// The family that draws and the one that copies.
void check(const std::vector<VkQueueFamilyProperties>& families, std::uint32_t draws,
           std::uint32_t copies) {
    const std::optional<QueueChoice> choice = choose_queues(families);
    REQUIRE(choice.has_value());
    CHECK(choice->family == draws);
    CHECK(choice->transfer_family == copies);
}

TEST_CASE("one family with one queue does everything") {
    check({family(k_graphics | k_compute | k_transfer)}, 0, 0);
}

TEST_CASE("a family for copies alone copies, wherever it stands among the others") {
    const auto all = family(k_graphics | k_compute | k_transfer | k_sparse, 16);
    const auto copies = family(k_transfer | k_sparse, 2);
    const auto computes = family(k_compute | k_transfer | k_sparse, 8);
    check({all, copies, computes}, 0, 1);
    check({computes, copies, all}, 2, 1);
    check({copies, all}, 1, 0);
    check({all, computes, copies, copies}, 0, 2);
}

TEST_CASE("families that compute, bind sparse memory, or code video are none for copies") {
    const auto all = family(k_graphics | k_compute | k_transfer);
    check({all, family(k_compute | k_transfer)}, 0, 0);
    check({all, family(k_sparse)}, 0, 0);
    check({all, family(k_video | k_transfer), family(k_flow | k_transfer)}, 0, 0);
    check({all, family(k_graphics | k_transfer)}, 0, 0);
}

TEST_CASE("a family without queues is none") {
    const auto all = family(k_graphics | k_compute | k_transfer);
    check({family(k_graphics | k_compute, 0), all, family(k_transfer, 0)}, 1, 1);
}

TEST_CASE("without a family that both draws and computes there is no choice") {
    CHECK_FALSE(choose_queues({}).has_value());
    CHECK_FALSE(
        choose_queues(std::vector{family(k_graphics), family(k_compute | k_transfer)}).has_value());
}

TEST_CASE("for a window the first family that draws, computes and presents to it is chosen") {
    const auto all = family(k_graphics | k_compute | k_transfer, 16);
    const std::vector families{family(k_compute | k_transfer), all, family(k_transfer), all};
    const auto drawing = [&](std::vector<VkBool32> presents) {
        const std::optional<QueueChoice> choice = choose_queues(families, presents);
        if (choice) CHECK(choice->transfer_family == 2);
        return choice ? std::optional(choice->family) : std::nullopt;
    };
    CHECK(drawing({VK_TRUE, VK_TRUE, VK_TRUE, VK_TRUE}) == 1u);
    CHECK(drawing({VK_TRUE, VK_FALSE, VK_FALSE, VK_TRUE}) == 3u);
    CHECK_FALSE(drawing({VK_TRUE, VK_FALSE, VK_TRUE, VK_FALSE}).has_value());
}

}  // namespace
}  // namespace rimline
