#include "engine/vulkan/queue_choice.h"

#include "silhouette/error.h"

namespace rimline {

namespace {

constexpr VkQueueFlags k_draws = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
// What families for copies may do besides. Excludes families for video, which copy only their own data.
constexpr VkQueueFlags k_beside_copies = VK_QUEUE_SPARSE_BINDING_BIT | VK_QUEUE_PROTECTED_BIT;

bool draws(const VkQueueFamilyProperties& family) {
    return family.queueCount > 0 && (family.queueFlags & k_draws) == k_draws;
}

bool only_copies(const VkQueueFamilyProperties& family) {
    return family.queueCount > 0 && (family.queueFlags & ~k_beside_copies) == VK_QUEUE_TRANSFER_BIT;
}

}  // namespace

std::optional<QueueChoice> choose_queues(std::span<const VkQueueFamilyProperties> families,
                                         std::optional<std::span<const VkBool32>> presents) {
    RIMLINE_CHECK(!presents || presents->size() == families.size());
    const auto find = [&](auto&& fits) {
        std::uint32_t family = 0;
        while (family < families.size() && !fits(family)) ++family;
        return family;
    };
    const std::uint32_t family = find([&](std::uint32_t f) {
        return draws(families[f]) && (!presents || (*presents)[f] == VK_TRUE);
    });
    if (family == families.size()) return std::nullopt;
    const std::uint32_t copies = find([&](std::uint32_t f) { return only_copies(families[f]); });
    return QueueChoice{family, copies == families.size() ? family : copies};
}

}  // namespace rimline
