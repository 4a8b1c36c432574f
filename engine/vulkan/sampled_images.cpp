#include "engine/vulkan/sampled_images.h"

#include <vector>

#include "engine/vulkan/debug_names.h"

namespace rimline {

OwnedSampler make_sampler(const DeviceContext& context, const std::string& name,
                          const VkSamplerCreateInfo& info) {
    VkSampler sampler = VK_NULL_HANDLE;
    vk_check(context.vk->CreateSampler(context.device, &info, nullptr, &sampler),
             "vkCreateSampler");
    set_name(*context.vk, VK_OBJECT_TYPE_SAMPLER, sampler, name);
    return {context, sampler};
}

OwnedSampler make_sampler(const DeviceContext& context, const std::string& name, VkFilter filter) {
    // Shaders that fetch texels use no filter, and nearest is allowed for every format.
    return make_sampler(context, name,
                        VkSamplerCreateInfo{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                            .magFilter = filter,
                                            .minFilter = filter,
                                            .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                            .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE});
}

DescriptorSets make_image_sets(const DeviceContext& context, const std::string& name,
                               const VkSampler& sampler, std::uint32_t bindings,
                               std::uint32_t sets) {
    std::vector<VkDescriptorSetLayoutBinding> all(bindings);
    for (std::uint32_t i = 0; i < bindings; ++i)
        all[i] = {.binding = i,
                  .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                  .descriptorCount = 1,
                  .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT,
                  .pImmutableSamplers = &sampler};
    return DescriptorSets(context, name, all, sets);
}

SampledImages::SampledImages(const DeviceContext& context, const std::string& name,
                             std::uint32_t count, VkFilter filter)
    : vk_(context.vk.get()),
      sampler_(make_sampler(context, name, filter)),
      sets_(make_image_sets(context, name, sampler_.get(), count, 1)) {}

void SampledImages::set(std::initializer_list<const Image*> images) {
    std::vector<VkDescriptorImageInfo> infos;
    for (const Image* image : images)
        infos.push_back({.imageView = image->sampled_view(),
                         .imageLayout = image->aspects() == VK_IMAGE_ASPECT_COLOR_BIT
                                            ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL
                                            : VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL});
    std::vector<VkWriteDescriptorSet> writes;
    for (std::uint32_t i = 0; i < infos.size(); ++i)
        writes.push_back({.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                          .dstSet = get(),
                          .dstBinding = i,
                          .descriptorCount = 1,
                          .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                          .pImageInfo = &infos[i]});
    vk_->UpdateDescriptorSets(vk_->device, static_cast<std::uint32_t>(writes.size()), writes.data(),
                              0, nullptr);
}

}  // namespace rimline
