#include "tools/bench/whole_drawing.h"

#include <chrono>
#include <vector>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/mesh/brute_force.h"
#include "tools/options/drawn_lines.h"
#include "tools/options/line_camera.h"
#include "tools/options/line_page.h"
#include "tools/output/drawing_file.h"
#include "tools/output/drawing_page.h"
#include "tools/output/page_lines.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

constexpr std::uint32_t k_faces_of_one_round = 1'000'000;

// Stops at the end of each part.
class PartClock {
public:
    double lap_ms() {
        const TimePoint now = std::chrono::steady_clock::now();
        const std::chrono::duration<double, std::milli> took = now - last_;
        last_ = now;
        return took.count();
    }

private:
    using TimePoint = std::chrono::steady_clock::time_point;
    TimePoint last_ = std::chrono::steady_clock::now();
};

// The steps of tools/commands/draw.cpp, but for the choice of a view.
WholeResult draw_once(const std::string& model, const Mesh& mesh, const LongCall& call) {
    WholeResult times;
    PartClock clock;
    const LinePage paper;
    const LineCamera camera = LineCameraOptions{}.make_camera(model, mesh);
    const ShownPart part = shown_part(camera, mesh, paper.aspect());
    const std::vector<ViewCell> cells{{part.low, part.high}};
    const DrawingPage page = place_views(paper, cells);
    times.text_ms = clock.lap_ms();

    const LineSurface surface(mesh, LineSurface::Contacts::found, call);
    times.surface_ms = clock.lap_ms();
    const std::vector<EdgeId> silhouette = brute_force_silhouette(mesh, camera.view.point());
    times.extraction_ms = clock.lap_ms();
    const DrawnLines lines;
    LineDrawer drawer(surface);
    const LineDrawing& drawing = drawer.draw(
        camera.view, silhouette, lines.line_options(page.views.front().mm_per_unit), call);
    times.drawing_ms = clock.lap_ms();

    PageDrawing on_page{.title = "Lines of " + model,
                        .size_mm = page.size_mm,
                        .lines = {},
                        .width_mm = lines.width_mm,
                        .hidden_width_mm = lines.hidden_width_mm,
                        .dashes_hidden = false,
                        .has_sources = false};
    add_page_lines(drawing, page.views.front(),
                   {.min_length_mm = lines.min_length_mm.value_or(DrawnLines::k_min_hidden_mm)},
                   on_page.lines);
    std::erase_if(on_page.lines, [](const PageLine& line) { return line.is_hidden; });
    times.text_bytes = drawing_svg(on_page).size();
    times.text_ms += clock.lap_ms();
    times.all_ms = times.surface_ms + times.extraction_ms + times.drawing_ms + times.text_ms;
    return times;
}

}  // namespace

WholeResult time_whole_drawing(const std::string& model, const Mesh& mesh, std::uint32_t rounds,
                               const Context& context) {
    Progress progress(context, "drawing " + model + " as a whole");
    std::vector<WholeResult> all;
    const bool is_large = mesh.face_count() > k_faces_of_one_round;
    if (!is_large) draw_once(model, mesh, progress.call());  // Warms up.
    for (std::uint32_t round = 0; round < (is_large ? 1 : rounds); ++round)
        all.push_back(draw_once(model, mesh, progress.call()));
    const auto median = [&](double WholeResult::*part) {
        std::vector<double> times;
        for (const WholeResult& result : all) times.push_back(result.*part);
        return quantile(times, 0.5);
    };
    return {.surface_ms = median(&WholeResult::surface_ms),
            .extraction_ms = median(&WholeResult::extraction_ms),
            .drawing_ms = median(&WholeResult::drawing_ms),
            .text_ms = median(&WholeResult::text_ms),
            .all_ms = median(&WholeResult::all_ms),
            .text_bytes = all.front().text_bytes};
}

}  // namespace rimline::tools
