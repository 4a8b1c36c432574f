#pragma once

// How a device's timestamps count: in ticks of timestampPeriod, in timestampValidBits of 64 bits.

#include <cstdint>

#include "engine/vulkan/device_context.h"

namespace rimline {

struct TimestampUnit {
    std::uint32_t valid_bits = 0;  ///< 0: the queue family has no timestamps.
    double tick_ms = 0.0;

    /// The time between two timestamps. Counters that wrap around once between them are right.
    double elapsed_ms(std::uint64_t first, std::uint64_t last) const noexcept {
        if (valid_bits == 0) return 0.0;
        const std::uint64_t mask =
            valid_bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << valid_bits) - 1;
        return tick_ms * static_cast<double>((last - first) & mask);
    }
};

/// Of the context's queue.
TimestampUnit timestamp_unit(const DeviceContext& context);

}  // namespace rimline
