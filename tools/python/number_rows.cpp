#include "tools/python/number_rows.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "silhouette/mesh/homogeneous_point.h"
#include "tools/python/arrays.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

constexpr py::ssize_t k_rows_per_checkpoint = 1 << 16;
// Rows of integers are faces, of which Mesh takes no more.
constexpr py::ssize_t k_max_faces = py::ssize_t{1} << 30;

// As hasattr(), which would swallow a KeyboardInterrupt in a property.
bool has_attribute(py::handle value, const char* attribute) {
    const auto found =
        py::reinterpret_steal<py::object>(PyObject_GetAttrString(value.ptr(), attribute));
    if (found) return true;
    if (PyErr_ExceptionMatches(PyExc_AttributeError) == 0) throw py::error_already_set();
    PyErr_Clear();
    return false;
}

py::array array_of_numpy(py::handle value, const std::string& name) {
    if (has_attribute(value, "mask") && has_attribute(value, "filled"))
        throw py::type_error(name + ": expected an array without a mask");
    const auto& numpy = py::detail::npy_api::get();
    auto array = py::reinterpret_steal<py::array>(numpy.PyArray_FromAny_(
        value.ptr(), nullptr, 0, 0, py::detail::npy_api::NPY_ARRAY_ENSUREARRAY_, nullptr));
    if (!array) throw_instead(PyExc_TypeError, name + ": expected an array of shape (N, 3)");
    return array;
}

std::string type_text(const py::array& array) {
    return py::str(py::object(array.dtype())).cast<std::string>();
}

template <typename Number>
Number read(const char* place, bool is_swapped) {
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), place, bytes.size());
    if (is_swapped) std::ranges::reverse(bytes);
    Number number;
    std::memcpy(&number, bytes.data(), sizeof number);
    return number;
}

}  // namespace

NumberRows::NumberRows(py::handle value, std::string name, Kind kind)
    : name_(std::move(name)), array_(array_of_numpy(value, name_)) {
    if (array_.ndim() == 1 && array_.size() == 0)  // [] is an empty list of rows.
        array_ = py::array_t<double>(std::vector<py::ssize_t>{0, 3});
    kind_ = array_.dtype().kind();
    if (kind_ == 'O' && array_.ndim() == 0)  // No sequence: None, or a generator.
        throw py::type_error(
            name_ + ": expected rows of three numbers, not " +
            py::str(py::type::handle_of(value).attr("__name__")).cast<std::string>());
    if (kind_ != 'f' && kind_ != 'i' && kind_ != 'u')
        throw py::type_error(name_ + ": expected real numbers, not " + type_text(array_));
    if (array_.ndim() != 2 || array_.shape(1) != 3)
        throw py::value_error(name_ + ": expected the shape (N, 3), not " +
                              py::str(array_.attr("shape")).cast<std::string>());
    rows_ = array_.shape(0);
    if (kind == Kind::integer && kind_ == 'f' && rows_ > 0)
        throw py::type_error(name_ + ": expected integers, not " + type_text(array_));
    if (kind == Kind::integer && rows_ > k_max_faces)
        throw py::value_error(name_ + ": more than 2^30 rows");
    if (kind == Kind::real && rows_ >= py::ssize_t{std::numeric_limits<std::uint32_t>::max()})
        throw py::value_error(name_ + ": more than 2^32 - 2 rows");
    width_ = array_.itemsize();
    if (kind_ == 'f' && width_ != 4 && width_ != 8) {  // float16 and float128.
        array_ = array_.attr("astype")("float64");
        width_ = array_.itemsize();
    }
    is_swapped_ = !array_.dtype().attr("isnative").cast<bool>();
    data_ = static_cast<const char*>(array_.data());
    down_ = array_.strides(0);
    across_ = array_.strides(1);
}

// Calls use(row, column, number) for each number.
template <typename Number, typename Use>
void NumberRows::each_number(const LongCall& call, Use use) const {
    for (py::ssize_t row = 0; row < rows_; ++row) {
        if (row % k_rows_per_checkpoint == 0) call.checkpoint(double(row) / double(rows_));
        for (py::ssize_t column = 0; column < 3; ++column)
            use(row, column, read<Number>(data_ + row * down_ + column * across_, is_swapped_));
    }
}

template <typename Use>
void NumberRows::each_integer(const LongCall& call, Use use) const {
    const bool is_signed = kind_ == 'i';
    switch (width_) {
        case 1:
            return is_signed ? each_number<std::int8_t>(call, use)
                             : each_number<std::uint8_t>(call, use);
        case 2:
            return is_signed ? each_number<std::int16_t>(call, use)
                             : each_number<std::uint16_t>(call, use);
        case 4:
            return is_signed ? each_number<std::int32_t>(call, use)
                             : each_number<std::uint32_t>(call, use);
        default:
            return is_signed ? each_number<std::int64_t>(call, use)
                             : each_number<std::uint64_t>(call, use);
    }
}

template <typename Vector>
std::vector<Vector> NumberRows::positions_as(const LongCall& call) const {
    // Memory is first touched between checkpoints: to clear that of millions of rows takes a tenth of a second.
    std::vector<Vector> positions;
    positions.reserve(count());
    const auto store = [&](py::ssize_t row, py::ssize_t column, auto number) {
        const double coordinate = static_cast<double>(number);
        if (!(std::abs(coordinate) <= double{k_max_coordinate}))  // NaN too.
            throw py::value_error(name_ + "[" + std::to_string(row) +
                                  "]: a coordinate is not a finite number within 2^60");
        if (column == 0) positions.emplace_back();
        positions.back()[int(column)] = static_cast<typename Vector::value_type>(coordinate);
    };
    if (kind_ != 'f')
        each_integer(call, store);
    else if (width_ == 4)
        each_number<float>(call, store);
    else
        each_number<double>(call, store);
    return positions;
}

std::vector<glm::dvec3> NumberRows::positions(const LongCall& call) const {
    return positions_as<glm::dvec3>(call);
}

std::vector<glm::vec3> NumberRows::float_positions(const LongCall& call) const {
    return positions_as<glm::vec3>(call);
}

std::vector<std::array<std::uint32_t, 3>> NumberRows::faces(std::size_t vertices,
                                                            const LongCall& call) const {
    std::vector<std::array<std::uint32_t, 3>> faces;
    faces.reserve(count());
    each_integer(call, [&](py::ssize_t row, py::ssize_t column, auto number) {
        // A negative number becomes too large.
        if (static_cast<std::uint64_t>(number) >= vertices)
            throw py::value_error(name_ + "[" + std::to_string(row) + "]: there is no vertex " +
                                  std::to_string(number) + " among " + std::to_string(vertices));
        if (column == 0) faces.emplace_back();
        faces.back()[std::size_t(column)] = static_cast<std::uint32_t>(number);
    });
    return faces;
}

}  // namespace rimline::python
