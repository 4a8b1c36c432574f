#include "silhouette/mesh/formats/gltf_textures.h"

#include <utility>

#include "silhouette/mesh/formats/gltf_uri.h"

namespace rimline {

TextureId GltfTextures::add_to(std::vector<MaterialTexture>& textures, std::uint32_t number) {
    const GltfTexture& texture = scene_.textures[number];
    const Source& found = source(texture.image);
    if (const Error* fault = std::get_if<Error>(&found)) throw Error(*fault);
    const auto [added, is_new] =
        added_.try_emplace({texture.image, texture.wrap_u, texture.wrap_v, texture.is_pixelated},
                           TextureId{static_cast<std::uint32_t>(textures.size())});
    if (is_new) {
        MaterialTexture& made = textures.emplace_back(std::get<MaterialTexture>(found));
        made.wrap_u = texture.wrap_u;
        made.wrap_v = texture.wrap_v;
        made.is_pixelated = texture.is_pixelated;
    }
    return added->second;
}

const GltfTextures::Source& GltfTextures::source(std::uint32_t image) {
    const auto known = sources_.find(image);
    if (known != sources_.end()) return known->second;
    Source made;
    try {
        made = opened(scene_.images[image]);
    } catch (const Error& e) {
        if (e.code() == ErrorCode::cancelled) throw;
        made = e;
    }
    return sources_.emplace(image, std::move(made)).first->second;
}

MaterialTexture GltfTextures::opened(const GltfImage& image) {
    const std::string place = "images[" + std::to_string(image.number) + "]";
    const GltfUri uri{file_, place, image.uri};
    MaterialTexture made{.place = file_.name + ": " + place};
    if (image.uri.empty())
        made.embedded = bytes_of_view(place, image.view);
    else if (uri.is_data())
        made.embedded = std::make_shared<const std::string>(uri.data(stop_));
    else
        made.path = file_.folder / uri.relative_path();
    return made;
}

std::shared_ptr<const std::string> GltfTextures::bytes_of_view(const std::string& place,
                                                               const GltfView& view) {
    const auto fail = [&](const std::string& what) { bad_file(file_.name, place + ": " + what); };
    if (view.buffer >= buffers_.size())
        fail("its buffer " + std::to_string(view.buffer) + " does not exist");
    const std::string_view bytes = buffers_[view.buffer];
    if (view.offset_bytes > bytes.size() || view.size_bytes > bytes.size() - view.offset_bytes)
        fail("its buffer view ends beyond its buffer");
    auto& known = views_[{view.buffer, view.offset_bytes, view.size_bytes}];
    if (known) return known;
    if (view.size_bytes > bytes_left_)
        fail("the pictures in the file have more bytes than the file and its buffers");
    bytes_left_ -= view.size_bytes;
    known = std::make_shared<const std::string>(bytes.substr(view.offset_bytes, view.size_bytes));
    return known;
}

}  // namespace rimline
