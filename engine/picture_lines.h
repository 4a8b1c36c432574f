#pragma once

// Lines of a picture whose visibility the caller knows: those of a LineDrawing, for example
// (silhouette/lines/line_drawing.h).
//
// The renderer draws them as it draws silhouette edges, with a width in pixels and round ends, but compares them
// with no depth. A hidden line has dashes along its whole length, around its corners: it begins and ends with a
// whole dash, and a closed one has no seam. For this its dashes and gaps become a little longer or shorter.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace rimline {

constexpr std::uint32_t k_own_line_color = 0xffffffffu;

struct PictureLine {
    std::uint32_t first_point, last_point;  ///< Of PictureLines::points: [first, last). Not empty.
    bool is_hidden = false;                 ///< Drawn in dashes, with Scene::hidden_line_strength.
    bool is_closed = false;                 ///< The last point goes on to the first.
    /// Index in PictureLines::colors, or k_own_line_color: that of the instance (Material::line_color).
    std::uint32_t color = k_own_line_color;
};

/// Points have the picture coordinates of Scene::camera, as LineView has them (silhouette/lines/line_view.h): x to
/// the right and y upwards, the target at (0, 0); tangents of angles, or units of the world where the camera is
/// orthographic. They are finite, and less than 10^30 pixels away (RIMLINE_CHECK).
struct PictureLines {
    std::vector<glm::dvec2> points;
    std::vector<PictureLine> lines;
    /// In linear light. Each costs one draw over the whole picture, and lies over those before it.
    std::vector<glm::vec3> colors = {};
};

}  // namespace rimline
