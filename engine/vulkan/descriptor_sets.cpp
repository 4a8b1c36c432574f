#include "engine/vulkan/descriptor_sets.h"

#include "engine/vulkan/debug_names.h"

namespace rimline {

OwnedDescriptorSetLayout make_set_layout(const DeviceContext& context, const std::string& name,
                                         std::span<const VkDescriptorSetLayoutBinding> bindings) {
    const VkDescriptorSetLayoutCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = static_cast<std::uint32_t>(bindings.size()),
        .pBindings = bindings.data()};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    vk_check(context.vk->CreateDescriptorSetLayout(context.device, &info, nullptr, &layout),
             "vkCreateDescriptorSetLayout");
    set_name(*context.vk, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, layout, name);
    return {context, layout};
}

DescriptorSets::DescriptorSets(const DeviceContext& context, const std::string& name,
                               std::span<const VkDescriptorSetLayoutBinding> bindings,
                               std::uint32_t count)
    : layout_(make_set_layout(context, name, bindings)), sets_(count) {
    std::vector<VkDescriptorPoolSize> sizes;
    for (const VkDescriptorSetLayoutBinding& binding : bindings)
        sizes.push_back({binding.descriptorType, binding.descriptorCount * count});
    const VkDescriptorPoolCreateInfo pool_info{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = count,
        .poolSizeCount = static_cast<std::uint32_t>(sizes.size()),
        .pPoolSizes = sizes.data()};
    VkDescriptorPool pool = VK_NULL_HANDLE;
    vk_check(context.vk->CreateDescriptorPool(context.device, &pool_info, nullptr, &pool),
             "vkCreateDescriptorPool");
    pool_ = {context, pool};
    set_name(*context.vk, VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool, name);

    const std::vector<VkDescriptorSetLayout> layouts(count, layout_);
    const VkDescriptorSetAllocateInfo allocate{
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = pool,
        .descriptorSetCount = count,
        .pSetLayouts = layouts.data()};
    vk_check(context.vk->AllocateDescriptorSets(context.device, &allocate, sets_.data()),
             "vkAllocateDescriptorSets");
    // The sets have no names of their own: lavapipe 22.3 keeps the name of a set that is freed with its pool.
}

}  // namespace rimline
