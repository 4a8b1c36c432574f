#pragma once

// rimline.Renderer: pictures, and the visible ratios that best_views() weighs with.

#include <pybind11/pybind11.h>

namespace rimline::python {

void bind_renderer(pybind11::module_& module);

}  // namespace rimline::python
