#include "tools/python/lines.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/lines/line_drawer.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/clear_creases.h"
#include "tools/options/drawn_lines.h"
#include "tools/options/line_camera.h"
#include "tools/options/line_kind_names.h"
#include "tools/options/line_page.h"
#include "tools/options/model_argument.h"
#include "tools/output/drawing_file.h"
#include "tools/output/output_file.h"
#include "tools/output/page_lines.h"
#include "tools/python/arrays.h"
#include "tools/python/keywords.h"
#include "tools/python/long_calls.h"
#include "tools/python/mesh.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

using tools::PageLine;

struct PythonDrawing {
    LineDrawing drawing;
    tools::PageDrawing page;
    tools::ViewPlace place;
};

// The options of `rimline draw`, but for those of files.
struct DrawKeywords {
    DrawKeywords() {
        camera.add_to(app);
        page.add_to(app);
        lines.add_to(app);
        page.size_mm.reset();  // As large as the drawing.
    }

    CLI::App app;
    tools::LineCameraOptions camera;
    tools::LinePage page;
    tools::DrawnLines lines;
};

class PythonLineDrawer {
public:
    PythonLineDrawer(SharedMesh mesh, const py::object& progress) : mesh_(std::move(mesh)) {
        if (!mesh_->mesh().is_welded())
            throw py::value_error("mesh: line drawings need a mesh with weld=True");
        run_long(progress, [&](const LongCall& call) {
            tools::check_has_extent(mesh_->name(), mesh_->mesh());
            drawer_.emplace(mesh_->line_surface(call));
        });
    }

    /// `follows`: chains keep their ids from the last drawing on.
    std::unique_ptr<PythonDrawing> draw(const py::dict& keywords, bool follows,
                                        const py::object& progress) {
        DrawKeywords options;
        parse_keywords(options.app, keywords);
        if (options.page.mm_per_unit && !options.camera.is_orthographic)
            throw py::value_error("scale: needs an orthographic view: ortho='auto' or a height");
        if (options.lines.has_material_colors)
            throw py::value_error("line_color: drawings from Python have one color");
        if (options.lines.hidden_by > 0 && !options.lines.draws_hidden())
            throw py::value_error("hidden_by: needs hidden='dashed' or hidden='layer'");
        return long_result(progress, [&](const LongCall& call) {
            const std::lock_guard lock(mutex_);
            return draw(options, follows, call);
        });
    }

private:
    std::unique_ptr<PythonDrawing> draw(const DrawKeywords& options, bool follows,
                                        const LongCall& call) {
        const Mesh& mesh = mesh_->mesh();
        const tools::LineCamera camera = options.camera.make_camera(mesh_->name(), mesh);
        const tools::ShownPart part = shown_part(camera, mesh, options.page.aspect());
        const tools::ViewCell cell{part.low, part.high, 0, 0};
        const tools::DrawingPage page = place_views(options.page, {&cell, 1});
        const tools::ViewPlace place = page.views.front();
        const glm::dvec2 sides_mm = place.mm_per_unit * (part.high - part.low);
        LineOptions line_options =
            options.lines.line_options(place.mm_per_unit, std::max(sides_mm.x, sides_mm.y));
        if (!options.lines.crease_degrees && options.lines.kinds[std::size_t(LineKind::crease)]) {
            if (creases_.empty())
                creases_ = clear_crease_flags(mesh, line_options.crease_angle_rad);
            line_options.shown_creases = creases_;
        }

        auto result = std::make_unique<PythonDrawing>();
        result->drawing =
            follows && last_
                ? draw_next(camera.view, line_options, call)
                : drawer_->draw(camera.view, brute_force_silhouette(mesh, camera.view.point()),
                                line_options, call);
        last_ = camera.view.point();
        result->place = place;
        result->page = {.title = "Lines of " + mesh_->name(),
                        .size_mm = page.size_mm,
                        .lines = {},
                        .width_mm = options.lines.width_mm,
                        .hidden_width_mm = options.lines.hidden_width_mm,
                        .dashes_hidden = options.lines.hidden == "dashed",
                        .has_sources = false,
                        .color = options.lines.color.value_or(tools::Color{0, 0, 0})};
        tools::PageLineOptions page_options{.min_length_mm = options.lines.min_length_mm.value_or(
                                                tools::DrawnLines::k_min_hidden_mm),
                                            .curve_mm = options.lines.curve_mm,
                                            .frame = {}};
        if (options.lines.hidden_by > 0) page_options.hidden_by = options.lines.hidden_by;
        if (part.is_cut) page_options.frame = {part.low, part.high};
        add_page_lines(result->drawing, place, page_options, result->page.lines);
        if (!options.lines.draws_hidden())
            std::erase_if(result->page.lines, [](const PageLine& line) { return line.is_hidden; });
        return result;
    }

    const LineDrawing& draw_next(const LineView& view, const LineOptions& options,
                                 const LongCall& call) {
        if (!tracker_) tracker_.emplace(mesh_->octree(call), *last_);
        if (!(tracker_->point() == *last_)) tracker_->move_to(*last_);
        const ChangeSet& changes = tracker_->move_to(view.point());
        last_.reset();  // Where the call is cancelled, the next drawing begins anew.
        return drawer_->draw_next(view, tracker_->silhouette(), changes, options, call);
    }

    SharedMesh mesh_;
    std::mutex mutex_;
    std::optional<LineDrawer> drawer_;
    std::optional<SilhouetteTracker> tracker_;
    std::optional<HomogeneousPoint> last_;  // Of the last drawing.
    std::vector<std::uint8_t> creases_;
};

std::string_view kind_name(LineKind kind) { return tools::k_line_kind_names[std::size_t(kind)]; }

py::list lines_of(const PythonDrawing& drawing) {
    py::list lines;
    const py::object make = py::module_::import("rimline").attr("Line");
    for (const PageLine& line : drawing.page.lines)
        lines.append(make(std::string(kind_name(line.kind)), line.is_hidden, line.is_closed,
                          copied<double>(std::span<const glm::dvec2>(line.points), 2)));
    return lines;
}

py::array runs_of(const LineDrawing& drawing) {
    std::vector<std::array<std::uint32_t, 4>> rows;
    for (const LineRun& run : drawing.runs)
        rows.push_back({run.chain, run.first_point, run.last_point, run.hidden_by});
    return copied<std::uint32_t>(std::span<const std::array<std::uint32_t, 4>>(rows), 4);
}

py::array chains_of(const LineDrawing& drawing) {
    std::vector<std::array<std::uint32_t, 5>> rows;
    for (const LineChain& chain : drawing.chains)
        rows.push_back({chain.first_run, chain.last_run, chain.id, std::uint32_t(chain.kind),
                        chain.is_closed ? 1u : 0u});
    return copied<std::uint32_t>(std::span<const std::array<std::uint32_t, 5>>(rows), 5);
}

py::array source_edges(const LineDrawing& drawing) {
    std::vector<std::int64_t> edges;
    for (const LineSource& source : drawing.sources)
        edges.push_back(source.edge == k_no_edge ? -1 : std::int64_t{index(source.edge)});
    return copied<std::int64_t>(std::span<const std::int64_t>(edges));
}

py::dict report_of(const LineDrawing& drawing) {
    const LineReport& report = drawing.report;
    py::dict result;
    result["lines"] = report.lines;
    result["crossings"] = report.crossings;
    result["contacts"] = report.contacts;
    result["components"] = report.components;
    result["checks"] = report.checks;
    result["failed_checks"] = report.failed_checks;
    result["lines_by_rays"] = report.lines_by_rays;
    result["undecided_lines"] = report.undecided_lines;
    return result;
}

void save(const PythonDrawing& drawing, const py::object& path) {
    const std::string name = path_of(path);
    const tools::DrawingFormat format = tools::drawing_format_of(name);
    if (format == tools::DrawingFormat::json)
        throw py::value_error("path: expected a name that ends in .svg, .pdf or .dxf");
    const py::gil_scoped_release unlocked;
    tools::OutputFile file(name);
    file.write(format == tools::DrawingFormat::svg   ? drawing_svg(drawing.page)
               : format == tools::DrawingFormat::pdf ? drawing_pdf(drawing.page)
                                                     : drawing_dxf(drawing.page));
    file.commit();
}

}  // namespace

void bind_lines(py::module_& module) {
    py::class_<PythonDrawing>(module, "LineDrawing",
                              "What a pen would draw of a mesh, and what is hidden.\n\n"
                              "Picture coordinates have x to the right and y upwards, with the "
                              "target at (0, 0): tangents of angles, or the model's units in an "
                              "orthographic view. Places on the page are in mm, y downwards.")
        .def_property_readonly("lines", &lines_of,
                               "The lines on the page, as rimline.Line: kind, hidden, closed and "
                               "points (N x 2 float64, mm).")
        .def_property_readonly(
            "page_mm",
            [](const PythonDrawing& d) {
                return py::make_tuple(d.page.size_mm.x, d.page.size_mm.y);
            },
            "Width and height of the page.")
        .def_property_readonly(
            "mm_per_unit", [](const PythonDrawing& d) { return d.place.mm_per_unit; },
            "Of picture coordinates.")
        .def_property_readonly(
            "origin_mm",
            [](const PythonDrawing& d) {
                return py::make_tuple(d.place.origin_mm.x, d.place.origin_mm.y);
            },
            "The place on the page of the picture coordinates (0, 0).")
        .def_property_readonly(
            "points",
            [](const py::object& self) {
                const auto& points = self.cast<const PythonDrawing&>().drawing.points;
                static_assert(sizeof(LinePoint) == 4 * sizeof(double));
                return array_over<double>(points.data(),
                                          {static_cast<py::ssize_t>(points.size()), 4}, self);
            },
            "P x 4 float64: x, y and depth in picture coordinates, and the length of the chain up "
            "to the point. A view.")
        .def_property_readonly(
            "source_edges", [](const PythonDrawing& d) { return source_edges(d.drawing); },
            "P int64: the edge of each point, a row of Mesh.edges; -1 on an intersection.")
        .def_property_readonly(
            "source_shares",
            [](const PythonDrawing& d) {
                std::vector<float> shares;
                for (const LineSource& source : d.drawing.sources) shares.push_back(source.share);
                return copied<float>(std::span<const float>(shares));
            },
            "P float32: its place on the edge, 0 to 1 from the first vertex to the second.")
        .def_property_readonly(
            "runs", [](const PythonDrawing& d) { return runs_of(d.drawing); },
            "R x 4 uint32: chain, points [first, last), and the least number of "
            "faces in front; 0: visible.")
        .def_property_readonly(
            "chains", [](const PythonDrawing& d) { return chains_of(d.drawing); },
            "C x 5 uint32: runs [first, last), id, kind (row of LINE_KINDS), closed.")
        .def_property_readonly(
            "report", [](const PythonDrawing& d) { return report_of(d.drawing); },
            "What was done, and the checks of the result.")
        .def("to_svg", [](const PythonDrawing& d) { return tools::drawing_svg(d.page); })
        .def("to_pdf", [](const PythonDrawing& d) { return py::bytes(tools::drawing_pdf(d.page)); })
        .def("to_dxf", [](const PythonDrawing& d) { return tools::drawing_dxf(d.page); })
        .def("save", &save, py::arg("path"),
             "Writes an .svg, .pdf or .dxf file, whole or not at all.")
        .def("_repr_svg_", [](const PythonDrawing& d) { return tools::drawing_svg(d.page); })
        .def("__repr__", [](const PythonDrawing& d) {
            return "<rimline.LineDrawing of " + std::to_string(d.page.lines.size()) + " lines>";
        });

    py::class_<PythonLineDrawer>(module, "LineDrawer",
                                 "Draws the lines of a mesh from a camera, with exact visibility.")
        .def(py::init<SharedMesh, const py::object&>(), py::arg("mesh").none(false), py::kw_only(),
             py::arg("progress") = py::none(),
             "Finds the contacts of faces, about a microsecond a face; once a mesh.")
        .def(
            "draw",
            [](PythonLineDrawer& self, const py::object& progress, const py::kwargs& options) {
                return self.draw(options, false, progress);
            },
            py::kw_only(), py::arg("progress") = py::none(),
            "Draws from a camera. The keywords are the options of `rimline draw`: eye, target, up, "
            "fov, ortho, lines, crease, hidden, hidden_by, gap, min_length, stubble, smooth, "
            "simplify, curve, width, hidden_width, line_color, keep_coincident, page, margin, "
            "scale.")
        .def(
            "draw_next",
            [](PythonLineDrawer& self, const py::object& progress, const py::kwargs& options) {
                return self.draw(options, true, progress);
            },
            py::kw_only(), py::arg("progress") = py::none(),
            "The next frame of a moving camera: the same drawing, but chains keep the ids of the "
            "drawing before.");
}

}  // namespace rimline::python
