#include "silhouette/mesh/formats/glb_textures.h"

#include <algorithm>

#include "silhouette/mesh/formats/embed_textures.h"

namespace rimline {

namespace {

using Json = GlbTextures::Json;

// glTF's numbers.
constexpr int k_nearest = 9728, k_linear = 9729;

int wrap_number(TextureWrap wrap) noexcept {
    switch (wrap) {
        case TextureWrap::repeat: return 10497;
        case TextureWrap::mirror: return 33648;
        case TextureWrap::clamp: return 33071;
    }
    return 10497;
}

// The number of an element of an array that equals `element`, which is appended if there is none.
std::size_t number_in(Json& array, const Json& element) {
    const auto found = std::find(array.begin(), array.end(), element);
    const auto number = static_cast<std::size_t>(found - array.begin());
    if (found == array.end()) array.push_back(element);
    return number;
}

}  // namespace

std::size_t GlbTextures::add(const MaterialTexture& texture, const AddView& add_view) {
    const auto [image, is_new] =
        images_of_bytes_.try_emplace(texture.embedded.get(), images_.size());
    if (is_new)
        images_.push_back({{"bufferView", add_view(*texture.embedded)},
                           {"mimeType", picture_mime_type(*texture.embedded)}});
    const Json sampler{{"magFilter", texture.is_pixelated ? k_nearest : k_linear},
                       {"wrapS", wrap_number(texture.wrap_u)},
                       {"wrapT", wrap_number(texture.wrap_v)}};
    // At most 18 samplers differ.
    const std::size_t sampler_number = number_in(samplers_, sampler);
    textures_.push_back({{"sampler", sampler_number}, {"source", image->second}});
    return textures_.size() - 1;
}

void GlbTextures::write_to(Json& document) const {
    if (textures_.empty()) return;
    document["textures"] = textures_;
    document["samplers"] = samplers_;
    document["images"] = images_;
}

}  // namespace rimline
