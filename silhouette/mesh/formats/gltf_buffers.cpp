#include "silhouette/mesh/formats/gltf_buffers.h"

#include <filesystem>
#include <utility>

#include "silhouette/mesh/formats/gltf_uri.h"

namespace rimline {

GltfBuffers::GltfBuffers(const SourceFile& file, const std::vector<GltfBuffer>& buffers,
                         std::string_view binary_chunk, const std::stop_token& stop)
    : folder_(file.folder) {
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        if (i % k_checkpoint_interval == 0) LongCall{stop, {}}.checkpoint(0.0);
        const GltfBuffer& buffer = buffers[i];
        const GltfUri source{file, "buffers[" + std::to_string(i) + "]", buffer.uri};
        if (buffer.size_bytes == 0) source.fail("byteLength is 0");
        std::string_view bytes;
        std::string name = "the binary chunk";
        if (!buffer.uri.empty()) {
            name = excerpt(buffer.uri);
            if (source.is_data()) {
                bytes = embedded_.emplace_back(source.data(stop));
                bytes_read_ += bytes.size();
            } else {
                const std::filesystem::path path = source.relative_path();
                // Without "..", a path and its normal form name the same file.
                const auto [found, is_new] = files_.try_emplace(path.lexically_normal());
                if (is_new) {
                    found->second = source.read_file(path, stop);
                    bytes_read_ += found->second.size();
                }
                bytes = found->second;
            }
        } else if (i == 0 && binary_chunk.data() != nullptr) {
            bytes = binary_chunk;
        } else {
            bytes_.emplace_back();
            continue;
        }
        if (bytes.size() < buffer.size_bytes)
            source.fail("byteLength is " + std::to_string(buffer.size_bytes) + " but " + name +
                        " has only " + std::to_string(bytes.size()) + " bytes");
        bytes_.push_back(bytes.substr(0, buffer.size_bytes));
    }
}

std::vector<std::filesystem::path> GltfBuffers::paths() const {
    std::vector<std::filesystem::path> paths;
    for (const auto& [path, bytes] : files_) paths.push_back(folder_ / path);
    return paths;
}

}  // namespace rimline
