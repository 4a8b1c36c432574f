#include "tools/python/points.h"

#include <memory>
#include <optional>
#include <string>

#include "silhouette/mesh/equal_positions.h"
#include "silhouette/mesh/formats/point_file.h"
#include "silhouette/points/feature_weights.h"
#include "silhouette/points/point_silhouette.h"
#include "silhouette/points/point_surface.h"
#include "silhouette/points/umbrella_index.h"
#include "tools/python/arrays.h"
#include "tools/python/bound_class.h"
#include "tools/python/long_calls.h"
#include "tools/python/number_rows.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

constexpr std::array<const char*, 4> k_label_names{"border", "interior", "feature", "undecided"};

// Points are numbered as the input numbers them. Of equal positions all have what the first has.
class PythonPoints {
public:
    PythonPoints(const py::object& points, const py::object& k, const py::object& drop_outliers,
                 const py::object& progress) {
        const PointSurfaceOptions options{
            .k = count_of(k, "k", 4, 32),
            .drops_outliers = flag_of(drop_outliers, "drop_outliers")};
        const NumberRows rows(points, "points", NumberRows::Kind::real);
        if (rows.count() == 0) throw py::value_error("points: expected at least one");
        run_long(progress, [&](const LongCall& call) {
            std::vector<glm::dvec3> positions = rows.positions(call.part(0.0, 0.02));
            number_rows(positions, call.stop);
            surface_.emplace(positions, options, call.part(0.02, 0.8));
            weights_ = feature_weights(*surface_, call.part(0.8, 0.9));
            index_ = std::make_unique<UmbrellaIndex>(*surface_, call.part(0.9, 1.0));
        });
    }

    const PointSurface& surface() const { return *surface_; }
    const UmbrellaIndex& index() const { return *index_; }
    const std::vector<float>& weights() const { return weights_; }
    std::size_t row_count() const { return of_row_.size(); }
    PointId point_of_row(std::size_t row) const { return PointId{of_row_[row]}; }
    std::uint32_t row_of(PointId point) const { return rows_[rimline::index(point)]; }

private:
    // Leaves in `positions` the first of equal ones, in the order of rows.
    void number_rows(std::vector<glm::dvec3>& positions, const std::stop_token& stop) {
        of_row_ = first_equal_positions<double>(positions, stop);
        for (std::uint32_t row = 0; row < of_row_.size(); ++row) {
            if (of_row_[row] != row) {
                of_row_[row] = of_row_[of_row_[row]];
                continue;
            }
            of_row_[row] = static_cast<std::uint32_t>(rows_.size());
            positions[rows_.size()] = positions[row];
            rows_.push_back(row);
        }
        positions.resize(rows_.size());
    }

    std::vector<std::uint32_t> of_row_;  // The point of each row.
    std::vector<std::uint32_t> rows_;    // The first row of each point.
    std::optional<PointSurface> surface_;
    std::vector<float> weights_;
    std::unique_ptr<UmbrellaIndex> index_;
};

struct PythonPointSilhouette {
    std::vector<std::uint32_t> points;
    std::vector<std::array<std::uint32_t, 2>> edges;
};

std::unique_ptr<PythonPointSilhouette> silhouette_of(const PythonPoints& self,
                                                     const py::object& eye,
                                                     const py::object& direction,
                                                     const py::object& progress) {
    if (eye.is_none() == direction.is_none())
        throw py::type_error("expected either eye or direction");
    const HomogeneousPoint point =
        eye.is_none() ? self.index().direction(direction_of(direction, "direction"))
                      : self.index().viewpoint(vector_of(eye, "eye"));
    return long_result(progress, [&](const LongCall&) {
        const PointSilhouette silhouette(self.index(), point);
        auto result = std::make_unique<PythonPointSilhouette>();
        for (const PointId id : silhouette.points()) result->points.push_back(self.row_of(id));
        for (const PointEdge& edge : silhouette.consensus_edges())
            result->edges.push_back({self.row_of(edge[0]), self.row_of(edge[1])});
        return result;
    });
}

py::array load_points(const py::object& path, const py::object& progress) {
    const std::string name = path_of(path);
    const std::vector<glm::dvec3> positions = long_result(progress, [&](const LongCall& call) {
        return read_point_file(name, BadPoints::refuse, call).positions;
    });
    py::array_t<double> result(
        std::vector<py::ssize_t>{static_cast<py::ssize_t>(positions.size()), 3});
    std::copy_n(&positions[0].x, 3 * positions.size(), result.mutable_data());
    return result;
}

}  // namespace

void bind_points(py::module_& module) {
    bound_class<PythonPointSilhouette>(module, "PointSilhouette",
                                       "The silhouette of a point set from a point.")
        .def("__len__", [](const PythonPointSilhouette& s) { return s.points.size(); })
        .def_property_readonly(
            "points",
            [](const PythonPointSilhouette& s) {
                return copied<std::uint32_t>(std::span<const std::uint32_t>(s.points));
            },
            "N uint32: rows of the points on the silhouette, ascending.")
        .def_property_readonly(
            "edges",
            [](const PythonPointSilhouette& s) {
                return copied<std::uint32_t>(std::span<const std::array<std::uint32_t, 2>>(s.edges),
                                             2);
            },
            "N x 2 uint32: edges that are on the silhouette by consensus of both their points.");

    bound_class<PythonPoints>(
        module, "PointSurface",
        "The surface that points were sampled from, point by point: normals, "
        "borders, features, silhouettes. Immutable; any number of threads may "
        "use one.")
        .def(py::init<const py::object&, const py::object&, const py::object&, const py::object&>(),
             py::arg("points"), py::kw_only(), py::arg("k") = 16, py::arg("drop_outliers") = false,
             py::arg("progress") = py::none(),
             "Finds the umbrella of each of N x 3 points, N > 0, about five microseconds a "
             "point.\n\n"
             "k: how many nearest neighbors are looked at, 4 to 32. drop_outliers: leave out the "
             "points that lie on no surface, as scans have them; they are undecided.")
        .def("__len__", &PythonPoints::row_count)
        .def_property_readonly(
            "labels",
            [](const PythonPoints& self) {
                py::array_t<std::uint8_t> labels(static_cast<py::ssize_t>(self.row_count()));
                std::uint8_t* to = labels.mutable_data();
                for (std::size_t row = 0; row < self.row_count(); ++row)
                    to[row] = std::uint8_t(self.surface().label(self.point_of_row(row)));
                return labels;
            },
            "N uint8: rows of POINT_LABELS: border, interior, feature or undecided.")
        .def_property_readonly(
            "normals",
            [](const PythonPoints& self) {
                py::array_t<double> normals(
                    std::vector<py::ssize_t>{static_cast<py::ssize_t>(self.row_count()), 3});
                double* to = normals.mutable_data();
                for (std::size_t row = 0; row < self.row_count(); ++row) {
                    const glm::dvec3 normal = self.surface().normal(self.point_of_row(row));
                    to = std::copy_n(&normal.x, 3, to);
                }
                return normals;
            },
            "N x 3 float64: unit normals, unoriented; zero where a point has none.")
        .def_property_readonly(
            "features",
            [](const PythonPoints& self) {
                py::array_t<float> weights(static_cast<py::ssize_t>(self.row_count()));
                float* to = weights.mutable_data();
                for (std::size_t row = 0; row < self.row_count(); ++row)
                    to[row] = self.weights()[index(self.point_of_row(row))];
                return weights;
            },
            "N float32: how sharply the surface turns, 0 (flat) to 1 (a right angle).")
        .def("silhouette", &silhouette_of, py::arg("eye") = py::none(), py::kw_only(),
             py::arg("direction") = py::none(), py::arg("progress") = py::none(),
             "The silhouette from a viewpoint or a direction towards the viewer.");

    py::tuple labels(k_label_names.size());
    for (std::size_t i = 0; i < k_label_names.size(); ++i) labels[i] = py::str(k_label_names[i]);
    module.attr("POINT_LABELS") = labels;

    module.def("load_points", &load_points, py::arg("path"), py::kw_only(),
               py::arg("progress") = py::none(),
               "The points of a file, N x 3 float64 in its order: PLY, OBJ, XYZ, PTS or CSV, and "
               "the vertices of STL, OFF, glTF and GLB. A file without points, or with one that is "
               "not finite, raises InputError naming file and place.");
}

}  // namespace rimline::python
