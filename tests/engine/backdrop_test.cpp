// Frames in the picture of a renderer that has drawn first: over its color, behind and before its depth, with
// its projection. The same scene drawn by Rimline alone is what it must look like.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "engine/vulkan/barrier.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/pipeline.h"
#include "sample_surface_frag.h"
#include "sample_surface_vert.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/engine/support/gpu_fixture.h"
#include "tests/engine/support/test_pictures.h"

namespace rimline {
namespace {

using namespace rimline::tests;

constexpr std::uint32_t k_backdrop_width = 160;
constexpr std::uint32_t k_backdrop_height = 120;
constexpr VkExtent2D k_backdrop_size{k_backdrop_width, k_backdrop_height};
constexpr RendererOptions k_backdrop_plain{.samples = 1, .scale = 1};
constexpr glm::vec3 k_sky{0.3f, 0.4f, 0.6f};

// How the other renderer sees: a matrix, and which depths are near.
struct HostView {
    const char* name;
    glm::dmat4 projection;
    bool is_reversed;
    VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
};

// Rows of a perspective for Vulkan, y down.
glm::dmat4 perspective(double fov_y_deg, double z_scale, double z_offset,
                       const glm::dvec2& shift = {0.0, 0.0}) {
    const double focal = 1.0 / std::tan(0.5 * glm::radians(fov_y_deg));
    glm::dmat4 matrix(0.0);
    matrix[0][0] = focal * k_backdrop_height / k_backdrop_width;
    matrix[1][1] = -focal;
    matrix[2][0] = -shift.x;
    matrix[2][1] = -shift.y;
    matrix[2][2] = z_scale;
    matrix[3][2] = z_offset;
    matrix[2][3] = -1.0;
    return matrix;
}

glm::dmat4 reversed_infinite(double near, const glm::dvec2& shift = {0.0, 0.0}) {
    return perspective(40.0, 0.0, near, shift);
}
glm::dmat4 standard(double near, double far) {
    return perspective(40.0, -far / (far - near), -far * near / (far - near));
}
glm::dmat4 flat(double near, double far, bool is_reversed) {
    glm::dmat4 matrix(1.0);
    const double depth = far - near;
    matrix[0][0] = 0.4 * k_backdrop_height / k_backdrop_width;
    matrix[1][1] = -0.4;
    matrix[2][2] = is_reversed ? 1.0 / depth : -1.0 / depth;
    matrix[3][2] = is_reversed ? far / depth : -near / depth;
    return matrix;
}

// What is drawn with Rimline and by the other renderer.
class Place {
public:
    Place() : knot_(make_built_in_shape("knot", 3000)), ground_(make_built_in_shape("box", 12)) {}

    Scene scene(const glm::dmat4& projection) const {
        const glm::dmat4 view =
            glm::lookAt(glm::dvec3(2.5, 3.0, 6.5), glm::dvec3(0.0, -0.4, 0.0), glm::dvec3(0, 1, 0));
        Scene scene{
            .camera = camera_of(view, projection),
            .style = Style::mask,
            .palette = {.background = k_sky, .ink = {0.5f, 0.05f, 0.0f}, .shade = glm::vec3(0.25f)},
            .line_width_px = 2.0f};
        scene.instances.push_back({.octree = &knot_.octree, .name = "the knot"});
        SceneInstance ground{.octree = &ground_.octree, .name = "the ground"};
        ground.translation = {0.0, -2.6, 0.0};
        scene.instances.push_back(ground);
        scene.lights.push_back({.vector = {0.4, 1.0, 0.3}});
        return scene;
    }

    std::vector<glm::vec3> corners(const SceneInstance& instance) const {
        std::vector<glm::vec3> corners;
        const Mesh& mesh = instance.mesh();
        for (const Triangle& triangle : mesh.triangles())
            for (const VertexId v : triangle)
                corners.emplace_back(instance.rotation * glm::dvec3(mesh.positions()[index(v)]) +
                                     instance.translation);
        return corners;
    }

private:
    Model knot_, ground_;
};

// A renderer that clears to the sky and draws triangles in white. Its picture holds floats of linear light.
class Host {
public:
    static constexpr VkFormat k_format = VK_FORMAT_R32G32B32A32_SFLOAT;

    Host(const DeviceContext& context, const HostView& view, std::uint32_t samples,
         VkExtent2D extent = k_backdrop_size)
        : context_(context), view_(view), samples_(samples), extent_(extent) {
        constexpr VkImageUsageFlags k_color = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
        color_ = Image(context, {k_format, extent, k_color | VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
                       "the host's picture");
        if (samples > 1)
            multisampled_ =
                Image(context, {k_format, extent, k_color, samples}, "the host's samples");
        depth_ = Image(
            context,
            {.format = view.depth_format,
             .extent = extent,
             .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
             .samples = samples,
             .sampled_aspect = VK_IMAGE_ASPECT_DEPTH_BIT},
            "the host's depth");
        pixels_ = Buffer(context, VkDeviceSize{16} * extent.width * extent.height,
                         BufferPlace::readback, "the host's pixels");
        layout_ = make_pipeline_layout(context, "the host", sizeof(Constants), k_stages);
        pipeline_ = make_graphics_pipeline(
            context, "the host",
            {.vertex = sample_surface_vert,
             .geometry = {},
             .fragment = sample_surface_frag,
             .formats = {k_format, view.depth_format, samples},
             .depth_compare = view.is_reversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS,
             .depth_write = true,
             .layout = layout_});
        pool_ = make_command_pool(context, "the host", context.queue_family);
        commands_ = make_commands(context, pool_);
    }

    PictureTarget target(PictureUse use, bool has_depth) const {
        PictureTarget target{.image = color_.handle(),
                             .view = color_.attachment_view(),
                             .format = k_format,
                             .extent = extent_,
                             .initial_layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                             .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                             .use = use};
        if (has_depth)
            target.backdrop = BackdropDepth{.image = depth_.handle(),
                                            .view = depth_.sampled_view(),
                                            .format = view_.depth_format,
                                            .samples = samples_};
        return target;
    }

    // Draws triangles, then the scene, and returns the picture: four floats a pixel.
    std::vector<glm::vec4> draw(Renderer& renderer, const Scene& scene,
                                std::span<const glm::vec3> corners, const PictureTarget& target) {
        const UploadPoint uploaded = renderer.prepare(scene, target);
        const Commands commands = begin_commands(context_, commands_);
        const Buffer triangles =
            corners.empty() ? Buffer() : upload_buffer(context_, corners, "the host's triangles");
        draw_triangles(commands, scene, triangles, static_cast<std::uint32_t>(corners.size()));
        renderer.record(commands, scene, target);
        const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                       .imageExtent = {extent_.width, extent_.height, 1}};
        commands->CmdCopyImageToBuffer(commands, color_.handle(),
                                       VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixels_.handle(), 1,
                                       &region);
        record_barrier(commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                       {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
        vk_check(commands->EndCommandBuffer(commands), "vkEndCommandBuffer");
        const OwnedFence fence = make_fence(context_);
        Submission submission{.queue = context_.queue, .commands = commands_, .fence = fence};
        if (uploaded.value > 0) submission.waits.push_back(uploaded);
        submit_commands(context_, submission);
        wait_for_fence(context_, fence);
        const auto* values = reinterpret_cast<const glm::vec4*>(pixels_.mapped());
        return {values, values + std::size_t{extent_.width} * extent_.height};
    }

private:
    static constexpr VkShaderStageFlags k_stages =
        VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    struct Constants {
        glm::mat4 clip_from_world;
        glm::vec4 color;
        VkDeviceAddress corners;
    };

    void draw_triangles(Commands commands, const Scene& scene, const Buffer& triangles,
                        std::uint32_t corner_count) const {
        const bool is_multisampled = samples_ > 1;
        std::vector<VkImageMemoryBarrier2> barriers;
        const auto fresh = [&](const Image& image, VkImageLayout layout) {
            barriers.push_back({.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
                                .dstStageMask = VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT,
                                .dstAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
                                .newLayout = layout,
                                .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                .image = image.handle(),
                                .subresourceRange = {image.aspects(), 0, 1, 0, 1}});
        };
        fresh(color_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
        if (is_multisampled) fresh(multisampled_, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
        fresh(depth_, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
        record(commands, barriers);
        VkRenderingAttachmentInfo color{
            .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = (is_multisampled ? multisampled_ : color_).attachment_view(),
            .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .clearValue = {.color = {{k_sky.r, k_sky.g, k_sky.b, 1.0f}}}};
        if (is_multisampled) {
            color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
            color.resolveImageView = color_.attachment_view();
            color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
        }
        const VkRenderingAttachmentInfo depth{
            .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
            .imageView = depth_.attachment_view(),
            .imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .clearValue = {.depthStencil = {view_.is_reversed ? 0.0f : 1.0f, 0}}};
        const VkRect2D area{{0, 0}, extent_};
        const bool has_stencil = (depth_.aspects() & VK_IMAGE_ASPECT_STENCIL_BIT) != 0;
        const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                   .renderArea = area,
                                   .layerCount = 1,
                                   .colorAttachmentCount = 1,
                                   .pColorAttachments = &color,
                                   .pDepthAttachment = &depth,
                                   .pStencilAttachment = has_stencil ? &depth : nullptr};
        commands->CmdBeginRendering(commands, &info);
        const VkViewport viewport{0.0f, 0.0f, float(extent_.width), float(extent_.height),
                                  0.0f, 1.0f};
        commands->CmdSetViewport(commands, 0, 1, &viewport);
        commands->CmdSetScissor(commands, 0, 1, &area);
        if (corner_count > 0) {
            glm::dmat4 view(camera_from_world(scene.camera));
            view[3] = glm::dvec4(camera_from_world(scene.camera) * -scene.camera.eye, 1.0);
            const Constants constants{glm::mat4(view_.projection * view), glm::vec4(1.0f),
                                      triangles.address()};
            commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
            commands->CmdPushConstants(commands, layout_, k_stages, 0, sizeof constants,
                                       &constants);
            commands->CmdDraw(commands, corner_count, 1, 0, 0);
        }
        commands->CmdEndRendering(commands);
        barriers.clear();
        fresh(depth_, VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL);
        barriers[0].srcStageMask = VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
        barriers[0].srcAccessMask = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
        barriers[0].dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        barriers[0].oldLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
        record(commands, barriers);
    }

    static void record(Commands commands, std::span<const VkImageMemoryBarrier2> barriers) {
        const VkDependencyInfo dependency{
            .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
            .imageMemoryBarrierCount = static_cast<std::uint32_t>(barriers.size()),
            .pImageMemoryBarriers = barriers.data()};
        commands->CmdPipelineBarrier2(commands, &dependency);
    }

    DeviceContext context_;
    HostView view_;
    std::uint32_t samples_;
    VkExtent2D extent_;
    Image color_, multisampled_, depth_;
    Buffer pixels_;
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
    OwnedCommandPool pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

// The share of pixels that differ by more than `tolerance` (linear) in a channel.
double differing(std::span<const glm::vec4> a, std::span<const glm::vec4> b,
                 float tolerance = 0.004f) {
    REQUIRE(a.size() == b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::vec4 off = glm::abs(a[i] - b[i]);
        if (!(std::max({off.r, off.g, off.b, off.a}) <= tolerance)) ++count;
    }
    return double(count) / double(a.size());
}

void save(const std::string& name, std::span<const glm::vec4> pixels, VkExtent2D extent) {
    Picture picture{.width = extent.width, .height = extent.height, .rgba = {}};
    for (const glm::vec4& pixel : pixels) {
        for (int c = 0; c < 3; ++c) {
            const float linear = std::clamp(pixel[c], 0.0f, 1.0f);
            picture.rgba.push_back(
                static_cast<std::uint8_t>(255.0f * std::pow(linear, 1.0f / 2.2f) + 0.5f));
        }
        picture.rgba.push_back(255);
    }
    save_picture(name, picture, {});
}

const std::array<HostView, 6> k_views{{
    {"reversed, infinite", reversed_infinite(0.1), true},
    {"off-axis", reversed_infinite(0.05, {0.13, -0.21}), true},
    {"near is 0", standard(0.1, 100.0), false},
    {"near is 0, 24 bits", standard(0.1, 100.0), false, VK_FORMAT_D24_UNORM_S8_UINT},
    {"parallel", flat(0.5, 30.0, true), true},
    {"parallel, near is 0", flat(0.5, 30.0, false), false},
}};

bool can_sample(const Gpu& gpu, VkFormat format) {
    VkFormatProperties properties;
    gpu.context().vk->GetPhysicalDeviceFormatProperties(gpu.context().physical_device, format,
                                                        &properties);
    constexpr VkFormatFeatureFlags k_needed =
        VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT | VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT;
    return (properties.optimalTilingFeatures & k_needed) == k_needed;
}

TEST_CASE("over a picture that has the surfaces already shadows and lines are those of our own" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Place place;
    for (const HostView& view : k_views) {
        if (!can_sample(*gpu, view.depth_format)) continue;
        for (const std::uint32_t samples : {1u, 4u})
            for (const bool lines : {true, false})
                for (const bool shadows : {true, false}) {
                    CAPTURE(std::string(view.name));
                    CAPTURE(samples);
                    CAPTURE(lines);
                    CAPTURE(shadows);
                    Scene scene = place.scene(view.projection);
                    scene.lines = lines;
                    scene.shadows = shadows;
                    if (!shadows) scene.lights.clear(), scene.palette.shade = glm::vec3(1.0f);
                    Renderer renderer(gpu->context(), {.samples = samples, .scale = 1});
                    Host host(gpu->context(), view, samples);
                    const std::vector<glm::vec4> own =
                        host.draw(renderer, scene, {}, host.target(PictureUse::whole, false));
                    std::vector<glm::vec3> corners = place.corners(scene.instances[0]);
                    std::ranges::copy(place.corners(scene.instances[1]),
                                      std::back_inserter(corners));
                    for (SceneInstance& instance : scene.instances) instance.has_surfaces = false;
                    const std::vector<glm::vec4> over =
                        host.draw(renderer, scene, corners, host.target(PictureUse::over, true));
                    save("backdrop_own", own, k_backdrop_size);
                    save("backdrop_over", over, k_backdrop_size);
                    // The host has resolved its samples, so at the edge of a shaded surface the shadow's
                    // opacity applies to what lies behind it too.
                    CHECK(differing(own, over) < (samples > 1 && shadows ? 0.012 : 0.002));
                    // It shows something of each.
                    const auto has = [&](const glm::vec3& color) {
                        return std::ranges::any_of(over, [&](const glm::vec4& pixel) {
                            return glm::length(glm::vec3(pixel) - color) < 0.02f;
                        });
                    };
                    CHECK(has(k_sky));
                    CHECK(has(glm::vec3(1.0f)));
                    CHECK(has(glm::vec3(0.25f)) == shadows);
                    CHECK(has({0.5f, 0.05f, 0.0f}) == lines);
                }
    }
}

TEST_CASE("surfaces stand in what the host has drawn and cast their shadows on it" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Place place;
    for (const HostView& view : k_views) {
        if (!can_sample(*gpu, view.depth_format)) continue;
        for (const std::uint32_t samples : {1u, 4u}) {
            CAPTURE(std::string(view.name));
            CAPTURE(samples);
            Scene scene = place.scene(view.projection);
            // The ground cuts through the knot, so that each hides a part of the other.
            scene.instances[1].translation.y += 1.1;
            scene.instances[1].casts_shadows = false;
            scene.instances[1].has_lines = false;
            Renderer renderer(gpu->context(), {.samples = samples, .scale = 1});
            Host host(gpu->context(), view, samples);
            const std::vector<glm::vec4> own =
                host.draw(renderer, scene, {}, host.target(PictureUse::whole, false));
            const std::vector<glm::vec3> ground = place.corners(scene.instances[1]);
            scene.instances.pop_back();
            const std::vector<glm::vec4> over =
                host.draw(renderer, scene, ground, host.target(PictureUse::over, true));
            save("backdrop_standing_own", own, k_backdrop_size);
            save("backdrop_standing_over", over, k_backdrop_size);
            CHECK(differing(own, over) < 0.004);
        }
    }
}

TEST_CASE("shadows limited to where they can be seen fall on a backdrop as others do" *
          doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Place place;
    Model caster(make_built_in_shape("box", 12));
    std::size_t limited_count = 0;
    for (const HostView& view : k_views) {
        if (!can_sample(*gpu, view.depth_format)) continue;
        Scene scene = place.scene(view.projection);
        const std::vector<glm::vec3> ground = place.corners(scene.instances[1]);
        scene.instances.pop_back();
        scene.instances.push_back({.octree = &caster.octree, .translation = {2.5, -0.8, 1.0}});
        // The last lamps are close to the eye, within the box of the knot, and behind the camera.
        const std::array<Light, 6> lights{Light{.vector = {0.4, 1.0, 0.3}},
                                          {.vector = {1.0, 0.2, -0.4}},
                                          {.vector = {1.0, 4.0, -3.0}, .directional = false},
                                          {.vector = {2.6, 3.0, 6.6}, .directional = false},
                                          {.vector = {0.1, 0.1, 0.1}, .directional = false},
                                          {.vector = {5.0, 6.0, 13.0}, .directional = false}};
        Renderer limited(gpu->context(), k_backdrop_plain);
        Renderer everywhere(gpu->context(), {.samples = 1, .scale = 1, .limits_shadows = false});
        Host host(gpu->context(), view, 1);
        for (const PictureUse use : {PictureUse::layer, PictureUse::over})
            for (const Light& light : lights) {
                CAPTURE(std::string(view.name));
                CAPTURE(light.vector.z);
                scene.lights = {light, lights[0]};
                const std::vector<glm::vec4> some =
                    host.draw(limited, scene, ground, host.target(use, true));
                const std::vector<glm::vec4> all =
                    host.draw(everywhere, scene, ground, host.target(use, true));
                save("backdrop_limited", some, k_backdrop_size);
                CHECK(some == all);
                limited.render(scene, k_backdrop_width, k_backdrop_height);
                for (const ShadowReport& shadow : limited.report().shadows)
                    limited_count += shadow.reach.width * shadow.reach.height <
                                     k_backdrop_width * k_backdrop_height;
            }
    }
    CHECK(limited_count > 0);
}

TEST_CASE("a layer laid over a background is the picture on it" * doctest::test_suite("plain")) {
    RIMLINE_OPEN_GPU(gpu);
    const Place place;
    const HostView& view = k_views[0];
    for (const Style style : {Style::ink, Style::toon, Style::hatch, Style::mask}) {
        for (const std::uint32_t scale : {1u, 2u}) {
            CAPTURE(static_cast<int>(style));
            CAPTURE(scale);
            Scene scene = place.scene(view.projection);
            scene.style = style;
            scene.instances[0].material.line_color = glm::vec3(0.0f, 0.2f, 0.7f);
            scene.instances[1].fade_radius = 4.0;
            Renderer renderer(gpu->context(), {.samples = 4, .scale = scale});
            Host host(gpu->context(), view, 1);
            const std::vector<glm::vec4> own =
                host.draw(renderer, scene, {}, host.target(PictureUse::whole, false));
            std::vector<glm::vec4> layer =
                host.draw(renderer, scene, {}, host.target(PictureUse::layer, false));
            const std::vector<glm::vec4> over =
                host.draw(renderer, scene, {}, host.target(PictureUse::over, false));
            CHECK(layer[0] == glm::vec4(0.0f));
            // The same with straight alpha.
            std::vector<glm::vec4> straight =
                host.draw(renderer, scene, {}, host.target(PictureUse::straight, false));
            for (glm::vec4& pixel : straight)
                pixel = glm::vec4(glm::vec3(pixel) * pixel.a, pixel.a);
            CHECK(differing(layer, straight) == 0.0);
            for (glm::vec4& pixel : layer)
                pixel = glm::vec4(glm::vec3(pixel) + (1.0f - pixel.a) * k_sky,
                                  pixel.a + (1.0f - pixel.a));
            save("layer_own", own, k_backdrop_size);
            save("layer_laid_over", layer, k_backdrop_size);
            CHECK(differing(own, layer) == 0.0);
            CHECK(differing(own, over) == 0.0);
        }
    }
}

TEST_CASE("light above 1 stays in targets of floats") {
    RIMLINE_OPEN_GPU(gpu);
    const Place place;
    Scene scene = place.scene(k_views[0].projection);
    scene.palette.background = {5.0f, 0.5f, 2.0f};
    Renderer renderer(gpu->context(), k_backdrop_plain);
    Host host(gpu->context(), k_views[0], 1);
    const std::vector<glm::vec4> own =
        host.draw(renderer, scene, {}, host.target(PictureUse::whole, false));
    CHECK(own[0] == glm::vec4(5.0f, 0.5f, 2.0f, 1.0f));
}

TEST_CASE("jitter by whole pixels moves the picture by whole pixels") {
    RIMLINE_OPEN_GPU(gpu);
    const Place place;
    Renderer renderer(gpu->context(), k_backdrop_plain);
    Host host(gpu->context(), k_views[0], 1);
    Scene scene = place.scene(k_views[0].projection);
    const std::vector<glm::vec4> still =
        host.draw(renderer, scene, {}, host.target(PictureUse::whole, false));
    scene.camera.projection->shift +=
        glm::dvec2(2.0 * 3 / k_backdrop_width, 2.0 * 5 / k_backdrop_height);
    const std::vector<glm::vec4> moved =
        host.draw(renderer, scene, {}, host.target(PictureUse::whole, false));
    std::vector<glm::vec4> a, b;
    for (std::uint32_t y = 0; y + 5 < k_backdrop_height; ++y)
        for (std::uint32_t x = 0; x + 3 < k_backdrop_width; ++x) {
            a.push_back(still[y * k_backdrop_width + x]);
            b.push_back(moved[(y + 5) * k_backdrop_width + x + 3]);
        }
    CHECK(differing(a, b, 0.02f) < 0.002);
    CHECK(differing(still, moved) > 0.1);
}

TEST_CASE("a frame in a part of a picture leaves the rest as it was") {
    RIMLINE_OPEN_GPU(gpu);
    const Place place;
    const HostView& view = k_views[0];
    const Scene scene = place.scene(view.projection);
    Renderer renderer(gpu->context(), k_backdrop_plain);
    Host host(gpu->context(), view, 1);
    const std::vector<glm::vec4> own =
        host.draw(renderer, scene, {}, host.target(PictureUse::whole, false));
    constexpr VkExtent2D k_large{k_backdrop_width + 60, k_backdrop_height + 40};
    Host large(gpu->context(), view, 1, k_large);
    for (const PictureUse use : {PictureUse::whole, PictureUse::layer, PictureUse::over}) {
        CAPTURE(static_cast<int>(use));
        PictureTarget target = large.target(use, false);
        target.extent = k_backdrop_size;
        target.corner = {37, 21};
        const std::vector<glm::vec4> all = large.draw(renderer, scene, {}, target);
        std::vector<glm::vec4> part;
        for (std::uint32_t y = 0; y < k_large.height; ++y)
            for (std::uint32_t x = 0; x < k_large.width; ++x) {
                const glm::vec4& pixel = all[y * k_large.width + x];
                if (x >= 37 && x < 37 + k_backdrop_width && y >= 21 && y < 21 + k_backdrop_height)
                    part.push_back(use == PictureUse::layer
                                       ? pixel + (1.0f - pixel.a) * glm::vec4(k_sky, 1.0f)
                                       : pixel);
                else
                    REQUIRE(pixel == glm::vec4(k_sky, 1.0f));
            }
        CHECK(differing(own, part) == 0.0);
    }
}

TEST_CASE("what cannot be drawn over or read is refused by name") {
    RIMLINE_OPEN_GPU(gpu);
    const Place place;
    const Scene scene = place.scene(k_views[0].projection);
    Renderer renderer(gpu->context(), {.samples = 4, .scale = 1});
    Host host(gpu->context(), k_views[0], 1);
    PictureTarget target = host.target(PictureUse::over, true);
    CHECK_THROWS_WITH_AS((void)renderer.prepare(scene, target),
                         doctest::Contains("1 samples a pixel, and the renderer takes 4"), Error);
    target.backdrop.reset();
    target.initial_layout = VK_IMAGE_LAYOUT_UNDEFINED;
    CHECK_THROWS_WITH_AS((void)renderer.prepare(scene, target),
                         doctest::Contains("VK_IMAGE_LAYOUT_UNDEFINED"), Error);
}

}  // namespace
}  // namespace rimline
