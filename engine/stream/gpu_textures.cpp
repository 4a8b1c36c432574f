#include "engine/stream/gpu_textures.h"

#include <algorithm>

#include "engine/stream/mip_levels.h"
#include "engine/vulkan/sampled_images.h"

namespace rimline {

namespace {

constexpr const char* k_name = "texture";

VkSamplerAddressMode address_mode(TextureWrap wrap) {
    if (wrap == TextureWrap::clamp) return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    return wrap == TextureWrap::mirror ? VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT
                                       : VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

// The faces of each texture; those without come last.
std::vector<std::vector<std::uint32_t>> faces_by_texture(const FaceMaterials& materials) {
    std::vector<std::vector<std::uint32_t>> faces(materials.textures.size() + 1);
    for (std::uint32_t f = 0; f < materials.of_face.size(); ++f) {
        const TextureId texture = materials.texture_of(f);
        (texture == k_no_texture ? faces.back() : faces[index(texture)]).push_back(f);
    }
    return faces;
}

void write_set(const DeviceContext& context, VkDescriptorSet set, const Image& image,
               VkSampler sampler) {
    const VkDescriptorImageInfo info{.sampler = sampler,
                                     .imageView = image.sampled_view(),
                                     .imageLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
    const VkWriteDescriptorSet write{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                     .dstSet = set,
                                     .dstBinding = k_texture_binding.binding,
                                     .descriptorCount = 1,
                                     .descriptorType = k_texture_binding.descriptorType,
                                     .pImageInfo = &info};
    context.vk->UpdateDescriptorSets(context.device, 1, &write, 0, nullptr);
}

}  // namespace

GpuTextures::GpuTextures(UploadBatch& batch, TextureSamplers& samplers,
                         const FaceMaterials& materials)
    : corner_uvs_(
          batch.add(std::span<const glm::vec2>(materials.corner_uvs), "texture coordinates")),
      sets_(batch.context(), k_name, {&k_texture_binding, 1},
            static_cast<std::uint32_t>(materials.textures.size() + 1)) {
    const DeviceContext& context = batch.context();
    std::vector<std::uint32_t> all;
    std::uint32_t set = 0;
    for (const std::vector<std::uint32_t>& faces : faces_by_texture(materials)) {
        const MaterialTexture none{.place = {}};
        const MaterialTexture& texture =
            set < materials.textures.size() ? materials.textures[set] : none;
        if (!faces.empty()) {
            write_set(context, sets_[set], image_of(batch, texture.picture.get()),
                      samplers.of(context, texture));
            ranges_.push_back({sets_[set], static_cast<std::uint32_t>(all.size()),
                               static_cast<std::uint32_t>(faces.size())});
        }
        all.insert(all.end(), faces.begin(), faces.end());
        ++set;
    }
    faces_ = batch.add(std::span<const std::uint32_t>(all), "faces by texture");
}

std::uint64_t GpuTextures::size_bytes() const noexcept {
    std::uint64_t size = faces_.size() + corner_uvs_.size();
    for (const auto& [picture, image] : images_) {
        const VkExtent2D extent = image.description().extent;
        // All levels together: a third more than the first.
        size += std::uint64_t{4} * extent.width * extent.height * 4 / 3;
    }
    return size;
}

VkSampler TextureSamplers::of(const DeviceContext& context, const MaterialTexture& texture) {
    OwnedSampler& sampler = samplers_[{static_cast<int>(texture.wrap_u),
                                       static_cast<int>(texture.wrap_v), texture.is_pixelated}];
    if (sampler.get() == VK_NULL_HANDLE)
        sampler =
            make_sampler(context, k_name,
                         {.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                          .magFilter = texture.is_pixelated ? VK_FILTER_NEAREST : VK_FILTER_LINEAR,
                          .minFilter = VK_FILTER_LINEAR,
                          .mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR,
                          .addressModeU = address_mode(texture.wrap_u),
                          .addressModeV = address_mode(texture.wrap_v),
                          .maxLod = VK_LOD_CLAMP_NONE});
    return sampler.get();
}

const Image& GpuTextures::image_of(UploadBatch& batch, const Picture* picture) {
    const auto found = images_.find(picture);
    if (found != images_.end()) return found->second;
    const Picture white{1, 1, {255, 255, 255, 255}};
    const std::vector<Picture> levels =
        mip_levels(picture ? *picture : white, batch.context().limits.maxImageDimension2D);
    return images_.emplace(picture, batch.add_image(VK_FORMAT_R8G8B8A8_SRGB, levels, k_name))
        .first->second;
}

}  // namespace rimline
