#pragma once

// The descriptor set of a pass whose fragment shader reads finished images: binding i is image i.

#include <vulkan/vulkan.h>

#include <initializer_list>

#include "engine/vulkan/descriptor_sets.h"
#include "engine/vulkan/memory.h"

namespace rimline {

OwnedSampler make_sampler(const DeviceContext& context, const std::string& name,
                          const VkSamplerCreateInfo& info);
/// Nearest or linear, within the image.
OwnedSampler make_sampler(const DeviceContext& context, const std::string& name, VkFilter filter);

/// `sets` descriptor sets of `bindings` images each for fragment shaders, all with this sampler, which must outlive
/// them.
DescriptorSets make_image_sets(const DeviceContext& context, const std::string& name,
                               const VkSampler& sampler, std::uint32_t bindings,
                               std::uint32_t sets);

class SampledImages {
public:
    /// The name is for debug_names.h. VK_FILTER_LINEAR is valid for color images only.
    SampledImages(const DeviceContext& context, const std::string& name, std::uint32_t count,
                  VkFilter filter = VK_FILTER_NEAREST);

    /// Sets the images of the bindings. When they are read they must be in SHADER_READ_ONLY_OPTIMAL or, for
    /// depth, DEPTH_STENCIL_READ_ONLY_OPTIMAL. Not while a frame that reads the set is in flight.
    void set(std::initializer_list<const Image*> images);

    VkDescriptorSetLayout layout() const noexcept { return sets_.layout(); }
    VkDescriptorSet get() const noexcept { return sets_[0]; }

private:
    const DeviceFunctions* vk_;
    OwnedSampler sampler_;
    DescriptorSets sets_;
};

}  // namespace rimline
