#pragma once

// Which lines a picture shows.

#include <optional>

namespace rimline::tools {

struct LineStyle {
    double crease_degrees = 0.0;         ///< The least bend of creases; 0: none are drawn.
    bool all_creases = false;            ///< Not only those that stand out (clear_creases.h).
    bool intersections = false;          ///< Where faces pass through each other.
    bool hidden = false;                 ///< Hidden lines too.
    std::optional<double> min_length{};  ///< In pixels. Not set: by the height of the picture.
    /// Shades of the materials of faces (line_shade()), pale ones if true. Not set: one color for all lines.
    std::optional<bool> material_shades_are_light{};
};

}  // namespace rimline::tools
