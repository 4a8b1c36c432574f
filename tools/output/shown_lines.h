#pragma once

// The lines of a model in a picture, with exact visibility: a line drawing (silhouette/lines/line_drawer.h) from
// the picture's camera, as the engine draws it.

#include <cstdint>
#include <vector>

#include "engine/camera.h"
#include "engine/picture_lines.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/lines/line_drawer.h"
#include "tools/command.h"
#include "tools/options/option_types.h"
#include "tools/options/scene_options.h"

namespace rimline::tools {

class ShownLines {
public:
    /// Prepares the octree's mesh, with progress (LineSurface). `octree` must outlive this object.
    ShownLines(const HoughOctree& octree, const Context& context);

    /// The lines of a picture, valid until the next call. Null where the eye lies at the end of the range of
    /// coordinates, so that no point lies beside it. Throws Error{cancelled}.
    const PictureLines* draw(const Camera& camera, ImageSize size, const SceneOptions& style,
                             const Context& context);

    /// Silhouette edges and borders of the last picture, hidden ones too.
    std::uint32_t silhouette_count() const noexcept { return silhouette_count_; }
    /// Edges that are creases in it.
    std::uint32_t crease_count() const noexcept { return crease_count_; }

private:
    void find_clear_creases(float min_bend_rad);
    void add_strokes(const LineDrawing& drawing);
    void add_hidden_lines(const LineDrawing& drawing, double min_length);
    void add_run(const LineDrawing& drawing, std::uint32_t run, bool is_reversed);
    void end_hidden_line(bool is_closed, double min_length);
    void end_line(bool is_hidden, bool is_closed);

    const HoughOctree& octree_;
    LineSurface surface_;
    LineDrawer drawer_;
    std::vector<std::uint8_t> clear_creases_;  // By edge.
    float clear_angle_rad_ = -1.0f;            // Of clear_creases_; -1: of none yet.
    PictureLines lines_;
    std::uint32_t first_point_ = 0;  // Of the line that is being made.
    std::uint32_t silhouette_count_ = 0, crease_count_ = 0;
};

}  // namespace rimline::tools
