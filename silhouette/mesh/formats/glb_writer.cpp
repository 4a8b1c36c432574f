#include "silhouette/mesh/formats/glb_writer.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "silhouette/mesh/formats/glb_corners.h"
#include "silhouette/mesh/formats/glb_textures.h"
#include "silhouette/mesh/formats/gltf_scene.h"

namespace rimline {

namespace {

using GlbJson = nlohmann::ordered_json;

// glTF's numbers.
constexpr int k_byte = 5120, k_unsigned_byte = 5121, k_unsigned_short = 5123, k_unsigned_int = 5125,
              k_float = 5126;
constexpr int k_array_buffer = 34962, k_element_array_buffer = 34963;
// The greatest 16-bit index separates strips.
constexpr std::uint32_t k_max_short_vertices = 0xffff;

static_assert(std::endian::native == std::endian::little);

// The matrix of a node, column by column, that turns an axis to y. Of zeros and ones, so that no coordinate is rounded.
GlbJson turned_to_y(const glm::dvec3& up) {
    // The direction that is turned to z; x follows from both.
    const glm::dvec3 front = up.y < 0.0    ? glm::dvec3(0.0, 0.0, -1.0)
                             : up.x != 0.0 ? glm::dvec3(0.0, 0.0, 1.0)
                                           : glm::dvec3(0.0, -up.z, 0.0);
    const glm::dmat3 rows(glm::cross(up, front), up, front);
    GlbJson matrix = GlbJson::array();
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            matrix.push_back(column < 3 && row < 3 ? int(rows[row][column]) : int(column == row));
    return matrix;
}

class GlbWriter {
public:
    GlbWriter(const Mesh& mesh, const GlbOptions& options)
        : mesh_(mesh),
          options_(options),
          corners_(checked_corners(mesh)),
          is_written_(mesh.edge_count(), 0) {}

    std::string bytes() {
        check_size(sizeof(glm::vec3) * (vertex_count() + corners_.colors.size()) +
                   sizeof(glm::vec2) * corners_.uvs.size() +
                   std::uint64_t{3} * mesh_.face_count() * (has_short_indices() ? 2 : 4));
        document_["asset"] = {{"version", "2.0"}, {"generator", "rimline"}};
        add_positions();
        if (!corners_.colors.empty()) color_accessor_ = add_attribute(corners_.colors, "VEC3");
        if (!corners_.uvs.empty()) uv_accessor_ = add_attribute(corners_.uvs, "VEC2");
        GlbJson primitives = GlbJson::array();
        for (const std::vector<FaceId>& faces : faces_by_material())
            primitives.push_back(primitive(faces));
        if (uses_edges_) document_["extensionsUsed"] = GlbJson::array({k_gltf_edges});
        document_["scene"] = 0;
        document_["scenes"] = GlbJson::array({GlbJson{{"nodes", GlbJson::array({0})}}});
        GlbJson node{{"mesh", 0}};
        if (options_.up != glm::dvec3(0.0, 1.0, 0.0)) node["matrix"] = turned_to_y(options_.up);
        document_["nodes"] = GlbJson::array({node});
        document_["meshes"] = GlbJson::array({GlbJson{{"primitives", primitives}}});
        if (!materials_.empty()) document_["materials"] = materials_;
        textures_.write_to(document_);
        document_["accessors"] = accessors_;
        document_["bufferViews"] = views_;
        document_["buffers"] = GlbJson::array({GlbJson{{"byteLength", binary_.size()}}});
        return joined();
    }

private:
    // Before memory is taken.
    static GlbCorners checked_corners(const Mesh& mesh) {
        check_size(sizeof(glm::vec3) * std::uint64_t{mesh.vertex_count()} +
                   2 * std::uint64_t{3} * mesh.face_count());
        return glb_corners(mesh);
    }

    // The faces of each material, in the order of its first face.
    std::vector<std::vector<FaceId>> faces_by_material() {
        const FaceMaterials& materials = mesh_.materials();
        constexpr std::size_t k_new = ~std::size_t{0};
        std::vector<std::size_t> group_of(materials.materials.size() + 1, k_new);
        std::vector<std::vector<FaceId>> groups;
        for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
            const MaterialId material = materials.empty() ? k_no_material : materials.of_face[f];
            const bool has_material = material != k_no_material;
            std::size_t& group = group_of[has_material ? index(material) + 1 : 0];
            if (group == k_new) {
                group = groups.size();
                groups.emplace_back();
                material_of_group_.push_back(has_material ? add_material(material) : -1);
            }
            groups[group].push_back(FaceId{f});
        }
        return groups;
    }

    int add_material(MaterialId material) {
        const FaceMaterials& all = mesh_.materials();
        const SurfaceMaterial& own = all.materials[index(material)];
        const glm::vec3 color = own.base_color;
        GlbJson surface{{"baseColorFactor", {color.x, color.y, color.z, 1.0f}},
                        {"metallicFactor", 0}};
        if (has_embedded_texture(all, material)) {
            const auto [number, is_new] = textures_of_.try_emplace(own.texture, 0);
            if (is_new)
                number->second =
                    textures_.add(all.textures[index(own.texture)],
                                  [&](const std::string& bytes) { return add_bytes(bytes); });
            surface["baseColorTexture"] = {{"index", number->second}};
        }
        materials_.push_back(GlbJson::object({{"pbrMetallicRoughness", surface}}));
        return static_cast<int>(materials_.size()) - 1;
    }

    GlbJson primitive(const std::vector<FaceId>& faces) {
        GlbJson primitive{{"attributes", {{"POSITION", 0}}}, {"indices", add_indices(faces)}};
        if (const int material = material_of_group_[next_group_++]; material >= 0) {
            primitive["material"] = material;
            if (have_colors(faces)) primitive["attributes"]["COLOR_0"] = color_accessor_;
            const MaterialId own = mesh_.materials().of_face[index(faces.front())];
            if (has_embedded_texture(mesh_.materials(), own))
                primitive["attributes"]["TEXCOORD_0"] = uv_accessor_;
        }
        if (options_.edges.empty()) return primitive;
        std::vector<Side> silhouettes;
        const std::vector<std::uint8_t> bits = visibility_bits(faces, silhouettes);
        // All edges hidden: the extension would be invalid.
        if (std::ranges::all_of(bits, [](std::uint8_t byte) { return byte == 0; }))
            return primitive;
        uses_edges_ = true;
        GlbJson edges;
        begin_view();
        binary_.append(bits.begin(), bits.end());
        edges["visibility"] = end_accessor(k_unsigned_byte, bits.size(), "SCALAR");
        if (!silhouettes.empty()) edges["silhouetteNormals"] = add_normals(silhouettes);
        primitive["extensions"][k_gltf_edges] = edges;
        return primitive;
    }

    // Whether a corner of these faces is not white.
    bool have_colors(const std::vector<FaceId>& faces) const {
        const std::vector<glm::vec3>& colors = mesh_.materials().corner_colors;
        if (colors.empty()) return false;
        return std::ranges::any_of(faces, [&](FaceId face) {
            const std::size_t first = std::size_t{3} * index(face);
            return std::any_of(&colors[first], &colors[first] + 3,
                               [](const glm::vec3& color) { return color != glm::vec3(1.0f); });
        });
    }

    // A face at which an edge has its class.
    struct Side {
        EdgeId edge;
        FaceId face;
    };

    // Appends the sides of silhouette edges.
    std::vector<std::uint8_t> visibility_bits(const std::vector<FaceId>& faces,
                                              std::vector<Side>& silhouettes) {
        std::vector<std::uint8_t> bits((6 * faces.size() + 7) / 8, 0);
        std::size_t at = 0;
        for (const FaceId face : faces)
            for (const EdgeId edge : mesh_.edges_of(face)) {
                bits[at / 8] |=
                    static_cast<std::uint8_t>(code_of(edge, face, silhouettes) << at % 8);
                at += 2;
            }
        return bits;
    }

    unsigned code_of(EdgeId edge, FaceId face, std::vector<Side>& silhouettes) {
        if (edge == k_no_edge) return 0;
        const EdgeVisibility visibility = options_.edges[index(edge)];
        if (visibility == EdgeVisibility::hidden) return 0;
        const bool is_first = is_written_[index(edge)] == 0;
        is_written_[index(edge)] = 1;
        if (visibility == EdgeVisibility::hard) return is_first ? 2 : 3;
        if (is_first) silhouettes.push_back({edge, face});
        return is_first ? 1 : 0;
    }

    std::size_t add_normals(const std::vector<Side>& silhouettes) {
        const bool are_bytes = options_.normals == SilhouetteNormals::bytes;
        constexpr std::size_t k_padded = 4;  // Vertex attributes are aligned so.
        begin_view(are_bytes ? GlbJson{{"byteStride", k_padded}} : GlbJson::object());
        const std::size_t side_bytes = 2 * (are_bytes ? k_padded : sizeof(glm::vec3));
        char* const begin = extended_by(silhouettes.size() * side_bytes);
        const auto write = [&](std::size_t i) {
            char* at = begin + i * side_bytes;
            const auto [edge, face] = silhouettes[i];
            for (const glm::vec3& normal : silhouette_normals(mesh_, edge, face)) {
                if (are_bytes)
                    std::memcpy(at, normal_bytes(normal).data(), 3);
                else
                    std::memcpy(at, &normal, sizeof normal);
                at += side_bytes / 2;
            }
        };
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, silhouettes.size(), 4096),
                          [&](const auto& run) {
                              for (std::size_t i = run.begin(); i < run.end(); ++i) write(i);
                          });
        // Bytes are not marked as normalized: CesiumJS scales them itself, and its sample does not either.
        return end_accessor(are_bytes ? k_byte : k_float, 2 * silhouettes.size(), "VEC3");
    }

    void add_positions() {
        begin_view({{"target", k_array_buffer}});
        char* at = extended_by(vertex_count() * sizeof(glm::vec3));
        const auto add = [&](const glm::vec3& p) {
            const glm::vec3 positive = p + 0.0f;  // Transforms of nodes do not keep negative zeros.
            std::memcpy(at, &positive, sizeof positive);
            at += sizeof positive;
        };
        for (const glm::vec3& p : mesh_.positions()) add(p);
        for (const VertexId v : corners_.copies) add(mesh_.positions()[index(v)]);
        const auto& [low, high] = mesh_.bounds();
        end_accessor(k_float, vertex_count(), "VEC3",
                     {{"min", {low.x, low.y, low.z}}, {"max", {high.x, high.y, high.z}}});
    }

    // Colors are linear, and the origin of texture coordinates is the left top corner, as in glTF.
    template <typename Vector>
    std::size_t add_attribute(const std::vector<Vector>& elements, const char* type) {
        begin_view({{"target", k_array_buffer}});
        const std::size_t size = elements.size() * sizeof(Vector);
        std::memcpy(extended_by(size), elements.data(), size);
        return end_accessor(k_float, elements.size(), type);
    }

    std::size_t vertex_count() const { return mesh_.vertex_count() + corners_.copies.size(); }
    bool has_short_indices() const { return vertex_count() <= k_max_short_vertices; }

    std::size_t add_indices(const std::vector<FaceId>& faces) {
        const bool are_short = has_short_indices();
        begin_view({{"target", k_element_array_buffer}});
        char* at = extended_by(3 * faces.size() * (are_short ? 2 : 4));
        for (const FaceId face : faces)
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t number =
                    corners_.vertices.empty() ? index(mesh_.triangles()[index(face)][c])
                                              : corners_.vertices[std::size_t{3} * index(face) + c];
                std::memcpy(at, &number, are_short ? 2 : 4);  // Its lower half comes first.
                at += are_short ? 2 : 4;
            }
        return end_accessor(are_short ? k_unsigned_short : k_unsigned_int, 3 * faces.size(),
                            "SCALAR");
    }

    // Begins what one accessor holds: all bytes that are added before end_accessor().
    void begin_view(const GlbJson& properties = GlbJson::object()) {
        while (binary_.size() % 4 != 0) binary_ += '\0';
        view_begin_ = binary_.size();
        view_ = {{"buffer", 0}, {"byteOffset", view_begin_}, {"byteLength", 0}};
        view_.update(properties);
    }

    // A view without an accessor. Returns its number.
    std::size_t add_bytes(const std::string& bytes) {
        begin_view();
        std::memcpy(extended_by(bytes.size()), bytes.data(), bytes.size());
        return end_view();
    }

    std::size_t end_view() {
        view_["byteLength"] = binary_.size() - view_begin_;
        views_.push_back(view_);
        return views_.size() - 1;
    }

    // Returns the number of the accessor.
    std::size_t end_accessor(int component, std::size_t count, const char* type,
                             const GlbJson& properties = GlbJson::object()) {
        GlbJson accessor{{"bufferView", end_view()},
                         {"componentType", component},
                         {"count", count},
                         {"type", type}};
        accessor.update(properties);
        accessors_.push_back(accessor);
        return accessors_.size() - 1;
    }

    // Before memory is taken. Sizes are below 2^63.
    static void check_size(std::uint64_t bytes) {
        if (bytes > k_max_bytes)
            throw Error(ErrorCode::too_large, "a GLB file of 2^31 bytes or more is too large");
    }

    // Where as many bytes were added.
    char* extended_by(std::size_t bytes) {
        const std::size_t size = binary_.size();
        check_size(std::uint64_t{size} + bytes);
        binary_.resize(size + bytes);
        return binary_.data() + size;
    }

    // The header, and the chunks with theirs.
    std::string joined() {
        std::string json = document_.dump();
        while (json.size() % 4 != 0) json += ' ';
        while (binary_.size() % 4 != 0) binary_ += '\0';
        check_size(std::uint64_t{28} + json.size() + binary_.size());
        std::string file;
        file.reserve(28 + json.size() + binary_.size());
        const auto add_word = [&](std::size_t value) {
            const auto word = static_cast<std::uint32_t>(value);
            char bytes[4];
            std::memcpy(bytes, &word, 4);
            file.append(bytes, 4);
        };
        file += "glTF";
        add_word(2);
        add_word(28 + json.size() + binary_.size());
        add_word(json.size());
        file += "JSON";
        file += json;
        add_word(binary_.size());
        file.append("BIN\0", 4);
        file += binary_;
        return file;
    }

    static constexpr std::uint64_t k_max_bytes = 0x7fffffff;

    const Mesh& mesh_;
    const GlbOptions& options_;
    const GlbCorners corners_;
    std::size_t color_accessor_ = 0, uv_accessor_ = 0;
    GlbTextures textures_;
    std::map<TextureId, std::size_t> textures_of_;  // The file's number of each of the mesh's.
    std::vector<std::uint8_t> is_written_;          // Edges whose class a face has.
    GlbJson document_, view_;
    GlbJson accessors_ = GlbJson::array(), views_ = GlbJson::array(), materials_ = GlbJson::array();
    std::vector<int> material_of_group_;  // -1: none.
    std::size_t next_group_ = 0;
    std::string binary_;
    std::size_t view_begin_ = 0;
    bool uses_edges_ = false;
};

}  // namespace

std::string glb_bytes(const Mesh& mesh, const GlbOptions& options) {
    RIMLINE_CHECK(mesh.face_count() > 0);
    RIMLINE_CHECK(options.edges.empty() || options.edges.size() == mesh.edge_count());
    return GlbWriter(mesh, options).bytes();
}

std::array<glm::vec3, 2> silhouette_normals(const Mesh& mesh, EdgeId edge, FaceId first) noexcept {
    const auto normal = [&](FaceId face) {
        const Plane& plane = mesh.plane(face);
        return glm::vec3(plane.nx, plane.ny, plane.nz);
    };
    const std::span<const FaceId> faces = mesh.faces_of(edge);
    const auto other = std::ranges::find_if(faces, [&](FaceId f) { return f != first; });
    const bool has_other = other != faces.end();
    glm::vec3 a = normal(first);
    glm::vec3 b = has_other ? normal(*other) : glm::vec3(0.0f);
    if (mesh.edge_class(edge) == EdgeClass::inconsistent) b = -b;
    constexpr glm::vec3 k_none(0.0f);
    if (a == k_none && b == k_none) a = {0.0f, 0.0f, 1.0f};
    if (a == k_none) a = -b;
    if (b == k_none) b = -a;
    return {a, b};
}

std::array<std::int8_t, 3> normal_bytes(glm::vec3 normal) noexcept {
    const auto byte = [](float c) {
        return static_cast<std::int8_t>(c * 127.0f + std::copysign(0.5f, c));
    };
    return {byte(normal.x), byte(normal.y), byte(normal.z)};
}

}  // namespace rimline
