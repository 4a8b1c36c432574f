#pragma once

// Which queues of a device are used, by the families it has. Separate from Vulkan calls, so that it can be
// tested on machines that do not exist.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <optional>
#include <span>

namespace rimline {

struct QueueChoice {
    std::uint32_t family = 0;  ///< Draws and computes.
    /// Copies: a family that does nothing else, where there is one, for it has engines of its own which
    /// run beside what is drawn. Else the same.
    std::uint32_t transfer_family = 0;
};

/// Of equal families the first. Nothing where no family both draws and computes. One queue of each is
/// enough: a second queue of the family that draws would take turns with the first.
std::optional<QueueChoice> choose_queues(std::span<const VkQueueFamilyProperties> families);

}  // namespace rimline
