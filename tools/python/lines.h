#pragma once

// rimline.LineDrawer and LineDrawing.

#include <pybind11/pybind11.h>

namespace rimline::python {

void bind_lines(pybind11::module_& module);

}  // namespace rimline::python
