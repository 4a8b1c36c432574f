#pragma once

// Marks drawn over the picture: the handles of the lights, and the camera of a frozen silhouette.

#include <glm/vec2.hpp>
#include <optional>

#include "tools/view/view_session.h"

namespace rimline::tools {

/// Draws into the background layer of the panel, in a window of `size` units. Highlights the light `chosen`.
void draw_marks(const ViewSession& session, const glm::dvec2& size,
                std::optional<std::size_t> chosen);

/// The coordinate axes as the camera sees them, in the lower left corner of the area.
void draw_axes(const Camera& camera, const FreeArea& area);

}  // namespace rimline::tools
