#pragma once

// rimline.Renderer: pictures, and the visible ratios that best_views() weighs with.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "engine/renderer.h"
#include "silhouette/field/best_views.h"
#include "tools/options/drawing_device.h"
#include "tools/output/shown_lines.h"
#include "tools/python/mesh.h"

namespace rimline::python {

/// A device and what is kept on it. Threads that share one take turns.
class PythonRenderer {
public:
    PythonRenderer(const std::string& device, bool validate);

    pybind11::array render(const SharedMesh& mesh, const pybind11::dict& keywords,
                           const pybind11::object& progress);
    /// Calls use(ratios) while no other thread uses the device. Without the interpreter's lock.
    void measure(PythonMesh& mesh, const LongCall& call,
                 const std::function<void(const VisibleRatios& ratios)>& use);

    std::string device_name() const { return device_->device.facts().name; }
    std::optional<std::uint32_t> validation_message_count() const {
        return device_->instance.validation_message_count();
    }

private:
    std::optional<tools::DrawingDevice> device_;
    std::mutex mutex_;
    // The renderer knows octrees by their addresses, those of the last picture and of one that failed after it. So these
    // meshes live until another picture has been drawn.
    std::vector<SharedMesh> meshes_;
    std::optional<tools::ShownLines> lines_;  // Of one of these.
    std::optional<Renderer> renderer_;
};

void bind_renderer(pybind11::module_& module);

}  // namespace rimline::python
