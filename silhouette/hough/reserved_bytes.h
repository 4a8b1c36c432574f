#pragma once

// The memory of vectors, for size_bytes() functions.

#include <cstdint>

namespace rimline {

/// The capacity of all `arrays` together, in bytes.
template <typename... Arrays>
std::uint64_t reserved_bytes(const Arrays&... arrays) noexcept {
    return (std::uint64_t{0} + ... + (arrays.capacity() * sizeof(*arrays.data())));
}

}  // namespace rimline
