#pragma once

// Mouse and keyboard input in the picture: orbit, pan, zoom, fly, drag lights. Input that the panel uses is
// ignored here.

#include <glm/vec2.hpp>
#include <optional>

#include "tools/view/view_session.h"
#include "tools/view/window.h"

namespace rimline::tools {

class ViewInput {
public:
    /// True: dragging turns the view, and W, A, S, D, Q and E move the camera. False: dragging orbits around
    /// the document's center or, after the user has panned or flown, around what is in the middle of the free area;
    /// with the right or middle button or with Shift it pans. The wheel zooms in both modes.
    bool flies = false;

    /// Whether the picture shows the whole document, also while it is orbited, until the user pans, zooms or flies.
    bool is_framed = false;

    /// Applies the input since the last frame to `session`, in a window with this free area. `has_handles`: the handles
    /// of lights are shown. `press`: the last one since then; what the mouse moved before it drags nothing. Returns whether
    /// another frame is needed: a drag or a flight is in progress.
    bool apply(ViewSession& session, const FreeArea& area, bool has_handles,
               const std::optional<Window::MousePress>& press);

    /// The light that is dragged, else the light under the mouse.
    std::optional<std::size_t> light() const noexcept {
        return dragged_light_ ? dragged_light_ : hovered_light_;
    }

private:
    void move_lights(ViewSession& session, const FreeArea& area);
    void move_camera(ViewSession& session, const FreeArea& area, const glm::dvec2& moved);
    bool move_flight(ViewSession& session);

    std::optional<std::size_t> hovered_light_;
    std::optional<std::size_t> dragged_light_;
    bool drags_picture_ = false;
    bool has_own_target_ = false;  // The user has panned or flown.
};

}  // namespace rimline::tools
