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
    /// Copies. A family that only copies, if there is one: it has its own engines, which work in parallel
    /// with drawing. Else the same family.
    std::uint32_t transfer_family = 0;
};

/// Returns the first of equal families; std::nullopt if no family both draws and computes, and presents where
/// `presents` is given: of each family, whether it can present to the surface. One queue of each family is enough:
/// two queues of the family that draws would share the same engine.
std::optional<QueueChoice> choose_queues(std::span<const VkQueueFamilyProperties> families,
                                         std::optional<std::span<const VkBool32>> presents = {});

}  // namespace rimline
