#pragma once

// operator new that fails on demand, for what the engine itself allocates: calls from this program's own
// code, on the thread that armed it. Drivers, layers and the standard library's own code never see it
// fail.

#include <cstdint>

namespace rimline::tests {

/// Makes the allocation numbered `allocation` throw std::bad_alloc, once. Counted from 0 over those made
/// while a CountingNew lives.
void arm_new(std::uint64_t allocation) noexcept;
/// Ends it; whether the allocation was reached.
bool disarm_new() noexcept;

/// While it lives allocations count, and fail if armed.
class CountingNew {
public:
    CountingNew() noexcept;
    ~CountingNew();
    CountingNew(const CountingNew&) = delete;
    CountingNew& operator=(const CountingNew&) = delete;
};

}  // namespace rimline::tests
