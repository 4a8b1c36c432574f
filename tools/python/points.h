#pragma once

// rimline.PointSurface and PointSilhouette.

#include <pybind11/pybind11.h>

namespace rimline::python {

void bind_points(pybind11::module_& module);

}  // namespace rimline::python
