// read_textures() and check_textures().

#include <map>
#include <span>
#include <utility>

#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/mesh_file.h"
#include "silhouette/mesh/formats/source_file.h"
#include "silhouette/mesh/formats/wrapped_content.h"
#include "silhouette/printable_text.h"

namespace rimline {

namespace {

using PicturePointer = std::shared_ptr<const Picture>;

PicturePointer decoded(const std::string& bytes) {
    return std::make_shared<const Picture>(
        decode_picture(std::as_bytes(std::span<const char>(bytes))));
}

PicturePointer read_picture(const MaterialTexture& texture, const LongCall& call,
                            std::vector<std::string>& warnings) {
    const auto warn = [&](const std::string& what) {
        add_warning(warnings,
                    texture.place + ": " + printable_text(what) + "; the texture is missing");
    };
    const std::string name = texture.embedded ? std::string() : texture.path.string() + ": ";
    try {
        if (texture.embedded) return decoded(*texture.embedded);
        const SourceFile file = read_source_file(texture.path, {call.stop, {}});
        try {
            return decoded(file.bytes);
        } catch (const Error& e) {
            const std::string_view what = wrapped_content(file.bytes);
            warn(file.name + ": " + (what.empty() ? e.what() : std::string(what)));
        }
    } catch (const Error& e) {
        if (e.code() == ErrorCode::cancelled) throw;
        warn(e.what());
    } catch (const std::bad_alloc&) {
        warn(name + "there is not enough memory for the picture");
    }
    return nullptr;
}

// Where pictures are not kept, each is freed before the next one is read.
void read_pictures(MeshSource& source, bool are_kept, const LongCall& call) {
    FaceMaterials& materials = source.materials;
    if (materials.corner_uvs.empty()) return;
    const std::vector<bool> is_used = used_textures(materials);
    // By file, or by the bytes within the model's file. Null: could not be read.
    std::map<std::pair<std::filesystem::path, const std::string*>, PicturePointer> pictures;
    for (std::size_t t = 0; t < materials.textures.size(); ++t) {
        call.checkpoint(static_cast<double>(t) / static_cast<double>(materials.textures.size()));
        MaterialTexture& texture = materials.textures[t];
        if (!is_used[t] || texture.picture) continue;
        const auto [picture, is_new] = pictures.try_emplace({texture.path, texture.embedded.get()});
        if (is_new) {
            PicturePointer made = read_picture(texture, call, source.warnings);
            if (are_kept) picture->second = std::move(made);
        }
        texture.picture = picture->second;
    }
    call.checkpoint(1.0);
}

}  // namespace

void read_textures(MeshSource& source, const LongCall& call) {
    read_pictures(source, true, call);
    for (MaterialTexture& texture : source.materials.textures) texture.embedded = nullptr;
}

void check_textures(MeshSource& source, const LongCall& call) {
    read_pictures(source, false, call);
}

}  // namespace rimline
