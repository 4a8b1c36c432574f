#pragma once

// Line drawings of a mesh for other languages, with the options of `rimline draw`.

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/lines/line_drawer.h"
#include "tools/bindings/bound_mesh.h"
#include "tools/options/drawn_lines.h"
#include "tools/options/line_camera.h"
#include "tools/options/line_page.h"
#include "tools/output/drawing_file.h"
#include "tools/output/drawing_page.h"

namespace rimline::tools {

/// The options of camera, lines and page. The page is as large as the drawing if it is not given.
struct DrawOptions {
    DrawOptions();

    CLI::App app;  ///< Parses into the others.
    LineCameraOptions camera;
    LinePage page;
    DrawnLines lines;
};

struct BoundDrawing {
    LineDrawing drawing;
    PageDrawing page;
    ViewPlace place;  ///< Of picture coordinates on the page.
};

/// Threads that share one take turns.
class BoundDrawer {
public:
    /// Throws UsageError for a mesh that is not welded, Error{bad_input} for one without extent, Error{cancelled}.
    BoundDrawer(SharedMesh mesh, const LongCall& call);

    /// `follows`: chains keep their ids from the last drawing on (LineDrawer::draw_next()). Throws UsageError for
    /// options that do not go together, and as LineDrawer.
    std::unique_ptr<BoundDrawing> draw(const DrawOptions& options, bool follows,
                                       const LongCall& call);

private:
    const LineDrawing& draw_lines(const LineView& view, const LineOptions& options, bool follows,
                                  const LongCall& call);

    SharedMesh mesh_;
    Turns turns_;
    LineDrawer drawer_;
    std::optional<SilhouetteTracker> tracker_;
    std::optional<HomogeneousPoint> last_;  // Of the last drawing.
    std::vector<std::uint8_t> creases_;
};

}  // namespace rimline::tools
