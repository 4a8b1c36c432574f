#pragma once

// rimline.TangentialField, best_views(), camera_path() and best_light().

#include <pybind11/pybind11.h>

namespace rimline::python {

void bind_fields(pybind11::module_& module);

}  // namespace rimline::python
