// Whatever fails, and whenever: stage.h says what is played and what must hold.

#include <array>
#include <cstring>

#include "engine/clouds/splat_renderer.h"
#include "engine/frame/draw_data.h"
#include "engine/frame/render_targets.h"
#include "engine/measure/visible_ratio.h"
#include "engine/passes/face_bits_pass.h"
#include "engine/passes/line_pass.h"
#include "engine/passes/shadow_volume_pass.h"
#include "engine/picture_lines.h"
#include "engine/stream/change_stream.h"
#include "engine/vulkan/barrier.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/image_barrier.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/face_bits.h"
#include "tests/engine/faults/stage.h"
#include "tests/engine/support/gpu_fixture.h"

namespace rimline::tests {
namespace {

constexpr RendererOptions k_faults_plain{.samples = 1, .scale = 1};

std::unique_ptr<Renderer> undisturbed_renderer(Stage& stage) {
    return stage.undisturbed(
        [&] { return std::make_unique<Renderer>(stage.context(), k_faults_plain); });
}

RIMLINE_FAULT_SCENARIO("a picture") {
    const auto renderer =
        stage.make<Renderer>(stage.context(), RendererOptions{.pass_times = true});
    const Scene scene = stage.scene();
    stage.show(stage.step([&] { return renderer->render(scene, 24, 24); }).rgba);
}

RIMLINE_FAULT_SCENARIO("an instance and its device") {
    const auto instance = stage.make<VulkanInstance>(
        InstanceOptions{.validate = stage.instance().validates(), .loader = &failing_loader});
    const auto device =
        stage.step([&] { return std::make_unique<TestedDevice>(*instance, requested_device()); });
    CHECK(device->face_bits_agree());
    stage.show(std::vector<char>(device->facts().name.begin(), device->facts().name.end()));
    CHECK(instance->first_validation_message() == "");
}

RIMLINE_FAULT_SCENARIO("pictures of a camera and a light that move") {
    const auto renderer = undisturbed_renderer(stage);
    Scene scene = stage.scene();
    for (int frame = 0; frame < 3; ++frame) {
        scene.camera.eye.x += 0.05;
        scene.lights[1].vector.y += 0.1;
        stage.show(stage.step([&] { return renderer->render(scene, 16, 16); }).rgba);
    }
}

RIMLINE_FAULT_SCENARIO("pictures of other sizes") {
    const auto renderer = undisturbed_renderer(stage);
    const Scene scene = stage.scene();
    for (const std::uint32_t size : {16u, 24u, 8u})
        stage.show(stage.step([&] { return renderer->render(scene, size, 16); }).rgba);
}

RIMLINE_FAULT_SCENARIO("pictures of instances and lights that come and go") {
    const auto renderer = undisturbed_renderer(stage);
    Scene scene = stage.scene();
    const auto show = [&] {
        stage.show(stage.step([&] { return renderer->render(scene, 16, 16); }).rgba);
    };
    show();
    scene.instances.push_back({.octree = &stage.models().box.octree});
    for (int light = 0; light < 6; ++light)
        scene.lights.push_back({.vector = {light - 2.5, 2.0, 1.0}, .directional = light % 2 == 0});
    show();
    scene.instances.erase(scene.instances.begin());
    scene.lights.resize(1);
    show();
}

RIMLINE_FAULT_SCENARIO("pictures of a mesh that deforms") {
    const auto renderer = undisturbed_renderer(stage);
    Scene scene = stage.scene();
    const Mesh& mesh = stage.models().box.mesh;
    scene.instances.push_back({.deforming = &mesh});
    for (const double turns : {0.0, 0.3}) {
        scene.instances.back().deformation = default_wave(mesh, {0, 1, 0}, turns);
        stage.show(stage.step([&] { return renderer->render(scene, 16, 16); }).rgba);
    }
}

// A sheet whose two materials have a texture and a color.
MeshSource textured_sheet() {
    MeshSource source{{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}, {{0, 2, 1}, {0, 3, 2}}};
    Picture picture{4, 2, {}};
    for (std::uint8_t i = 0; i < 32; ++i) picture.rgba.push_back(i % 4 == 3 ? 255 : 7 * i);
    FaceMaterials& materials = source.materials;
    materials.textures.push_back(
        {.place = "a test", .picture = std::make_shared<const Picture>(std::move(picture))});
    materials.materials = {{.texture = TextureId{0}}, {.base_color = glm::vec3(0.7f, 0.2f, 0.1f)}};
    materials.of_face = {MaterialId{0}, MaterialId{1}};
    for (const auto& triangle : source.triangles)
        for (const std::uint32_t v : triangle)
            materials.corner_uvs.push_back({source.positions[v].x, source.positions[v].z});
    return source;
}

RIMLINE_FAULT_SCENARIO("pictures with textures and with lines of a caller") {
    const auto sheet = stage.undisturbed([] { return std::make_unique<Model>(textured_sheet()); });
    const auto renderer = undisturbed_renderer(stage);
    const PictureLines lines = stage.undisturbed([] {
        return PictureLines{.points = {{-0.2, 0.0}, {0.1, 0.1}, {0.2, -0.1}},
                            .lines = {{0, 3, true, true}, {0, 2}},
                            .colors = {glm::vec3(0.0f, 0.2f, 0.6f)}};
    });
    Scene scene = stage.scene();
    scene.style = Style::toon;
    const auto show = [&] {
        stage.show(stage.step([&] { return renderer->render(scene, 16, 16); }).rgba);
    };
    show();
    scene.instances.push_back({.octree = &sheet->octree, .material = {.shows_mesh_colors = true}});
    show();
    scene.instances[0].picture_lines = &lines;
    show();
}

RIMLINE_FAULT_SCENARIO("pictures of clouds") {
    const auto renderer =
        stage.make<SplatRenderer>(stage.context(), SplatRendererOptions{.scale = 1});
    SplatCloud cloud;
    SplatScene scene{.cloud = &cloud};
    scene.camera = {.eye = {0, 0, 5}, .target = {0, 0, 0}, .ortho_height = 2.0};
    const auto show = [&] {
        stage.show(stage.step([&] { return renderer->render(scene, 16, 16); }).rgba);
    };
    const auto change = [&](const auto& how) { stage.undisturbed([&] { return how(), 0; }); };
    show();
    for (const float x : {-0.4f, 0.3f}) {
        change([&] {
            cloud.splats.push_back({{x, 0.1f, 0.0f}, 0.4f, {0.0f, 0.0f, 1.0f}, 0xff20c040u, {}});
            ++cloud.revision;
            scene.strokes.push_back({{x, -0.5f, 0.2f}, 1.0f, {0.4f, 0.5f, 0.2f}, 0xff000000u, {}});
        });
        scene.camera.eye.x += 0.1;
        show();
    }
}

RIMLINE_FAULT_SCENARIO("pictures of lines that are tested in every frame") {
    const auto data = stage.make<DrawData>(stage.context(), 2u);
    for (const LinePath path :
         {LinePath::pulling, LinePath::all_edges, LinePath::quads, LinePath::adjacency}) {
        const auto pass =
            stage.make<LinePass>(stage.context(), data->layout(), k_surface_format, path);
        stage.step([&] {
            pass->prepare_edges(stage.context());
            pass->prepare_segments(stage.context());
            return 0;
        });
    }
    RendererOptions options = k_faults_plain;
    options.line_path = LinePath::adjacency;
    const auto renderer =
        stage.undisturbed([&] { return std::make_unique<Renderer>(stage.context(), options); });
    const Scene scene = stage.scene();
    stage.show(stage.step([&] { return renderer->render(scene, 16, 16); }).rgba);
}

RIMLINE_FAULT_SCENARIO("pictures of shadows by every method and form") {
    const AttachmentFormats formats{k_surface_format, k_depth_stencil_format, 1};
    const auto data = stage.make<DrawData>(stage.context(), 2u);
    for (const SideStage sides : {SideStage::vertex, SideStage::geometry})
        stage.make<ShadowVolumePass>(stage.context(), data->layout(), formats, sides);
    RendererOptions options = k_faults_plain;
    options.shadow_sides = SideStage::geometry;
    const auto renderer =
        stage.undisturbed([&] { return std::make_unique<Renderer>(stage.context(), options); });
    Scene scene = stage.scene();
    for (const ShadowMethod method :
         {ShadowMethod::fail, ShadowMethod::pass, ShadowMethod::automatic})
        for (const ShadowForm form : {ShadowForm::general, ShadowForm::automatic}) {
            scene.shadow_method = method;
            scene.shadow_form = form;
            scene.camera.eye.x += 0.05;
            stage.show(stage.step([&] { return renderer->render(scene, 16, 16); }).rgba);
        }
}

// A caller's image, and the commands of a caller that draw into it. The caller drops a frame that failed, and records
// it once more.
class CallersPicture {
public:
    explicit CallersPicture(Stage& stage)
        : image_(stage.undisturbed([&] {
              return Image(
                  stage.context(),
                  {.format = k_format,
                   .extent = k_extent,
                   .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
                  "a caller's image");
          })),
          pixels_(stage.undisturbed([&] {
              return Buffer(stage.context(), 4 * k_extent.width * k_extent.height,
                            BufferPlace::readback, "a caller's pixels");
          })) {}

    static constexpr VkExtent2D k_extent{16, 16};

    PictureTarget target() const {
        return {.image = image_.handle(),
                .view = image_.attachment_view(),
                .format = k_format,
                .extent = k_extent,
                .final_layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    }

    void show(Stage& stage, Renderer& renderer, const Scene& scene) {
        show(stage, renderer, scene, target(), [](Commands) {});
    }
    /// `record_before` records the caller's own commands before the frame.
    template <typename Record>
    void show(Stage& stage, Renderer& renderer, const Scene& scene, const PictureTarget& target,
              const Record& record_before) {
        stage.step([&] {
            renderer.forget_recorded();
            const UploadPoint uploaded = renderer.prepare(scene, target);
            const auto record = [&](Commands commands) {
                record_before(commands);
                renderer.record(commands, scene, target);
                const VkBufferImageCopy region{
                    .imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                    .imageExtent = {k_extent.width, k_extent.height, 1}};
                commands->CmdCopyImageToBuffer(commands, image_.handle(),
                                               VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                               pixels_.handle(), 1, &region);
                record_barrier(commands,
                               {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                               {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
            };
            run_commands(stage.context(), record, uploaded);
        });
        stage.show(std::vector<std::byte>(pixels_.mapped(), pixels_.mapped() + pixels_.size()));
    }

private:
    static constexpr VkFormat k_format = VK_FORMAT_R8G8B8A8_UNORM;

    Image image_;
    Buffer pixels_;
};

RIMLINE_FAULT_SCENARIO("frames recorded into a caller's commands") {
    const auto renderer = undisturbed_renderer(stage);
    CallersPicture picture(stage);
    Scene scene = stage.scene();
    for (int frame = 0; frame < 3; ++frame) {
        scene.camera.eye.x += 0.05;
        scene.lights[1].vector.y += 0.1;
        if (frame == 2) scene.instances.push_back({.octree = &stage.models().box.octree});
        picture.show(stage, *renderer, scene);
    }
}

RIMLINE_FAULT_SCENARIO("frames behind and before what a caller has drawn") {
    const auto renderer = undisturbed_renderer(stage);
    CallersPicture picture(stage);
    constexpr VkExtent2D k_size = CallersPicture::k_extent;
    const Image depth = stage.undisturbed([&] {
        return Image(stage.context(),
                     {.format = VK_FORMAT_D32_SFLOAT,
                      .extent = k_size,
                      .usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                               VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                      .sampled_aspect = VK_IMAGE_ASPECT_DEPTH_BIT},
                     "a caller's depth");
    });
    // The caller has drawn near things on the left and nothing on the right.
    const Buffer depths = stage.undisturbed([&] {
        std::vector<float> values(k_size.width * k_size.height, 0.0f);
        for (std::size_t i = 0; i < values.size(); ++i)
            if (i % k_size.width < k_size.width / 2) values[i] = 1.0f;
        Buffer buffer(stage.context(), values.size() * sizeof(float), BufferPlace::upload,
                      "a caller's depths");
        std::memcpy(buffer.mapped(), values.data(), values.size() * sizeof(float));
        return buffer;
    });
    const Scene scene = stage.scene();
    for (const PictureUse use : {PictureUse::whole, PictureUse::layer}) {
        PictureTarget target = picture.target();
        target.use = use;
        target.backdrop = BackdropDepth{
            .image = depth.handle(), .view = depth.sampled_view(), .format = VK_FORMAT_D32_SFLOAT};
        picture.show(stage, *renderer, scene, target, [&](Commands commands) {
            record_barrier(
                commands, {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE},
                {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                {{depth, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL}});
            const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 0, 1},
                                           .imageExtent = {k_size.width, k_size.height, 1}};
            commands->CmdCopyBufferToImage(commands, depths.handle(), depth.handle(),
                                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
            record_barrier(
                commands, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT},
                {VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT},
                {{depth, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                  VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL}});
        });
    }
}

RIMLINE_FAULT_SCENARIO("visible ratios") {
    const auto pass =
        stage.make<VisibleRatioPass>(stage.context(), std::cref(stage.models().knot.octree),
                                     VisibleRatioOptions{.side_px = 32, .budget_bytes = 1});
    const std::array<glm::dvec3, 4> eyes{{{3, 2, 1}, {-3, 1, 2}, {0, 4, 1}, {1, 1, -4}}};
    stage.show(stage.step([&] { return pass->mask(eyes[0]); }));
    for (const VisibleRatio& ratio : stage.step([&] { return pass->measure(eyes); }))
        stage.show(std::vector{ratio.visible_pixels, ratio.total_pixels});
}

RIMLINE_FAULT_SCENARIO("change sets") {
    const ScatterPass scatter(stage.undisturbed([&] { return ScatterPass(stage.context()); }));
    const Model& model = stage.models().knot;
    SilhouetteTracker tracker(model.octree, HomogeneousPoint::viewpoint({3, 2, 1}));
    const auto stream =
        stage.step([&] { return std::make_unique<ChangeStream>(stage.context(), model.mesh, 1); });
    for (int move = 0; move < 3; ++move) {
        const ChangeSet& changes = tracker.move_to(
            HomogeneousPoint::viewpoint({3, 2, 1.0f - 0.1f * static_cast<float>(move)}));
        // What failed may have been queued or not: only the whole state is sure to be right.
        bool repeated = false;
        stage.step([&] {
            if (std::exchange(repeated, true)) stream->invalidate();
            stream->begin_frame(0);
            if (!stream->apply(changes))
                stream->resend(tracker.sequence(), tracker.silhouette(), tracker.face_words());
            run_commands(stage.context(), [&](Commands commands) {
                ChangeStream::record_before(commands);
                stream->record(commands, scatter);
                ChangeStream::record_after(commands);
            });
        });
    }
    std::vector<std::uint32_t> words(tracker.face_words().size());
    stage.step([&] {
        read_buffer(stage.context(), stream->face_words(),
                    std::as_writable_bytes(std::span(words)));
    });
    CHECK(std::ranges::equal(words, tracker.face_words()));
    stage.show(words);
}

RIMLINE_FAULT_SCENARIO("face bits") {
    const auto pass = stage.make<FaceBitsPass>(stage.context());
    const Mesh& mesh = stage.models().knot.mesh;
    const HomogeneousPoint point = HomogeneousPoint::viewpoint({3, 2, 1});
    stage.show(stage.step([&] { return pass->compute(mesh.planes(), point); }));
}

// Overlapping frames are not for the cases above: a frame whose finish() fails is over.
TEST_CASE("frames that overlap survive failed submits, and what was queued before is finished") {
    RIMLINE_OPEN_GPU(gpu, &failing_loader);
    const FaultModels models;
    Stage stage(gpu->instance(), gpu->context(), models);
    const auto scene_at = [&](int frame) {
        Scene scene = stage.scene();
        scene.camera.eye.x += 0.05 * frame;
        return scene;
    };
    Renderer one_by_one(gpu->context(), k_faults_plain);
    std::array<Picture, 4> expected;
    for (int frame = 0; frame < 4; ++frame)
        expected[static_cast<std::size_t>(frame)] = one_by_one.render(scene_at(frame), 16, 16);
    std::uint64_t calls = 0;
    for (bool injected = true; injected; calls += 7) {
        CAPTURE(calls);
        Renderer renderer(gpu->context(), k_faults_plain);
        arm({.kind = FaultKind::failure, .call = calls, .result = calls});
        const auto submit = [&](int frame) {
            stage.step([&] { renderer.submit(scene_at(frame), 16, 16); });
        };
        submit(0);
        for (int frame = 0; frame < 4; ++frame) {
            if (frame < 3) submit(frame + 1);
            CHECK(renderer.finish().rgba == expected[static_cast<std::size_t>(frame)].rgba);
        }
        injected = disarm().injected;
    }
    CHECK(calls > 10);
}

TEST_CASE("the books of handles notice what is left and what never was") {
    RIMLINE_OPEN_GPU(gpu, &failing_loader);
    const auto before = live_objects();
    const VkSemaphoreCreateInfo info{.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    VkSemaphore semaphore = VK_NULL_HANDLE;
    REQUIRE(gpu->context().vk->CreateSemaphore(gpu->context().device, &info, nullptr, &semaphore) ==
            VK_SUCCESS);
    CHECK(live_objects().size() == before.size() + 1);
    gpu->context().vk->DestroySemaphore(gpu->context().device, semaphore, nullptr);
    CHECK(live_objects() == before);
    arm({.kind = FaultKind::failure, .call = 0, .result = 1});
    CHECK(gpu->context().vk->CreateSemaphore(gpu->context().device, &info, nullptr, &semaphore) ==
          VK_ERROR_OUT_OF_DEVICE_MEMORY);
    CHECK(semaphore == VK_NULL_HANDLE);
    CHECK(disarm().injected);
    CHECK(live_objects() == before);
}

}  // namespace
}  // namespace rimline::tests
