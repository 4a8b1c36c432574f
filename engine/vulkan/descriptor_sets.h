#pragma once

// Descriptor sets of one layout, as many as a pass or a frame in flight needs.

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

#include "engine/vulkan/device_context.h"
#include "engine/vulkan/vulkan_handle.h"

namespace rimline {

/// Names are for debug_names.h.
OwnedDescriptorSetLayout make_set_layout(const DeviceContext& context, const std::string& name,
                                         std::span<const VkDescriptorSetLayoutBinding> bindings);

class DescriptorSets {
public:
    /// `count` sets of `bindings`, which hold one descriptor each.
    DescriptorSets(const DeviceContext& context, const std::string& name,
                   std::span<const VkDescriptorSetLayoutBinding> bindings, std::uint32_t count);

    VkDescriptorSetLayout layout() const noexcept { return layout_; }
    VkDescriptorSet operator[](std::uint32_t set) const noexcept { return sets_[set]; }

private:
    OwnedDescriptorSetLayout layout_;
    OwnedDescriptorPool pool_;
    std::vector<VkDescriptorSet> sets_;
};

}  // namespace rimline
