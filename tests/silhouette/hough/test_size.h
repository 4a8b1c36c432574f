#pragma once

// How many points and moves to try on real models. Sanitized builds define RIMLINE_MODEL_DIVISOR, as
// brute force takes many times longer there; the numbers run are printed.

#include <cstdint>

#ifndef RIMLINE_MODEL_DIVISOR
#define RIMLINE_MODEL_DIVISOR 1
#endif

namespace rimline::tests {

constexpr std::uint32_t model_count(std::uint32_t count) { return count / RIMLINE_MODEL_DIVISOR; }

}  // namespace rimline::tests
