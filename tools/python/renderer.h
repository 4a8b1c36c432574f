#pragma once

// rimline.Renderer: pictures, and the visible ratios that best_views() weighs with.

#include <pybind11/pybind11.h>

#include <memory>

namespace rimline::tools {
class BoundRenderer;
}

namespace rimline::python {

/// Throws TypeError naming `renderer` for anything but a rimline.Renderer.
std::shared_ptr<tools::BoundRenderer> renderer_of(const pybind11::object& renderer);

void bind_renderer(pybind11::module_& module);

}  // namespace rimline::python
