#pragma once

// A URI of a glTF document: a file in the document's folder or below it, or data (RFC 2397) of any media type, in
// base64 or not.

#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>

#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

/// Its functions throw Error{bad_input} that begins with the file and the place.
struct GltfUri {
    const SourceFile& file;
    std::string place;  ///< Of what has the URI: "buffers[2]".
    std::string_view uri;

    [[noreturn]] void fail(const std::string& what) const;

    bool is_data() const noexcept { return uri.starts_with("data:"); }
    /// The bytes of data. Throws Error{cancelled} if `stop` is requested.
    std::string data(const std::stop_token& stop) const;
    /// The path of a file, below the document's folder, without "..".
    std::filesystem::path relative_path() const;
    /// The bytes of the file. Throws Error{io} and Error{cancelled} as read_source_file().
    std::string read_file(const std::filesystem::path& relative, const std::stop_token& stop) const;

private:
    std::string unescaped(std::string_view text, const std::stop_token& stop) const;
    std::string from_base64(std::string_view text, const std::stop_token& stop) const;
};

}  // namespace rimline
