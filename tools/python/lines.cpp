#include "tools/python/lines.h"

#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>

#include "tools/bindings/bound_drawer.h"
#include "tools/command.h"
#include "tools/options/line_kind_names.h"
#include "tools/output/drawing_file.h"
#include "tools/output/output_file.h"
#include "tools/output/page_line.h"
#include "tools/python/arrays.h"
#include "tools/python/bound_class.h"
#include "tools/python/errors.h"
#include "tools/python/keywords.h"
#include "tools/python/long_calls.h"
#include "tools/python/mesh.h"
#include "tools/python/unlocked.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

using tools::BoundDrawer;
using tools::BoundDrawing;
using tools::PageLine;

std::unique_ptr<BoundDrawer> make_drawer(const py::object& mesh, const py::object& progress) {
    SharedMesh shared = mesh_of(mesh);
    std::unique_ptr<BoundDrawer> drawer;
    run_long(progress, [&](const LongCall& call) {
        drawer = std::make_unique<BoundDrawer>(std::move(shared), call);
    });
    return drawer;
}

std::unique_ptr<BoundDrawing> draw(BoundDrawer& drawer, const py::dict& keywords, bool follows,
                                   const py::object& progress) {
    tools::DrawOptions options;
    parse_keywords(options.app, keywords);
    auto drawing = long_result(
        progress, [&](const LongCall& call) { return drawer.draw(options, follows, call); });
    if (drawing->page.lines.empty() && !follows)
        warn("the drawing is empty: no line of these kinds is on its page");
    return drawing;
}

std::string_view kind_name(LineKind kind) { return tools::k_line_kind_names[std::size_t(kind)]; }

py::list lines_of(const BoundDrawing& drawing) {
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

// Points of strokes follow those of runs.
std::size_t points_of_runs(const LineDrawing& drawing) {
    return drawing.runs.empty() ? 0 : drawing.runs.back().last_point;
}

std::span<const LineSource> sources_of_runs(const LineDrawing& drawing) {
    return {drawing.sources.data(), points_of_runs(drawing)};
}

py::array source_edges(const LineDrawing& drawing) {
    std::vector<std::int64_t> edges;
    for (const LineSource& source : sources_of_runs(drawing))
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

void save(const BoundDrawing& drawing, const py::object& path) {
    const std::string name = path_of(path);
    const std::optional<tools::DrawingFormat> format = tools::drawing_format_of(name);
    if (!format || format == tools::DrawingFormat::json)
        throw tools::UsageError("path: expected a name that ends in .svg, .pdf or .dxf, not '" +
                                name + "'");
    const Unlocked unlocked;
    tools::OutputFile file(name);
    file.write(format == tools::DrawingFormat::svg   ? drawing_svg(drawing.page)
               : format == tools::DrawingFormat::pdf ? drawing_pdf(drawing.page)
                                                     : drawing_dxf(drawing.page));
    file.commit();
}

// A file's text, without Python's lock.
std::string text_of(std::string (*write)(const tools::PageDrawing&), const BoundDrawing& drawing) {
    const Unlocked unlocked;
    return write(drawing.page);
}

}  // namespace

void bind_lines(py::module_& module) {
    bound_class<BoundDrawing>(module, "LineDrawing",
                              "What a pen would draw of a mesh, and what is hidden.\n\n"
                              "Picture coordinates have x to the right and y upwards, with the "
                              "target at (0, 0): tangents of angles, or the model's units in an "
                              "orthographic view. Places on the page are in mm, y downwards.")
        .def_property_readonly("lines", &lines_of,
                               "The lines on the page, as rimline.Line: kind, hidden, closed and "
                               "points (N x 2 float64, mm).")
        .def_property_readonly(
            "page_mm",
            [](const BoundDrawing& d) {
                return py::make_tuple(d.page.size_mm.x, d.page.size_mm.y);
            },
            "Width and height of the page.")
        .def_property_readonly(
            "mm_per_unit", [](const BoundDrawing& d) { return d.place.mm_per_unit; },
            "Of picture coordinates.")
        .def_property_readonly(
            "origin_mm",
            [](const BoundDrawing& d) {
                return py::make_tuple(d.place.origin_mm.x, d.place.origin_mm.y);
            },
            "The place on the page of the picture coordinates (0, 0).")
        .def_property_readonly(
            "points",
            [](const py::object& self) {
                const LineDrawing& drawing = self.cast<const BoundDrawing&>().drawing;
                static_assert(sizeof(LinePoint) == 4 * sizeof(double));
                return array_over<double>(drawing.points.data(),
                                          {static_cast<py::ssize_t>(points_of_runs(drawing)), 4},
                                          self);
            },
            "P x 4 float64: x, y and depth in picture coordinates, and the length of the chain up "
            "to the point. A view.")
        .def_property_readonly(
            "source_edges", [](const BoundDrawing& d) { return source_edges(d.drawing); },
            "P int64: the edge of each point, a row of Mesh.edges; -1 on an intersection.")
        .def_property_readonly(
            "source_shares",
            [](const BoundDrawing& d) {
                std::vector<float> shares;
                for (const LineSource& source : sources_of_runs(d.drawing))
                    shares.push_back(source.share);
                return copied<float>(std::span<const float>(shares));
            },
            "P float32: its place on the edge, 0 to 1 from the first vertex to the second.")
        .def_property_readonly(
            "runs", [](const BoundDrawing& d) { return runs_of(d.drawing); },
            "R x 4 uint32: chain, points [first, last), and the least number of "
            "faces in front; 0: visible.")
        .def_property_readonly(
            "chains", [](const BoundDrawing& d) { return chains_of(d.drawing); },
            "C x 5 uint32: runs [first, last), id, kind (row of LINE_KINDS), closed.")
        .def_property_readonly(
            "report", [](const BoundDrawing& d) { return report_of(d.drawing); },
            "What was done, and the checks of the result.")
        .def(
            "to_svg", [](const BoundDrawing& d) { return text_of(tools::drawing_svg, d); },
            "The text of an SVG file.")
        .def(
            "to_pdf",
            [](const BoundDrawing& d) { return py::bytes(text_of(tools::drawing_pdf, d)); },
            "The bytes of a PDF file.")
        .def(
            "to_dxf", [](const BoundDrawing& d) { return text_of(tools::drawing_dxf, d); },
            "The text of a DXF file.")
        .def("save", &save, py::arg("path"),
             "Writes an .svg, .pdf or .dxf file, whole or not at all.")
        .def("_repr_svg_", [](const BoundDrawing& d) { return text_of(tools::drawing_svg, d); })
        .def("__repr__", [](const BoundDrawing& d) {
            return "<rimline.LineDrawing of " + std::to_string(d.page.lines.size()) + " lines>";
        });

    bound_class<BoundDrawer>(module, "LineDrawer",
                             "Draws the lines of a mesh from a camera, with exact visibility.")
        .def(py::init(&make_drawer), py::arg("mesh"), py::kw_only(),
             py::arg("progress") = py::none(),
             "Finds the contacts of faces, about a microsecond a face; once a mesh.")
        .def(
            "draw",
            [](BoundDrawer& self, const py::object& progress, const py::kwargs& options) {
                return draw(self, options, false, progress);
            },
            py::kw_only(), py::arg("progress") = py::none(),
            "Draws from a camera. The keywords are the options of `rimline draw`: eye (a point or "
            "the name of a view), azimuth, elevation, target, up, fov, ortho, lines, crease, "
            "hidden, hidden_by, gap, min_length, stubble, smooth, "
            "simplify, curve, width, hidden_width, line_color, keep_coincident, page, margin, "
            "scale. What is not given is as with the command, but for page: 'fit', as large as the "
            "drawing.")
        .def(
            "draw_next",
            [](BoundDrawer& self, const py::object& progress, const py::kwargs& options) {
                return draw(self, options, true, progress);
            },
            py::kw_only(), py::arg("progress") = py::none(),
            "The next frame of a moving camera: the same drawing, but chains keep the ids of the "
            "drawing before.");
}

}  // namespace rimline::python
