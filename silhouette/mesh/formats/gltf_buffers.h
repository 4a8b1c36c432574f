#pragma once

// The bytes behind a glTF's buffers: the binary chunk of a GLB, a file beside the document, or a data
// URI (RFC 2397) of any media type, in base64 or not.
//
// Buffers that name the same file, however they spell its path, share one copy of it, so a document cannot
// multiply what it names. Links are not looked through: those lie in the folder, not in the document.

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
    /// Reads all of them. `file`, whose folder relative URIs start from, and `binary_chunk` must
    /// outlive this; without a chunk its data() is null. Throws Error{bad_input} or Error{io} that
    /// names the buffer: one that is empty, is shorter than its byteLength, lies outside the folder
    /// or cannot be read; Error{cancelled} where `stop` is requested.
    GltfBuffers(const SourceFile& file, const std::vector<GltfBuffer>& buffers,
                std::string_view binary_chunk, const std::stop_token& stop);

    std::size_t size() const noexcept { return bytes_.size(); }
    /// byteLength bytes. data() is null where the document gives neither URI nor chunk, which only
    /// matters to those who need them.
    std::string_view operator[](std::size_t buffer) const { return bytes_[buffer]; }
    /// What was read or decoded, beside the document itself.
    std::uint64_t bytes_read() const noexcept { return bytes_read_; }

private:
    std::vector<std::string_view> bytes_;
    // In both a string stays where it is.
    std::map<std::filesystem::path, std::string> files_;  // By normal path below the folder.
    std::deque<std::string> embedded_;
    std::uint64_t bytes_read_ = 0;
};

}  // namespace rimline
