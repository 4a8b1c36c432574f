#pragma once

// Hard meshes without end, one a number: what hard_meshes.h has one of each, in every size, place and
// scale, and meshes aimed at the index's margins.

#include <cstdint>

#include "tests/silhouette/hough/support/hard_meshes.h"

namespace rimline::tests {

/// The kinds there are; mesh `number` is of kind number % k_generated_kinds.
constexpr std::uint32_t k_generated_kinds = 16;

/// One to about 1,500 faces, the same for the same number on every machine. Some are moved as far as
/// 2^22 times their size, some scaled by powers of two from 2^-90, where squares underflow, to 2^58; no
/// coordinate exceeds k_max_coordinate.
NamedSource generated_mesh(std::uint32_t number);

}  // namespace rimline::tests
