// glTF 2 and GLB: gltf_document.h checks the document, gltf_buffers.h reads the bytes, gltf_nodes.h finds the
// instances of meshes, gltf_accessor.h reads the numbers, and this file puts them together.
//
// A mesh that two nodes reference appears twice. Transforms are applied in double and rounded once. A
// mirroring transform reverses triangles, so the order of their corners is reversed again. Skins and
// morph targets are not applied. Primitives of points and lines give vertices only. A primitive
// without positions gives nothing, as the format says.
//
// Instances multiply the content of a file. So the result is counted first, and refused if it is too large.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <map>
#include <vector>

#include "silhouette/mesh/formats/byte_scanner.h"
#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/gltf_accessor.h"
#include "silhouette/mesh/formats/gltf_buffers.h"
#include "silhouette/mesh/formats/gltf_document.h"
#include "silhouette/mesh/formats/gltf_edges.h"
#include "silhouette/mesh/formats/gltf_nodes.h"
#include "silhouette/mesh/formats/gltf_scene.h"
#include "silhouette/mesh/formats/gltf_textures.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

namespace {

// The share of parsing at which the document is read.
constexpr double k_flattening = 0.6;

// What a primitive or a mesh gives.
struct GltfSize {
    std::uint64_t vertices = 0;
    std::uint64_t triangles = 0;
};

class Flattener {
public:
    Flattener(const SourceFile& file, const GltfScene& scene, const GltfBuffers& buffers,
              BadPoints bad, const LongCall& call)
        : file_(file.name),
          scene_(scene),
          bad_(bad),
          call_(call),
          file_bytes_(file.bytes.size() + buffers.bytes_read()),
          limit_(max_elements(file_bytes_)),
          accessors_(file_, scene, buffers, file_bytes_),
          is_counted_(scene.accessors.size(), false),
          has_no_uvs_(scene.primitives.size(), false),
          has_no_colors_(scene.primitives.size(), false) {}

    MeshSource run(const SourceFile& file, const GltfBuffers& buffers) {
        source_.is_up_known = true;
        source_.warnings = scene_.warnings;
        add_materials(file, buffers);
        measure();
        source_.positions.reserve(total_.vertices);
        source_.triangles.reserve(total_.triangles);
        for_each_instance(
            file_, scene_, call_.stop,
            [&](std::uint32_t mesh, const glm::dmat4& transform) { add_mesh(mesh, transform); });
        if (!vertex_colors_.empty()) {
            vertex_colors_.resize(source_.positions.size(), glm::vec3(1.0f));
            color_corners(source_, vertex_colors_, call_.stop);
        }
        if (!source_.materials.textures.empty())
            source_.materials.corner_uvs.resize(3 * source_.triangles.size(), glm::vec2(0.0f));
        if (!source_.edge_codes.empty()) source_.edge_codes.resize(source_.triangles.size(), 0);
        return std::move(source_);
    }

private:
    void add_materials(const SourceFile& file, const GltfBuffers& buffers) {
        FaceMaterials& materials = source_.materials;
        GltfTextures textures(file, scene_, buffers, file_bytes_, call_.stop);
        materials.materials.reserve(scene_.materials.size());
        for (const GltfMaterial& material : scene_.materials) {
            work(1);
            SurfaceMaterial& added = materials.materials.emplace_back(
                SurfaceMaterial{material.base_color.value_or(glm::vec3(1.0f))});
            if (!material.texture) continue;
            try {
                added.texture = textures.add_to(materials.textures, *material.texture);
            } catch (const Error& e) {
                if (e.code() == ErrorCode::cancelled) throw;
                add_warning(source_.warnings, std::string(e.what()) + "; the texture is missing");
            }
        }
    }

    // Counts what all instances give together, and finds the primitives that give something.
    void measure() {
        sizes_.resize(scene_.meshes.size());
        given_.resize(scene_.meshes.size());
        std::vector<bool> is_known(scene_.meshes.size(), false);
        for_each_instance(file_, scene_, call_.stop, [&](std::uint32_t mesh, const glm::dmat4&) {
            if (!is_known[mesh]) sizes_[mesh] = mesh_size(mesh);
            is_known[mesh] = true;
            // Both summands are below 2^63.
            total_.vertices += sizes_[mesh].vertices;
            total_.triangles += sizes_[mesh].triangles;
            place_.mesh = mesh;
            if (std::max(total_.vertices, total_.triangles) > limit_) fail_too_large();
        });
    }

    // A small file may be one mesh many times; a large one holds most of what it becomes.
    static std::uint64_t max_elements(std::uint64_t file_bytes) noexcept {
        constexpr std::uint64_t k_any_file = std::uint64_t{1} << 24;
        constexpr std::uint64_t k_each_byte = 16;
        constexpr std::uint64_t k_all = std::uint64_t{1} << 28;
        return std::clamp(std::min(file_bytes, k_all) * k_each_byte, k_any_file, k_all);
    }

    [[noreturn]] void fail_too_large() const {
        throw Error(
            ErrorCode::too_large,
            file_ + ": meshes[" + std::to_string(place_.mesh) +
                "]: with it, the instances of meshes have more than " + std::to_string(limit_) +
                " vertices, triangles or indices, the limit for a file that has, with its "
                "buffers, " +
                std::to_string(file_bytes_) +
                " bytes: 16 for each byte, but at least 2^24 and at most 2^28. Export fewer "
                "instances, or several files");
    }

    GltfSize mesh_size(std::uint32_t mesh) {
        const auto [begin, end] = scene_.meshes[mesh];
        GltfSize sum;
        given_[mesh].begin = static_cast<std::uint32_t>(given_primitives_.size());
        for (std::uint32_t i = begin; i < end; ++i) {
            work(1);
            place_ = {mesh, i - begin};
            const GltfSize size = primitive_size(scene_.primitives[i], i);
            sum.vertices += size.vertices;
            sum.triangles += size.triangles;
        }
        given_[mesh].end = static_cast<std::uint32_t>(given_primitives_.size());
        return sum;
    }

    // Checks all of primitive `number` that needs no look at its elements.
    GltfSize primitive_size(const GltfPrimitive& primitive, std::uint32_t number) {
        if (!primitive.positions) return {};
        const std::uint64_t vertices = accessors_.positions(*primitive.positions).count();
        const std::uint64_t corners =
            primitive.indices ? accessors_.indices(*primitive.indices).count() : vertices;
        if (vertices > 0 || corners > 0) given_primitives_.push_back(number);
        if (primitive.mode > k_gltf_triangle_fan)
            fail("mode " + std::to_string(primitive.mode) + " is not glTF's");
        if (primitive.mode < k_gltf_triangles) {
            if (primitive.edges)
                fail(std::string(k_gltf_edges) + ": the primitive has no triangles");
            if (primitive.indices) count_once(*primitive.indices, corners);
            return {vertices, 0};
        }
        const bool is_separate = primitive.mode == k_gltf_triangles;
        if (is_separate ? corners % 3 != 0 : corners < 3)
            fail(std::to_string(corners) + " corners do not make triangles");
        if (primitive.material && *primitive.material >= scene_.materials.size())
            fail("material " + std::to_string(*primitive.material) + " does not exist");
        if (primitive.colors)
            if (const std::uint64_t colors = accessors_.colors(*primitive.colors).count();
                colors != vertices)
                fail("COLOR_0 has " + std::to_string(colors) + " colors for " +
                     std::to_string(vertices) + " vertices");
        return {vertices, is_separate ? corners / 3 : corners - 2};
    }

    // Indices of points and lines give nothing, but reading them takes time, and many accessors can name the same
    // bytes.
    void count_once(std::uint32_t accessor, std::uint64_t indices) {
        if (is_counted_[accessor]) return;
        is_counted_[accessor] = true;
        point_indices_ += indices;
        if (point_indices_ > limit_) fail_too_large();
    }

    void add_mesh(std::uint32_t mesh, const glm::dmat4& transform) {
        const auto [begin, end] = given_[mesh];
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::uint32_t number = given_primitives_[i];
            place_ = {mesh, number - scene_.meshes[mesh].begin};
            add_primitive(number, transform);
        }
    }

    [[noreturn]] void fail(const std::string& what) const {
        bad_file(file_, "meshes[" + std::to_string(place_.mesh) + "].primitives[" +
                            std::to_string(place_.primitive) + "]: " + what);
    }

    // Counts `elements` as done: reports progress and checks for cancellation now and then.
    void work(std::uint64_t elements) {
        done_ += elements;
        if (done_ < next_checkpoint_) return;
        next_checkpoint_ = done_ + k_checkpoint_interval;
        const auto whole = static_cast<double>(total_.vertices + total_.triangles);
        const auto made = static_cast<double>(source_.positions.size() + source_.triangles.size());
        parse_checkpoint(call_,
                         k_flattening + (1.0 - k_flattening) * (made > 0.0 ? made / whole : 0.0));
    }

    void add_primitive(std::uint32_t number, const glm::dmat4& transform) {
        const GltfPrimitive& primitive = scene_.primitives[number];
        const auto first = static_cast<std::uint32_t>(source_.positions.size());
        const std::uint32_t count = add_positions(*primitive.positions, transform);
        const bool has_triangles = primitive.mode >= k_gltf_triangles;
        if (primitive.indices && !has_triangles) {
            // The number of triangles is limited, that of points and lines is not. So each of their accessors is
            // read only once.
            const auto known = min_vertices_.find(*primitive.indices);
            if (known != min_vertices_.end() && known->second <= count) return;
        }
        if (!primitive.indices && !has_triangles) return;
        read_corners(primitive, count);
        if (!has_triangles) return;
        const bool mirrored = glm::determinant(glm::dmat3(transform)) < 0.0;
        add_triangles(primitive.mode, first, mirrored);
        add_colors(primitive, number, count, first);
        add_edges(primitive, number, count, mirrored);
    }

    // Returns their number.
    std::uint32_t add_positions(std::uint32_t accessor, const glm::dmat4& transform) {
        GltfElements elements = accessors_.positions(accessor);
        for (std::uint32_t i = 0; i < elements.count(); ++i) {
            work(1);
            const glm::dvec3 p(transform * glm::dvec4(elements.position(), 1.0));
            for (int axis = 0; axis < 3; ++axis)
                if (!(std::abs(p[axis]) <= static_cast<double>(k_max_coordinate)) &&
                    (std::isfinite(p[axis]) || bad_ == BadPoints::refuse))
                    fail("vertex " + std::to_string(i) + " is " +
                         (std::isfinite(p[axis]) ? "beyond 2^60 in size; scale the model down"
                                                 : "not a finite position"));
            source_.positions.emplace_back(p);
        }
        return elements.count();
    }

    // Into `corners_`, each below `count`.
    void read_corners(const GltfPrimitive& primitive, std::uint32_t count) {
        corners_.clear();
        if (!primitive.indices) {
            for (std::uint32_t i = 0; i < count; ++i) corners_.push_back(i);
            return;
        }
        GltfElements elements = accessors_.indices(*primitive.indices);
        corners_.reserve(elements.count());
        std::uint64_t min_vertices = 0;
        for (std::uint32_t i = 0; i < elements.count(); ++i) {
            work(1);
            const std::uint32_t corner = elements.index();
            if (corner >= count)
                fail("index " + std::to_string(corner) + " (number " + std::to_string(i) +
                     ") is out of range; there are " + std::to_string(count) + " vertices");
            min_vertices = std::max(min_vertices, std::uint64_t{corner} + 1);
            corners_.push_back(corner);
        }
        min_vertices_[*primitive.indices] = min_vertices;
    }

    // The corners of triangle `i` of a primitive, in `corners_`.
    static std::array<std::size_t, 3> corner_at(std::uint32_t mode, std::size_t i) noexcept {
        if (mode == k_gltf_triangle_strip) return {i, i + 1 + i % 2, i + 2 - i % 2};
        if (mode == k_gltf_triangle_fan) return {i + 1, i + 2, 0};
        return {3 * i, 3 * i + 1, 3 * i + 2};
    }

    void add_triangles(std::uint32_t mode, std::uint32_t first, bool mirrored) {
        const std::size_t n = corners_.size();
        const std::size_t count = mode == k_gltf_triangles ? n / 3 : n - 2;
        for (std::size_t i = 0; i < count; ++i) {
            work(1);
            std::array<std::size_t, 3> at = corner_at(mode, i);
            if (mirrored) std::swap(at[1], at[2]);
            source_.triangles.push_back(
                {first + corners_[at[0]], first + corners_[at[1]], first + corners_[at[2]]});
        }
    }

    // Call it after add_triangles().
    void add_edges(const GltfPrimitive& primitive, std::uint32_t number, std::uint32_t vertices,
                   bool mirrored) {
        if (!primitive.edges) return;
        auto known = edge_codes_.find(number);
        if (known == edge_codes_.end()) {
            const std::size_t n = corners_.size();
            const std::size_t triangles = primitive.mode == k_gltf_triangles ? n / 3 : n - 2;
            work(triangles);
            std::vector<std::array<std::uint32_t, 3>> own;
            own.reserve(triangles);
            for (std::size_t i = 0; i < triangles; ++i) {
                own.emplace_back();
                for (std::size_t c = 0; c < 3; ++c)
                    own.back()[c] = corners_[corner_at(primitive.mode, i)[c]];
            }
            known = edge_codes_
                        .emplace(number, read_gltf_edges(
                                             scene_, accessors_, *primitive.edges, own, vertices,
                                             [&](const std::string& what) { fail(what); }))
                        .first;
        }
        std::vector<std::uint8_t>& codes = source_.edge_codes;
        codes.reserve(total_.triangles);
        codes.resize(source_.triangles.size() - known->second.size(), 0);
        for (const std::uint8_t code : known->second)
            codes.push_back(mirrored ? mirrored_edge_codes(code) : code);
    }

    // Call it after add_triangles().
    void add_colors(const GltfPrimitive& primitive, std::uint32_t number, std::uint32_t count,
                    std::uint32_t first) {
        MaterialId material = k_no_material;
        if (primitive.material) {
            const GltfMaterial& named = scene_.materials[*primitive.material];
            if (named.base_color || named.texture) material = MaterialId{*primitive.material};
        }
        if (primitive.colors && has_colors(*primitive.colors, number)) {
            GltfElements colors = accessors_.colors(*primitive.colors);
            vertex_colors_.reserve(total_.vertices);
            vertex_colors_.resize(first, glm::vec3(1.0f));
            for (std::uint32_t i = 0; i < count; ++i) {
                work(1);
                vertex_colors_.push_back(colors.color());
            }
            if (material == k_no_material) {
                if (white_ == k_no_material) white_ = add_white_material(source_.materials);
                material = white_;
            }
        }
        const std::size_t first_triangle = source_.materials.of_face.size();
        source_.materials.of_face.reserve(total_.triangles);
        source_.materials.of_face.resize(source_.triangles.size(), material);
        if (material != k_no_material &&
            source_.materials.materials[index(material)].texture != k_no_texture)
            add_uvs(number, count, first, first_triangle);
    }

    bool has_colors(std::uint32_t accessor, std::uint32_t number) {
        if (accessors_.has_color_numbers(accessor)) return true;
        if (!has_no_colors_[number])
            add_warning(source_.warnings,
                        file_ + ": accessors[" + std::to_string(accessor) +
                            "]: holds colors, which should be floats or normalized unsigned "
                            "integers of 8 or 16 bits; the colors of these vertices are missing");
        has_no_colors_[number] = true;
        return false;
    }

    // Of the triangles from `first_triangle` on, whose vertices are the `count` ones from `first` on.
    void add_uvs(std::uint32_t number, std::uint32_t count, std::uint32_t first,
                 std::size_t first_triangle) {
        if (has_no_uvs_[number]) return;
        const GltfPrimitive& primitive = scene_.primitives[number];
        const GltfTexture& texture =
            scene_.textures[*scene_.materials[*primitive.material].texture];
        std::vector<glm::vec2> uvs;
        try {
            read_uvs(primitive, texture, count, uvs);
        } catch (const Error& e) {
            if (e.code() == ErrorCode::cancelled) throw;
            has_no_uvs_[number] = true;
            add_warning(source_.warnings,
                        std::string(e.what()) + "; its texture is one color there");
            return;
        }
        std::vector<glm::vec2>& corners = source_.materials.corner_uvs;
        corners.reserve(3 * total_.triangles);
        corners.resize(3 * first_triangle, glm::vec2(0.0f));
        for (std::size_t t = first_triangle; t < source_.triangles.size(); ++t) {
            work(1);
            for (const std::uint32_t vertex : source_.triangles[t])
                corners.push_back(uvs[vertex - first]);
        }
    }

    void read_uvs(const GltfPrimitive& primitive, const GltfTexture& texture, std::uint32_t count,
                  std::vector<glm::vec2>& uvs) {
        if (!primitive.uvs)
            fail("has no TEXCOORD_" + std::to_string(texture.coordinate_set) + " for its texture");
        GltfElements elements = accessors_.uvs(*primitive.uvs);
        if (elements.count() != count)
            bad_file(file_, "accessors[" + std::to_string(*primitive.uvs) + "]: has " +
                                std::to_string(elements.count()) + " elements for " +
                                std::to_string(count) + " vertices");
        uvs.reserve(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            work(1);
            uvs.push_back(finite_uv(texture.transform * glm::vec3(elements.uv(), 1.0f)));
        }
    }

    const std::string& file_;
    const GltfScene& scene_;
    BadPoints bad_;
    const LongCall& call_;
    std::uint64_t file_bytes_;
    std::uint64_t limit_;  // Of vertices, of triangles and of indices of points and lines.
    GltfAccessors accessors_;
    std::vector<GltfSize> sizes_;                  // Of meshes.
    GltfSize total_;                               // Of all instances.
    std::vector<std::uint32_t> given_primitives_;  // Those that give something, mesh by mesh.
    std::vector<GltfRange> given_;                 // Of each mesh in `given_primitives_`.
    std::vector<bool> is_counted_;                 // Index accessors in `point_indices_`.
    std::uint64_t point_indices_ = 0;              // Of points and lines, each accessor once.
    MeshSource source_;
    std::vector<std::uint32_t> corners_;
    std::vector<glm::vec3> vertex_colors_;  // Of the first positions; white where they end.
    MaterialId white_ = k_no_material;      // Made for the first primitive that needs it.
    // Primitives that have a warning about it.
    std::vector<bool> has_no_uvs_, has_no_colors_;
    std::map<std::uint32_t, std::vector<std::uint8_t>> edge_codes_;  // Of primitives.
    std::map<std::uint32_t, std::uint64_t>
        min_vertices_;  // The vertices that an index accessor requires.
    struct {
        std::uint32_t mesh;
        std::uint32_t primitive;
    } place_{};  // For messages.
    std::uint64_t done_ = 0;
    std::uint64_t next_checkpoint_ = 0;
};

MeshSource read_document(const SourceFile& file, std::string_view json, std::size_t first_byte,
                         std::string_view binary_chunk, BadPoints bad, const LongCall& call) {
    const LongCall parsing =
        call.part(k_read_share, k_read_share + (1.0 - k_read_share) * k_flattening);
    const GltfScene scene = read_gltf_scene(file.name, json, first_byte, parsing);
    const GltfBuffers buffers(file, scene.buffers, binary_chunk, call.stop);
    MeshSource source = Flattener(file, scene, buffers, bad, call).run(file, buffers);
    for (std::filesystem::path& path : buffers.paths()) source.files.push_back(std::move(path));
    return source;
}

}  // namespace

MeshSource read_gltf(const SourceFile& file, BadPoints bad, const LongCall& call) {
    return read_document(file, file.text(), file.text_begin, {}, bad, call);
}

// A GLB is a header (magic, version, length) and chunks (length, type, bytes): JSON, then perhaps BIN.
MeshSource read_glb(const SourceFile& file, BadPoints bad, const LongCall& call) {
    constexpr std::uint32_t k_json = 0x4e4f534a;
    constexpr std::uint32_t k_bin = 0x004e4942;
    const std::string_view bytes = file.bytes;
    ByteScanner scanner(file.name, bytes, 4, std::endian::little);
    const auto word = [&](const char* what) {
        return static_cast<std::uint64_t>(scanner.integer(ScalarType::uint32, what));
    };
    const std::uint64_t version = word("the GLB header");
    if (version != 2)
        bad_byte(file.name, 4,
                 "GLB version " + std::to_string(version) + " is not supported; version 2 is");
    if (const std::uint64_t length = word("the GLB header"); length != bytes.size())
        bad_byte(file.name, 8,
                 "the header says " + std::to_string(length) + " bytes, the file has " +
                     std::to_string(bytes.size()) + "; it is truncated or damaged");
    std::string_view json;
    std::string_view binary;
    std::size_t json_begin = 0;
    for (int chunk = 0; scanner.remaining() != 0; ++chunk) {
        const std::uint64_t size = word("a chunk's header");
        const std::uint64_t type = word("a chunk's header");
        const std::size_t begin = scanner.offset();
        scanner.skip(1, size, "a chunk");
        if (chunk == 0) {
            if (type != k_json) bad_byte(file.name, begin - 4, "the first chunk is not JSON");
            json = bytes.substr(begin, size);
            json_begin = begin;
        } else if (chunk == 1 && type == k_bin) {
            binary = bytes.substr(begin, size);
        }
    }
    if (json.empty()) scanner.fail("there is no JSON chunk");
    return read_document(file, json, json_begin, binary, bad, call);
}

}  // namespace rimline
