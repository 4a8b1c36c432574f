#include "engine/vulkan/memory_budget.h"

#include <array>
#include <cstdio>

#include "engine/vulkan/vulkan_result.h"

namespace rimline {

void MemoryBudget::check(std::uint64_t more_bytes, const std::string& what) const {
    if (more_bytes <= size_bytes_ - used_bytes_) return;
    throw Error(ErrorCode::too_large, what + " needs " + size_text(more_bytes) + " more, and of " +
                                          name_ + " of " + size_text(size_bytes_) + " " +
                                          size_text(size_bytes_ - used_bytes_) + " are left");
}

void check_room(VkResult result, const char* call, std::uint64_t size_bytes,
                const std::string& what) {
    if (is_out_of_memory(result))
        throw Error(ErrorCode::too_large,
                    (result == VK_ERROR_TOO_MANY_OBJECTS
                         ? "the device allows no more allocations (maxMemoryAllocationCount), for "
                         : "the device has no memory left for ") +
                        what + " of " + size_text(size_bytes) + ": " + call + " failed with " +
                        name_of(result));
    vk_check(result, call);
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
