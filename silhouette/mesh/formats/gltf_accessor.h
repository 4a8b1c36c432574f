#pragma once

// The numbers of an accessor of a glTF model. All bounds are checked against the available bytes.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "silhouette/mesh/formats/gltf_buffers.h"

namespace tinygltf {
struct Accessor;
class Model;
}  // namespace tinygltf

namespace rimline {

class GltfAccessors {
public:
    /// `file`, `model` and `buffers` must outlive this. `file_bytes` is the size of the file and its buffers.
    /// An accessor without a buffer view holds zeros, and its count may be at most `file_bytes`.
    GltfAccessors(const std::string& file, const tinygltf::Model& model, const GltfBuffers& buffers,
                  std::uint64_t file_bytes)
        : file_(file), model_(model), buffers_(buffers), file_bytes_(file_bytes) {}

    /// Three numbers per element, of any component type, normalized if the accessor says so.
    std::vector<glm::dvec3> positions(int accessor) const;
    /// The first three of three or four numbers per element, likewise, limited to [0, 1].
    std::vector<glm::vec3> colors(int accessor) const;
    /// Two numbers for each of `count` elements, likewise, not limited.
    std::vector<glm::vec2> uvs(int accessor, std::size_t count) const;
    /// One unsigned integer per element.
    std::vector<std::uint32_t> indices(int accessor) const;

private:
    const tinygltf::Accessor& checked(int accessor) const;
    const tinygltf::Accessor& accessor_of_type(int accessor, int type, const char* name) const;
    // Elements that lie `stride` bytes apart.
    struct Elements {
        const char* bytes;
        std::size_t stride;
    };
    std::vector<double> numbers(int accessor, int width) const;
    Elements elements(int accessor, const char* part, int view, std::uint64_t offset,
                      std::uint64_t count, std::size_t element_bytes, bool may_stride) const;
    void apply_sparse(int accessor, int width, std::vector<double>& values) const;
    [[noreturn]] void fail(int accessor, const std::string& what) const;

    const std::string& file_;
    const tinygltf::Model& model_;
    const GltfBuffers& buffers_;
    std::uint64_t file_bytes_;
};

}  // namespace rimline
