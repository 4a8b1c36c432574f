#pragma once

// The lines of a model in a picture, with exact visibility: a line drawing (silhouette/lines/line_drawer.h) from
// the picture's camera, as the engine draws it.

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/camera.h"
#include "engine/picture_lines.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/lines/line_drawer.h"
#include "tools/command.h"
#include "tools/options/line_style.h"
#include "tools/options/option_types.h"
#include "tools/output/line_materials.h"

namespace rimline::tools {

class ShownLines {
public:
    /// Prepares the octree's mesh (LineSurface). `octree` must outlive this object.
    explicit ShownLines(const HoughOctree& octree,
                        LineSurface::Contacts contacts = LineSurface::Contacts::found,
                        const LongCall& call = {});
    /// With a surface of the octree's mesh that is there already. It must outlive this object.
    ShownLines(const HoughOctree& octree, const LineSurface& surface);

    const LineSurface& surface() const noexcept { return surface_; }

    /// The lines of a picture, valid until the next call. Null where the eye lies at the end of the range of
    /// coordinates, so that no point lies beside it. Throws Error{cancelled}.
    const PictureLines* draw(const Camera& camera, ImageSize size, const LineStyle& style,
                             const LongCall& call = {});

    /// The viewpoint or direction of the last picture.
    const HomogeneousPoint& point() const noexcept { return point_; }
    /// Silhouette edges and borders of the last picture, hidden ones too.
    std::uint32_t silhouette_count() const noexcept { return silhouette_count_; }
    /// Creases drawn as lines, on the silhouette or not.
    std::uint32_t crease_count() const noexcept { return crease_count_; }

private:
    void choose_creases(const LineStyle& style);
    void choose_colors(const LineStyle& style);
    void add_strokes(const LineDrawing& drawing);
    void add_hidden_lines(const LineDrawing& drawing, double min_length);
    void add_run(const LineDrawing& drawing, const StrokePart& run);
    void end_hidden_line(bool is_closed, double min_length);
    void end_line(bool is_hidden, bool is_closed);
    void add_part(std::size_t first, std::size_t last, bool is_hidden, bool is_closed);

    const HoughOctree& octree_;
    std::optional<LineSurface> own_surface_;
    const LineSurface& surface_;
    LineDrawer drawer_;
    std::vector<std::uint8_t> creases_;  // By edge, whether it is a crease that is drawn.
    double crease_degrees_ = 0.0;        // Of these.
    bool all_creases_ = false;
    LineMaterials materials_;
    bool has_colors_ = false;  // Whether lines have those of materials.
    HomogeneousPoint point_;   // Of the view.
    double simplify_ = 0.0;    // Of lines with colors, in picture coordinates.
    PictureLines lines_;
    // The line that is being made; of each point, the color of the line up to it (PictureLine::color).
    std::vector<LinePoint> points_;
    std::vector<std::uint32_t> colors_, kept_;
    std::uint32_t silhouette_count_ = 0, crease_count_ = 0;
};

/// The same with progress.
ShownLines prepare_lines(const HoughOctree& octree, const Context& context);

}  // namespace rimline::tools
