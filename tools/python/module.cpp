// The extension module of the Python package rimline (rimline/__init__.py).

#include <pybind11/pybind11.h>

#include "tools/command.h"
#include "tools/options/line_kind_names.h"
#include "tools/python/errors.h"
#include "tools/python/fields.h"
#include "tools/python/lines.h"
#include "tools/python/long_calls.h"
#include "tools/python/mesh.h"
#include "tools/python/points.h"
#include "tools/python/renderer.h"
#include "tools/python/tracker.h"
#include "tools/python/unlocked.h"

namespace py = pybind11;

PYBIND11_MODULE(_rimline, module) {
    using namespace rimline::python;
    module.doc() = "Silhouettes of meshes and point clouds: found, kept up to date, drawn.";
    module.attr("__version__") = RIMLINE_VERSION;
    rimline::tools::be_quiet();  // What the command's parts would print.
    bind_errors(module);
    bind_unlocked();
    bind_long_calls(module);
    bind_mesh(module);
    bind_tracker(module);
    bind_lines(module);
    bind_renderer(module);
    bind_fields(module);
    bind_points(module);
    py::list kinds;
    for (const std::string_view name : rimline::tools::k_line_kind_names)
        kinds.append(std::string(name));
    module.attr("LINE_KINDS") = py::tuple(kinds);
}
