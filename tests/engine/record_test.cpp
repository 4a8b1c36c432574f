#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "engine/vulkan/barrier.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/memory.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

constexpr RendererOptions k_record_plain{.samples = 1, .scale = 1};
constexpr std::uint32_t k_record_width = 80;
constexpr std::uint32_t k_record_height = 48;

Scene scene_at(const tests::Model& model, int frame) {
    const glm::vec3 paper(0.8f);
    Scene scene{.camera = fit_camera({}, model.mesh, default_view_direction({0, 1, 0}),
                                     double(k_record_width) / k_record_height),
                .style = Style::toon,
                .palette = default_palette(Style::toon, paper)};
    scene.instances.push_back({.octree = &model.octree,
                               .material = {.color = default_surface_color(Style::toon, paper)}});
    scene.lights.push_back(default_sun(scene.camera));
    scene.camera.eye.x += 0.03 * frame;
    scene.lights[0].vector.y += 0.1 * frame;
    return scene;
}

// A renderer that is there already: images, a command pool and fences of its own, a frame for each that may be
// in flight.
class Caller {
public:
    Caller(const DeviceContext& context, VkFormat format, std::uint32_t layers = 1,
           VkExtent2D extent = {k_record_width, k_record_height},
           std::uint32_t frames_in_flight = RendererOptions{}.frames_in_flight)
        : context_(context), format_(format), extent_(extent), flights_(frames_in_flight) {
        const VkImageCreateInfo image_info{
            .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
            .imageType = VK_IMAGE_TYPE_2D,
            .format = format,
            .extent = {extent.width, extent.height, 1},
            .mipLevels = 1,
            .arrayLayers = layers,
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .tiling = VK_IMAGE_TILING_OPTIMAL,
            .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT};
        VkImage image = VK_NULL_HANDLE;
        vk_check(context.vk->CreateImage(context.device, &image_info, nullptr, &image),
                 "vkCreateImage");
        image_ = {context, image};
        VkMemoryRequirements requirements;
        context.vk->GetImageMemoryRequirements(context.device, image, &requirements);
        std::uint32_t type = 0;
        while ((requirements.memoryTypeBits >> type & 1u) == 0) ++type;
        const VkMemoryAllocateInfo memory_info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                               .allocationSize = requirements.size,
                                               .memoryTypeIndex = type};
        VkDeviceMemory memory = VK_NULL_HANDLE;
        vk_check(context.vk->AllocateMemory(context.device, &memory_info, nullptr, &memory),
                 "memory");
        memory_ = {context, memory};
        vk_check(context.vk->BindImageMemory(context.device, image, memory, 0),
                 "vkBindImageMemory");
        const VkImageViewCreateInfo view_info{
            .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
            .image = image,
            .viewType = VK_IMAGE_VIEW_TYPE_2D,
            .format = format,
            .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, layers - 1, 1}};
        VkImageView view = VK_NULL_HANDLE;
        vk_check(context.vk->CreateImageView(context.device, &view_info, nullptr, &view), "view");
        view_ = {context, view};

        pool_ = make_command_pool(context, "test", context.queue_family);
        for (Flight& flight : flights_) {
            flight.commands = make_commands(context, pool_);
            flight.fence = make_fence(context, VK_FENCE_CREATE_SIGNALED_BIT);
            flight.pixels = Buffer(context, VkDeviceSize{16} * extent.width * extent.height,
                                   BufferPlace::readback, "pixels");
        }
    }
    ~Caller() { context_.vk->QueueWaitIdle(context_.queue); }
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

    /// Of the frames that follow; null: none.
    void set_condition(const Buffer* condition) { condition_ = condition; }

    PictureTarget target(VkImageLayout final_layout) const {
        std::optional<FrameCondition> condition;
        if (condition_ != nullptr) condition = FrameCondition{condition_->handle(), 0};
        return {.image = image_,
                .view = view_,
                .format = format_,
                .extent = extent_,
                .layer = layer_,
                .final_layout = final_layout,
                .condition = condition};
    }
    void set_layer(std::uint32_t layer) { layer_ = layer; }

    /// Waits for the frame before the last, records, submits unless told not to, and does not wait.
    FrameReport draw(Renderer& renderer, const Scene& scene, bool submit = true) {
        Flight& flight = flights_[frame_++ % flights_.size()];
        wait_for_fence(context_, flight.fence);
        const PictureTarget into = target(VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        const UploadPoint uploaded = renderer.prepare(scene, into);
        const Commands commands = begin_commands(context_, flight.commands);
        const FrameReport report = renderer.record(commands, scene, into);
        const VkBufferImageCopy region{
            .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, layer_, 1},
            .imageExtent = {extent_.width, extent_.height, 1}};
        commands->CmdCopyImageToBuffer(commands, image_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                       flight.pixels.handle(), 1, &region);
        record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
        vk_check(commands->EndCommandBuffer(commands), "vkEndCommandBuffer");
        if (!submit) return report;
        const VkFence fence = flight.fence;
        vk_check(context_.vk->ResetFences(context_.device, 1, &fence), "vkResetFences");
        Submission submission{.queue = context_.queue, .commands = commands, .fence = fence};
        if (uploaded.value > 0) submission.waits.push_back(uploaded);
        submit_commands(context_, submission);
        return report;
    }

    /// Waits for the frame drawn `ago` frames before the last.
    std::span<const std::byte> pixels(std::size_t ago = 0) {
        Flight& flight = flights_[(frame_ - 1 - ago) % flights_.size()];
        wait_for_fence(context_, flight.fence);
        return {flight.pixels.mapped(), flight.pixels.size()};
    }

private:
    struct Flight {
        VkCommandBuffer commands = VK_NULL_HANDLE;
        OwnedFence fence;
        Buffer pixels;
    };
    DeviceContext context_;
    VkFormat format_;
    VkExtent2D extent_;
    DeviceHandle<VkDeviceMemory, &DeviceFunctions::FreeMemory> memory_;
    OwnedImage image_;
    OwnedImageView view_;
    OwnedCommandPool pool_;
    std::vector<Flight> flights_;
    std::size_t frame_ = 0;
    std::uint32_t layer_ = 0;
    const Buffer* condition_ = nullptr;
};

std::uint8_t as_byte(std::span<const std::byte> pixels, std::size_t i) {
    return std::to_integer<std::uint8_t>(pixels[i]);
}

TEST_CASE("frames recorded into a caller's commands and image are those that render() gives") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 3000));
    Renderer own(gpu->context(), k_record_plain);
    Renderer embedded(gpu->context(), k_record_plain);
    Caller caller(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM, 3);
    caller.set_layer(2);
    std::vector<Picture> expected;
    for (int frame = 0; frame < 6; ++frame) {
        CAPTURE(frame);
        expected.push_back(own.render(scene_at(model, frame), k_record_width, k_record_height));
        const FrameReport report = caller.draw(embedded, scene_at(model, frame));
        CHECK(report.bytes_streamed == own.report().bytes_streamed);
        CHECK(report.silhouette == own.report().silhouette);
        if (frame == 0) continue;
        // The frame before this one: both are in flight.
        const std::span<const std::byte> pixels = caller.pixels(1);
        const std::vector<std::uint8_t>& wanted = expected[std::size_t(frame) - 1].rgba;
        CHECK(std::ranges::equal(std::as_bytes(std::span(wanted)), pixels.first(wanted.size())));
    }
}

TEST_CASE("as many frames may be in flight as the caller says") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 3000));
    const tests::Model other(make_built_in_shape("spring", 2000));
    for (const std::uint32_t frames_in_flight : {1u, 3u, 5u}) {
        CAPTURE(frames_in_flight);
        RendererOptions options = k_record_plain;
        options.frames_in_flight = frames_in_flight;
        Renderer own(gpu->context(), k_record_plain);
        Renderer embedded(gpu->context(), options);
        Caller caller(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM, 1,
                      {k_record_width, k_record_height}, frames_in_flight);
        std::vector<Picture> expected;
        for (std::uint32_t frame = 0; frame < 3 * frames_in_flight; ++frame) {
            Scene scene = scene_at(frame % 4 == 3 ? other : model, int(frame));
            scene.instances.push_back(
                {.deforming = &other.mesh,
                 .deformation = default_wave(other.mesh, {0, 1, 0}, 0.1 * frame)});
            expected.push_back(own.render(scene, k_record_width, k_record_height));
            caller.draw(embedded, scene);
            if (frame + 1 < frames_in_flight) continue;
            // The oldest one in flight.
            const std::vector<std::uint8_t>& wanted = expected[frame + 1 - frames_in_flight].rgba;
            CHECK(std::ranges::equal(std::as_bytes(std::span(wanted)),
                                     caller.pixels(frames_in_flight - 1).first(wanted.size())));
        }
    }
}

TEST_CASE("a frame that is given up draws nothing, and the next one has its silhouettes") {
    RIMLINE_OPEN_GPU(gpu);
    if (!gpu->context().features.conditional_rendering)
        RIMLINE_SKIP("no VK_EXT_conditional_rendering");
    const tests::Model model(make_built_in_shape("knot", 3000));
    Renderer own(gpu->context(), k_record_plain);
    RendererOptions checked = k_record_plain;
    checked.check_silhouettes = true;
    Renderer embedded(gpu->context(), checked);
    Caller caller(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM);
    const Buffer condition(gpu->context(), 4, BufferPlace::upload, "condition");
    caller.set_condition(&condition);
    const auto is_drawn = [&](int frame) {
        const Picture expected =
            own.render(scene_at(model, frame), k_record_width, k_record_height);
        return std::ranges::equal(std::as_bytes(std::span(expected.rgba)),
                                  caller.pixels().first(expected.rgba.size()));
    };
    for (int frame = 0; frame < 9; ++frame) {
        CAPTURE(frame);
        const std::uint32_t goes_on = frame % 3 == 0 ? 1 : 0;
        std::memcpy(condition.mapped(), &goes_on, sizeof goes_on);
        caller.draw(embedded, scene_at(model, frame));
        CHECK(is_drawn(frame) == (goes_on == 1));
    }
    CHECK(embedded.differences() == 0);
    caller.set_condition(nullptr);
    caller.draw(embedded, scene_at(model, 9));
    CHECK(is_drawn(9));
}

TEST_CASE("a condition is refused where the device does not follow it") {
    RIMLINE_OPEN_GPU(gpu);
    DeviceContext plain = gpu->context();
    plain.features.conditional_rendering = false;
    const tests::Model model(make_built_in_shape("box", 12));
    Renderer renderer(plain, k_record_plain);
    Caller caller(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM);
    const Buffer condition(gpu->context(), 4, BufferPlace::upload, "condition");
    caller.set_condition(&condition);
    try {
        (void)renderer.prepare(scene_at(model, 0), caller.target(VK_IMAGE_LAYOUT_GENERAL));
        FAIL("it was taken");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        CHECK(std::string(error.what()).find("VK_EXT_conditional_rendering") != std::string::npos);
    }
}

TEST_CASE("each format of target holds the same picture, encoded once") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 3000));
    Renderer renderer(gpu->context(), k_record_plain);
    const Picture expected = renderer.render(scene_at(model, 0), k_record_width, k_record_height);
    const std::size_t channels = expected.rgba.size();

    for (const auto& [format, is_bgr] : {std::pair{VK_FORMAT_B8G8R8A8_UNORM, true},
                                         {VK_FORMAT_R8G8B8A8_SRGB, false},
                                         {VK_FORMAT_B8G8R8A8_SRGB, true}}) {
        CAPTURE(format);
        Caller caller(gpu->context(), format);
        caller.draw(renderer, scene_at(model, 0));
        const std::span<const std::byte> pixels = caller.pixels();
        int worst = 0;
        for (std::size_t i = 0; i < channels; ++i) {
            const std::size_t from = is_bgr && i % 4 != 3 ? i / 4 * 4 + 2 - i % 4 : i;
            worst = std::max(worst, std::abs(int(as_byte(pixels, from)) - int(expected.rgba[i])));
        }
        // The hardware's encoding may round otherwise than ours.
        CHECK(worst <= 1);
    }

    Caller caller(gpu->context(), VK_FORMAT_R32G32B32A32_SFLOAT);
    caller.draw(renderer, scene_at(model, 0));
    const auto* values = reinterpret_cast<const float*>(caller.pixels().data());
    for (std::size_t i = 0; i < channels; ++i) {
        if (i % 4 == 3) {
            REQUIRE(values[i] == 1.0f);
        } else {
            const double linear = tests::linear_from_srgb(expected.rgba[i]);
            // Half a step of 8 bits where the curve is steepest in linear light.
            REQUIRE(std::abs(double(values[i]) - linear) < 0.6 / 255.0 * 2.3);
        }
    }
}

TEST_CASE("a format that no picture can be drawn in is named") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("box", 12));
    Renderer renderer(gpu->context(), k_record_plain);
    Caller caller(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM);
    PictureTarget target = caller.target(VK_IMAGE_LAYOUT_GENERAL);
    for (const VkFormat format : {VK_FORMAT_R8G8B8A8_UINT, VK_FORMAT_D32_SFLOAT,
                                  VK_FORMAT_BC1_RGB_UNORM_BLOCK, VK_FORMAT_UNDEFINED}) {
        CAPTURE(format);
        target.format = format;
        try {
            (void)renderer.prepare(scene_at(model, 0), target);
            FAIL("was taken");
        } catch (const Error& error) {
            CHECK(error.code() == ErrorCode::bad_input);
            CHECK(std::string(error.what()).find("VkFormat " + std::to_string(format)) !=
                  std::string::npos);
        }
    }
}

TEST_CASE("frames of a caller and own ones follow on each other, and sizes change") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("torus", 2000));
    Renderer own(gpu->context(), k_record_plain);
    Renderer mixed(gpu->context(), k_record_plain);
    Caller caller(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM);
    for (int frame = 0; frame < 8; ++frame) {
        CAPTURE(frame);
        const Scene scene = scene_at(model, frame);
        const std::uint32_t width = frame % 4 == 3 ? 40 : k_record_width;
        const Picture expected = own.render(scene, width, k_record_height);
        if (frame % 2 == 0) {
            caller.draw(mixed, scene);
            CHECK(std::ranges::equal(std::as_bytes(std::span(expected.rgba)),
                                     caller.pixels().first(expected.rgba.size())));
        } else {
            CHECK(mixed.render(scene, width, k_record_height).rgba == expected.rgba);
        }
    }
}

TEST_CASE("what leaves the scene stays until the caller's frames that read it are done") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("spring", 3000));
    const tests::Model other(make_built_in_shape("knot", 3000));
    Renderer own(gpu->context(), k_record_plain);
    Renderer embedded(gpu->context(), k_record_plain);
    Caller caller(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM);
    std::vector<Picture> expected;
    for (int frame = 0; frame < 9; ++frame) {
        CAPTURE(frame);
        Scene scene = scene_at(frame % 3 == 2 ? other : model, frame);
        if (frame % 3 == 1) scene.lights.push_back({.vector = {0.3, 1, 0.2}});
        if (frame % 3 == 0) scene.instances.push_back({.octree = &other.octree});
        expected.push_back(own.render(scene, k_record_width, k_record_height));
        caller.draw(embedded, scene);
        if (frame == 0) continue;
        const std::vector<std::uint8_t>& wanted = expected[std::size_t(frame) - 1].rgba;
        CHECK(std::ranges::equal(std::as_bytes(std::span(wanted)),
                                 caller.pixels(1).first(wanted.size())));
    }
}

TEST_CASE("other images are not made while frames that use the old ones may run") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 1500));
    Renderer renderer(gpu->context(), k_record_plain);
    Caller caller(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM);
    Caller other(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM, 1, {96, 64});
    caller.draw(renderer, scene_at(model, 0), false);
    const PictureTarget target = other.target(VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
    try {
        (void)renderer.prepare(scene_at(model, 0), target);
        FAIL("it was prepared");
    } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
        CHECK(std::string(error.what()).find("wait for them") != std::string::npos);
    }
    renderer.forget_recorded();
    CHECK(other.draw(renderer, scene_at(model, 0)).silhouette > 0);
    CHECK(other.pixels().size() > 0);
}

// Counts how often the library takes it.
class CountedLock : public QueueMutex {
public:
    void lock() override { ++count; }
    void unlock() override {}
    int count = 0;
};

TEST_CASE("a renderer that has uploaded nothing takes no lock of the queue, from first to last") {
    RIMLINE_OPEN_GPU(gpu);
    CountedLock counted;
    DeviceContext context = gpu->context();
    context.queue_mutex = &counted;
    { const Renderer renderer(context, k_record_plain); }
    CHECK(counted.count == 0);
    const tests::Model model(make_built_in_shape("knot", 1500));
    Renderer(context, k_record_plain).render(scene_at(model, 0), 32, 32);
    CHECK(counted.count > 0);
}

TEST_CASE("after a command buffer that is never submitted the next frame is whole and right") {
    RIMLINE_OPEN_GPU(gpu);
    const tests::Model model(make_built_in_shape("knot", 3000));
    Renderer own(gpu->context(), k_record_plain);
    Renderer embedded(gpu->context(), k_record_plain);
    Caller caller(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM);
    for (int frame = 0; frame < 6; ++frame) {
        CAPTURE(frame);
        const Scene scene = scene_at(model, frame);
        const Picture expected = own.render(scene, k_record_width, k_record_height);
        if (frame == 2) {
            caller.draw(embedded, scene, false);
            embedded.forget_recorded();
            continue;
        }
        const FrameReport report = caller.draw(embedded, scene);
        CHECK((report.bytes_streamed == report.bytes_full) == (frame == 0 || frame == 3));
        CHECK(std::ranges::equal(std::as_bytes(std::span(expected.rgba)),
                                 caller.pixels().first(expected.rgba.size())));
    }
}

}  // namespace
}  // namespace rimline
