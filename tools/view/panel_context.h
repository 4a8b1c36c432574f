#pragma once

// Dear ImGui for one window. Its input comes from GLFW; its output is an OverlayDrawing.
//
//     begin_frame() --> ImGui:: calls --> end_frame() --> drawing()

#include "engine/passes/overlay_pass.h"
#include "tools/view/window.h"
#include "tools/view/window_renderer.h"

namespace rimline::tools {

class PanelContext {
public:
    /// At most one at a time. `window` must outlive it. The font is DejaVu Sans if it is installed, else the
    /// toolkit's own.
    explicit PanelContext(const Window& window);
    ~PanelContext();
    PanelContext(const PanelContext&) = delete;
    PanelContext& operator=(const PanelContext&) = delete;

    FontTexture font_texture() const;

    void begin_frame();
    void end_frame();
    /// The last frame's drawing. Valid until the next end_frame().
    const OverlayDrawing& drawing() const noexcept { return drawing_; }
    /// Pixels per unit of the panel layout.
    float pixels_per_unit() const;

private:
    OverlayDrawing drawing_;
};

}  // namespace rimline::tools
