#pragma once

// How often tests on random input repeat.

#include <concepts>

namespace rimline::tests {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr int k_sanitized_share = 4;
#else
inline constexpr int k_sanitized_share = 1;
#endif

/// `count`, or a quarter of it, rounded up, under a sanitizer: a round takes about ten times as long there, and
/// what sanitizers look for does not need rare input.
template <std::integral Count>
constexpr Count rounds(Count count) {
    return (count + Count{k_sanitized_share} - 1) / Count{k_sanitized_share};
}

}  // namespace rimline::tests
