#pragma once

// Watches what this program allocates through operator new, and makes an allocation fail.

#include <cstdint>

namespace rimline::tests {

/// Allocation number `allocation` of the calling thread from now on throws std::bad_alloc; with `and_all_later`, so
/// do all after it, until disarm_new().
void arm_new(std::uint64_t allocation, bool and_all_later) noexcept;

/// Returns whether an allocation failed.
bool disarm_new() noexcept;

/// The most bytes that the calling thread had at one time since its construction, without those that it had before.
class PeakBytes {
public:
    PeakBytes() noexcept;
    std::int64_t bytes() const noexcept;

private:
    std::int64_t before_;
};

}  // namespace rimline::tests
