#include "silhouette/mesh/formats/embed_textures.h"

#include <map>
#include <new>
#include <span>
#include <utility>

#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/source_file.h"
#include "silhouette/mesh/formats/wrapped_content.h"
#include "silhouette/picture.h"

namespace rimline {

namespace {

using Bytes = std::shared_ptr<const std::string>;

void warn_of_damage(const std::string& bytes, const std::string& name,
                    std::vector<std::string>& warnings) {
    try {
        decode_picture(std::as_bytes(std::span<const char>(bytes)));
    } catch (const Error& e) {
        add_warning(warnings, name + e.what() + "; it is copied as it is");
    } catch (const std::bad_alloc&) {
        // Too large to look into here. Copies need less.
    }
}

// Null, with a warning, if it cannot be used.
Bytes read_texture(const MaterialTexture& texture, const LongCall& call,
                   std::vector<std::string>& warnings) {
    const auto warn = [&](const std::string& what) {
        add_warning(warnings, texture.place + ": " + what + "; the texture is missing");
    };
    Bytes bytes = texture.embedded;
    std::string name;
    try {
        if (!bytes) {
            SourceFile file = read_source_file(texture.path, {call.stop, {}});
            name = file.name + ": ";
            bytes = std::make_shared<const std::string>(std::move(file.bytes));
        }
        if (picture_mime_type(*bytes)) {
            warn_of_damage(*bytes, texture.place + ": " + name, warnings);
            return bytes;
        }
        const std::string_view what = wrapped_content(*bytes);
        warn(name + (what.empty() ? "it is neither PNG nor JPEG" : std::string(what)));
    } catch (const Error& e) {
        if (e.code() == ErrorCode::cancelled) throw;
        warn(e.what());
    }
    return nullptr;
}

}  // namespace

const char* picture_mime_type(std::string_view bytes) noexcept {
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
    if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
    return nullptr;
}

void embed_textures(MeshSource& source, const LongCall& call) {
    FaceMaterials& materials = source.materials;
    if (materials.corner_uvs.empty()) return;
    const std::vector<bool> is_used = used_textures(materials);
    // By file, or by the bytes within the model's file. `kept` keeps the addresses of those taken.
    std::map<std::pair<std::filesystem::path, const std::string*>, Bytes> read;
    std::vector<Bytes> kept;
    for (std::size_t t = 0; t < materials.textures.size(); ++t) {
        call.checkpoint(static_cast<double>(t) / static_cast<double>(materials.textures.size()));
        MaterialTexture& texture = materials.textures[t];
        if (!is_used[t]) {
            texture.embedded = nullptr;
            continue;
        }
        kept.push_back(texture.embedded);
        const auto [bytes, is_new] = read.try_emplace({texture.path, texture.embedded.get()});
        if (is_new) bytes->second = read_texture(texture, call, source.warnings);
        texture.embedded = bytes->second;
    }
    call.checkpoint(1.0);
}

}  // namespace rimline
