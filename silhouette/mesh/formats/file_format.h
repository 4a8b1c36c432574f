#pragma once

// The format of a file: decided by its content, and by its name if the content does not decide.

#include <filesystem>
#include <string>

#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

enum class FileFormat { ply, stl_text, stl_binary, off, obj, gltf, glb, point_text };

/// Reads a file and finds its format. Throws Error{io}, or Error{bad_input} for an empty file, an unknown format or
/// wrapped_content().
struct KnownFile {
    KnownFile(const std::filesystem::path& path, const LongCall& call);
    /// The same for bytes that were read already. `extension`, with its point and in lower case, stands for that
    /// of the name.
    KnownFile(SourceFile source, const std::string& extension);

    SourceFile file;
    FileFormat format;
};

/// Bytes that must have the format of `extension`; else Error{bad_input}. ".xyz", ".pts" and ".csv" are one
/// format.
KnownFile known_bytes(const std::string& name, std::string bytes, const std::string& extension);

}  // namespace rimline
