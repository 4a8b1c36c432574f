#pragma once

// Growth of large arrays that can be stopped. The system gives the memory of a page when it is first touched: for 40 MB
// that takes 10 ms, and more than 100 ms on a slow virtual machine.

#include <algorithm>
#include <cstddef>
#include <stop_token>
#include <vector>

#include "silhouette/error.h"

namespace rimline {

/// values.resize(size, value) where it grows. Throws Error{cancelled} soon after a stop.
template <typename Value>
void resize_gradually(std::vector<Value>& values, std::size_t size, const std::stop_token& stop,
                      const Value& value = {}) {
    constexpr std::size_t k_part = std::max<std::size_t>((std::size_t{1} << 21) / sizeof(Value), 1);
    values.reserve(size);
    while (values.size() < size) {
        LongCall{stop, {}}.checkpoint(0.0);
        values.resize(std::min(size, values.size() + k_part), value);
    }
}

}  // namespace rimline
