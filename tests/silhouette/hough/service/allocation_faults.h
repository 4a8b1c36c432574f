#pragma once

// Counts what this program allocates through operator new, on all threads, and can make it fail.

#include <cstdint>

namespace rimline::tests {

/// Allocations of all threads so far.
std::uint64_t allocation_count() noexcept;

/// While one lives, every allocation on every thread throws std::bad_alloc, but for the first `spared`.
class AllocationFaults {
public:
    explicit AllocationFaults(std::uint64_t spared = 0) noexcept;
    ~AllocationFaults();
    AllocationFaults(const AllocationFaults&) = delete;
    AllocationFaults& operator=(const AllocationFaults&) = delete;
};

}  // namespace rimline::tests
