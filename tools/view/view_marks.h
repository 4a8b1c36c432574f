#pragma once

// What is drawn over the picture to be seen and taken: the lights' handles, and the point that a frozen
// silhouette is seen from.

#include <glm/vec2.hpp>
#include <optional>

#include "tools/view/view_session.h"

namespace rimline::tools {

/// Draws into the panel's background, in a window of `size` units. The light `chosen` stands out.
void draw_marks(const ViewSession& session, const glm::dvec2& size,
                std::optional<std::size_t> chosen);

}  // namespace rimline::tools
