#pragma once

// Dear ImGui for one window: its input comes through GLFW, what it draws goes out as an OverlayDrawing.
//
//     begin_frame() --> ImGui:: calls --> end_frame() --> drawing()

#include "engine/passes/overlay_pass.h"
#include "tools/view/window.h"
#include "tools/view/window_renderer.h"

namespace rimline::tools {

class PanelContext {
public:
    /// One at a time, as long as the window. Letters are those of DejaVu Sans where that is installed,
    /// else the toolkit's own.
    explicit PanelContext(const Window& window);
    ~PanelContext();
    PanelContext(const PanelContext&) = delete;
    PanelContext& operator=(const PanelContext&) = delete;

    LetterTexture letters() const;

    void begin_frame();
    void end_frame();
    /// Of the last frame; valid until the next ends.
    const OverlayDrawing& drawing() const noexcept { return drawing_; }
    /// Pixels for each unit that panels are laid out in.
    float pixels_per_unit() const;

private:
    OverlayDrawing drawing_;
};

}  // namespace rimline::tools
