// rimline draw: the lines of a model, or of several, as a vector drawing.

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/common.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "silhouette/lines/line_drawer.h"
#include "silhouette/lines/line_oracle.h"
#include "silhouette/lines/line_surface.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/clear_creases.h"
#include "tools/command.h"
#include "tools/options/drawn_lines.h"
#include "tools/options/line_camera.h"
#include "tools/options/line_kind_names.h"
#include "tools/options/line_page.h"
#include "tools/options/model_list.h"
#include "tools/options/picture_options.h"
#include "tools/options/sheet_views.h"
#include "tools/output/drawing_file.h"
#include "tools/output/drawing_json.h"
#include "tools/output/json_vector.h"
#include "tools/output/output_file.h"
#include "tools/output/page_lines.h"
#include "tools/output/pen_order.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

// --verify takes a sample every so many mm on the page: a quarter of a pixel of a screen.
constexpr double k_verify_spacing_mm = 0.066;

// Of all views together.
struct DrawnTotals {
    std::size_t chains = 0, runs = 0;
    // Visible lines on the page. The borders of the picture divide some strokes and leave out others.
    std::size_t strokes = 0;
    LineReport report;
    // Lengths in mm on the page, by LineKind.
    std::array<double, k_line_kinds> visible{}, hidden{};
    double surface_ms = 0.0, silhouette_ms = 0.0, ms = 0.0;
    LineCheck check;  // Of --verify.

    void add(const LineCheck& other) {
        check.samples += other.samples;
        check.undecided += other.undecided;
        check.wrong += other.wrong;
        check.wrong_visibility += other.wrong_visibility;
        check.missing_edges += other.missing_edges;
        check.repeated_edges += other.repeated_edges;
        if (check.first_difference.empty()) check.first_difference = other.first_difference;
    }
    void add(const LineDrawing& drawing) {
        chains += drawing.chains.size();
        runs += drawing.runs.size();
        report.lines += drawing.report.lines;
        report.crossings += drawing.report.crossings;
        report.contacts += drawing.report.contacts;
        report.components += drawing.report.components;
        report.checks += drawing.report.checks;
        report.failed_checks += drawing.report.failed_checks;
        report.lines_by_rays += drawing.report.lines_by_rays;
        report.undecided_lines += drawing.report.undecided_lines;
    }
    void add(const PageLine& line) {
        if (!line.is_hidden) ++strokes;
        (line.is_hidden ? hidden : visible)[std::size_t(line.kind)] += line.length_mm();
    }
    static double sum(const std::array<double, k_line_kinds>& lengths) {
        double all = 0.0;
        for (const double length : lengths) all += length;
        return all;
    }
};

class DrawCommand final : public Command {
public:
    std::string name() const override { return "draw"; }
    std::string summary() const override {
        return "Draw the lines of a model, as SVG, PDF, DXF or JSON";
    }

    void add_options(CLI::App& app) override {
        // --scale is that of the page.
        models_.add_to(app, StandardInput::read,
                       {.scale = "--model-scale", .painted = "with --line-color material"});
        app.get_option("MODEL")->required();
        app.add_option("-o,--output", output_,
                       "Drawing to write: FILE.svg, .pdf, .dxf or .json; - is standard output")
            ->type_name("FILE")
            ->capture_default_str()
            ->group("Output");
        as_option_ = app.add_option("--as", standard_format_,
                                    "Format of a drawing that goes to standard output")
                         ->check(CLI::IsMember({"svg", "pdf", "dxf", "json"}))
                         ->capture_default_str()
                         ->group("Output");
        app.add_flag(
               "--source", has_sources_,
               "SVG: say of each path which chains (data-chain) and edges (data-edges) it is "
               "made of; edges are pairs of vertex numbers of the file, with --subdivide of the "
               "refined mesh; those of a later MODEL go on where the one before ends")
            ->group("Output");
        app.add_flag(
               "--verify", verifies_,
               "Count the faces in front of all lines by another method, in long double; exit "
               "3 if a count differs")
            ->group("Output");
        camera_.add_to(app);
        models_.add_to_camera(app);
        views_option_ = add_sheet_views(app, views_)->group("Camera");
        page_.add_to(app);
        lines_.add_to(app);
        app.footer(
            "Each line is visible exactly where no face hides it. --hidden shows the others.\n"
            "Lines are silhouettes, borders of open meshes, creases, and intersections of "
            "surfaces.\n\n"
            "Several models make a scene. --at, --turn, --model-scale, --paint and --up belong to "
            "the MODEL before\n"
            "them: first the model is scaled, then turned, then moved. Of a scene file, its models "
            "and one of its\n"
            "cameras are used; a camera with its own field of view shows what the picture of the "
            "file shows.\n\n"
            "Examples:\n"
            "  rimline draw bunny.obj -o bunny.svg\n"
            "  rimline draw part.stl --hidden dashed --views front,top,right,iso --scale 1:2 -o "
            "part.pdf\n"
            "  rimline draw table.obj lamp.obj --at 0,0.8,0 --lines silhouette,border -o room.svg\n"
            "  rimline draw shape:knot --ortho auto --page fit --lines silhouette -o knot.dxf");
    }

    ExitStatus run(const Context& context) override {
        models_.settle(camera_, {.first_camera = views_.empty(), .picture = false});
        check_options();
        // Half of a line lies outside of what it encloses.
        page_.margin_mm = std::max(page_.margin_mm, 0.5 * lines_.width_mm);
        const double aspect = picture_aspect();
        check_output(context, output_);
        if (as_option_->count() > 0 && output_ != k_standard_output)
            throw UsageError("--as: needs -o -, which is standard output");
        const std::optional<DrawingFormat> named =
            drawing_format_of(output_ == k_standard_output ? "." + standard_format_ : output_);
        if (!named)
            throw UsageError("-o: expected a name that ends in .svg, .pdf, .dxf or .json, not '" +
                             output_ + "'");
        const DrawingFormat format = *named;
        check_format(format);
        models_.check_output_is_no_input(output_);
        OutputFile file(output_);
        const TexturePictures textures =
            lines_.has_material_colors ? TexturePictures::read : TexturePictures::skip;
        const Mesh mesh = models_.load_mesh(camera_, {.textures = textures}, context);
        check_has_extent(models_.name(), mesh);
        context.checkpoint();

        choose_view(mesh, context);
        const std::vector<LineCamera> cameras = make_cameras(mesh);
        std::vector<ShownPart> parts;
        for (const LineCamera& camera : cameras) parts.push_back(shown_part(camera, mesh, aspect));
        const DrawingPage page =
            about_model(models_.name(), [&] { return place_views(page_, cells_of(parts)); });

        DrawnTotals totals;
        nlohmann::ordered_json views = nlohmann::ordered_json::array();
        PageDrawing drawing = about_model(models_.name(), [&] {
            return draw_views(context, mesh, cameras, parts, page, format, totals, views);
        });
        context.checkpoint();
        context.times.end("drawing lines");
        switch (format) {
            case DrawingFormat::svg: file.write(drawing_svg(drawing)); break;
            case DrawingFormat::pdf: file.write(drawing_pdf(drawing)); break;
            case DrawingFormat::dxf: file.write(drawing_dxf(drawing)); break;
            case DrawingFormat::json: file.write(drawing_text(page, std::move(views))); break;
        }
        context.checkpoint();
        file.commit();
        context.times.end("writing");
        if (totals.strokes == 0 &&
            (!lines_.draws_hidden() || DrawnTotals::sum(totals.hidden) == 0.0))
            print_warning(models_.name() +
                          ": the drawing is empty: no line of these kinds is on its page");
        if (context.json)
            print_result(context, mesh, cameras, page, totals);
        else
            print_summary(page, totals);
        return report_check(totals.check.first_difference.empty()
                                ? ""
                                : models_.name() + ": " + totals.check.first_difference);
    }

private:
    void check_options() const {
        const bool is_sheet = views_option_->count() > 0;
        if (is_sheet && (camera_.has_place() || !models_.camera_name().empty() || camera_.target ||
                         camera_.fov_degrees || camera_.ortho_height))
            throw UsageError(
                "--views: the views of a sheet are orthographic and show the whole model; leave "
                "--camera, --eye, --azimuth, --elevation, --target, --fov and a height of --ortho "
                "out");
        if (page_.mm_per_unit && !is_sheet && !camera_.is_orthographic)
            throw UsageError("--scale: needs an orthographic view: --ortho auto, or --views");
        if (!models_.has_scene_file() && models_.has_paint() && !lines_.has_material_colors)
            throw UsageError("--paint: lines have it only with --line-color material");
    }

    // Width over height of what a camera shows that is not placed to show the whole model: of the space on the page, or
    // with a camera of a scene file of the file's picture. Reports margins without space.
    double picture_aspect() const {
        const double of_page = page_.aspect();
        if (models_.camera_name().empty()) return of_page;
        const ImageSize size = models_.scene_size().value_or(PictureOptions().size);
        return double(size.width) / size.height;
    }

    std::string drawing_text(const DrawingPage& page, nlohmann::ordered_json views) const {
        nlohmann::ordered_json json = models_.json();
        json["page_mm"] = {page.size_mm.x, page.size_mm.y};
        json["views"] = std::move(views);
        return json_text(json) + "\n";
    }

    void check_format(DrawingFormat format) const {
        if (has_sources_ && format != DrawingFormat::svg)
            throw UsageError("--source: only drawings in SVG name edges");
        lines_.check_usage(has_curves(format));
    }

    static bool has_curves(DrawingFormat format) {
        return format == DrawingFormat::svg || format == DrawingFormat::pdf;
    }

    void choose_view(const Mesh& mesh, const Context& context) {
        if (!views_.empty()) return;
        Progress progress(context, "choosing the view");
        camera_.choose_view(models_.name(), mesh, progress.call());
        context.times.end("choosing the view");
    }

    std::vector<LineCamera> make_cameras(const Mesh& mesh) const {
        if (views_.empty()) return {camera_.make_camera(models_.name(), mesh)};
        std::vector<LineCamera> cameras;
        for (const SheetView view : views_)
            cameras.push_back(sheet_camera(view, mesh, camera_.up_of(mesh)));
        return cameras;
    }

    std::vector<ViewCell> cells_of(const std::vector<ShownPart>& parts) const {
        std::vector<ViewCell> cells;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const SheetCell cell = views_.empty() ? SheetCell{0, 0} : cell_of(views_[i]);
            cells.push_back({parts[i].low, parts[i].high, cell.column, cell.row});
        }
        return cells;
    }

    // Adds to `views` only if the format is JSON.
    PageDrawing draw_views(const Context& context, const Mesh& mesh,
                           const std::vector<LineCamera>& cameras,
                           const std::vector<ShownPart>& parts, const DrawingPage& page,
                           DrawingFormat format, DrawnTotals& totals,
                           nlohmann::ordered_json& views) const {
        Stopwatch watch;
        const LineSurface surface = [&] {
            Progress progress(context, "finding contacts of faces");
            return LineSurface(mesh, LineSurface::Contacts::found, progress.call());
        }();
        totals.surface_ms = watch.ms();
        context.times.end("contacts");

        PageDrawing drawing = empty_drawing(lines_, "Lines of " + models_.name(), page.size_mm);
        drawing.has_sources = has_sources_;
        std::optional<LineMaterials> materials;
        if (lines_.has_material_colors) {
            materials.emplace(mesh);
            drawing.inks = materials->inks_on_paper();
        }
        std::vector<std::uint8_t> clear_creases;
        if (!lines_.crease_degrees && lines_.kinds[std::size_t(LineKind::crease)])
            clear_creases =
                clear_crease_flags(mesh, lines_.line_options(1.0).crease_angle_rad, context.stop);
        LineDrawer drawer(surface);
        for (std::size_t i = 0; i < cameras.size(); ++i) {
            const LineCamera& camera = cameras[i];
            watch = Stopwatch();
            const std::vector<EdgeId> silhouette =
                brute_force_silhouette(mesh, camera.view.point());
            totals.silhouette_ms += watch.ms();
            context.checkpoint();

            const bool has_edges = has_sources_ && format == DrawingFormat::svg;
            const double mm_per_unit = page.views[i].mm_per_unit;
            const glm::dvec2 sides_mm = mm_per_unit * (parts[i].high - parts[i].low);
            LineOptions options =
                lines_.line_options(mm_per_unit, std::max(sides_mm.x, sides_mm.y));
            options.shown_creases = clear_creases;
            options.shapes_hidden = lines_.draws_hidden() || format == DrawingFormat::json;
            // Points that are left out would take their edges and colors with them.
            if (has_edges || materials) options.simplify = 0.0;
            if (verifies_) verify(context, mesh, camera, silhouette, page.views[i], drawer, totals);
            Progress progress(context, "drawing lines");
            watch = Stopwatch();
            const LineDrawing& lines =
                drawer.draw(camera.view, silhouette, options, progress.call());
            totals.ms += watch.ms();
            totals.add(lines);

            PageLineOptions page_options =
                page_line_options(lines_, parts[i], page.size_mm, mm_per_unit);
            if (has_edges || materials) page_options.simplify_mm = lines_.simplify_mm;
            if (!has_curves(format)) page_options.curve_mm = 0.0;
            // A JSON file has the strokes of the drawing, which are counted.
            if (format == DrawingFormat::json)
                page_options.visible_double_mm = page_options.hidden_stubble_mm = 0.0;
            if (has_edges) page_options.mesh = &mesh;
            if (materials) page_options.materials = &*materials;
            page_options.point = camera.view.point();
            add_page_lines(lines, page.views[i], page_options, drawing.lines);
            if (format == DrawingFormat::json) {
                nlohmann::ordered_json view = camera_json(camera);
                view.update(drawing_json(lines, mesh, page.views[i], page_options.frame));
                views.push_back(std::move(view));
            }
        }
        for (const PageLine& line : drawing.lines) totals.add(line);
        if (!lines_.draws_hidden())
            std::erase_if(drawing.lines, [](const PageLine& line) { return line.is_hidden; });
        order_for_pen(drawing.lines);
        return drawing;
    }

    // Of a drawing of its own: that of the file has joined and simplified lines.
    void verify(const Context& context, const Mesh& mesh, const LineCamera& camera,
                const std::vector<EdgeId>& silhouette, const ViewPlace& place, LineDrawer& drawer,
                DrawnTotals& totals) const {
        LineOptions options = checkable(lines_.line_options(place.mm_per_unit));
        options.draws[std::size_t(LineKind::silhouette)] = true;
        options.draws[std::size_t(LineKind::border)] = true;
        Progress progress(context, "verifying lines");
        const LineDrawing& all = drawer.draw(camera.view, silhouette, options, progress.call());
        totals.add(check_lines(mesh, camera.view, all, k_verify_spacing_mm / place.mm_per_unit,
                               progress.call()));
    }

    static nlohmann::ordered_json camera_json(const LineCamera& camera) {
        return {{"name", camera.name},
                {"eye", json_vector(camera.eye)},
                {"target", json_vector(camera.target)},
                {"up", json_vector(camera.up)},
                {"orthographic", camera.view.is_orthographic()}};
    }

    static nlohmann::ordered_json lengths_json(const std::array<double, k_line_kinds>& lengths) {
        nlohmann::ordered_json by_kind;
        for (std::size_t kind = 0; kind < k_line_kinds; ++kind)
            by_kind[std::string(k_line_kind_names[kind])] = lengths[kind];
        return by_kind;
    }

    void print_result(const Context& context, const Mesh& mesh,
                      const std::vector<LineCamera>& cameras, const DrawingPage& page,
                      const DrawnTotals& totals) const {
        const LineReport& report = totals.report;
        nlohmann::ordered_json views = nlohmann::ordered_json::array();
        for (const LineCamera& camera : cameras) views.push_back(camera_json(camera));
        nlohmann::ordered_json result = models_.json();
        result.update(nlohmann::ordered_json{{"faces", mesh.face_count()},
                                             {"lines", report.lines},
                                             {"chains", totals.chains},
                                             {"runs", totals.runs},
                                             {"strokes", totals.strokes},
                                             {"visible_length", DrawnTotals::sum(totals.visible)},
                                             {"hidden_length", DrawnTotals::sum(totals.hidden)},
                                             {"visible_lengths", lengths_json(totals.visible)},
                                             {"hidden_lengths", lengths_json(totals.hidden)},
                                             {"crossings", report.crossings},
                                             {"contacts", report.contacts},
                                             {"components", report.components},
                                             {"checks", report.checks},
                                             {"failed_checks", report.failed_checks},
                                             {"lines_by_rays", report.lines_by_rays},
                                             {"undecided_lines", report.undecided_lines},
                                             {"page", {page.size_mm.x, page.size_mm.y}},
                                             {"mm_per_unit", page.views.front().mm_per_unit},
                                             {"views", std::move(views)},
                                             {"surface_ms", totals.surface_ms},
                                             {"silhouette_ms", totals.silhouette_ms},
                                             {"ms", totals.ms},
                                             {"output", output_}});
        if (verifies_)
            result["verify"] = {{"samples", totals.check.samples},
                                {"undecided", totals.check.undecided},
                                {"wrong", totals.check.wrong},
                                {"wrong_visibility", totals.check.wrong_visibility},
                                {"missing_edges", totals.check.missing_edges},
                                {"repeated_edges", totals.check.repeated_edges}};
        print_json(context, std::move(result));
    }

    void print_summary(const DrawingPage& page, const DrawnTotals& totals) const {
        const LineReport& report = totals.report;
        std::printf("%s\n", output_.c_str());
        std::printf("  lines       %u edges in %zu chains, %zu strokes\n", report.lines,
                    totals.chains, totals.strokes);
        std::printf("  visible     %.0f mm\n", DrawnTotals::sum(totals.visible));
        std::printf("  hidden      %.0f mm%s\n", DrawnTotals::sum(totals.hidden),
                    lines_.draws_hidden() ? "" : ", not drawn");
        std::printf("  page        %.6g x %.6g mm", page.size_mm.x, page.size_mm.y);
        if (camera_.is_orthographic || !views_.empty())
            std::printf(", %.6g mm for each unit of the model", page.views.front().mm_per_unit);
        std::printf("\n  checks      %llu, of which %llu failed\n",
                    static_cast<unsigned long long>(report.checks),
                    static_cast<unsigned long long>(report.failed_checks));
        if (report.undecided_lines > 0)
            std::printf("  undecided   %u lines, of which rays could not tell what is seen\n",
                        report.undecided_lines);
        if (verifies_)
            std::printf("  verified    %llu samples, of which %llu undecided and %llu wrong\n",
                        static_cast<unsigned long long>(totals.check.samples),
                        static_cast<unsigned long long>(totals.check.undecided),
                        static_cast<unsigned long long>(totals.check.wrong));
        std::printf("  time        %.1f ms, and %.1f ms to prepare the model\n",
                    totals.silhouette_ms + totals.ms, totals.surface_ms);
    }

    ModelList models_;
    std::string output_ = "rimline.svg", standard_format_ = "svg";
    bool has_sources_ = false;
    bool verifies_ = false;
    LineCameraOptions camera_;
    std::vector<SheetView> views_;
    const CLI::Option *as_option_ = nullptr, *views_option_ = nullptr;
    LinePage page_;
    DrawnLines lines_;
};

}  // namespace

std::unique_ptr<Command> make_draw_command() { return std::make_unique<DrawCommand>(); }

}  // namespace rimline::tools
