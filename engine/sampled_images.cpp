#include "engine/sampled_images.h"

#include <vector>

namespace rimline {

SampledImages::SampledImages(const DeviceContext& context, std::uint32_t count, VkFilter filter)
    : device_(context.device) {
    // Where shaders fetch texels filters do not matter, and nearest is allowed for every format.
    const VkSamplerCreateInfo sampler_info{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                           .magFilter = filter,
                                           .minFilter = filter,
                                           .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                           .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
    VkSampler sampler = VK_NULL_HANDLE;
    vk_check(vkCreateSampler(device_, &sampler_info, nullptr, &sampler), "vkCreateSampler");
    sampler_ = {device_, sampler};

    const std::vector<VkSampler> samplers(count, sampler);
    std::vector<VkDescriptorSetLayoutBinding> bindings(count);
    for (std::uint32_t i = 0; i < count; ++i)
        bindings[i] = {.binding = i,
                       .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                       .descriptorCount = 1,
                       .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT,
                       .pImmutableSamplers = &samplers[i]};
    const VkDescriptorSetLayoutCreateInfo layout_info{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = count,
        .pBindings = bindings.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    vk_check(vkCreateDescriptorSetLayout(device_, &layout_info, nullptr, &layout),
             "vkCreateDescriptorSetLayout");
    layout_ = {device_, layout};

    const VkDescriptorPoolSize size{.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                    .descriptorCount = count};
    const VkDescriptorPoolCreateInfo pool_info{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = 1,
        .poolSizeCount = 1,
        .pPoolSizes = &size};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    vk_check(vkCreateDescriptorPool(device_, &pool_info, nullptr, &pool), "vkCreateDescriptorPool");
    pool_ = {device_, pool};
    const VkDescriptorSetAllocateInfo allocate{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = pool,
        .descriptorSetCount = 1,
        .pSetLayouts = &layout};
    vk_check(vkAllocateDescriptorSets(device_, &allocate, &set_), "vkAllocateDescriptorSets");
}

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
                          .dstSet = set_,
                          .dstBinding = i,
                          .descriptorCount = 1,
                          .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                          .pImageInfo = &infos[i]});
    vkUpdateDescriptorSets(device_, static_cast<std::uint32_t>(writes.size()), writes.data(), 0,
                           nullptr);
}

}  // namespace rimline
