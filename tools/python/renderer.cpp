#include "tools/python/renderer.h"

#include <pybind11/stl.h>

#include <algorithm>

#include "engine/measure/visible_ratio.h"
#include "engine/vulkan/device.h"
#include "silhouette/picture.h"
#include "tools/options/model_argument.h"
#include "tools/options/scene_options.h"
#include "tools/options/up_option.h"
#include "tools/output/still_scene.h"
#include "tools/python/arrays.h"
#include "tools/python/keywords.h"
#include "tools/python/long_calls.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

// The options of `rimline render`, but for those of files and the machine.
struct RenderKeywords {
    RenderKeywords() {
        style.add_to(app);
        style.add_palette_to(app);
        style.add_still_lines_to(app);
        picture.add_camera_to(app);
        picture.add_ground_up_to(app);
        picture.add_lights_to(app);
        picture.add_image_to(app, tools::PictureOptions::Background::any);
    }

    CLI::App app;
    tools::SceneOptions style;
    tools::PictureOptions picture;
};

tools::PictureOptions device_options(const std::string& device, bool validate) {
    tools::PictureOptions options;
    options.device = device;
    options.validate = validate;
    return options;
}

py::bytes png_of(const py::array_t<std::uint8_t, py::array::c_style | py::array::forcecast>& rgba) {
    if (rgba.ndim() != 3 || rgba.shape(2) != 4 || rgba.size() == 0)
        throw py::value_error("picture: expected the shape (H, W, 4)");
    Picture picture{.width = std::uint32_t(rgba.shape(1)), .height = std::uint32_t(rgba.shape(0))};
    picture.rgba.assign(rgba.data(), rgba.data() + rgba.size());
    for (std::size_t i = 3; i < picture.rgba.size() && !picture.has_alpha; i += 4)
        picture.has_alpha = picture.rgba[i] != 255;
    std::vector<std::byte> bytes;
    {
        const py::gil_scoped_release unlocked;
        bytes = encode_png(picture);
    }
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

py::list devices() {
    const VulkanInstance instance;
    py::list names;
    for (const DeviceFacts& facts : describe_devices(instance))
        names.append(py::make_tuple(facts.name, name_of(facts.type), judge_device(facts).lacks));
    return names;
}

}  // namespace

PythonRenderer::PythonRenderer(const std::string& device, bool validate) {
    const py::gil_scoped_release unlocked;
    device_.emplace(device_options(device, validate));
}

py::array PythonRenderer::render(const SharedMesh& shared, const py::dict& keywords,
                                 const py::object& progress) {
    RenderKeywords options;
    parse_keywords(options.app, keywords);
    PythonMesh& mesh = *shared;
    if (!mesh.mesh().is_welded())
        throw py::value_error("mesh: pictures need a mesh with weld=True");
    options.style.check_usage(options.picture);
    tools::settle_up(mesh.mesh(), options.picture.up, options.picture.is_up_auto);
    const Picture picture = long_result(progress, [&](const LongCall& call) {
        tools::check_has_extent(mesh.name(), mesh.mesh());
        const HoughOctree& octree = mesh.octree(call);
        const std::lock_guard lock(mutex_);
        if (std::ranges::find(meshes_, shared) == meshes_.end()) meshes_.push_back(shared);
        if (!options.picture.eye)
            options.picture.view.choose(mesh.name(), mesh.mesh(), glm::dvec3(*options.picture.up),
                                        call);
        tools::StillScene still(mesh.name(), octree, options.style, options.picture, call);
        if (still.scene().lines) {
            if (!lines_ || &lines_->surface().mesh() != &mesh.mesh()) {
                lines_.reset();
                lines_.emplace(octree, LineSurface::Contacts::found, call);
            }
            still.add_lines(*lines_, call);
        }
        if (!renderer_) renderer_.emplace(device_->context());
        const tools::ImageSize size = options.picture.size;
        Picture drawn = renderer_->render(still.scene(), size.width, size.height);
        std::erase_if(meshes_, [&](const SharedMesh& other) { return other != shared; });
        call.checkpoint(1.0);
        options.style.finish(options.picture).apply(drawn);
        return drawn;
    });
    return py::array_t<std::uint8_t>(
        std::vector<py::ssize_t>{py::ssize_t(picture.height), py::ssize_t(picture.width), 4},
        picture.rgba.data());
}

void PythonRenderer::measure(PythonMesh& mesh, const LongCall& call,
                             const std::function<void(const VisibleRatios& ratios)>& use) {
    const HoughOctree& octree = mesh.octree(call);
    const std::lock_guard lock(mutex_);
    VisibleRatioPass pass(device_->context(), octree, {}, call.stop);
    use([&](std::span<const glm::dvec3> eyes) {
        std::vector<double> ratios;
        for (const VisibleRatio& ratio : pass.measure(eyes, {call.stop, {}}))
            ratios.push_back(ratio.ratio());
        return ratios;
    });
}

void bind_renderer(py::module_& module) {
    py::class_<PythonRenderer>(module, "Renderer",
                               "Draws pictures on a Vulkan device. Threads that share one take "
                               "turns.")
        .def(py::init<const std::string&, bool>(), py::arg("device") = "", py::kw_only(),
             py::arg("validate") = false,
             "device: 'gpu', 'cpu', a number or a part of the name; a discrete GPU if there is "
             "one. validate: with validation layers. Raises NoDeviceError.")
        .def("_render", &PythonRenderer::render, py::arg("mesh").none(false), py::arg("options"),
             py::arg("progress"))
        .def_property_readonly("device_name", &PythonRenderer::device_name)
        .def_property_readonly("validation_message_count",
                               &PythonRenderer::validation_message_count,
                               "None without validation layers.");
    module.def("encode_png", &png_of, py::arg("picture"),
               "The bytes of a PNG file of an H x W x 4 array.");
    module.def("devices", &devices,
               "Vulkan devices: name, type, and what each lacks; an empty list where it can be "
               "used.");
}

}  // namespace rimline::python
