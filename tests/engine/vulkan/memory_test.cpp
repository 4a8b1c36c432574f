#include "engine/vulkan/memory.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "tests/engine/support/changed_functions.h"
#include "tests/engine/support/gpu_fixture.h"

namespace rimline {
namespace {

TEST_CASE("images that are drawn into are within the limits of attachments") {
    RIMLINE_OPEN_GPU(gpu);
    DeviceContext context = gpu->context();
    context.limits.maxFramebufferWidth = 100;
    context.limits.maxFramebufferHeight = 60;
    const auto make = [&](VkExtent2D extent, VkImageUsageFlags usage) {
        return Image(context, {VK_FORMAT_R8G8B8A8_UNORM, extent, usage}, "the picture");
    };
    constexpr VkImageUsageFlags k_drawn = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    CHECK_NOTHROW(make({100, 60}, k_drawn));
    CHECK_THROWS_WITH_AS(make({101, 60}, k_drawn),
                         "the picture of 101x60 exceeds the device's maxFramebufferWidth of 100",
                         Error);
    CHECK_THROWS_WITH_AS(make({100, 61}, k_drawn),
                         "the picture of 100x61 exceeds the device's maxFramebufferHeight of 60",
                         Error);
    CHECK_NOTHROW(make({101, 61}, VK_IMAGE_USAGE_SAMPLED_BIT));
    context.limits.maxImageDimension2D = 90;
    CHECK_THROWS_WITH_AS(make({91, 1}, VK_IMAGE_USAGE_SAMPLED_BIT),
                         "the picture of 91x1 exceeds the device's maxImageDimension2D of 90",
                         Error);
    CHECK(max_attachment_extent(context.limits).width == 90);
    CHECK(max_attachment_extent(context.limits).height == 60);
}

// Notes the alignments that are asked for.
class NotingAllocator : public MemoryAllocator {
public:
    explicit NotingAllocator(MemoryAllocator& blocks) : blocks_(blocks) {}
    MemoryPart allocate(const MemoryRequest& request) override {
        alignments.push_back(request.requirements.alignment);
        MemoryRequest aligned = request;
        aligned.requirements.alignment = 256;  // What the device really asks for, or more.
        return blocks_.allocate(aligned);
    }
    void free(const MemoryPart& part) noexcept override { blocks_.free(part); }
    std::vector<VkDeviceSize> alignments;

private:
    MemoryAllocator& blocks_;
};

PFN_vkGetBufferMemoryRequirements buffer_requirements = nullptr;

VKAPI_ATTR void VKAPI_CALL small_alignment(VkDevice device, VkBuffer buffer,
                                           VkMemoryRequirements* requirements) {
    buffer_requirements(device, buffer, requirements);
    requirements->alignment = 4;
}

TEST_CASE("buffers begin at multiples of 16, whatever the device asks for") {
    RIMLINE_OPEN_GPU(gpu);
    DeviceContext context = tests::with_functions(gpu->context(), [](DeviceFunctions& vk) {
        buffer_requirements = vk.GetBufferMemoryRequirements;
        vk.GetBufferMemoryRequirements = &small_alignment;
    });
    const auto allocator = std::make_shared<NotingAllocator>(*gpu->context().allocator);
    context.allocator = allocator;
    const Buffer buffer(context, 64, BufferPlace::device, "a test");
    CHECK(allocator->alignments == std::vector<VkDeviceSize>{k_min_buffer_alignment});
}

TEST_CASE("a buffer that needs a little more each frame is made a few times") {
    RIMLINE_OPEN_GPU(gpu);
    Buffer buffer;
    int made = 0;
    for (VkDeviceSize size = 0; size < 4000; ++size) {
        made += grow(buffer, gpu->context(), size, BufferPlace::upload, "a test");
        REQUIRE(buffer.size() >= std::max<VkDeviceSize>(size, 1));
        REQUIRE(buffer.mapped() != nullptr);
    }
    CHECK(made < 25);
    // It is kept where it is large enough, and large ones have little to spare.
    const VkBuffer handle = buffer.handle();
    CHECK_FALSE(grow(buffer, gpu->context(), 100, BufferPlace::upload, "a test"));
    CHECK(buffer.handle() == handle);
    constexpr VkDeviceSize k_large = VkDeviceSize{100} << 20;
    CHECK(grow(buffer, gpu->context(), k_large, BufferPlace::upload, "a test"));
    CHECK(buffer.size() < k_large + k_large / 4);
}

}  // namespace
}  // namespace rimline
