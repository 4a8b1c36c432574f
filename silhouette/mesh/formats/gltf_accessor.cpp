#include "silhouette/mesh/formats/gltf_accessor.h"

#include <algorithm>
#include <optional>

#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/source_file.h"

namespace rimline {

namespace {

std::optional<ScalarType> scalar_type(std::uint32_t component) noexcept {
    switch (component) {
        case 5120: return ScalarType::int8;
        case 5121: return ScalarType::uint8;
        case 5122: return ScalarType::int16;
        case 5123: return ScalarType::uint16;
        case 5125: return ScalarType::uint32;
        case 5126: return ScalarType::float32;
        default: return std::nullopt;
    }
}

bool is_unsigned(ScalarType type) noexcept {
    return type == ScalarType::uint8 || type == ScalarType::uint16 || type == ScalarType::uint32;
}

// The value of a normalized integer (glTF 2, 3.6.2.2).
double normalized(double value, ScalarType type) noexcept {
    switch (type) {
        case ScalarType::int8: return std::max(value / 127.0, -1.0);
        case ScalarType::uint8: return value / 255.0;
        case ScalarType::int16: return std::max(value / 32767.0, -1.0);
        case ScalarType::uint16: return value / 65535.0;
        default: return value;
    }
}

[[noreturn]] void bad_accessor(const std::string& file, std::uint32_t accessor,
                               const std::string& what) {
    bad_file(file, "accessors[" + std::to_string(accessor) + "]: " + what);
}

}  // namespace

glm::dvec4 GltfElements::next() {
    const char* bytes =
        elements_.bytes != nullptr ? elements_.bytes + at_ * elements_.stride : nullptr;
    if (sparse_at_ < sparse_count_ && sparse_index_ == at_) {
        bytes = values_.bytes + sparse_at_ * values_.stride;
        ++sparse_at_;
        read_sparse_index();
    }
    ++at_;
    glm::dvec4 element(0.0);
    if (bytes == nullptr) return element;
    for (int i = 0; i < width_; ++i) {
        const double value = load_scalar(bytes, type_, std::endian::little);
        element[i] = is_normalized_ ? normalized(value, type_) : value;
        bytes += size_bytes(type_);
    }
    return element;
}

void GltfElements::read_sparse_index() {
    if (sparse_at_ == sparse_count_) return;
    const auto index = static_cast<std::uint64_t>(load_scalar(
        indices_.bytes + sparse_at_ * indices_.stride, index_type_, std::endian::little));
    if (index >= count_)
        bad_accessor(file_, accessor_,
                     "sparse.indices: index " + std::to_string(index) +
                         " is out of range; there are " + std::to_string(count_) + " elements");
    if (sparse_at_ > 0 && index <= sparse_index_)
        bad_accessor(file_, accessor_,
                     "sparse.indices: index " + std::to_string(index) + " (number " +
                         std::to_string(sparse_at_) + ") follows " + std::to_string(sparse_index_) +
                         "; they should increase");
    sparse_index_ = index;
}

glm::dvec3 GltfElements::position() { return glm::dvec3(next()); }

glm::vec3 GltfElements::color() { return clamped_color(glm::dvec3(next())); }

glm::vec2 GltfElements::uv() { return glm::dvec2(next()); }

std::uint32_t GltfElements::index() { return static_cast<std::uint32_t>(next().x); }

GltfElements::Elements GltfAccessors::elements(std::uint32_t accessor, const char* part,
                                               std::uint32_t view_number, std::uint64_t offset,
                                               std::uint64_t count, std::size_t element_bytes,
                                               bool may_stride) const {
    const auto fail = [&](const std::string& what) { bad_accessor(file_, accessor, part + what); };
    if (view_number >= scene_.views.size())
        fail("bufferView " + std::to_string(view_number) + " does not exist");
    const GltfView& view = scene_.views[view_number];
    if (view.buffer >= buffers_.size())
        fail("bufferView " + std::to_string(view_number) + " has no buffer");
    const std::string_view data = buffers_[view.buffer];
    if (data.data() == nullptr)
        fail("buffers[" + std::to_string(view.buffer) +
             "]: has no uri, and there is no binary chunk for it");
    if (view.offset_bytes > data.size() || view.size_bytes > data.size() - view.offset_bytes)
        fail("bufferView " + std::to_string(view_number) + " reaches beyond its buffer of " +
             std::to_string(data.size()) + " bytes");
    const std::size_t stride =
        view.stride_bytes != 0 && may_stride ? view.stride_bytes : element_bytes;
    if (stride < element_bytes)
        fail("byteStride is less than an element's " + std::to_string(element_bytes) + " bytes");
    // Counts and strides are below 2^31, so the products do not overflow.
    if (count > 0 && offset + (count - 1) * stride + element_bytes > view.size_bytes)
        fail(std::to_string(count) + " elements reach beyond their bufferView of " +
             std::to_string(view.size_bytes) + " bytes");
    return {data.data() + view.offset_bytes + offset, stride};
}

GltfType GltfAccessors::type_of(std::uint32_t accessor) const {
    if (accessor >= scene_.accessors.size()) bad_accessor(file_, accessor, "does not exist");
    const GltfAccessor& a = scene_.accessors[accessor];
    if (!scalar_type(a.component))
        bad_accessor(file_, accessor,
                     "componentType " + std::to_string(a.component) + " is not glTF's");
    return a.type;
}

GltfElements GltfAccessors::opened(std::uint32_t accessor, int width) const {
    const GltfAccessor& a = scene_.accessors[accessor];
    GltfElements opened(file_, accessor);
    opened.count_ = a.count;
    opened.type_ = *scalar_type(a.component);
    opened.width_ = width;
    opened.is_normalized_ = a.is_normalized;
    if (a.view) {
        const std::size_t element_bytes =
            static_cast<std::size_t>(width) * size_bytes(opened.type_);
        opened.elements_ =
            elements(accessor, "", *a.view, a.offset_bytes, a.count, element_bytes, true);
    } else if (a.count > file_bytes_) {
        bad_accessor(file_, accessor,
                     std::to_string(a.count) + " elements of zeros, in a file of " +
                         std::to_string(file_bytes_) + " bytes; the count is wrong");
    }
    if (a.sparse) open_sparse(*a.sparse, opened);
    return opened;
}

void GltfAccessors::open_sparse(const GltfSparse& sparse, GltfElements& opened) const {
    const std::uint32_t accessor = opened.accessor_;
    const auto index_type = scalar_type(sparse.indices_component);
    if (!index_type || !is_unsigned(*index_type))
        bad_accessor(file_, accessor,
                     "sparse.indices: componentType should be an unsigned integer");
    // Their indices increase, so a larger count is wrong.
    if (sparse.count > opened.count_)
        bad_accessor(file_, accessor,
                     "sparse.count: " + std::to_string(sparse.count) +
                         " elements are replaced, but there are only " +
                         std::to_string(opened.count_));
    opened.sparse_count_ = sparse.count;
    opened.index_type_ = *index_type;
    opened.indices_ =
        elements(accessor, "sparse.indices: ", sparse.indices_view, sparse.indices_offset_bytes,
                 sparse.count, size_bytes(*index_type), false);
    opened.values_ = elements(
        accessor, "sparse.values: ", sparse.values_view, sparse.values_offset_bytes, sparse.count,
        static_cast<std::size_t>(opened.width_) * size_bytes(opened.type_), false);
    opened.read_sparse_index();
}

// Numbers of an attribute, as glTF 2 (3.7.2.1) and KHR_mesh_quantization allow them:
//
//                          float   normalized unsigned 8, 16   any other 8, 16   32-bit integers
//   positions              yes     quantized                   quantized         no
//   texture coordinates    yes     yes                         quantized         no
//   colors                 yes     yes                         no                no
bool GltfAccessors::has_color_numbers(std::uint32_t accessor) const {
    const GltfAccessor& a = scene_.accessors[accessor];
    const ScalarType type = *scalar_type(a.component);
    return type == ScalarType::float32 ||
           (a.is_normalized && (type == ScalarType::uint8 || type == ScalarType::uint16));
}

bool GltfAccessors::has_quantized_numbers(std::uint32_t accessor) const {
    return scene_.is_quantized &&
           *scalar_type(scene_.accessors[accessor].component) != ScalarType::uint32;
}

GltfElements GltfAccessors::positions(std::uint32_t accessor) const {
    if (type_of(accessor) != GltfType::vec3)
        bad_accessor(file_, accessor, "should be of type VEC3, as it holds positions");
    const std::uint32_t component = scene_.accessors[accessor].component;
    if (*scalar_type(component) != ScalarType::float32 && !has_quantized_numbers(accessor))
        bad_accessor(file_, accessor,
                     "componentType " + std::to_string(component) +
                         ": positions are floats, or integers of 8 or 16 bits if the file lists "
                         "KHR_mesh_quantization");
    return opened(accessor, 3);
}

GltfElements GltfAccessors::colors(std::uint32_t accessor) const {
    const GltfType type = type_of(accessor);
    if (type != GltfType::vec3 && type != GltfType::vec4)
        bad_accessor(file_, accessor, "should be of type VEC3 or VEC4, as it holds colors");
    return opened(accessor, type == GltfType::vec3 ? 3 : 4);
}

GltfElements GltfAccessors::uvs(std::uint32_t accessor) const {
    if (type_of(accessor) != GltfType::vec2)
        bad_accessor(file_, accessor, "should be of type VEC2, as it holds texture coordinates");
    if (!has_color_numbers(accessor) && !has_quantized_numbers(accessor))
        bad_accessor(file_, accessor,
                     "holds texture coordinates, which should be floats or normalized unsigned "
                     "integers of 8 or 16 bits");
    return opened(accessor, 2);
}

GltfElements GltfAccessors::indices(std::uint32_t accessor) const {
    if (type_of(accessor) != GltfType::scalar)
        bad_accessor(file_, accessor, "should be of type SCALAR, as it holds indices");
    const GltfAccessor& a = scene_.accessors[accessor];
    if (a.is_normalized || !is_unsigned(*scalar_type(a.component)))
        bad_accessor(file_, accessor,
                     "holds indices, which should be unsigned integers and not normalized");
    return opened(accessor, 1);
}

GltfElements GltfAccessors::bit_field(std::uint32_t accessor) const {
    if (type_of(accessor) != GltfType::scalar ||
        scalar_type(scene_.accessors[accessor].component) != ScalarType::uint8)
        bad_accessor(file_, accessor, "should be of type SCALAR and of bytes, as it holds bits");
    return indices(accessor);
}

GltfElements GltfAccessors::normals(std::uint32_t accessor) const {
    if (type_of(accessor) != GltfType::vec3 ||
        is_unsigned(*scalar_type(scene_.accessors[accessor].component)))
        bad_accessor(file_, accessor,
                     "should be of type VEC3 and of floats or signed integers, as it holds "
                     "normals");
    return opened(accessor, 3);
}

std::uint32_t GltfAccessors::restart_index(std::uint32_t accessor) const {
    switch (*scalar_type(scene_.accessors[accessor].component)) {
        case ScalarType::uint8: return 0xff;
        case ScalarType::uint16: return 0xffff;
        default: return 0xffffffff;
    }
}

}  // namespace rimline
