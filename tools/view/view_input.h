#pragma once

// What the mouse and the keys do to the picture: turn, move, fly, drag lights. The panel takes its own
// part of them first.

#include <glm/vec2.hpp>
#include <optional>

#include "tools/view/view_session.h"

namespace rimline::tools {

class ViewInput {
public:
    /// Flying, the mouse looks around and W, A, S, D, Q and E move; else dragging turns around the
    /// target, with the right or middle button or Shift it moves the picture, and the wheel zooms.
    bool flies = false;

    /// Does to `session` what was done since the last frame, in a window of `size` units. Returns
    /// whether something is held or moves on by itself, so that another frame is wanted.
    bool apply(ViewSession& session, const glm::dvec2& size);

    /// The light under the mouse, or held by it.
    std::optional<std::size_t> light() const noexcept { return held_ ? held_ : hovered_; }

private:
    void take_light(ViewSession& session, const glm::dvec2& size);
    void move_camera(ViewSession& session, const glm::dvec2& size) const;
    bool fly_on(ViewSession& session) const;

    std::optional<std::size_t> hovered_;
    std::optional<std::size_t> held_;
    bool holds_picture_ = false;
};

}  // namespace rimline::tools
