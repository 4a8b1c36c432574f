#pragma once

// The numbers of an accessor of a glTF scene. All bounds are checked against the available bytes.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>

#include "silhouette/mesh/formats/byte_scanner.h"
#include "silhouette/mesh/formats/gltf_buffers.h"
#include "silhouette/mesh/formats/gltf_scene.h"

namespace rimline {

/// Reads the elements of one accessor in order, without a copy of them.
class GltfElements {
public:
    std::uint32_t count() const noexcept { return count_; }

    // Call one of these at most count() times. They throw Error{bad_input} if sparse indices do not increase.
    /// Three numbers, normalized if the accessor says so.
    glm::dvec3 position();
    /// The first three of three or four numbers, likewise, limited to [0, 1].
    glm::vec3 color();
    /// Two numbers, likewise, not limited.
    glm::vec2 uv();
    /// An unsigned integer.
    std::uint32_t index();

private:
    friend class GltfAccessors;
    // Elements that lie `stride` bytes apart. Without bytes, they are zeros.
    struct Elements {
        const char* bytes = nullptr;
        std::size_t stride = 0;
    };
    GltfElements(const std::string& file, std::uint32_t accessor) noexcept
        : file_(file), accessor_(accessor) {}
    glm::dvec4 next();
    void read_sparse_index();

    const std::string& file_;
    std::uint32_t accessor_;
    std::uint32_t count_ = 0;
    ScalarType type_ = ScalarType::float32;
    int width_ = 1;  // Numbers of an element.
    bool is_normalized_ = false;
    Elements elements_;
    std::uint32_t at_ = 0;  // The next element.
    // Sparse elements. Their indices increase, so one of them is enough to know.
    std::uint32_t sparse_count_ = 0;
    std::uint32_t sparse_at_ = 0;
    std::uint64_t sparse_index_ = 0;  // The element that number `sparse_at_` replaces.
    ScalarType index_type_ = ScalarType::uint8;
    Elements indices_;
    Elements values_;
};

class GltfAccessors {
public:
    /// `file`, `scene` and `buffers` must outlive this and what it returns. `file_bytes` is the size of the file
    /// and its buffers. An accessor without a buffer view holds zeros, and its count may be at most `file_bytes`.
    GltfAccessors(const std::string& file, const GltfScene& scene, const GltfBuffers& buffers,
                  std::uint64_t file_bytes)
        : file_(file), scene_(scene), buffers_(buffers), file_bytes_(file_bytes) {}

    // Each throws Error{bad_input} if the accessor cannot hold such elements or reaches beyond its bytes. O(1).
    GltfElements positions(std::uint32_t accessor) const;
    /// Where has_color_numbers() is false, its numbers are no colors.
    GltfElements colors(std::uint32_t accessor) const;
    /// Whether the numbers of an accessor that colors() accepts are floats or normalized 8 or 16 bits, unsigned: of
    /// others glTF does not say which one is white.
    bool has_color_numbers(std::uint32_t accessor) const;
    GltfElements uvs(std::uint32_t accessor) const;
    GltfElements indices(std::uint32_t accessor) const;
    /// Bytes, read by index().
    GltfElements bit_field(std::uint32_t accessor) const;
    /// Floats or signed integers, read by position(), whose length means nothing.
    GltfElements normals(std::uint32_t accessor) const;
    /// The index that no vertex has, as it separates strips: of an accessor that indices() accepts.
    std::uint32_t restart_index(std::uint32_t accessor) const;

private:
    GltfType type_of(std::uint32_t accessor) const;
    bool has_quantized_numbers(std::uint32_t accessor) const;
    GltfElements opened(std::uint32_t accessor, int width) const;
    void open_sparse(const GltfSparse& sparse, GltfElements& elements) const;
    GltfElements::Elements elements(std::uint32_t accessor, const char* part, std::uint32_t view,
                                    std::uint64_t offset, std::uint64_t count,
                                    std::size_t element_bytes, bool may_stride) const;

    const std::string& file_;
    const GltfScene& scene_;
    const GltfBuffers& buffers_;
    std::uint64_t file_bytes_;
};

}  // namespace rimline
