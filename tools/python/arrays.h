#pragma once

// Arguments of Python as the library takes them, and arrays of the library as numpy's.
//
// A wrong argument is a ValueError or TypeError that names it.
//
// Errors of a value's own methods, as __float__() or __array__(), are passed on. But TypeError and ValueError become
// the cause of the error that names the argument. Arrays of rows are in number_rows.h.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"

namespace rimline::python {

/// Raises `exception` because of the error that is set, which is passed on if it is neither TypeError nor ValueError.
[[noreturn]] void throw_instead(PyObject* exception, const std::string& message);

/// An integer from `low` to `high`.
std::uint32_t count_of(pybind11::handle value, const char* name, std::uint32_t low,
                       std::uint32_t high = std::numeric_limits<std::uint32_t>::max());
double number_of(pybind11::handle value, const char* name);
/// True or False, of Python or numpy.
bool is_flag(pybind11::handle value);
bool flag_of(pybind11::handle value, const char* name);
/// A str.
std::string word_of(pybind11::handle value, const char* name);
/// The same for what is known to be a str.
std::string utf8_of(pybind11::handle text, const std::string& name);

/// Three finite numbers, each at most k_max_coordinate in magnitude.
glm::dvec3 vector_of(pybind11::handle value, const char* name);
/// The same as directions need them: not zero, components below k_min_point_component count as zero.
glm::dvec3 direction_of(pybind11::handle value, const char* name);
/// Exactly one of the two is not None.
HomogeneousPoint point_of(pybind11::handle eye, pybind11::handle direction);

/// An array of this shape over memory that `owner` keeps, without a copy and read-only.
template <typename Number>
pybind11::array array_over(const void* numbers, std::vector<pybind11::ssize_t> shape,
                           pybind11::handle owner) {
    pybind11::array_t<Number> array(std::move(shape), static_cast<const Number*>(numbers), owner);
    pybind11::detail::array_proxy(array.ptr())->flags &=
        ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
}

/// An array with a copy of the elements; each of them is `columns` numbers, 0: one number and no second axis.
template <typename Number, typename Element>
pybind11::array_t<Number> copied(std::span<const Element> elements, pybind11::ssize_t columns = 0) {
    static_assert(sizeof(Element) % sizeof(Number) == 0);
    std::vector<pybind11::ssize_t> shape{static_cast<pybind11::ssize_t>(elements.size())};
    if (columns > 0) shape.push_back(columns);
    // numpy would give up the interpreter's lock to copy many (unlocked.h).
    pybind11::array_t<Number> array(std::move(shape));
    if (!elements.empty())
        std::memcpy(array.mutable_data(), elements.data(), elements.size_bytes());
    return array;
}

/// An array of three numbers.
pybind11::array_t<double> array_of(const glm::dvec3& vector);

/// Text of a path: a str, bytes or os.PathLike. Neither empty nor "-", which would be standard input or output.
std::string path_of(const pybind11::object& path);

}  // namespace rimline::python
