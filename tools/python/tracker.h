#pragma once

// rimline.ChangeSet, Tracker and SilhouetteService.

#include <pybind11/pybind11.h>

namespace rimline::python {

void bind_tracker(pybind11::module_& module);

}  // namespace rimline::python
