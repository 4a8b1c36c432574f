#include "silhouette/mesh/formats/gltf_textures.h"

#include "silhouette/mesh/formats/gltf_uri.h"

namespace rimline {

namespace {

std::string bytes_of_buffer(const GltfUri& source, const GltfImage& image,
                            const GltfBuffers& buffers) {
    if (image.buffer >= buffers.size())
        source.fail("its buffer " + std::to_string(image.buffer) + " does not exist");
    const std::string_view bytes = buffers[image.buffer];
    if (image.offset_bytes > bytes.size() || image.size_bytes > bytes.size() - image.offset_bytes)
        source.fail("its buffer view ends beyond its buffer");
    return std::string(bytes.substr(image.offset_bytes, image.size_bytes));
}

}  // namespace

MaterialTexture material_texture(const SourceFile& file, const GltfTexture& texture,
                                 const GltfBuffers& buffers,
                                 std::map<std::string, std::shared_ptr<const std::string>>& known) {
    const GltfImage& image = texture.image;
    const GltfUri source{file, image.place, image.uri};
    MaterialTexture made{.place = file.name + ": " + image.place,
                         .wrap_u = texture.wrap_u,
                         .wrap_v = texture.wrap_v,
                         .is_pixelated = texture.is_pixelated};
    if (!image.uri.empty() && !source.is_data()) {
        made.path = file.folder / source.relative_path();
        return made;
    }
    std::shared_ptr<const std::string>& bytes = known[image.place];
    if (!bytes)
        bytes = std::make_shared<const std::string>(
            source.is_data() ? source.data() : bytes_of_buffer(source, image, buffers));
    made.embedded = bytes;
    return made;
}

}  // namespace rimline
