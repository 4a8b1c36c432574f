#include "tools/python/mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "silhouette/hough/silhouette_tracker.h"
#include "silhouette/mesh/brute_force.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "tools/options/model_argument.h"
#include "tools/options/up_option.h"
#include "tools/python/arrays.h"
#include "tools/python/bound_class.h"
#include "tools/python/errors.h"
#include "tools/python/keywords.h"
#include "tools/python/long_calls.h"
#include "tools/python/number_rows.h"
#include "tools/python/unlocked.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

// As messages have a mesh of arrays.
constexpr const char* k_unnamed = "the mesh";

// Taking the interpreter back may take a turn of another thread, 5 ms.
constexpr std::size_t k_many_rows = 100'000;

struct PythonSilhouette {
    SharedMesh mesh;
    HomogeneousPoint point;
    std::vector<EdgeId> edges;  // Ascending.

    const Mesh& library_mesh() const { return mesh->mesh(); }
};

SharedMesh mesh_of_arrays(const py::object& vertices, const py::object& faces, const py::object& up,
                          const py::object& weld, const py::object& progress) {
    const Welding welding = flag_of(weld, "weld") ? Welding::equal_positions : Welding::none;
    const NumberRows vertex_rows(vertices, "vertices", NumberRows::Kind::real);
    const NumberRows face_rows(faces, "faces", NumberRows::Kind::integer);
    MeshSource source;
    if (!up.is_none()) {
        const std::string axis = PyUnicode_Check(up.ptr()) != 0 ? word_of(up, "up") : "";
        if (axis != "y" && axis != "z") throw py::value_error("up: expected 'y' or 'z'");
        source.up = axis == "z" ? UpAxis::z : UpAxis::y;
        source.is_up_known = true;
    }
    std::string warning;
    SharedMesh mesh = long_result(progress, [&](const LongCall& call) {
        source.positions = vertex_rows.float_positions(call.part(0.0, 0.05));
        source.triangles = face_rows.faces(source.positions.size(), call.part(0.05, 0.1));
        warning = lost_shape_warning(k_unnamed, source);
        return std::make_shared<BoundMesh>(k_unnamed, std::move(source), welding,
                                           call.part(0.1, 1.0));
    });
    if (!warning.empty()) warn(warning);
    return mesh;
}

SharedMesh load(const py::object& path, const py::object& subdivide, const py::object& textures,
                const py::object& progress) {
    const std::string name = path_of(path);
    const std::uint32_t steps = count_of(subdivide, "subdivide", 0, tools::k_max_subdivisions);
    const bool reads_textures = flag_of(textures, "textures");
    std::vector<std::string> warnings;
    SharedMesh mesh = long_result(progress, [&](const LongCall& call) {
        try {
            return tools::load_bound_mesh(name, steps, reads_textures, "; load_points() reads it",
                                          warnings, call);
        } catch (const FileError&) {
            throw;
        } catch (const Error& error) {
            // Of the message, not of the name of the file.
            const std::string message = error.what();
            const std::size_t begin = message.starts_with(name) ? name.size() : 0;
            throw Error(error.code(),
                        message.substr(0, begin) + in_keywords(message.substr(begin)));
        }
    });
    for (const std::string& warning : warnings) warn(warning);
    return mesh;
}

PythonSilhouette silhouette(const py::object& self, const py::object& eye,
                            const py::object& direction, const py::object& progress) {
    const SharedMesh mesh = mesh_of(self);
    PythonSilhouette result{mesh, point_of(eye, direction), {}};
    result.edges = long_result(progress, [&](const LongCall&) {
        // An index takes fifty times the time of a test of all faces.
        const HoughOctree* octree = mesh->octree_if_made();
        if (octree == nullptr) return brute_force_silhouette(mesh->mesh(), result.point);
        std::vector<EdgeId> edges;
        TraversalCounters counters;
        octree->extract(result.point, edges, counters);
        std::ranges::sort(edges);
        return edges;
    });
    return result;
}

py::array front_faces(BoundMesh& mesh, const py::object& eye, const py::object& direction) {
    const HomogeneousPoint point = point_of(eye, direction);
    py::array_t<bool> result(mesh.mesh().face_count());
    bool* const bits = result.mutable_data();
    const Unlocked unlocked;
    const std::vector<std::uint32_t> words = brute_force_face_bits(mesh.mesh(), point);
    for (std::uint32_t face = 0; face < mesh.mesh().face_count(); ++face)
        bits[face] = face_bit(words, FaceId{face});
    return result;
}

// N x `columns` numbers, which `fill` writes: where they are many, while other threads run.
template <class Number, class Fill>
py::array filled_rows(std::size_t rows, py::ssize_t columns, const Fill& fill) {
    py::array_t<Number> result(std::vector<py::ssize_t>{static_cast<py::ssize_t>(rows), columns});
    Number* const numbers = result.mutable_data();
    std::optional<Unlocked> unlocked;
    if (rows > k_many_rows) unlocked.emplace();
    fill(numbers);
    return result;
}

// Over the rows of numbers that the mesh of `self` keeps.
template <typename Number, typename Row>
py::array rows_of(const std::vector<Row>& rows, const py::object& self) {
    return array_over<Number>(
        rows.data(),
        {static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(std::tuple_size_v<Row>)},
        self);
}

std::vector<EdgeId> edges_of_class(const Mesh& mesh, EdgeClass edge_class) {
    const Mesh::EdgeRange range = mesh.edges_of_class(edge_class);
    std::vector<EdgeId> edges;
    edges.reserve(range.size());
    for (std::uint32_t edge = range.first; edge < range.last; ++edge) edges.push_back(EdgeId{edge});
    return edges;
}

// N x 2 x 3, in the coordinates of the mesh.
py::array segments(const PythonSilhouette& silhouette) {
    const Mesh& mesh = silhouette.library_mesh();
    std::vector<glm::vec3> ends;
    ends.reserve(2 * silhouette.edges.size());
    for (const EdgeId edge : silhouette.edges)
        for (const VertexId vertex : mesh.edge(edge).vertices)
            ends.push_back(mesh.positions()[index(vertex)]);
    return copied<float>(std::span<const glm::vec3>(ends), 3)
        .reshape(
            {static_cast<py::ssize_t>(silhouette.edges.size()), py::ssize_t{2}, py::ssize_t{3}});
}

// As Python's own functions have names of files: os.fsencode() gives the bytes.
py::object system_name_of(const BoundMesh& mesh) {
    PyObject* const name = PyUnicode_DecodeFSDefaultAndSize(
        mesh.name().data(), static_cast<Py_ssize_t>(mesh.name().size()));
    if (name == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(name);
}

py::str description_of(const BoundMesh& mesh) {
    return message_text("<rimline.Mesh " + (mesh.name() == k_unnamed ? "" : mesh.name() + ": ") +
                        std::to_string(mesh.mesh().vertex_count()) + " vertices, " +
                        std::to_string(mesh.mesh().face_count()) + " faces, " +
                        std::to_string(mesh.mesh().edge_count()) + " edges>");
}

}  // namespace

SharedMesh mesh_of(const py::object& mesh) {
    if (!py::isinstance<BoundMesh>(mesh))
        throw py::type_error(std::string("mesh: expected a rimline.Mesh, not ") +
                             Py_TYPE(mesh.ptr())->tp_name);
    mesh.cast<const BoundMesh&>();  // TypeError where it was not made.
    return mesh.cast<SharedMesh>();
}

py::array edge_vertices(const Mesh& mesh, std::span<const EdgeId> edges) {
    return filled_rows<std::uint32_t>(edges.size(), 2, [&](std::uint32_t* numbers) {
        for (const EdgeId edge : edges)
            for (const VertexId vertex : mesh.edge(edge).vertices)
                *numbers++ = mesh.file_vertex(vertex);
    });
}

void bind_mesh(py::module_& module) {
    bound_class<PythonSilhouette>(
        module, "Silhouette",
        "The silhouette of a mesh from a point: edges between a face that "
        "is seen from the front and one that is not. Two faces that "
        "traverse their edge in the same direction have opposite fronts: "
        "their edge is in it where both are seen from the front, or "
        "neither is. An edge of three faces or more is in it where some "
        "are seen from the front and some are not.")
        .def("__len__", [](const PythonSilhouette& s) { return s.edges.size(); })
        .def_property_readonly(
            "edges",
            [](const PythonSilhouette& s) { return edge_vertices(s.library_mesh(), s.edges); },
            "N x 2 uint32: the vertices of each edge, as the input numbers them; of equal "
            "positions the first stands for all.")
        .def_property_readonly(
            "ids",
            [](const PythonSilhouette& s) {
                return copied<std::uint32_t>(std::span<const EdgeId>(s.edges));
            },
            "N uint32: rows of Mesh.edges, ascending.")
        .def_property_readonly("segments", &segments, "N x 2 x 3 float32: the ends of each edge.")
        .def("__repr__", [](const PythonSilhouette& s) {
            return "<rimline.Silhouette of " + std::to_string(s.edges.size()) + " edges>";
        });

    bound_class<BoundMesh, SharedMesh>(
        module, "Mesh", "A triangle mesh. Immutable; any number of threads may use one.")
        .def(py::init(&mesh_of_arrays), py::arg("vertices"), py::arg("faces"), py::kw_only(),
             py::arg("up") = py::none(), py::arg("weld") = true, py::arg("progress") = py::none(),
             "Makes a mesh of vertices (V x 3 numbers, rounded to float32) and faces (F x 3 "
             "integers, counter-clockwise from outside).\n\n"
             "up: 'y' or 'z' where it is known. weld: equal positions are one vertex; without, "
             "faces that only touch share no edge. progress: None, True (a bar of tqdm), a bar, or "
             "a function that takes the finished share.\n\n"
             "Raises ValueError or TypeError naming the first wrong row. Warns of a mesh so far "
             "from "
             "the origin that float32 loses its shape.")
        .def_property_readonly(
            "vertices",
            [](const py::object& self) {
                const auto& positions = self.cast<const BoundMesh&>().positions();
                return array_over<float>(positions.data(),
                                         {static_cast<py::ssize_t>(positions.size()), 3}, self);
            },
            "V x 3 float32: the positions as they were given, with unused ones. A view.")
        .def_property_readonly(
            "faces",
            [](const py::object& self) {
                return rows_of<std::uint32_t>(self.cast<BoundMesh&>().faces(), self);
            },
            "F x 3 uint32: corners as rows of vertices; of equal positions the first stands for "
            "all. A view.")
        .def_property_readonly(
            "edges",
            [](const py::object& self) {
                return rows_of<std::uint32_t>(self.cast<BoundMesh&>().edges(), self);
            },
            "E x 2 uint32: the vertices of each edge, as rows of vertices. A view.")
        .def_property_readonly(
            "edge_faces",
            [](const py::object& self) {
                return rows_of<std::int64_t>(self.cast<BoundMesh&>().edge_faces(), self);
            },
            "E x 2 int64: the first two faces of each edge; -1 for the second of a border. A view.")
        .def_property_readonly(
            "borders",
            [](const BoundMesh& m) {
                return edge_vertices(m.mesh(), edges_of_class(m.mesh(), EdgeClass::border));
            },
            "N x 2 uint32: edges of one face. They are in no silhouette.")
        .def_property_readonly("name", &system_name_of,
                               "Of its file or shape, as messages name it.")
        .def_property_readonly(
            "center", [](const BoundMesh& m) { return array_of(m.mesh().center()); },
            "The center of the bounding box of the used vertices.")
        .def_property_readonly(
            "radius", [](const BoundMesh& m) { return m.mesh().radius(); },
            "The greatest distance from the center to a used vertex.")
        .def_property_readonly(
            "bounds",
            [](const BoundMesh& m) {
                const std::array<glm::vec3, 2> bounds{m.mesh().bounds().low,
                                                      m.mesh().bounds().high};
                return copied<float>(std::span<const glm::vec3>(bounds), 3);
            },
            "2 x 3 float32: least and greatest coordinates of the used vertices.")
        .def_property_readonly(
            "up",
            [](const BoundMesh& m) {
                return array_of(tools::choose_up(m.mesh(), std::nullopt, false).up);
            },
            "The direction that pictures show upwards: the file's, or where it names none the "
            "axis on which the mesh stands; y unless another is clearly better.")
        .def_property_readonly(
            "is_closed", [](const BoundMesh& m) { return m.mesh().is_closed(); },
            "Whether there is an edge, and every edge has an even number of faces.")
        .def_property_readonly(
            "is_oriented", [](const BoundMesh& m) { return m.mesh().is_oriented(); },
            "Whether no edge has two faces that traverse it in the same direction.")
        .def("silhouette", &silhouette, py::arg("eye") = py::none(), py::kw_only(),
             py::arg("direction") = py::none(), py::arg("progress") = py::none(),
             "The silhouette from a viewpoint, or for an orthographic view from the direction that "
             "points towards the viewer.\n\n"
             "Tests all faces, in about 1 ms for 200,000, or uses the index after build_index() "
             "or where a Tracker has made it: the result is the same.")
        .def("front_faces", &front_faces, py::arg("eye") = py::none(), py::kw_only(),
             py::arg("direction") = py::none(), "F bool: whether each face is seen from its front.")
        .def(
            "build_index",
            [](BoundMesh& m, const py::object& progress) {
                run_long(progress, [&](const LongCall& call) { m.octree(call); });
            },
            py::kw_only(), py::arg("progress") = py::none(),
            "Makes the index that trackers and fast silhouettes use, about half a microsecond a "
            "face. Where it is needed it is made anyway.")
        .def("__repr__", &description_of);

    module.def("load", &load, py::arg("path"), py::kw_only(), py::arg("subdivide") = 0,
               py::arg("textures") = false, py::arg("progress") = py::none(),
               "Reads a mesh: OBJ, PLY, STL, OFF, glTF, GLB; or a built-in shape, as "
               "'shape:knot:5000'.\n\n"
               "subdivide: refines it so many times (Loop), 0 to 14. textures: reads pictures of "
               "materials, "
               "which only render() needs. Raises InputError naming file and place, FileError.");
}

}  // namespace rimline::python
