#include "tools/python/renderer.h"

#include <pybind11/stl.h>
#include <unistd.h>

#include <algorithm>
#include <memory>

#include "engine/vulkan/device.h"
#include "silhouette/picture.h"
#include "tools/bindings/bound_renderer.h"
#include "tools/output/output_file.h"
#include "tools/output/picture_file.h"
#include "tools/python/arrays.h"
#include "tools/python/bound_class.h"
#include "tools/python/keywords.h"
#include "tools/python/long_calls.h"
#include "tools/python/mesh.h"

namespace rimline::python {

namespace py = pybind11;

using tools::BoundRenderer;

namespace {

std::shared_ptr<BoundRenderer> make_renderer(const py::object& device, const py::object& validate) {
    const std::string device_name =
        py::isinstance<py::int_>(device) ? std::string(py::str(device)) : word_of(device, "device");
    const bool validates = flag_of(validate, "validate");
    // A stop leaves the device to be opened and closed.
    return long_result_apart(py::none(), [=](const LongCall&) {
        // A child of fork() has none of the device's threads: closing it would wait for them.
        const auto close = [opened_by = getpid()](const BoundRenderer* renderer) {
            if (getpid() == opened_by) delete renderer;
        };
        return std::shared_ptr<BoundRenderer>(new BoundRenderer(device_name, validates), close);
    });
}

py::array render(const py::object& self, const py::object& mesh_object, const py::dict& keywords,
                 const py::object& progress) {
    const std::shared_ptr<BoundRenderer> renderer = renderer_of(self);
    const SharedMesh mesh = mesh_of(mesh_object);
    const auto options = std::make_shared<tools::RenderOptions>();
    parse_keywords(options->app, keywords);
    const Picture picture = long_result_apart(
        progress, [=](const LongCall& call) { return renderer->render(mesh, *options, call); });
    py::array_t<std::uint8_t> pixels(
        std::vector<py::ssize_t>{py::ssize_t(picture.height), py::ssize_t(picture.width), 4});
    std::ranges::copy(picture.rgba, pixels.mutable_data());
    return pixels;
}

// Raises what render() would raise for them, whatever the mesh.
void check_scene_options(const py::dict& keywords) {
    tools::RenderOptions options;
    parse_keywords(options.app, keywords);
}

using Pixels = py::array_t<std::uint8_t, py::array::c_style>;

Pixels pixels_of(const py::object& picture) {
    if (!py::isinstance<py::array_t<std::uint8_t>>(picture))
        throw py::type_error(
            "picture: expected an array of uint8, not " +
            py::str(py::getattr(picture, "dtype", py::type::of(picture))).cast<std::string>());
    Pixels pixels(picture);
    if (pixels.ndim() != 3 || pixels.shape(2) != 4 || pixels.size() == 0)
        throw py::value_error("picture: expected the shape (H, W, 4), not " +
                              py::str(picture.attr("shape")).cast<std::string>());
    return pixels;
}

// Needs no lock of the interpreter.
Picture picture_of(const Pixels& pixels, const LongCall& call) {
    Picture picture{.width = std::uint32_t(pixels.shape(1)),
                    .height = std::uint32_t(pixels.shape(0))};
    picture.rgba.reserve(std::size_t(pixels.size()));
    const std::size_t row_size = std::size_t{4} * picture.width;
    for (std::uint32_t y = 0; y < picture.height; ++y) {
        call.checkpoint(0.0);
        const std::uint8_t* row = pixels.data() + row_size * y;
        picture.rgba.insert(picture.rgba.end(), row, row + row_size);
        for (std::size_t i = 3; i < row_size && !picture.has_alpha; i += 4)
            picture.has_alpha = row[i] != 255;
    }
    return picture;
}

py::bytes png_of(const py::object& picture) {
    const Pixels pixels = pixels_of(picture);
    const std::vector<std::byte> bytes = long_result(py::none(), [&](const LongCall& call) {
        return encode_png(picture_of(pixels, call), call);
    });
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void save_png(const py::object& picture, const py::object& path) {
    const Pixels pixels = pixels_of(picture);
    const std::string name = path_of(path);
    run_long(py::none(), [&](const LongCall& call) {
        tools::OutputFile file(name);
        tools::write_png(file, picture_of(pixels, call), call);
    });
}

py::list devices() {
    const VulkanInstance instance;
    py::list names;
    for (const DeviceFacts& facts : describe_devices(instance))
        names.append(py::make_tuple(facts.name, name_of(facts.type), judge_device(facts).lacks));
    return names;
}

}  // namespace

std::shared_ptr<BoundRenderer> renderer_of(const py::object& renderer) {
    if (!py::isinstance<BoundRenderer>(renderer))
        throw py::type_error(std::string("renderer: expected a rimline.Renderer, not ") +
                             Py_TYPE(renderer.ptr())->tp_name);
    renderer.cast<const BoundRenderer&>();  // TypeError where it was not made.
    return renderer.cast<std::shared_ptr<BoundRenderer>>();
}

void bind_renderer(py::module_& module) {
    bound_class<BoundRenderer, std::shared_ptr<BoundRenderer>>(
        module, "Renderer",
        "Draws pictures on a Vulkan device. Threads that share one take "
        "turns.")
        .def(py::init(&make_renderer), py::arg("device") = "", py::kw_only(),
             py::arg("validate") = false,
             "device: 'gpu', 'cpu', a number or a part of the name; a discrete GPU if there is "
             "one. validate: with validation layers. Raises NoDeviceError.")
        .def("_render", &render, py::arg("mesh"), py::arg("options"), py::arg("progress"))
        .def_property_readonly(
            "device_name", [](const BoundRenderer& r) { return r.device().device.facts().name; },
            "As its driver calls it.")
        .def_property_readonly(
            "validation_message_count",
            [](const BoundRenderer& r) { return r.device().instance.validation_message_count(); },
            "None without validation layers.");
    module.def("_check_scene_options", &check_scene_options, py::arg("options"));
    module.def("encode_png", &png_of, py::arg("picture"),
               "The bytes of a PNG file of an H x W x 4 array of uint8.");
    module.def("save_png", &save_png, py::arg("picture"), py::arg("path"),
               "Writes a PNG file of an H x W x 4 array of uint8, whole or not at all.");
    module.def("devices", &devices,
               "Vulkan devices: name, type, and what each lacks; an empty list where it can be "
               "used.");
}

}  // namespace rimline::python
