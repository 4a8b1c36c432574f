#pragma once

// The inspector's window: Hough space in three dimensions. The view can be turned and zoomed. Colors tell
// what is inside the v-sphere, what is outside, and what is tested face by face.

#include <array>

#include "engine/camera.h"
#include "tools/view/hough_inspection.h"

namespace rimline::tools {

class HoughPanel {
public:
    bool open = false;

    /// Shows `inspection` if `open`. `x`, `y`, `width` and `height` are the window's place and size, in units of the
    /// panel. It goes there when they change.
    void draw(const HoughInspection& inspection, float x, float y, float width, float height);

private:
    Camera camera_{.eye = {1.6, 1.1, 2.6}, .target = {0, 0, 0}, .up = {0, 1, 0}, .fov_y_deg = 38.0};
    std::array<float, 4> place_{};
    bool shows_points_ = true;
    bool shows_sphere_ = true;
    bool shows_tested_ = true;
    bool shows_settled_ = false;
};

}  // namespace rimline::tools
