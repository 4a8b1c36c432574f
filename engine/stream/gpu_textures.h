#pragma once

// The textures of a mesh on the GPU (silhouette/mesh/face_materials.h).
//
// Faces are drawn in ranges of one texture each, with a descriptor set of its own, so that no feature of the device is
// needed. Faces without a texture, and those whose picture could not be read, have a white one.

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "engine/stream/textured_faces.h"
#include "engine/vulkan/descriptor_sets.h"
#include "engine/vulkan/uploads.h"
#include "silhouette/mesh/face_materials.h"

namespace rimline {

/// The samplers of all textures of a renderer, each made when it is first asked for: there are at most 18, and a
/// device may allow no more than 4000 (maxSamplerAllocationCount).
class TextureSamplers {
public:
    /// The sampler for `texture`. It lives as long as this object.
    VkSampler of(const DeviceContext& context, const MaterialTexture& texture);

private:
    std::map<std::array<int, 3>, OwnedSampler> samplers_;  // By wrap_u, wrap_v and is_pixelated.
};

class GpuTextures {
public:
    /// `materials` has pictures. Pictures larger than the device's images are reduced. `samplers` must outlive it.
    GpuTextures(UploadBatch& batch, TextureSamplers& samplers, const FaceMaterials& materials);

    /// Bytes of buffers and images.
    std::uint64_t size_bytes() const noexcept;
    /// All faces, ordered by texture.
    VkDeviceAddress faces() const noexcept { return faces_.address(); }
    VkDeviceAddress corner_uvs() const noexcept { return corner_uvs_.address(); }
    /// The ranges in faces().
    std::span<const TexturedFaces> ranges() const noexcept { return ranges_; }

private:
    const Image& image_of(UploadBatch& batch, const Picture* picture);

    Buffer faces_, corner_uvs_;
    std::map<const Picture*, Image> images_;  // Null: white.
    DescriptorSets sets_;
    std::vector<TexturedFaces> ranges_;
};

}  // namespace rimline
