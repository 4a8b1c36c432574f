#pragma once

#include <string_view>

#include "silhouette/error.h"
#include "silhouette/mesh/mesh_source.h"

namespace rimline {

/// The MIME type of a picture that glTF files may hold, by its first bytes, or null: PNG or JPEG.
const char* picture_mime_type(std::string_view bytes) noexcept;

/// Reads the files of the textures that faces use into MaterialTexture::embedded, each file once, for a writer that
/// copies their bytes. A file that is missing or is neither PNG nor JPEG becomes one of MeshSource::warnings, and
/// `embedded` is null. One that cannot be decoded becomes a warning only. Throws Error{cancelled}. Cost: O(faces +
/// bytes of the files + pixels).
void embed_textures(MeshSource& source, const LongCall& call = {});

}  // namespace rimline
