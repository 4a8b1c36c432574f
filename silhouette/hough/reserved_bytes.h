#pragma once

#include <cstdint>

namespace rimline {

/// Memory that vectors have reserved.
template <typename... Arrays>
std::uint64_t reserved_bytes(const Arrays&... arrays) noexcept {
    return (std::uint64_t{0} + ... + (arrays.capacity() * sizeof(*arrays.data())));
}

}  // namespace rimline
