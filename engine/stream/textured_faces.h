#pragma once

// The faces of a mesh that have one texture.

#include <vulkan/vulkan.h>

#include <cstdint>

namespace rimline {

/// A range of InstanceData.textured_faces.
struct TexturedFaces {
    VkDescriptorSet texture = VK_NULL_HANDLE;
    std::uint32_t first_face = 0;
    std::uint32_t face_count = 0;
};

/// Of the descriptor set of a texture: a combined image and sampler for the fragment stage.
constexpr VkDescriptorSetLayoutBinding k_texture_binding{
    .binding = 0,
    .descriptorType = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
    .descriptorCount = 1,
    .stageFlags = VK_SHADER_STAGE_FRAGMENT_BIT};

}  // namespace rimline
