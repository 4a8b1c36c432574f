#pragma once

// Counts what this program allocates through operator new, on all threads, and can make it fail.

#include <cstdint>

namespace rimline::tests {

/// Allocations of all threads so far.
std::uint64_t allocation_count() noexcept;

/// While one lives, every allocation on every thread throws std::bad_alloc.
class AllocationFaults {
public:
    AllocationFaults() noexcept;
    ~AllocationFaults();
    AllocationFaults(const AllocationFaults&) = delete;
    AllocationFaults& operator=(const AllocationFaults&) = delete;
};

}  // namespace rimline::tests
