#pragma once

// The textures of a glTF's materials.
//
// A document can name one picture any number of times, so each is decoded once, and textures that differ only in
// their use of coordinates are one. Together the pictures that the file holds may have as many bytes as the
// file and its buffers: views of buffers can overlap.

#include <cstdint>
#include <map>
#include <memory>
#include <stop_token>
#include <string>
#include <tuple>
#include <variant>

#include "silhouette/mesh/formats/gltf_buffers.h"
#include "silhouette/mesh/formats/gltf_scene.h"
#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

class GltfTextures {
public:
    /// All must outlive this. `file_bytes` is the size of the file and its buffers.
    GltfTextures(const SourceFile& file, const GltfScene& scene, const GltfBuffers& buffers,
                 std::uint64_t file_bytes, const std::stop_token& stop)
        : file_(file), scene_(scene), buffers_(buffers), bytes_left_(file_bytes), stop_(stop) {}

    /// The texture of number `texture` of the scene, appended to `textures` unless an equal one is there. Throws
    /// Error{bad_input} if its bytes or its file cannot be named, and Error{cancelled}.
    TextureId add_to(std::vector<MaterialTexture>& textures, std::uint32_t texture);

private:
    // What an image is, without what a texture does with it; or why it cannot be used.
    using Source = std::variant<MaterialTexture, Error>;
    const Source& source(std::uint32_t image);
    MaterialTexture opened(const GltfImage& image);
    std::shared_ptr<const std::string> bytes_of_view(const std::string& place,
                                                     const GltfView& view);

    const SourceFile& file_;
    const GltfScene& scene_;
    const GltfBuffers& buffers_;
    std::uint64_t bytes_left_;
    const std::stop_token& stop_;
    std::map<std::uint32_t, Source> sources_;  // By number in GltfScene::images.
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>,
             std::shared_ptr<const std::string>>
        views_;  // By buffer, offset and size.
    std::map<std::tuple<std::uint32_t, TextureWrap, TextureWrap, bool>, TextureId> added_;
};

}  // namespace rimline
