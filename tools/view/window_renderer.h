#pragma once

// Everything of Vulkan that a window needs: device, surface, swapchain, renderer, panel; frames in
// flight, and the way back when the device or the surface is lost.
//
//     wait until the ring slot's last frame is done --> acquire --> the picture (Renderer::record, of a
//         cloud SplatRenderer::record)
//         --> the panel over it --> submit --> present
//
// A lost device takes all of this with it, but no mesh, octree or scene: it is made again and the frame
// drawn once more (engine/vulkan/device_loss.h).

#include <vulkan/vulkan.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/clouds/splat_renderer.h"
#include "engine/passes/overlay_pass.h"
#include "engine/renderer.h"
#include "engine/vulkan/device.h"
#include "engine/vulkan/vulkan_instance.h"
#include "tools/view/view_session.h"
#include "tools/view/window.h"

namespace rimline::tools {

/// The panel's letters: rows of opacities.
struct LetterTexture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> opacity;
};

class WindowRenderer {
public:
    /// `instance`, made with the window's extensions, and `window` must outlive it. Throws
    /// Error{no_device} where `device` names none that can show pictures in the window.
    WindowRenderer(const VulkanInstance& instance, const Window& window, std::string device,
                   LetterTexture letters);
    ~WindowRenderer();
    WindowRenderer(const WindowRenderer&) = delete;
    WindowRenderer& operator=(const WindowRenderer&) = delete;

    struct Drawn {
        FrameReport report;  ///< Of a model.
        Picture shown;       ///< What the window shows, where it was asked for.
    };
    /// Draws and presents a frame of `scale` x `scale` samples a pixel (RendererOptions). Nothing where
    /// the window has no size. `capture` waits for the frame and brings it back. Throws what
    /// Renderer::record() does, after which the next frame is as good as the first.
    std::optional<Drawn> draw(const ViewPicture& scene, const OverlayDrawing& overlay,
                              std::uint32_t scale, bool capture = false);

    /// Draws a picture apart from the window, without the panel, as `rimline render` and `points` do.
    Picture picture(const ViewPicture& scene, std::uint32_t width, std::uint32_t height);

    /// Makes everything again, as after a loss.
    void remake();
    /// How often that was done.
    std::uint32_t remade() const noexcept { return remade_; }

    /// Of the device that is drawn with, or was last.
    const DeviceFacts& device_facts() const noexcept { return device_facts_; }

private:
    struct OnDevice;

    std::optional<Drawn> draw_once(const ViewPicture& scene, const OverlayDrawing& overlay,
                                   std::uint32_t scale, bool capture);

    const VulkanInstance* instance_;
    const Window* window_;
    std::string request_;
    LetterTexture letters_;
    std::unique_ptr<OnDevice> gpu_;  // Null after an error, until the next frame.
    DeviceFacts device_facts_;
    std::uint32_t remade_ = 0;
};

}  // namespace rimline::tools
