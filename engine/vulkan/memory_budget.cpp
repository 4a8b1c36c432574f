#include "engine/vulkan/memory_budget.h"

#include <array>
#include <cstdio>

namespace rimline {

void MemoryBudget::check(std::uint64_t more_bytes, const std::string& what) const {
    if (more_bytes <= size_bytes_ - used_bytes_) return;
    throw Error(ErrorCode::too_large, what + " needs " + size_text(more_bytes) + " more, and of " +
                                          name_ + " of " + size_text(size_bytes_) + " " +
                                          size_text(size_bytes_ - used_bytes_) + " are left");
}

std::string size_text(std::uint64_t bytes) {
    constexpr std::array k_units{"bytes", "KiB", "MiB", "GiB", "TiB"};
    double size = double(bytes);
    std::size_t unit = 0;
    while (size >= 1024.0 && unit + 1 < k_units.size()) {
        size /= 1024.0;
        ++unit;
    }
    std::array<char, 32> text{};
    // One digit after the point for values below 10, but not for bytes.
    std::snprintf(text.data(), text.size(), size < 10.0 && unit > 0 ? "%.1f %s" : "%.0f %s", size,
                  k_units[unit]);
    return text.data();
}

}  // namespace rimline
