#include "tools/python/arrays.h"

#include <algorithm>
#include <cmath>

#include "tools/bindings/bound_mesh.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

std::string type_message(const std::string& name, const std::string& expected, py::handle value) {
    return name + ": expected " + expected + ", not " + Py_TYPE(value.ptr())->tp_name;
}

[[noreturn]] void throw_type(const std::string& name, const std::string& expected,
                             py::handle value) {
    throw py::type_error(type_message(name, expected, value));
}

// Instead of what the value's own conversion raised.
[[noreturn]] void throw_type_instead(const std::string& name, const std::string& expected,
                                     py::handle value) {
    throw_instead(PyExc_TypeError, type_message(name, expected, value));
}

// As Python writes the text, in ASCII.
std::string escaped(py::handle text) {
    // An error is set: the one that is told of it.
    const py::error_scope scope;
    const auto ascii = py::reinterpret_steal<py::object>(PyObject_ASCII(text.ptr()));
    if (!ascii) throw py::error_already_set();
    return ascii.cast<std::string>();
}

}  // namespace

void throw_instead(PyObject* exception, const std::string& message) {
    py::error_already_set error;
    if (!error.matches(PyExc_TypeError) && !error.matches(PyExc_ValueError)) throw error;
    py::raise_from(error, exception, message.c_str());
    throw py::error_already_set();
}

std::uint32_t count_of(py::handle value, const char* name, std::uint32_t low, std::uint32_t high) {
    const auto integer = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    if (!integer) throw_type_instead(name, "an integer", value);
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
    if (PyErr_ExceptionMatches(PyExc_OverflowError) == 0)
        throw_type_instead(name, "a number", value);
    PyErr_Clear();
    return std::numeric_limits<double>::infinity();
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
    return utf8_of(value, name);
}

std::string utf8_of(py::handle text, const std::string& name) {
    Py_ssize_t size = 0;
    const char* const bytes = PyUnicode_AsUTF8AndSize(text.ptr(), &size);
    if (bytes == nullptr)
        throw_instead(PyExc_ValueError,
                      name + ": expected text without lone surrogates, not " + escaped(text));
    return {bytes, static_cast<std::size_t>(size)};
}

glm::dvec3 vector_of(py::handle value, const char* name) {
    glm::dvec3 vector;
    if (PyUnicode_Check(value.ptr()) != 0 || PyBytes_Check(value.ptr()) != 0 ||
        PyAnySet_Check(value.ptr()) || PyDict_Check(value.ptr()))  // These have no order.
        throw_type(name, "three numbers", value);
    // A copy: methods of its numbers may change a list.
    const auto numbers = py::reinterpret_steal<py::tuple>(PySequence_Tuple(value.ptr()));
    if (!numbers) throw_type_instead(name, "three numbers", value);
    if (numbers.size() != 3)
        throw py::value_error(std::string(name) + ": expected three numbers, not " +
                              std::to_string(numbers.size()));
    for (int i = 0; i < 3; ++i) {
        vector[i] = number_of(PyTuple_GET_ITEM(numbers.ptr(), i), name);
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
