#pragma once

// All Vulkan objects of a window: device, surface, swapchain, renderer and panel overlay. Keeps several
// frames in flight, and recovers from a lost device or surface. One frame:
//
//     wait for the last frame of the ring slot --> acquire an image
//         --> record the picture (Renderer for a model, SplatRenderer for a cloud), and keep it;
//             a coarse one is smaller than the window
//         --> copy it into the window, enlarged --> record the panel over it --> submit --> present
//
// While only the panel changes, frames show the kept picture. A fine picture of a view at rest is drawn beside it,
// without an image of the window, and takes its place when it is done; drawing it is given up as soon as something
// moves.
//
// After a loss all these objects are created again and the frame is drawn once more
// (engine/vulkan/device_loss.h). Mesh, octree and scene are not affected.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/clouds/splat_renderer.h"
#include "engine/passes/overlay_pass.h"
#include "engine/renderer.h"
#include "engine/vulkan/device_choice.h"
#include "engine/vulkan/device_context.h"
#include "engine/vulkan/vulkan_instance.h"
#include "tools/view/coarseness.h"
#include "tools/view/view_session.h"
#include "tools/view/window.h"

namespace rimline::tools {

/// The font of the panel: rows of opacities.
struct FontTexture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<std::uint8_t> opacity;
};

class WindowRenderer {
public:
    /// `instance` must have the window's extensions. `instance` and `window` must outlive this object.
    /// Throws Error{no_device} if no device that matches `device` can present in the window.
    WindowRenderer(const VulkanInstance& instance, const Window& window, std::string device,
                   FontTexture font);
    ~WindowRenderer();
    WindowRenderer(const WindowRenderer&) = delete;
    WindowRenderer& operator=(const WindowRenderer&) = delete;

    struct Frame {
        FrameReport report;  ///< Only of a model.
        Picture picture;     ///< What the window shows. Empty without `capture`.
    };
    /// Draws and presents a frame. The shadows of `quality` are those of `scene`. Returns nothing if the window has no
    /// size. With `capture` it waits for the frame and reads it back; Error{bad_input} where the window's pictures
    /// cannot be copied from. Throws what Renderer::record() throws; the next call then starts from new Vulkan objects.
    std::optional<Frame> draw(const ViewPicture& scene, const OverlayDrawing& overlay,
                              const FrameQuality& quality, bool capture = false);

    /// Whether the last picture can be shown again.
    bool has_kept_picture() const noexcept;
    /// Presents the last picture again, under another panel. Returns nothing if the window has no size, and after
    /// an error, which leaves no picture. has_kept_picture() must be true.
    std::optional<Frame> draw_kept(const OverlayDrawing& overlay, bool capture = false);

    /// What has become of a picture that is drawn beside the kept one.
    enum class Beside {
        done,      ///< It is the kept one now; draw_kept() shows it.
        given_up,  ///< Because it was not wanted any more. The kept one is still there.
        impossible,  ///< The window has another size, or after an error: draw() does what is to be done.
    };
    /// Draws a picture as draw() does, and shows nothing. While the device works, `is_wanted` is asked again and again;
    /// it should wait a few milliseconds for events. has_kept_picture() must be true.
    Beside draw_beside(const ViewPicture& scene, const FrameQuality& quality, FrameReport& report,
                       const std::function<bool()>& is_wanted);
    /// Draws a picture as draw_beside() does, and throws it away. The next one like it finds shaders compiled, images
    /// allocated and meshes uploaded: its first frame takes what all others take.
    void rehearse(const ViewPicture& scene, const FrameQuality& quality,
                  const std::function<bool()>& is_wanted);

    /// Draws a picture offscreen and without the panel, as `rimline render` and `points` do.
    Picture picture(const ViewPicture& scene, std::uint32_t width, std::uint32_t height);

    /// Destroys and creates all Vulkan objects, as after a loss.
    void recreate();
    /// Number of recreations so far.
    std::uint32_t recreation_count() const noexcept { return recreation_count_; }

    /// The present device, or the last one.
    const DeviceFacts& device_facts() const noexcept { return device_facts_; }

private:
    struct OnDevice;

    // `enlarges`: as a frame that shows it does.
    bool begin_beside(const ViewPicture& scene, const FrameQuality& quality, bool enlarges,
                      FrameReport& report);
    Beside finish_beside(const std::function<bool()>& is_wanted);
    // Without a scene, the kept picture.
    std::optional<Frame> draw_once(const ViewPicture* scene, const OverlayDrawing& overlay,
                                   const FrameQuality& quality, bool capture);

    const VulkanInstance* instance_;
    const Window* window_;
    std::string request_;
    FontTexture font_;
    std::unique_ptr<OnDevice> gpu_;  // Null after an error, until the next frame.
    DeviceFacts device_facts_;
    std::uint32_t recreation_count_ = 0;
};

}  // namespace rimline::tools
