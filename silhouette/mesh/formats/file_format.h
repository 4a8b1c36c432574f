#pragma once

// What kind of file it is: by its content, and by its name where content does not say.

#include <filesystem>

#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

enum class FileFormat { ply, stl_text, stl_binary, off, obj, gltf, glb, point_text };

/// Reads a file and sees what it is. Throws Error{io}, or Error{bad_input} for an empty file and for one
/// that is nothing known.
struct KnownFile {
    KnownFile(const std::filesystem::path& path, const LongCall& call);

    SourceFile file;
    FileFormat format;
};

}  // namespace rimline
