#pragma once

// Compute dispatches in rows: more workgroups than a device allows along one axis.

#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstdint>

#include "engine/vulkan/functions.h"
#include "engine/vulkan/rounding.h"

namespace rimline {

/// Workgroups that every device allows along an axis.
constexpr std::uint32_t k_min_group_limit = 65535;

/// Dispatches at least `group_count` workgroups, in rows of at most `groups_a_row`. The last row may have more
/// than needed: shaders must ignore them. None for a count of 0.
inline void record_dispatch(Commands commands, std::uint32_t group_count,
                            std::uint32_t groups_a_row) {
    if (group_count == 0) return;
    const std::uint32_t row = std::min(group_count, groups_a_row);
    commands->CmdDispatch(commands, row, units_of(group_count, row), 1);
}

}  // namespace rimline
