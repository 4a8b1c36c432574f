#pragma once

// The window's life: events, hand, panel, loader and renderer, frame after frame until it is closed.
//
// A frame is drawn only when there is something new to show. On devices that draw on the CPU it is drawn
// coarsely while something moves and finely when it rests.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/vulkan/vulkan_instance.h"
#include "tools/command.h"
#include "tools/view/hough_inspection.h"
#include "tools/view/hough_panel.h"
#include "tools/view/model_loader.h"
#include "tools/view/panel_context.h"
#include "tools/view/view_counters.h"
#include "tools/view/view_input.h"
#include "tools/view/view_panel.h"
#include "tools/view/view_session.h"
#include "tools/view/window.h"
#include "tools/view/window_renderer.h"

namespace rimline::tools {

struct ViewLoopOptions {
    std::string device;        ///< As --device names it.
    bool panel = true;         ///< Panel and handles; else nothing but the picture.
    bool inspector = false;    ///< Hough space open from the beginning.
    std::uint32_t frames = 0;  ///< Closes after so many; 0: when the user does.
    bool fits = true;          ///< Begins with the model filling what the panel leaves free.
};

class ViewLoop {
public:
    /// `instance` was made with the window's extensions; all of them, and `session` with a model to
    /// show, must outlive it.
    ViewLoop(Window& window, const VulkanInstance& instance, ViewSession& session,
             ViewLoopOptions options);
    ~ViewLoop();
    ViewLoop(const ViewLoop&) = delete;
    ViewLoop& operator=(const ViewLoop&) = delete;

    /// Runs until the window is closed, or `context` is interrupted. Throws Error where no frame can be
    /// drawn at all.
    void run(const Context& context);

    /// One turn: events, panel, and a frame where one is due or `always`. Returns whether one was drawn.
    bool turn(bool always);

    /// Opens a model as the panel does: on another thread, errors shown in the panel.
    void open(const std::string& model) { loader_.open(model); }
    bool is_loading() const { return loader_.stage().has_value(); }
    const std::string& message() const noexcept { return panel_.message; }

    WindowRenderer& renderer() noexcept { return renderer_; }
    /// Brings back what the window shows in the next frame; run() does with the last of its frames.
    void capture_next() noexcept { captures_ = true; }
    const Picture& captured() const noexcept { return captured_; }
    /// Whether the last frame was drawn coarsely, for something had moved a moment before.
    bool is_coarse() const noexcept { return is_coarse_; }

    /// Of the window's area that the panel leaves free: width over height.
    double free_aspect() const;

private:
    bool take_loaded();  // Whether there is something new to show.
    void take_keys();
    void serve(const PanelRequests& requests);
    void save(const PanelRequests::Save& save);
    void fit();
    void build_panel();
    bool draw();
    double waiting_time() const;
    std::uint32_t scale() const;

    Window& window_;
    ViewSession& session_;
    ViewLoopOptions options_;
    PanelContext context_;
    WindowRenderer renderer_;
    ModelLoader loader_;
    ViewPanel panel_;
    ViewInput hand_;
    HoughPanel hough_;
    std::optional<HoughInspection> inspection_;
    const ModelDocument* inspected_ = nullptr;
    ViewCounters counters_;
    PanelRequests requests_;
    Picture captured_;
    bool captures_ = false;
    bool moving_ = false;
    bool is_coarse_ = false;
    int frames_due_ = 0;
    std::uint32_t frames_of_model_ = 0;  // Drawn since it was opened.
    double last_change_s_ = 0.0;
};

}  // namespace rimline::tools
