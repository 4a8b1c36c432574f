#pragma once

// The textures of a GLB file: images, samplers and textures of its document.

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "silhouette/mesh/face_materials.h"

namespace rimline {

class GlbTextures {
public:
    using Json = nlohmann::ordered_json;

    /// Appends bytes to the file and returns the number of their buffer view.
    using AddView = std::function<std::size_t(const std::string& bytes)>;

    /// The number of the file's texture for a texture with embedded bytes. Textures of the same bytes share an image,
    /// and those that repeat or end in the same way a sampler.
    std::size_t add(const MaterialTexture& texture, const AddView& add_view);

    /// Adds what was added to the document.
    void write_to(Json& document) const;

private:
    std::map<const std::string*, std::size_t> images_of_bytes_;
    Json images_ = Json::array(), samplers_ = Json::array(), textures_ = Json::array();
};

}  // namespace rimline
