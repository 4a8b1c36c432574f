#include "tools/python/fields.h"

#include <CLI/Error.hpp>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <optional>
#include <string>

#include "silhouette/field/best_views.h"
#include "silhouette/field/camera_path.h"
#include "silhouette/field/camera_tour.h"
#include "silhouette/field/named_functions.h"
#include "silhouette/field/sun_choice.h"
#include "silhouette/field/tangential_field.h"
#include "silhouette/field/unit_planes.h"
#include "tools/bindings/bound_renderer.h"
#include "tools/options/model_argument.h"
#include "tools/options/placed_model.h"
#include "tools/options/scene_lights.h"
#include "tools/options/up_option.h"
#include "tools/options/view_camera.h"
#include "tools/options/view_choice.h"
#include "tools/output/path_report.h"
#include "tools/python/arrays.h"
#include "tools/python/bound_class.h"
#include "tools/python/keywords.h"
#include "tools/python/long_calls.h"
#include "tools/python/mesh.h"
#include "tools/python/number_rows.h"
#include "tools/python/renderer.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

// Of the picture for which target and field of view of a view are given.
constexpr double k_aspect = 4.0 / 3.0;

constexpr std::size_t k_points_per_checkpoint = 1 << 16;

// A direction, or a word as --up takes it.
glm::dvec3 up_of(const Mesh& mesh, const py::object& up) {
    std::optional<glm::vec3> given;
    bool is_auto = false;
    if (py::isinstance<py::str>(up)) {
        try {
            given = tools::parse_up_choice("--up", word_of(up, "up")).direction;
        } catch (const CLI::ValidationError& error) {
            throw py::value_error(in_keywords(error.what()));
        }
        is_auto = !given;
    } else if (!up.is_none()) {
        given = glm::vec3(direction_of(up, "up"));
    }
    return tools::choose_up(mesh, given, is_auto).up;
}

class PythonField {
public:
    PythonField(const py::object& mesh, const py::object& function, const py::object& tolerance,
                const py::object& by_area, const py::object& progress) {
        const SharedMesh shared = mesh_of(mesh);
        const std::string name = word_of(function, "function");
        const NamedFunction* named = find_named_function(name);
        if (named == nullptr) {
            std::string names;
            for (const NamedFunction& known : named_functions())
                names += (names.empty() ? "" : ", ") + std::string(known.name);
            throw py::value_error("function: expected one of " + names + ", not '" + name + "'");
        }
        const double error = number_of(tolerance, "tolerance");
        if (!(error >= 0.0 && error <= 1.0)) throw py::value_error("tolerance: expected 0 to 1");
        const FieldOptions options{.tolerance = error,
                                   .weight = flag_of(by_area, "by_area")
                                                 ? FieldOptions::Weight::area
                                                 : FieldOptions::Weight::count};
        const Mesh& library_mesh = shared->mesh();
        run_long(progress, [&](const LongCall& call) {
            field_ = std::make_unique<TangentialField>(outward_planes(library_mesh, call.stop),
                                                       named->function, options, call.stop);
        });
    }

    const TangentialField& field() const { return *field_; }

    py::array at(const py::object& points, const py::object& progress) const {
        const NumberRows rows(points, "points", NumberRows::Kind::real);
        py::array_t<double> values(static_cast<py::ssize_t>(rows.count()));
        double* to = values.mutable_data();
        run_long(progress, [&](const LongCall& call) {
            std::vector<glm::dvec3> places = rows.positions(call.part(0.0, 0.1));
            for (std::size_t i = 0; i < places.size(); ++i) {
                if (i % k_points_per_checkpoint == 0) call.checkpoint(0.1);
                places[i] = field_->frame().from_model(places[i]);
            }
            field_->values(places, {to, places.size()}, call.part(0.1, 1.0));
        });
        return values;
    }

private:
    std::unique_ptr<TangentialField> field_;
};

struct PythonView {
    tools::ViewCamera camera;
    BestView view;
    bool is_weighted;
};

// `visible`: not only votes count. `renderer` is None where rays tell what is visible.
py::list best_views(const py::object& mesh_object, const py::object& count, bool visible,
                    const py::object& renderer, const py::object& below, const py::object& by_area,
                    const py::object& up, const py::object& progress) {
    const SharedMesh shared = mesh_of(mesh_object);
    const tools::ViewChoice choice{.count = count_of(count, "count", 1, 64),
                                   .by_area = flag_of(by_area, "by_area"),
                                   .below = word_of(below, "below")};
    if (choice.below != "less" && choice.below != "full")
        throw py::value_error("below: expected 'less' or 'full'");
    const std::shared_ptr<tools::BoundRenderer> drawer =
        renderer.is_none() ? nullptr : renderer_of(renderer);
    const glm::dvec3 upwards = up_of(shared->mesh(), up);
    const BestViews best = long_result_apart(progress, [=](const LongCall& call) {
        BoundMesh& mesh = *shared;
        tools::check_viewing_range(mesh.name(), mesh.mesh());
        const TangentialField field =
            make_view_field(mesh.mesh(), choice.field_options(), view_function(), call.stop);
        const LongCall searched = call.part(visible ? 0.1 : 0.0, 1.0);
        BestViews found;
        const auto find = [&](const VisibleRatios& ratios) {
            found = find_best_views(field, choice.options(mesh.mesh(), upwards, ratios), searched);
        };
        if (visible)
            tools::measure_views(mesh, drawer.get(), call.part(0.0, 0.1), find);
        else
            find({});
        return found;
    });
    py::list views;
    for (const BestView& view : best.views)
        views.append(PythonView{tools::camera_of_view(shared->mesh(), view.eye, upwards, k_aspect),
                                view, visible});
    return views;
}

class PythonPath {
public:
    PythonPath(const py::object& mesh_object, const py::object& eyes, const py::object& up,
               const py::object& progress) {
        const SharedMesh shared = mesh_of(mesh_object);
        const Mesh& mesh = shared->mesh();
        const std::vector<glm::dvec3> views =
            NumberRows(eyes, "eyes", NumberRows::Kind::real).positions({});
        if (views.size() < 2) throw py::value_error("eyes: expected at least two");
        const double radius = unit_frame(mesh).radius;
        for (std::size_t i = 0; i < views.size(); ++i) {
            const double distance = glm::distance(views[i], mesh.center()) / radius;
            if (!(distance >= 0.99 * k_view_shell.inner_radius &&
                  distance <= 1.01 * k_view_shell.outer_radius))
                throw py::value_error("eyes[" + std::to_string(i) +
                                      "]: expected a point 1.73 to 2 radii from the mesh's center, "
                                      "as those of best_views()");
        }
        up_ = up_of(mesh, up);
        center_ = mesh.center();
        run_long(progress, [&](const LongCall& call) {
            const TangentialField field =
                make_view_field(mesh, {.tolerance = k_view_tolerance}, view_function(), call.stop);
            std::vector<glm::dvec3> places;
            for (const TourNode& node : plan_tour(field, views, call)) places.push_back(node.place);
            path_ = std::make_shared<const CameraPath>(center_, places);
        });
    }

    const CameraPath& path() const { return *path_; }

    py::tuple sample(const py::object& count) const {
        // A stop leaves it to end by itself, which takes a second or two.
        const tools::PathSamples samples = long_result_apart(
            py::none(), [path = path_, center = center_, up = up_,
                         frames = count_of(count, "count", 1, 1'000'000)](const LongCall&) {
                return tools::sample_path(*path, center, up, frames);
            });
        return py::make_tuple(copied<double>(std::span<const glm::dvec3>(samples.eyes), 3),
                              copied<double>(std::span<const glm::dvec3>(samples.ups), 3));
    }
    py::array position(const py::object& share) const {
        const double number = number_of(share, "share");
        if (!std::isfinite(number)) throw py::value_error("share: expected a finite number");
        return array_of(path_->position(number));
    }

private:
    glm::dvec3 up_, center_;
    std::shared_ptr<const CameraPath> path_;
};

py::array best_light(const py::object& mesh_object, const py::object& eye, const py::object& by,
                     const py::object& up, const py::object& progress) {
    const SharedMesh shared = mesh_of(mesh_object);
    const Mesh& mesh = shared->mesh();
    const glm::dvec3 place(glm::vec3(vector_of(eye, "eye")));
    const std::string way = word_of(by, "by");
    if (way != "tones" && way != "votes") throw py::value_error("by: expected 'tones' or 'votes'");
    const glm::dvec3 upwards = up_of(mesh, up);
    const tools::ViewCamera seen = tools::camera_of_view(mesh, place, upwards, k_aspect);
    if (seen.eye == seen.target) throw py::value_error("eye: is the mesh's center, where it looks");
    const Camera camera{
        .eye = seen.eye, .target = seen.target, .up = seen.up, .fov_y_deg = seen.fov_y_deg};
    const auto direction =
        long_result(progress, [&](const LongCall& call) -> std::optional<glm::dvec3> {
            if (way == "votes") {
                const std::optional<ChosenSun> sun = choose_sun(mesh, place, call);
                return sun ? std::optional(sun->direction) : std::nullopt;
            }
            const SunSurvey survey(mesh, k_shading_crease_rad, call.part(0.0, 0.5));
            const std::optional<PictureSun> sun =
                choose_picture_sun(survey, tools::picture_frame(camera, k_aspect), {.up = upwards},
                                   call.part(0.5, 1.0));
            return sun ? std::optional(sun->direction) : std::nullopt;
        });
    if (!direction)
        throw Error(ErrorCode::bad_input, way == "votes"
                                              ? "no face turns a side towards the eye: move it"
                                              : "no face is in the picture from the eye: move it");
    return array_of(*direction);
}

}  // namespace

void bind_fields(py::module_& module) {
    bound_class<PythonField>(
        module, "TangentialField",
        "The sum over a mesh's planes of a function of the distance of a point "
        "from each. Immutable; any number of threads may use one.")
        .def(py::init<const py::object&, const py::object&, const py::object&, const py::object&,
                      const py::object&>(),
             py::arg("mesh"), py::arg("function") = "views", py::kw_only(),
             py::arg("tolerance") = 1e-3, py::arg("by_area") = false,
             py::arg("progress") = py::none(),
             "function: one of FIELD_FUNCTIONS. tolerance: the greatest error as a share of "
             "max_value; 0: all planes are summed. by_area: planes count by the areas of their "
             "faces.")
        .def("at", &PythonField::at, py::arg("points"), py::kw_only(),
             py::arg("progress") = py::none(),
             "N float64: the values at N x 3 points, in the mesh's coordinates.")
        .def_property_readonly(
            "max_value", [](const PythonField& f) { return f.field().max_value(); },
            "The greatest magnitude that a value can have.")
        .def_property_readonly(
            "error_bound", [](const PythonField& f) { return f.field().error_bound(); },
            "The greatest error of a value.");

    bound_class<PythonView>(module, "View", "A viewpoint that best_views() chose.")
        .def_property_readonly(
            "eye", [](const PythonView& v) { return array_of(v.view.eye); },
            "The viewpoint: 3 float64.")
        .def_property_readonly(
            "target", [](const PythonView& v) { return array_of(v.camera.target); },
            "With up and fov, a camera that shows the whole mesh in a picture of 4:3.")
        .def_property_readonly(
            "up", [](const PythonView& v) { return array_of(v.camera.up); }, "3 float64.")
        .def_property_readonly(
            "fov", [](const PythonView& v) { return v.camera.fov_y_deg; }, "Vertical, in degrees.")
        .def_property_readonly(
            "score", [](const PythonView& v) { return v.view.score(); },
            "Votes times visible ratio times preference.")
        .def_property_readonly(
            "votes", [](const PythonView& v) { return v.view.votes; },
            "Votes of planes that no view chosen before it has.")
        .def_property_readonly(
            "visible_ratio",
            [](const PythonView& v) {
                return v.is_weighted ? py::object(py::float_(v.view.visible_ratio)) : py::none();
            },
            "The visible share of the silhouette; None where it was not measured.")
        .def("__repr__", [](const PythonView& v) {
            return "<rimline.View from " + py::str(array_of(v.camera.eye)).cast<std::string>() +
                   ">";
        });

    bound_class<PythonPath>(module, "CameraPath", "A closed, smooth path around a mesh.")
        .def(py::init<const py::object&, const py::object&, const py::object&, const py::object&>(),
             py::arg("mesh"), py::arg("eyes"), py::kw_only(), py::arg("up") = py::none(),
             py::arg("progress") = py::none(),
             "Through N x 3 eyes of best_views(), two or more, and an interesting view between "
             "each two. Eyes are 1.73 to 2 radii from the mesh's center; ValueError if not.")
        .def_property_readonly(
            "nodes", [](const PythonPath& p) { return copied<double>(p.path().nodes(), 3); },
            "2N x 3 float64: the points that it passes through.")
        .def_property_readonly(
            "length", [](const PythonPath& p) { return p.path().length(); },
            "In units of the mesh.")
        .def("position", &PythonPath::position, py::arg("share"),
             "The point at this share of the length; 0 and 1 are the first node.")
        .def("sample", &PythonPath::sample, py::arg("count"),
             "Eyes and up axes (each N x 3 float64) of 1 to 1,000,000 equally spaced cameras that "
             "look at the mesh's center.");

    module.def("_best_views", &best_views, py::arg("mesh"), py::arg("count"), py::arg("visible"),
               py::arg("renderer"), py::arg("below"), py::arg("by_area"), py::arg("up"),
               py::arg("progress"));
    module.def("best_light", &best_light, py::arg("mesh"), py::arg("eye"), py::kw_only(),
               py::arg("by") = "tones", py::arg("up") = py::none(),
               py::arg("progress") = py::none(),
               "The direction (3 float64) towards the sun that lights the mesh best, seen from "
               "`eye`.\n\n"
               "by: 'tones' weighs what is lit and what is in shadow, 'votes' is the field of the "
               "thesis (4.6).");
    py::list functions;
    for (const NamedFunction& function : named_functions())
        functions.append(std::string(function.name));
    module.attr("FIELD_FUNCTIONS") = py::tuple(functions);
}

}  // namespace rimline::python
