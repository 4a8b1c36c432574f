#include "engine/passes/overlay_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/vulkan/commands.h"
#include "engine/vulkan/image_barrier.h"
#include "tests/engine/support/gpu_fixture.h"

using namespace rimline;

namespace {

constexpr VkExtent2D k_overlay_pass_extent{16, 8};
constexpr std::array<std::uint8_t, 3> k_paper{200, 100, 50};

using Pixel = std::array<int, 3>;

// Draws over an even picture and reads it back.
class DrawnOverlay {
public:
    DrawnOverlay(const DeviceContext& context, OverlayPass& pass, const OverlayDrawing& drawing) {
        const Image image(context,
                          {VK_FORMAT_R8G8B8A8_UNORM, k_overlay_pass_extent,
                           VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
                          "the test's picture");
        const Buffer pixels(context, bytes_.size(), BufferPlace::readback, "the test's pixels");
        constexpr StageAccess k_drawing{VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                        VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
        run_commands(context, [&](Commands commands) {
            record_barrier(
                commands, {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE}, k_drawing,
                {{image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL}});
            VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                            .imageView = image.attachment_view(),
                                            .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                            .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
            color.clearValue.color = {{float(k_paper[0]) / 255.0f, float(k_paper[1]) / 255.0f,
                                       float(k_paper[2]) / 255.0f, 1.0f}};
            const VkRenderingInfo rendering{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                            .renderArea = {{0, 0}, k_overlay_pass_extent},
                                            .layerCount = 1,
                                            .colorAttachmentCount = 1,
                                            .pColorAttachments = &color};
            commands->CmdBeginRendering(commands, &rendering);
            pass.record(commands, 0, drawing, k_overlay_pass_extent);
            commands->CmdEndRendering(commands);
            record_barrier(commands, k_drawing,
                           {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT},
                           {{image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                             VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL}});
            const VkBufferImageCopy region{
                .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                .imageExtent = {k_overlay_pass_extent.width, k_overlay_pass_extent.height, 1}};
            commands->CmdCopyImageToBuffer(commands, image.handle(),
                                           VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixels.handle(), 1,
                                           &region);
            record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                           {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
        });
        std::memcpy(bytes_.data(), pixels.mapped(), bytes_.size());
    }

    Pixel at(std::uint32_t x, std::uint32_t y) const {
        const std::uint8_t* pixel = &bytes_[4 * (y * k_overlay_pass_extent.width + x)];
        return {pixel[0], pixel[1], pixel[2]};
    }

private:
    std::array<std::uint8_t, 4 * k_overlay_pass_extent.width * k_overlay_pass_extent.height>
        bytes_{};
};

constexpr std::uint32_t color_of(std::uint32_t r, std::uint32_t g, std::uint32_t b,
                                 std::uint32_t a) {
    return r | g << 8 | b << 16 | a << 24;
}

// A rectangle of two triangles, its texture from (0, 0) to (1, 1).
void add_rectangle(OverlayDrawing& drawing, glm::vec2 low, glm::vec2 high, std::uint32_t color,
                   const VkRect2D& scissor) {
    const auto first = static_cast<std::uint32_t>(drawing.vertices.size());
    drawing.vertices.push_back({low, {0, 0}, color});
    drawing.vertices.push_back({{high.x, low.y}, {1, 0}, color});
    drawing.vertices.push_back({high, {1, 1}, color});
    drawing.vertices.push_back({{low.x, high.y}, {0, 1}, color});
    const auto first_index = static_cast<std::uint32_t>(drawing.indices.size());
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
        drawing.indices.push_back(first + corner);
    drawing.parts.push_back({first_index, 6, scissor});
}

OverlayDrawing drawing_of_picture() {
    return {.unit_size = {float(k_overlay_pass_extent.width), float(k_overlay_pass_extent.height)}};
}

int mixed(int over, int under, double alpha) {
    return static_cast<int>(std::lround(over * alpha + under * (1.0 - alpha)));
}

void check_near(const Pixel& found, const Pixel& expected) {
    for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(found[i] - expected[i]) <= 1);
}

constexpr VkRect2D k_everywhere{{0, 0}, k_overlay_pass_extent};
const Pixel k_untouched{k_paper[0], k_paper[1], k_paper[2]};

}  // namespace

TEST_CASE("an overlay mixes sRGB values as they are stored, and leaves the rest alone") {
    RIMLINE_OPEN_GPU(gpu);
    OverlayPass pass(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM, 1);
    OverlayDrawing drawing = drawing_of_picture();
    add_rectangle(drawing, {2, 1}, {6, 5}, color_of(10, 250, 90, 128), k_everywhere);
    const DrawnOverlay drawn(gpu->context(), pass, drawing);
    const double alpha = 128.0 / 255.0;
    check_near(drawn.at(2, 1),
               {mixed(10, 200, alpha), mixed(250, 100, alpha), mixed(90, 50, alpha)});
    check_near(drawn.at(5, 4), drawn.at(2, 1));
    for (const auto& [x, y] : {std::pair{1, 1}, {2, 0}, {6, 4}, {5, 5}})
        CHECK(drawn.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)) ==
              k_untouched);
}

TEST_CASE("scissors cut the parts of an overlay, those beyond the picture too") {
    RIMLINE_OPEN_GPU(gpu);
    OverlayPass pass(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM, 1);
    OverlayDrawing drawing = drawing_of_picture();
    const std::uint32_t red = color_of(255, 0, 0, 255);
    add_rectangle(drawing, {-50, -50}, {50, 50}, red, {{-4, -4}, {7, 6}});
    add_rectangle(drawing, {-50, -50}, {50, 50}, red, {{14, 6}, {100, 100}});
    add_rectangle(drawing, {-50, -50}, {50, 50}, red, {{40, 40}, {5, 5}});
    const DrawnOverlay drawn(gpu->context(), pass, drawing);
    for (std::uint32_t y = 0; y < k_overlay_pass_extent.height; ++y)
        for (std::uint32_t x = 0; x < k_overlay_pass_extent.width; ++x) {
            const bool inside = (x < 3 && y < 2) || (x >= 14 && y >= 6);
            CHECK(drawn.at(x, y) == (inside ? Pixel{255, 0, 0} : k_untouched));
        }
}

TEST_CASE("later parts lie over earlier ones, and the origin moves all of them") {
    RIMLINE_OPEN_GPU(gpu);
    OverlayPass pass(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM, 1);
    OverlayDrawing drawing = drawing_of_picture();
    drawing.origin = {100, 200};
    add_rectangle(drawing, {100, 200}, {108, 208}, color_of(255, 0, 0, 255), k_everywhere);
    add_rectangle(drawing, {104, 200}, {112, 208}, color_of(0, 0, 255, 255), k_everywhere);
    const DrawnOverlay drawn(gpu->context(), pass, drawing);
    CHECK(drawn.at(3, 3) == Pixel{255, 0, 0});
    CHECK(drawn.at(4, 3) == Pixel{0, 0, 255});
    CHECK(drawn.at(11, 7) == Pixel{0, 0, 255});
    CHECK(drawn.at(12, 3) == k_untouched);
}

TEST_CASE("an overlay's opacity is its texture's, read between the texels' middles") {
    RIMLINE_OPEN_GPU(gpu);
    OverlayPass pass(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM, 1);
    constexpr std::array<std::uint8_t, 2> k_opacity{0, 255};
    pass.set_texture(2, 1, k_opacity);
    OverlayDrawing drawing = drawing_of_picture();
    add_rectangle(drawing, {0, 0}, {16, 8}, color_of(0, 0, 0, 255), k_everywhere);
    const DrawnOverlay drawn(gpu->context(), pass, drawing);
    for (std::uint32_t x = 0; x < k_overlay_pass_extent.width; ++x) {
        // Texel middles lie at a quarter and three quarters of the width.
        const double alpha = std::clamp((double(x) + 0.5) / 8.0 - 0.5, 0.0, 1.0);
        check_near(drawn.at(x, 3),
                   {mixed(0, 200, alpha), mixed(0, 100, alpha), mixed(0, 50, alpha)});
    }
}

TEST_CASE("an overlay without parts draws nothing, and one that grows gets the room it needs") {
    RIMLINE_OPEN_GPU(gpu);
    OverlayPass pass(gpu->context(), VK_FORMAT_R8G8B8A8_UNORM, 1);
    OverlayDrawing drawing = drawing_of_picture();
    CHECK(DrawnOverlay(gpu->context(), pass, drawing).at(0, 0) == k_untouched);
    for (int i = 0; i < 500; ++i) {
        const auto at = glm::vec2(float(i % 16), float(i / 16 % 8));
        add_rectangle(drawing, at, at + 1.0f, color_of(1, 2, 3, 255), k_everywhere);
    }
    const DrawnOverlay drawn(gpu->context(), pass, drawing);
    CHECK(drawn.at(0, 0) == Pixel{1, 2, 3});
    CHECK(drawn.at(15, 7) == Pixel{1, 2, 3});
}
