#pragma once

// The bytes of a glTF's buffers: the binary chunk of a GLB, a file in the document's folder, or a data URI
// (RFC 2397) of any media type, in base64 or not.
//
// Buffers that name the same file share one copy, also if they spell its path differently, so a document
// cannot multiply the memory. Symbolic links are not resolved: they belong to the folder, not to the
// document.

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "silhouette/mesh/formats/gltf_scene.h"
#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

class GltfBuffers {
public:
    /// Reads all buffers. `file` and `binary_chunk` must outlive this. Relative URIs start from the folder
    /// of `file`. Without a chunk, the data() of `binary_chunk` is null. Throws Error{bad_input} or
    /// Error{io} that names the buffer if it is empty, shorter than its byteLength, outside the folder or
    /// not readable. Throws Error{cancelled} if `stop` is requested.
    GltfBuffers(const SourceFile& file, const std::vector<GltfBuffer>& buffers,
                std::string_view binary_chunk, const std::stop_token& stop);

    std::size_t size() const noexcept { return bytes_.size(); }
    /// The byteLength bytes of a buffer. data() is null if the document gives neither URI nor chunk. This
    /// is an error only if an accessor uses the buffer.
    std::string_view operator[](std::size_t buffer) const { return bytes_[buffer]; }
    /// The paths of the files that were read.
    std::vector<std::filesystem::path> paths() const;
    /// The number of bytes read or decoded, without the document itself.
    std::uint64_t bytes_read() const noexcept { return bytes_read_; }

private:
    std::filesystem::path folder_;
    std::vector<std::string_view> bytes_;
    // `bytes_` points into these two containers, which never move their strings.
    std::map<std::filesystem::path, std::string> files_;  // By normal path below the folder.
    std::deque<std::string> embedded_;
    std::uint64_t bytes_read_ = 0;
};

}  // namespace rimline
