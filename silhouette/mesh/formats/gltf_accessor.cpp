#include "silhouette/mesh/formats/gltf_accessor.h"

#include <algorithm>
#include <optional>

#include "silhouette/mesh/formats/byte_scanner.h"
#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/source_file.h"
#include "silhouette/mesh/formats/tinygltf.h"

namespace rimline {

namespace {

std::optional<ScalarType> scalar_type(int component_type) noexcept {
    switch (component_type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: return ScalarType::int8;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return ScalarType::uint8;
        case TINYGLTF_COMPONENT_TYPE_SHORT: return ScalarType::int16;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return ScalarType::uint16;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return ScalarType::uint32;
        case TINYGLTF_COMPONENT_TYPE_FLOAT: return ScalarType::float32;
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

double load(const char* bytes, std::size_t i, ScalarType type) noexcept {
    return load_scalar(bytes + i * size_bytes(type), type, std::endian::little);
}

}  // namespace

void GltfAccessors::fail(int accessor, const std::string& what) const {
    bad_file(file_, "accessors[" + std::to_string(accessor) + "]: " + what);
}

GltfAccessors::Elements GltfAccessors::elements(int accessor, const char* part, int view_number,
                                                std::uint64_t offset, std::uint64_t count,
                                                std::size_t element_bytes, bool may_stride) const {
    const std::string where(part);
    if (view_number < 0 || static_cast<std::size_t>(view_number) >= model_.bufferViews.size())
        fail(accessor, where + "bufferView " + std::to_string(view_number) + " does not exist");
    const tinygltf::BufferView& view = model_.bufferViews[static_cast<std::size_t>(view_number)];
    if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= buffers_.size())
        fail(accessor, where + "bufferView " + std::to_string(view_number) + " has no buffer");
    const std::string_view data = buffers_[static_cast<std::size_t>(view.buffer)];
    if (data.data() == nullptr)
        fail(accessor, where + "buffers[" + std::to_string(view.buffer) +
                           "]: has no uri, and there is no binary chunk for it");
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        fail(accessor, where + "bufferView " + std::to_string(view_number) +
                           " reaches beyond its buffer of " + std::to_string(data.size()) +
                           " bytes");
    const std::size_t stride = view.byteStride != 0 && may_stride ? view.byteStride : element_bytes;
    if (stride < element_bytes)
        fail(accessor, where + "byteStride is less than an element's " +
                           std::to_string(element_bytes) + " bytes");
    // Counts and strides are below 2^31, so the products do not overflow.
    if (count > 0 && offset + (count - 1) * stride + element_bytes > view.byteLength)
        fail(accessor, where + std::to_string(count) +
                           " elements reach beyond their bufferView of " +
                           std::to_string(view.byteLength) + " bytes");
    return {data.data() + view.byteOffset + offset, stride};
}

const tinygltf::Accessor& GltfAccessors::checked(int accessor) const {
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= model_.accessors.size())
        fail(accessor, "does not exist");
    const tinygltf::Accessor& a = model_.accessors[static_cast<std::size_t>(accessor)];
    if (!scalar_type(a.componentType))
        fail(accessor, "componentType " + std::to_string(a.componentType) + " is not glTF's");
    return a;
}

const tinygltf::Accessor& GltfAccessors::accessor_of_type(int accessor, int type,
                                                          const char* name) const {
    const tinygltf::Accessor& a = checked(accessor);
    if (a.type != type) fail(accessor, std::string("should be of type ") + name);
    return a;
}

std::vector<double> GltfAccessors::numbers(int accessor, int width) const {
    const tinygltf::Accessor& a = model_.accessors[static_cast<std::size_t>(accessor)];
    const auto type = scalar_type(a.componentType);
    const std::uint64_t count = a.count;
    const auto components = static_cast<std::size_t>(width);
    const std::size_t element_bytes = components * size_bytes(*type);
    std::vector<double> values;
    if (a.bufferView < 0) {
        if (count > file_bytes_)
            fail(accessor, std::to_string(count) + " elements of zeros, in a file of " +
                               std::to_string(file_bytes_) + " bytes; the count is wrong");
        values.resize(count * components, 0.0);
    } else {
        const Elements from =
            elements(accessor, "", a.bufferView, a.byteOffset, count, element_bytes, true);
        values.reserve(count * components);
        for (std::uint64_t i = 0; i < count; ++i)
            for (std::size_t c = 0; c < components; ++c)
                values.push_back(load(from.bytes + i * from.stride, c, *type));
    }
    if (a.sparse.isSparse) apply_sparse(accessor, width, values);
    if (a.normalized)
        for (double& value : values) value = normalized(value, *type);
    return values;
}

void GltfAccessors::apply_sparse(int accessor, int width, std::vector<double>& values) const {
    const tinygltf::Accessor& a = model_.accessors[static_cast<std::size_t>(accessor)];
    const auto type = *scalar_type(a.componentType);
    const auto index_type = scalar_type(a.sparse.indices.componentType);
    if (!index_type || !is_unsigned(*index_type))
        fail(accessor, "sparse.indices: componentType should be an unsigned integer");
    const auto count = static_cast<std::uint64_t>(a.sparse.count);
    // Sparse indices increase, so a larger count is wrong. It would also cost time not limited by
    // a.count.
    if (count > a.count)
        fail(accessor, "sparse.count: " + std::to_string(count) +
                           " elements are replaced, but there are only " + std::to_string(a.count));
    const auto components = static_cast<std::size_t>(width);
    const Elements at = elements(accessor, "sparse.indices: ", a.sparse.indices.bufferView,
                                 static_cast<std::uint64_t>(a.sparse.indices.byteOffset), count,
                                 size_bytes(*index_type), false);
    const Elements from = elements(accessor, "sparse.values: ", a.sparse.values.bufferView,
                                   static_cast<std::uint64_t>(a.sparse.values.byteOffset), count,
                                   components * size_bytes(type), false);
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto element = static_cast<std::uint64_t>(load(at.bytes, i, *index_type));
        if (element >= a.count)
            fail(accessor, "sparse.indices: index " + std::to_string(element) +
                               " is out of range; there are " + std::to_string(a.count) +
                               " elements");
        for (std::size_t c = 0; c < components; ++c)
            values[element * components + c] = load(from.bytes + i * from.stride, c, type);
    }
}

std::vector<glm::dvec3> GltfAccessors::positions(int accessor) const {
    accessor_of_type(accessor, TINYGLTF_TYPE_VEC3, "VEC3, as it holds positions");
    const std::vector<double> values = numbers(accessor, 3);
    std::vector<glm::dvec3> positions;
    positions.reserve(values.size() / 3);
    for (std::size_t i = 0; i < values.size(); i += 3)
        positions.emplace_back(values[i], values[i + 1], values[i + 2]);
    return positions;
}

std::vector<glm::vec3> GltfAccessors::colors(int accessor) const {
    const tinygltf::Accessor& a = checked(accessor);
    if (a.type != TINYGLTF_TYPE_VEC3 && a.type != TINYGLTF_TYPE_VEC4)
        fail(accessor, "should be of type VEC3 or VEC4, as it holds colors");
    const std::size_t width = a.type == TINYGLTF_TYPE_VEC3 ? 3 : 4;
    const std::vector<double> values = numbers(accessor, static_cast<int>(width));
    std::vector<glm::vec3> colors;
    colors.reserve(values.size() / width);
    for (std::size_t i = 0; i < values.size(); i += width)
        colors.push_back(clamped_color(glm::dvec3(values[i], values[i + 1], values[i + 2])));
    return colors;
}

std::vector<glm::vec2> GltfAccessors::uvs(int accessor, std::size_t count) const {
    const tinygltf::Accessor& a =
        accessor_of_type(accessor, TINYGLTF_TYPE_VEC2, "VEC2, as it holds texture coordinates");
    // First, because it is not known how often it is read.
    if (a.count != count)
        fail(accessor, "has " + std::to_string(a.count) + " elements for " + std::to_string(count) +
                           " vertices");
    const std::vector<double> values = numbers(accessor, 2);
    std::vector<glm::vec2> uvs;
    uvs.reserve(values.size() / 2);
    for (std::size_t i = 0; i < values.size(); i += 2) uvs.emplace_back(values[i], values[i + 1]);
    return uvs;
}

std::vector<std::uint32_t> GltfAccessors::indices(int accessor) const {
    const tinygltf::Accessor& a =
        accessor_of_type(accessor, TINYGLTF_TYPE_SCALAR, "SCALAR, as it holds indices");
    if (a.normalized || !is_unsigned(*scalar_type(a.componentType)))
        fail(accessor, "holds indices, which should be unsigned integers and not normalized");
    const std::vector<double> values = numbers(accessor, 1);
    std::vector<std::uint32_t> indices;
    indices.reserve(values.size());
    for (const double value : values) indices.push_back(static_cast<std::uint32_t>(value));
    return indices;
}

}  // namespace rimline
