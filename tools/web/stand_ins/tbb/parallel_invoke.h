#pragma once

// A stand-in for oneTBB (blocked_range.h).

namespace tbb {

template <typename... Bodies>
void parallel_invoke(const Bodies&... bodies) {
    (bodies(), ...);
}

}  // namespace tbb
