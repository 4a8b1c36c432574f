#pragma once

// The values of a field at the squares of a slice, without a sum at each of them.

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"
#include "tools/output/slice_picture.h"

namespace rimline::tools {

/// The values at these points, in unit coordinates.
using FieldValues =
    std::function<void(std::span<const glm::dvec3>, std::span<double>, const LongCall&)>;

struct SliceValues {
    std::vector<double> values;   ///< Of SliceGrid::points().
    std::size_t sums = 0;         ///< Points at which `field` was asked.
    double greatest_error = 0.0;  ///< Of interpolated values, where they were checked.
};

/// Asks the field in every fourth square along both axes, also beyond the slice, and interpolates cubically between
/// them. In the middle of each block of 4 x 4 squares the field is asked too: where that differs by more than half of
/// `tolerance`, it is asked in the whole block and in those around it. So an error beyond `tolerance` is possible, but only where the middle is
/// no example. A tolerance of 0 asks the field everywhere. Throws what `field` throws.
SliceValues slice_values(const SliceGrid& grid, double tolerance, const FieldValues& field,
                         const LongCall& call = {});

}  // namespace rimline::tools
