#include "tools/view/window_renderer.h"

#include <array>
#include <cstring>
#include <utility>
#include <variant>

#include "engine/picture_readback.h"
#include "engine/tested_device.h"
#include "engine/vulkan/commands.h"
#include "engine/vulkan/device_loss.h"
#include "engine/vulkan/image_barrier.h"
#include "engine/vulkan/memory.h"
#include "tools/options/cache_folder.h"

namespace rimline::tools {

namespace {

constexpr std::uint32_t k_ring_slots = RendererOptions{}.frames_in_flight;

constexpr StageAccess k_drawing{
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr StageAccess k_enlarging{VK_PIPELINE_STAGE_2_BLIT_BIT,
                                  VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr StageAccess k_copying{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr VkImageLayout k_drawn = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
// Presentation waits for a semaphore, which orders all later accesses.
constexpr StageAccess k_no_access{VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE};

}  // namespace

// Members are in the order of their dependencies.
struct WindowRenderer::OnDevice {
    struct RingSlot {
        VkCommandBuffer commands = VK_NULL_HANDLE;  // All but what uses the swapchain's image:
        VkCommandBuffer picture = VK_NULL_HANDLE;
        OwnedFence done;
        Buffer pixels;  // The captured picture; `picture` writes it.
    };

    OnDevice(const VulkanInstance& instance, const Window& window, const std::string& request,
             const FontTexture& font)
        : surface(window.make_surface(instance)),
          device(instance, request, user_cache_folder(), surface.get()),
          swapchain(device.context(), surface.get(), k_ring_slots),
          overlay(device.context(), swapchain.format(), k_ring_slots),
          pool(make_command_pool(device.context(), "the window", device.context().queue_family)),
          goes_on(device.context(), sizeof(std::uint32_t), BufferPlace::upload,
                  "whether a frame goes on") {
        overlay.set_texture(font.width, font.height, font.opacity);
        for (RingSlot& slot : ring) {
            slot.commands = make_commands(device.context(), pool);
            slot.picture = make_commands(device.context(), pool);
            slot.done = make_fence(device.context(), VK_FENCE_CREATE_SIGNALED_BIT);
        }
    }
    ~OnDevice() {
        // Returns on a lost device too.
        (void)repeat_wait(
            [&] { return device.context().vk->DeviceWaitIdle(device.context().device); });
    }
    OnDevice(const OnDevice&) = delete;
    OnDevice& operator=(const OnDevice&) = delete;

    void wait_for(const RingSlot& slot) const { wait_for_fence(device.context(), slot.done); }
    void wait_for_all() const {
        for (const RingSlot& slot : ring) wait_for(slot);
    }

    PictureTarget shown_target() const;
    PictureTarget kept_target(VkExtent2D extent) { return target_of(kept, extent); }
    struct WindowPicture;
    void record_kept(Commands commands) { record_enlarged(commands, kept, shown_target()); }
    // Leaves `to` as an attachment.
    void record_enlarged(Commands commands, WindowPicture& picture, const PictureTarget& to);
    void set_goes_on(std::uint32_t value) { std::memcpy(goes_on.mapped(), &value, sizeof value); }
    void record_overlay(Commands commands, std::uint32_t ring_slot, const OverlayDrawing& drawing);
    void make_renderer(const ViewPicture& scene, std::uint32_t scale);
    UploadPoint prepare(const ViewPicture& scene, const PictureTarget& target);
    FrameReport record_scene(Commands commands, Commands picture, const ViewPicture& scene,
                             const PictureTarget& target);
    // The size of a picture of the window.
    VkExtent2D picture_extent(const FrameQuality& quality) const;
    void prepare_size(VkExtent2D extent, const FrameQuality& quality);
    // Into the kept picture, or where windows cannot be copied to, into the window.
    UploadPoint record_picture(const RingSlot& slot, Commands picture, const ViewPicture& scene,
                               const FrameQuality& quality, FrameReport& report);
    // Of a frame that shows the kept picture again, only `picture` is submitted.
    void submit(const RingSlot& slot, const std::optional<UploadPoint>& uploaded);

    WindowSurface surface;
    TestedDevice device;
    Swapchain swapchain;
    // One of the two, by the kind of the document. Both identify what they drew by its address, which a
    // later object may reuse.
    std::unique_ptr<Renderer> renderer;
    std::unique_ptr<SplatRenderer> splat_renderer;
    OverlayPass overlay;
    OwnedCommandPool pool;
    std::array<RingSlot, k_ring_slots> ring;
    std::uint64_t frames = 0;
    VkExtent2D last_extent{};  // The size of the renderer's targets.
    std::uint32_t last_scale = 0;
    // A picture without the panel; a coarse one is smaller than the window.
    struct WindowPicture {
        VkImageUsageFlags copying = VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        Image image;
        VkExtent2D extent{};
        VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    };
    // Waits for all frames where it has another size.
    PictureTarget target_of(WindowPicture& picture, VkExtent2D extent);
    WindowPicture kept;    // The last one.
    WindowPicture beside;  // The one that takes its place when it is done.
    bool has_kept = false;
    WindowPicture rehearsed{VK_IMAGE_USAGE_TRANSFER_DST_BIT};  // Nobody sees it.
    Buffer goes_on;  // A FrameCondition: whether the picture beside is still wanted.
};

PictureTarget WindowRenderer::OnDevice::shown_target() const {
    return {.image = swapchain.image(),
            .view = swapchain.view(),
            .format = swapchain.format(),
            .extent = swapchain.extent()};
}

PictureTarget WindowRenderer::OnDevice::target_of(WindowPicture& picture, VkExtent2D extent) {
    if (picture.extent.width != extent.width || picture.extent.height != extent.height) {
        wait_for_all();
        picture = {picture.copying};
        picture.image = Image(device.context(),
                              {.format = swapchain.format(),
                               .extent = extent,
                               .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | picture.copying},
                              "the window's picture");
        picture.extent = extent;
    }
    picture.layout = k_drawn;
    return {.image = picture.image.handle(),
            .view = picture.image.attachment_view(),
            .format = swapchain.format(),
            .extent = extent};
}

void WindowRenderer::OnDevice::record_enlarged(Commands commands, WindowPicture& picture,
                                               const PictureTarget& to) {
    constexpr VkImageLayout k_source = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    constexpr VkImageLayout k_enlarged = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    const VkImageLayout layout = picture.layout;
    const PictureTarget from = target_of(picture, picture.extent);
    record_barrier(commands, k_drawing, k_enlarging,
                   {{from, layout, k_source}, {to, VK_IMAGE_LAYOUT_UNDEFINED, k_enlarged}});
    picture.layout = k_source;
    const auto corner = [](VkExtent2D extent) {
        return VkOffset3D{static_cast<std::int32_t>(extent.width),
                          static_cast<std::int32_t>(extent.height), 1};
    };
    constexpr VkImageSubresourceLayers k_color{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    const VkImageBlit region{.srcSubresource = k_color,
                             .srcOffsets = {{}, corner(from.extent)},
                             .dstSubresource = k_color,
                             .dstOffsets = {{}, corner(to.extent)}};
    commands->CmdBlitImage(commands, from.image, k_source, to.image, k_enlarged, 1, &region,
                           VK_FILTER_LINEAR);
    record_barrier(commands, k_enlarging, k_drawing, {{to, k_enlarged, k_drawn}});
}

void WindowRenderer::OnDevice::record_overlay(Commands commands, std::uint32_t ring_slot,
                                              const OverlayDrawing& drawing) {
    // The panel blends with the complete picture.
    record_barrier(commands, k_drawing, k_drawing);
    const VkRenderingAttachmentInfo color{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                          .imageView = swapchain.view(),
                                          .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                          .loadOp = VK_ATTACHMENT_LOAD_OP_LOAD,
                                          .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                               .renderArea = {{0, 0}, swapchain.extent()},
                               .layerCount = 1,
                               .colorAttachmentCount = 1,
                               .pColorAttachments = &color};
    commands->CmdBeginRendering(commands, &info);
    overlay.record(commands, ring_slot, drawing, swapchain.extent());
    commands->CmdEndRendering(commands);
}

void WindowRenderer::OnDevice::make_renderer(const ViewPicture& scene, std::uint32_t scale) {
    const bool is_model = std::holds_alternative<Scene>(scene);
    if (is_model ? !renderer : !splat_renderer) {
        wait_for_all();
        renderer.reset();
        splat_renderer.reset();
        if (is_model)
            renderer =
                std::make_unique<Renderer>(device.context(), RendererOptions{.pass_times = true});
        else
            splat_renderer = std::make_unique<SplatRenderer>(device.context());
    }
    if (renderer) renderer->set_scale(scale);
    if (splat_renderer) splat_renderer->set_scale(scale);
}

UploadPoint WindowRenderer::OnDevice::prepare(const ViewPicture& scene,
                                              const PictureTarget& target) {
    if (const Scene* model = std::get_if<Scene>(&scene)) return renderer->prepare(*model, target);
    return splat_renderer->prepare(std::get<SplatScene>(scene), target);
}

FrameReport WindowRenderer::OnDevice::record_scene(Commands commands, Commands picture,
                                                   const ViewPicture& scene,
                                                   const PictureTarget& target) {
    if (const Scene* model = std::get_if<Scene>(&scene))
        return renderer->record(commands, picture, *model, target);
    splat_renderer->record(commands, picture, std::get<SplatScene>(scene), target);
    return {};
}

VkExtent2D WindowRenderer::OnDevice::picture_extent(const FrameQuality& quality) const {
    const std::uint32_t divisor = swapchain.can_be_copied_to() ? quality.divisor : 1;
    const VkExtent2D window_extent = swapchain.extent();
    return {(window_extent.width + divisor - 1) / divisor,
            (window_extent.height + divisor - 1) / divisor};
}

void WindowRenderer::OnDevice::prepare_size(VkExtent2D extent, const FrameQuality& quality) {
    if (extent.width != last_extent.width || extent.height != last_extent.height ||
        quality.scale != last_scale)
        wait_for_all();
    last_extent = extent;
    last_scale = quality.scale;
}

UploadPoint WindowRenderer::OnDevice::record_picture(const RingSlot& slot, Commands picture,
                                                     const ViewPicture& scene,
                                                     const FrameQuality& quality,
                                                     FrameReport& report) {
    const bool keeps = swapchain.can_be_copied_to();
    const VkExtent2D extent = picture_extent(quality);
    prepare_size(extent, quality);
    make_renderer(scene, quality.scale);
    has_kept = false;
    const PictureTarget target = keeps ? kept_target(extent) : shown_target();
    const UploadPoint uploaded = prepare(scene, target);
    const Commands commands = begin_commands(device.context(), slot.commands);
    report = record_scene(commands, picture, scene, target);
    vk_check(commands->EndCommandBuffer(commands), "vkEndCommandBuffer");
    has_kept = keeps;
    return uploaded;
}

void WindowRenderer::OnDevice::submit(const RingSlot& slot,
                                      const std::optional<UploadPoint>& uploaded) {
    const VkFence fence = slot.done;
    vk_check(device.context().vk->ResetFences(device.context().device, 1, &fence), "vkResetFences");
    if (uploaded) {
        // What does not use the swapchain's image does not wait for it.
        Submission scene{.queue = device.context().queue, .commands = slot.commands};
        if (uploaded->value > 0) scene.waits.push_back(*uploaded);
        submit_commands(device.context(), scene);
    }
    submit_commands(device.context(), {.queue = device.context().queue,
                                       .commands = slot.picture,
                                       .waits = {{swapchain.acquired(), 0, k_drawing.stages}},
                                       .signal = swapchain.drawn(),
                                       .fence = fence});
}

WindowRenderer::WindowRenderer(const VulkanInstance& instance, const Window& window,
                               std::string device, FontTexture font)
    : instance_(&instance),
      window_(&window),
      request_(std::move(device)),
      font_(std::move(font)),
      gpu_(std::make_unique<OnDevice>(instance, window, request_, font_)),
      device_facts_(gpu_->device.facts()) {}

WindowRenderer::~WindowRenderer() = default;

void WindowRenderer::recreate() {
    gpu_.reset();  // First: a window has at most one surface.
    gpu_ = std::make_unique<OnDevice>(*instance_, *window_, request_, font_);
    device_facts_ = gpu_->device.facts();
    ++recreation_count_;
}

std::optional<WindowRenderer::Frame> WindowRenderer::draw(const ViewPicture& scene,
                                                          const OverlayDrawing& overlay,
                                                          const FrameQuality& quality,
                                                          bool capture) {
    for (int losses = 0;; ++losses) {
        try {
            if (!gpu_ || losses > 0) recreate();
            return draw_once(&scene, overlay, quality, capture);
        } catch (const Error& error) {
            // A lost surface is reported as no_device. Other errors, as a lack of memory, would repeat. They
            // leave the acquired image and its semaphore in an unknown state, so the next frame creates all
            // objects again.
            const bool is_lost =
                error.code() == ErrorCode::device_lost || error.code() == ErrorCode::no_device;
            if (is_lost && losses < k_max_device_losses) continue;
            gpu_.reset();
            throw;
        } catch (...) {
            gpu_.reset();
            throw;
        }
    }
}

bool WindowRenderer::has_kept_picture() const noexcept { return gpu_ && gpu_->has_kept; }

std::optional<WindowRenderer::Frame> WindowRenderer::draw_kept(const OverlayDrawing& overlay,
                                                               bool capture) {
    try {
        return draw_once(nullptr, overlay, {}, capture);
    } catch (const std::exception&) {
        gpu_.reset();  // The next frame begins anew, and tells what repeats.
        return std::nullopt;
    }
}

std::optional<WindowRenderer::Frame> WindowRenderer::draw_once(const ViewPicture* scene,
                                                               const OverlayDrawing& overlay,
                                                               const FrameQuality& quality,
                                                               bool capture) {
    const auto ring_slot = static_cast<std::uint32_t>(gpu_->frames % k_ring_slots);
    OnDevice::RingSlot& slot = gpu_->ring[ring_slot];
    gpu_->wait_for(slot);
    if (!gpu_->swapchain.acquire(ring_slot, window_->size_px())) return std::nullopt;
    if (capture && !gpu_->swapchain.can_be_copied_from())
        throw Error(
            ErrorCode::bad_input,
            "the window's picture cannot be saved: the device does not let programs copy from the "
            "pictures of this window");
    const PictureTarget shown = gpu_->shown_target();
    Frame frame{};
    const Commands picture = begin_commands(gpu_->device.context(), slot.picture);
    std::optional<UploadPoint> uploaded;
    if (scene) uploaded = gpu_->record_picture(slot, picture, *scene, quality, frame.report);
    if (gpu_->has_kept) gpu_->record_kept(picture);
    gpu_->record_overlay(picture, ring_slot, overlay);
    constexpr VkImageLayout k_copied = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
    constexpr VkImageLayout k_shown = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
    if (capture) {
        slot.pixels = make_picture_buffer(gpu_->device.context(), shown.extent);
        record_barrier(picture, k_drawing, k_copying, {{shown, k_drawn, k_copied}});
        record_read_back(picture, shown.image, shown.extent, slot.pixels);
        record_barrier(picture, k_copying, k_no_access, {{shown, k_copied, k_shown}});
    } else {
        record_barrier(picture, k_drawing, k_no_access, {{shown, k_drawn, k_shown}});
    }
    vk_check(picture->EndCommandBuffer(picture), "vkEndCommandBuffer");
    gpu_->submit(slot, uploaded);
    ++gpu_->frames;
    gpu_->swapchain.present();
    if (capture) {
        gpu_->wait_for(slot);
        frame.picture = read_picture(slot.pixels, shown.extent, shown.format);
    }
    return frame;
}

WindowRenderer::Beside WindowRenderer::draw_beside(const ViewPicture& scene,
                                                   const FrameQuality& quality, FrameReport& report,
                                                   const std::function<bool()>& is_wanted) {
    try {
        if (!begin_beside(scene, quality, false, report)) return Beside::impossible;
        const Beside became = finish_beside(is_wanted);
        if (became == Beside::done) std::swap(gpu_->kept, gpu_->beside);
        return became;
    } catch (const std::exception&) {
        gpu_.reset();
        return Beside::impossible;
    }
}

void WindowRenderer::rehearse(const ViewPicture& scene, const FrameQuality& quality,
                              const std::function<bool()>& is_wanted) {
    try {
        FrameReport report;
        if (begin_beside(scene, quality, true, report)) finish_beside(is_wanted);
    } catch (const std::exception&) {
        gpu_.reset();  // The next frame begins anew, and tells what repeats.
    }
}

// Returns false where the window's size is not that of its images.
bool WindowRenderer::begin_beside(const ViewPicture& scene, const FrameQuality& quality,
                                  bool enlarges, FrameReport& report) {
    const VkExtent2D size = window_->size_px();
    const VkExtent2D extent = gpu_->swapchain.extent();
    if (size.width != extent.width || size.height != extent.height) return false;
    // One that was given up may still use its image.
    gpu_->wait_for_all();
    OnDevice::RingSlot& slot = gpu_->ring[gpu_->frames % k_ring_slots];
    const VkExtent2D picture_extent = gpu_->picture_extent(quality);
    gpu_->prepare_size(picture_extent, quality);
    gpu_->make_renderer(scene, quality.scale);
    PictureTarget target = gpu_->target_of(gpu_->beside, picture_extent);
    const DeviceContext& context = gpu_->device.context();
    if (context.features.conditional_rendering)
        target.condition = FrameCondition{gpu_->goes_on.handle(), 0};
    gpu_->set_goes_on(1);
    const UploadPoint uploaded = gpu_->prepare(scene, target);
    const Commands commands = begin_commands(context, slot.commands);
    report = gpu_->record_scene(commands, commands, scene, target);
    if (enlarges)
        gpu_->record_enlarged(commands, gpu_->beside, gpu_->target_of(gpu_->rehearsed, extent));
    vk_check(commands->EndCommandBuffer(commands), "vkEndCommandBuffer");
    const VkFence fence = slot.done;
    vk_check(context.vk->ResetFences(context.device, 1, &fence), "vkResetFences");
    Submission submission{.queue = context.queue, .commands = slot.commands, .fence = fence};
    if (uploaded.value > 0) submission.waits.push_back(uploaded);
    submit_commands(context, submission);
    ++gpu_->frames;
    return true;
}

WindowRenderer::Beside WindowRenderer::finish_beside(const std::function<bool()>& is_wanted) {
    const VkFence done = gpu_->ring[(gpu_->frames - 1) % k_ring_slots].done;
    while (!is_signaled(gpu_->device.context(), done)) {
        if (is_wanted()) continue;
        gpu_->set_goes_on(0);
        return Beside::given_up;
    }
    return Beside::done;
}

Picture WindowRenderer::picture(const ViewPicture& scene, std::uint32_t width,
                                std::uint32_t height) {
    if (!gpu_) recreate();
    gpu_->wait_for_all();
    // This picture has another size, so the next frame must recreate the renderer's targets.
    gpu_->last_extent = {};
    gpu_->make_renderer(scene, RendererOptions{}.scale);
    if (const Scene* model = std::get_if<Scene>(&scene))
        return gpu_->renderer->render(*model, width, height);
    return gpu_->splat_renderer->render(std::get<SplatScene>(scene), width, height);
}

}  // namespace rimline::tools
