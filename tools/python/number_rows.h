#pragma once

// Arrays of N x 3 numbers as the library takes them, read without the interpreter's lock.
//
// Float32, float64 and integers of any width, in any order of memory and of bytes, are read where they lie; other
// sequences and kinds are converted by numpy first.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "silhouette/error.h"

namespace rimline::python {

/// Holds the array. Its end needs the interpreter's lock; the other members do not.
class NumberRows {
public:
    enum class Kind { real, integer };

    /// Throws ValueError or TypeError naming `name` for a wrong shape or kind.
    NumberRows(pybind11::handle value, std::string name, Kind kind);

    std::size_t count() const { return static_cast<std::size_t>(rows_); }

    // They throw ValueError naming the first wrong row, and Error{cancelled}.

    /// Finite numbers within k_max_coordinate.
    std::vector<glm::dvec3> positions(const LongCall& call) const;
    /// The same, rounded to float.
    std::vector<glm::vec3> float_positions(const LongCall& call) const;
    /// Integers in [0, vertices). Of Kind::integer.
    std::vector<std::array<std::uint32_t, 3>> faces(std::size_t vertices,
                                                    const LongCall& call) const;

private:
    template <typename Number, typename Use>
    void each_number(const LongCall& call, Use use) const;
    template <typename Use>
    void each_integer(const LongCall& call, Use use) const;
    template <typename Vector>
    std::vector<Vector> positions_as(const LongCall& call) const;

    std::string name_;
    pybind11::array array_;
    const char* data_;
    pybind11::ssize_t rows_, down_, across_, width_;
    char kind_;        // Of numpy: f, i or u.
    bool is_swapped_;  // The other order of bytes.
};

}  // namespace rimline::python
