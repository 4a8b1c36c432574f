#pragma once

// One small model in every format the library reads: thirteen points, of which some make faces.

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "tests/silhouette/mesh/formats/scratch_file.h"

namespace rimline::tests {

/// Appends values as bytes of the given order.
class Bytes {
public:
    explicit Bytes(std::endian order = std::endian::little) : order_(order) {}

    template <typename T>
    Bytes& add(T value) {
        char raw[sizeof(T)];
        std::memcpy(raw, &value, sizeof(T));
        if (order_ != std::endian::native) std::reverse(raw, raw + sizeof(T));
        bytes_.append(raw, sizeof(T));
        return *this;
    }
    Bytes& add_text(std::string_view text) {
        bytes_ += text;
        return *this;
    }
    const std::string& str() const { return bytes_; }

private:
    std::endian order_;
    std::string bytes_;
};

inline const std::vector<glm::vec3>& sample_positions() {
    static const std::vector<glm::vec3> positions{
        {0, 0, 0},     {1.5f, 0, 0}, {1.5f, 1.25f, 0},   {0, 1.25f, 0}, {-2, -2, -2},
        {-2, 3, 1},    {4, 4, 0.5f}, {0, 0, 2},          {1, 0, 2},     {1, 1, 2},
        {0, 1, 2.25f}, {7, 8, 9},    {-7.5f, 0.125f, 12}};
    return positions;
}

/// Triangles only, so that no triangulation stands between the file and what is compared.
inline const Triangles& sample_triangles() {
    static const Triangles triangles{{0, 2, 1}, {0, 3, 2}, {7, 8, 9}, {7, 9, 10}, {4, 11, 12}};
    return triangles;
}

inline std::string text_of(float value) {
    std::string text = std::to_string(value);  // Exact here: eighths have three decimals.
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

inline std::string text_of(glm::vec3 p) {
    return text_of(p.x) + " " + text_of(p.y) + " " + text_of(p.z);
}

/// The corners, separated by spaces, plus `base`.
inline std::string text_of(const std::array<std::uint32_t, 3>& t, std::uint32_t base) {
    std::string text = std::to_string(t[0] + base);
    for (int i = 1; i < 3; ++i) text.append(" ").append(std::to_string(t[i] + base));
    return text;
}

inline std::string sample_ply_text() {
    std::string text =
        "ply\nformat ascii 1.0\ncomment made by a test\nelement vertex 13\nproperty float x\n"
        "property float y\nproperty float z\nelement face 5\n"
        "property list uchar int vertex_indices\nend_header\n";
    for (const glm::vec3& p : sample_positions()) text += text_of(p) + "\n";
    for (const auto& t : sample_triangles()) text.append("3 ").append(text_of(t, 0)).append("\n");
    return text;
}

inline std::string sample_ply_binary(std::endian order) {
    Bytes bytes(order);
    bytes.add_text(order == std::endian::little ? "ply\nformat binary_little_endian 1.0\n"
                                                : "ply\nformat binary_big_endian 1.0\n");
    bytes.add_text(
        "element vertex 13\nproperty uchar red\nproperty double y\nproperty float x\n"
        "property float z\nproperty list uchar short extra\nelement edge 2\nproperty ushort a\n"
        "element face 3\nproperty list ushort uint vertex_index\nproperty char flag\n"
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n");
    for (const glm::vec3& p : sample_positions()) {
        bytes.add<std::uint8_t>(200).add<double>(p.y).add(p.x).add(p.z);
        bytes.add<std::uint8_t>(2).add<std::int16_t>(-1).add<std::int16_t>(7);
    }
    bytes.add<std::uint16_t>(1).add<std::uint16_t>(2);
    for (int i = 0; i < 3; ++i) {
        bytes.add<std::uint16_t>(3);
        for (const std::uint32_t corner : sample_triangles()[i]) bytes.add(corner);
        bytes.add<std::int8_t>(1);
    }
    bytes.add<std::int32_t>(7);
    for (const std::int32_t corner : {7, 9, 10, -1, 4, 11, 12}) bytes.add(corner);
    return bytes.str();
}

inline std::string sample_off() {
    std::string text = "OFF\n# made by a test\n13 5 0\n";
    for (const glm::vec3& p : sample_positions()) text += text_of(p) + "\n";
    for (const auto& t : sample_triangles()) text.append("3 ").append(text_of(t, 0)).append("\n");
    return text;
}

inline std::string sample_obj() {
    std::string text = "# made by a test\nmtllib missing.mtl\no thing\n";
    for (const glm::vec3& p : sample_positions()) text += "v " + text_of(p) + "\n";
    text += "vn 0 0 1\nvt 0.5 0.5\ng one\ns off\nusemtl red\n";
    for (const auto& t : sample_triangles()) text.append("f ").append(text_of(t, 1)).append("\n");
    return text;
}

/// STL holds corners, not vertices: these are its positions.
inline std::vector<glm::vec3> sample_soup() {
    std::vector<glm::vec3> soup;
    for (const auto& t : sample_triangles())
        for (const std::uint32_t corner : t) soup.push_back(sample_positions()[corner]);
    return soup;
}

inline std::string sample_stl_text() {
    std::string text = "solid a thing\n";
    const std::vector<glm::vec3> soup = sample_soup();
    for (std::size_t i = 0; i < soup.size(); i += 3) {
        text += "  facet normal 0 0 1\n    outer loop\n";
        for (std::size_t c = i; c < i + 3; ++c) text += "      vertex " + text_of(soup[c]) + "\n";
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid a thing\n";
}

inline std::string sample_stl_binary(std::string_view header = "made by a test") {
    Bytes bytes;
    std::string head(header);
    head.resize(80, ' ');
    bytes.add_text(head).add<std::uint32_t>(5);
    const std::vector<glm::vec3> soup = sample_soup();
    for (std::size_t i = 0; i < soup.size(); i += 3) {
        bytes.add(0.0f).add(0.0f).add(1.0f);
        for (std::size_t c = i; c < i + 3; ++c) bytes.add(soup[c].x).add(soup[c].y).add(soup[c].z);
        bytes.add<std::uint16_t>(0);
    }
    return bytes.str();
}

/// Positions, then indices of 16 bits: 156 and 30 bytes.
inline std::string sample_gltf_buffer() {
    Bytes bytes;
    for (const glm::vec3& p : sample_positions()) bytes.add(p.x).add(p.y).add(p.z);
    for (const auto& t : sample_triangles())
        for (const std::uint32_t corner : t) bytes.add(static_cast<std::uint16_t>(corner));
    return bytes.str();
}

inline std::string base64(std::string_view bytes) {
    constexpr std::string_view k_digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t j = 0; j < 3; ++j)
            group =
                group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            text += j <= bytes.size() - i ? k_digits[group >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

/// `buffer` is the buffer's JSON object.
inline std::string sample_gltf(const std::string& buffer) {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 13, "type": "VEC3"},
  {"bufferView": 1, "componentType": 5123, "count": 15, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteLength": 156},
  {"buffer": 0, "byteOffset": 156, "byteLength": 30}],
 "buffers": [)" +
           buffer + "]}";
}

inline std::string sample_gltf_embedded() {
    return sample_gltf(R"({"byteLength": 186, "uri": "data:application/octet-stream;base64,)" +
                       base64(sample_gltf_buffer()) + "\"}");
}

inline std::string glb_of(std::string json, std::string binary) {
    while (json.size() % 4 != 0) json += ' ';
    while (binary.size() % 4 != 0) binary += '\0';
    Bytes bytes;
    bytes.add_text("glTF").add<std::uint32_t>(2);
    bytes.add(static_cast<std::uint32_t>(28 + json.size() + binary.size()));
    bytes.add(static_cast<std::uint32_t>(json.size())).add_text("JSON").add_text(json);
    bytes.add(static_cast<std::uint32_t>(binary.size())).add_text(std::string("BIN\0", 4));
    return bytes.add_text(binary).str();
}

inline std::string sample_glb() {
    return glb_of(sample_gltf(R"({"byteLength": 186})"), sample_gltf_buffer());
}

struct SampleFile {
    std::string name, bytes;
};

inline std::vector<SampleFile> sample_files() {
    return {{"text.ply", sample_ply_text()},
            {"little.ply", sample_ply_binary(std::endian::little)},
            {"big.ply", sample_ply_binary(std::endian::big)},
            {"sample.off", sample_off()},
            {"sample.obj", sample_obj()},
            {"text.stl", sample_stl_text()},
            {"binary.stl", sample_stl_binary()},
            {"solid.stl", sample_stl_binary("solid but binary")},
            {"sample.gltf", sample_gltf_embedded()},
            {"sample.glb", sample_glb()}};
}

}  // namespace rimline::tests
