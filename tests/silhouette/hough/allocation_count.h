#pragma once

// Counts what this program allocates through operator new, to show that something does not.

#include <cstdint>

namespace rimline::tests {

/// Allocations by the calling thread so far.
std::uint64_t allocation_count() noexcept;

}  // namespace rimline::tests
