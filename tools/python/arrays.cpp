#include "tools/python/arrays.h"

#include <algorithm>
#include <cmath>

#include "tools/bindings/bound_mesh.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

[[noreturn]] void throw_type(const std::string& name, const std::string& what) {
    throw py::type_error(name + ": " + what);
}

[[noreturn]] void throw_type(const std::string& name, const std::string& expected,
                             py::handle value) {
    throw_type(name, "expected " + expected + ", not " + Py_TYPE(value.ptr())->tp_name);
}

std::string shape_text(const py::array& array) {
    return py::str(array.attr("shape")).cast<std::string>();
}

// An N x 3 array of numbers, in the machine's order of bytes.
py::array three_columns(py::handle value, const char* name) {
    if (py::hasattr(value, "mask") && py::hasattr(value, "filled"))
        throw_type(name, "expected an array without a mask");
    const py::array array = py::array::ensure(value);
    if (!array) {
        PyErr_Clear();
        throw_type(name, "expected an array of shape (N, 3)");
    }
    if (array.ndim() == 1 && array.size() == 0)  // [] is an empty list of rows.
        return py::array_t<double>(std::vector<py::ssize_t>{0, 3});
    const char kind = array.dtype().kind();
    if (kind != 'f' && kind != 'i' && kind != 'u')
        throw_type(name, "expected real numbers, not " +
                             py::str(py::object(array.dtype())).cast<std::string>());
    if (array.ndim() != 2 || array.shape(1) != 3)
        throw py::value_error(std::string(name) + ": expected the shape (N, 3), not " +
                              shape_text(array));
    const bool is_native = array.dtype().attr("isnative").cast<bool>();
    const py::ssize_t width = array.itemsize();
    if (is_native && (kind != 'f' || width == 4 || width == 8)) return array;
    // float16, float128 and the other order of bytes.
    const char* type = kind == 'f' ? "float64" : kind == 'i' ? "int64" : "uint64";
    return py::array::ensure(array.attr("astype")(type));
}

template <typename Number>
Number read(const char* place) {
    Number number;
    std::memcpy(&number, place, sizeof number);
    return number;
}

// Calls use(row, column, number) for each number.
template <typename Number, typename Use>
void each_number(const py::array& array, Use use) {
    const char* data = static_cast<const char*>(array.data());
    const py::ssize_t rows = array.shape(0), down = array.strides(0), across = array.strides(1);
    for (py::ssize_t row = 0; row < rows; ++row)
        for (py::ssize_t column = 0; column < 3; ++column)
            use(row, column, read<Number>(data + row * down + column * across));
}

template <typename Use>
void each_integer(const py::array& array, Use use) {
    const bool is_signed = array.dtype().kind() == 'i';
    switch (array.itemsize()) {
        case 1:
            return is_signed ? each_number<std::int8_t>(array, use)
                             : each_number<std::uint8_t>(array, use);
        case 2:
            return is_signed ? each_number<std::int16_t>(array, use)
                             : each_number<std::uint16_t>(array, use);
        case 4:
            return is_signed ? each_number<std::int32_t>(array, use)
                             : each_number<std::uint32_t>(array, use);
        default:
            return is_signed ? each_number<std::int64_t>(array, use)
                             : each_number<std::uint64_t>(array, use);
    }
}

template <typename Vector>
std::vector<Vector> positions_as(py::handle value, const char* name) {
    const py::array array = three_columns(value, name);
    if (array.shape(0) >= py::ssize_t{std::numeric_limits<std::uint32_t>::max()})
        throw py::value_error(std::string(name) + ": more than 2^32 - 2 rows");
    std::vector<Vector> positions(static_cast<std::size_t>(array.shape(0)));
    const auto store = [&](py::ssize_t row, py::ssize_t column, auto number) {
        const double coordinate = static_cast<double>(number);
        if (!(std::abs(coordinate) <= double{k_max_coordinate}))  // NaN too.
            throw py::value_error(std::string(name) + "[" + std::to_string(row) +
                                  "]: a coordinate is not a finite number within 2^60");
        positions[std::size_t(row)][int(column)] =
            static_cast<typename Vector::value_type>(coordinate);
    };
    if (array.dtype().kind() != 'f')
        each_integer(array, store);
    else if (array.itemsize() == 4)
        each_number<float>(array, store);
    else
        each_number<double>(array, store);
    return positions;
}

}  // namespace

std::uint32_t count_of(py::handle value, const char* name, std::uint32_t low, std::uint32_t high) {
    const auto integer = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    if (!integer) {
        PyErr_Clear();
        throw_type(name, "an integer", value);
    }
    int overflow = 0;
    const long long count = PyLong_AsLongLongAndOverflow(integer.ptr(), &overflow);
    if (overflow != 0 || count < low || count > high)
        throw py::value_error(std::string(name) + ": expected " + std::to_string(low) + " to " +
                              std::to_string(high) + ", not " +
                              py::str(integer).cast<std::string>());
    return static_cast<std::uint32_t>(count);
}

double number_of(py::handle value, const char* name) {
    const double number = PyFloat_AsDouble(value.ptr());
    if (number != -1.0 || PyErr_Occurred() == nullptr) return number;
    const bool is_too_large = PyErr_ExceptionMatches(PyExc_OverflowError) != 0;
    PyErr_Clear();
    if (is_too_large) return std::numeric_limits<double>::infinity();
    throw_type(name, "a number", value);
}

bool is_flag(py::handle value) {
    return PyBool_Check(value.ptr()) != 0 ||
           py::isinstance(value, py::module_::import("numpy").attr("bool_"));
}

bool flag_of(py::handle value, const char* name) {
    if (!is_flag(value)) throw_type(name, "True or False", value);
    return PyObject_IsTrue(value.ptr()) == 1;
}

std::string word_of(py::handle value, const char* name) {
    if (PyUnicode_Check(value.ptr()) == 0) throw_type(name, "a str", value);
    return value.cast<std::string>();
}

glm::dvec3 vector_of(py::handle value, const char* name) {
    glm::dvec3 vector;
    const py::object sequence =
        PyUnicode_Check(value.ptr()) != 0 || PyBytes_Check(value.ptr()) != 0 ||
                PyAnySet_Check(value.ptr()) || PyDict_Check(value.ptr())  // These have no order.
            ? py::object()
            : py::reinterpret_steal<py::object>(PySequence_Fast(value.ptr(), ""));
    if (!sequence) {
        PyErr_Clear();
        throw_type(name, "three numbers", value);
    }
    if (PySequence_Fast_GET_SIZE(sequence.ptr()) != 3)
        throw py::value_error(std::string(name) + ": expected three numbers, not " +
                              std::to_string(PySequence_Fast_GET_SIZE(sequence.ptr())));
    for (int i = 0; i < 3; ++i) {
        vector[i] = number_of(PySequence_Fast_GET_ITEM(sequence.ptr(), i), name);
        if (!(std::abs(vector[i]) <= double{k_max_coordinate}))  // NaN too.
            throw py::value_error(std::string(name) +
                                  ": expected finite numbers within 2^60, not " +
                                  py::str(value).cast<std::string>());
    }
    return vector;
}

glm::dvec3 direction_of(py::handle value, const char* name) {
    const glm::dvec3 direction = tools::long_direction(vector_of(value, name));
    if (HomogeneousPoint::direction(glm::vec3(direction)).xyz() == glm::vec3(0.0f))
        throw py::value_error(std::string(name) + ": expected a direction, which is not zero");
    return direction;
}

HomogeneousPoint point_of(py::handle eye, py::handle direction) {
    if (eye.is_none() == direction.is_none())
        throw py::type_error("expected either eye or direction");
    return eye.is_none()
               ? HomogeneousPoint::direction(glm::vec3(direction_of(direction, "direction")))
               : HomogeneousPoint::viewpoint(glm::vec3(vector_of(eye, "eye")));
}

std::vector<glm::dvec3> positions_of(py::handle array, const char* name) {
    return positions_as<glm::dvec3>(array, name);
}

std::vector<glm::vec3> float_positions_of(py::handle array, const char* name) {
    return positions_as<glm::vec3>(array, name);
}

std::vector<std::array<std::uint32_t, 3>> faces_of(py::handle value, const char* name,
                                                   std::size_t vertices) {
    const py::array array = three_columns(value, name);
    std::vector<std::array<std::uint32_t, 3>> faces(static_cast<std::size_t>(array.shape(0)));
    if (faces.empty()) return faces;
    if (array.dtype().kind() == 'f')
        throw_type(name, "expected integers, not " +
                             py::str(py::object(array.dtype())).cast<std::string>());
    each_integer(array, [&](py::ssize_t row, py::ssize_t column, auto number) {
        // A negative number becomes too large.
        if (static_cast<std::uint64_t>(number) >= vertices)
            throw py::value_error(std::string(name) + "[" + std::to_string(row) +
                                  "]: there is no vertex " + std::to_string(number) + " among " +
                                  std::to_string(vertices));
        faces[std::size_t(row)][std::size_t(column)] = static_cast<std::uint32_t>(number);
    });
    return faces;
}

py::array_t<double> array_of(const glm::dvec3& vector) { return py::array_t<double>(3, &vector.x); }

std::string path_of(const py::object& path) {
    PyObject* bytes = nullptr;
    if (PyUnicode_FSConverter(path.ptr(), &bytes) == 0) {
        const py::error_already_set error;
        const std::string message = "path: " + py::str(error.value()).cast<std::string>();
        if (error.matches(PyExc_TypeError)) throw py::type_error(message);
        if (error.matches(PyExc_ValueError)) throw py::value_error(message);
        throw error;
    }
    const std::string name = py::reinterpret_steal<py::bytes>(bytes);
    if (name.empty() || name == "-") throw py::value_error("path: expected the name of a file");
    return name;
}

}  // namespace rimline::python
