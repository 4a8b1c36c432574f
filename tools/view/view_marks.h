#pragma once

// Marks drawn over the picture: the handles of the lights, and the camera of a frozen silhouette.

#include <glm/vec2.hpp>
#include <optional>

#include "tools/view/view_session.h"

namespace rimline::tools {

/// From the edge of the free area, in the panel's unit: the place of handles of lights that lie outside of it.
constexpr double k_handle_margin = 26.0;

/// The upper left corner of a label of this size beside a mark: to its right, or to its left where the area has no room
/// at the right.
glm::dvec2 label_corner(const glm::dvec2& mark, const glm::dvec2& size, const FreeArea& area);

/// Draws into the background layer of the panel. Highlights the light `chosen`.
void draw_marks(const ViewSession& session, const FreeArea& area,
                std::optional<std::size_t> chosen);

/// The coordinate axes as the camera sees them, in the lower left corner of the area.
void draw_axes(const Camera& camera, const FreeArea& area);

}  // namespace rimline::tools
