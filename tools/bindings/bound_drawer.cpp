#include "tools/bindings/bound_drawer.h"

#include <algorithm>
#include <utility>

#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/clear_creases.h"
#include "tools/command.h"
#include "tools/options/model_argument.h"
#include "tools/output/page_lines.h"
#include "tools/output/pen_order.h"

namespace rimline::tools {

namespace {

const LineSurface& drawable_surface(BoundMesh& mesh, const LongCall& call) {
    if (!mesh.mesh().is_welded())
        throw UsageError("line drawings need a mesh whose equal positions are one vertex");
    check_has_extent(mesh.name(), mesh.mesh());
    return mesh.line_surface(call);
}

void check_options(const DrawOptions& options) {
    if (options.page.mm_per_unit && !options.camera.is_orthographic)
        throw UsageError("--scale: needs an orthographic view: --ortho");
    if (options.lines.hidden_by > 0 && !options.lines.draws_hidden())
        throw UsageError("--hidden-by: needs --hidden dashed or layer");
}

}  // namespace

DrawOptions::DrawOptions() {
    camera.add_to(app);
    page.add_to(app);
    lines.add_to(app);
    page.size_mm.reset();
}

BoundDrawer::BoundDrawer(SharedMesh mesh, const LongCall& call)
    : mesh_(std::move(mesh)), drawer_(drawable_surface(*mesh_, call)) {}

std::unique_ptr<BoundDrawing> BoundDrawer::draw(const DrawOptions& options, bool follows,
                                                const LongCall& call) {
    check_options(options);
    const Turns::Turn turn(turns_, call);
    const Mesh& mesh = mesh_->mesh();
    LineCameraOptions camera_options = options.camera;
    settle_up(mesh, camera_options.up, camera_options.is_up_auto, call.stop);
    camera_options.choose_view(mesh_->name(), mesh, call.part(0.0, 0.3));
    const LineCamera camera = camera_options.make_camera(mesh_->name(), mesh);
    const ShownPart part = shown_part(camera, mesh, options.page.aspect());
    const ViewCell cell{part.low, part.high, 0, 0};
    const DrawingPage page = place_views(options.page, {&cell, 1});
    const ViewPlace place = page.views.front();
    const DrawnLines& lines = options.lines;
    const glm::dvec2 sides_mm = place.mm_per_unit * (part.high - part.low);
    LineOptions line_options =
        lines.line_options(place.mm_per_unit, std::max(sides_mm.x, sides_mm.y));
    if (!lines.crease_degrees && lines.kinds[std::size_t(LineKind::crease)]) {
        if (creases_.empty())
            creases_ = clear_crease_flags(mesh, line_options.crease_angle_rad, call.stop);
        line_options.shown_creases = creases_;
    }

    std::optional<LineMaterials> materials;
    if (lines.has_material_colors) {
        materials.emplace(mesh);
        line_options.simplify = 0.0;  // Points that are left out would take their colors with them.
    }

    const LongCall drawn = call.part(0.3, 0.95);
    auto result = std::make_unique<BoundDrawing>(
        BoundDrawing{.drawing = draw_lines(camera.view, line_options, follows, drawn),
                     .page = empty_drawing(lines, "Lines of " + mesh_->name(), page.size_mm),
                     .place = place});
    PageLineOptions page_options = page_line_options(lines, part, page.size_mm, place.mm_per_unit);
    if (materials) {
        result->page.inks = materials->inks_on_paper();
        page_options.simplify_mm = lines.simplify_mm;
        page_options.materials = &*materials;
        page_options.point = camera.view.point();
    }
    add_page_lines(result->drawing, place, page_options, result->page.lines);
    call.checkpoint(1.0);
    if (!lines.draws_hidden())
        std::erase_if(result->page.lines, [](const PageLine& line) { return line.is_hidden; });
    order_for_pen(result->page.lines);
    return result;
}

const LineDrawing& BoundDrawer::draw_lines(const LineView& view, const LineOptions& options,
                                           bool follows, const LongCall& call) {
    // Where the call is cancelled, the next drawing begins anew.
    const std::optional<HomogeneousPoint> last = std::exchange(last_, std::nullopt);
    const LineDrawing* drawing = nullptr;
    if (follows && last) {
        if (!tracker_) tracker_.emplace(mesh_->octree(call), *last);
        if (!(tracker_->point() == *last)) tracker_->move_to(*last);
        const ChangeSet& changes = tracker_->move_to(view.point());
        drawing = &drawer_.draw_next(view, tracker_->silhouette(), changes, options, call);
    } else {
        drawing =
            &drawer_.draw(view, brute_force_silhouette(mesh_->mesh(), view.point()), options, call);
    }
    last_ = view.point();
    return *drawing;
}

}  // namespace rimline::tools
