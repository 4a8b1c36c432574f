// glTF 2 and GLB: gltf_scene.h checks the document, tinygltf builds the model, gltf_buffers.h reads
// the bytes, gltf_accessor.h reads the numbers, and this file flattens the node tree.
//
// A mesh that two nodes reference appears twice. Transforms are applied in double and rounded once. A
// mirroring transform reverses triangles, so the order of their corners is reversed again. Skins and
// morph targets are not applied. Primitives of points and lines give vertices only. A primitive
// without positions gives nothing, as the format says.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <map>

#include "silhouette/mesh/formats/byte_scanner.h"
#include "silhouette/mesh/formats/file_colors.h"
#include "silhouette/mesh/formats/gltf_accessor.h"
#include "silhouette/mesh/formats/gltf_buffers.h"
#include "silhouette/mesh/formats/gltf_scene.h"
#include "silhouette/mesh/formats/gltf_textures.h"
#include "silhouette/mesh/formats/readers.h"
#include "silhouette/mesh/formats/tinygltf.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

namespace {

// Instances multiply the content of a file. These limits prevent running out of memory.
constexpr std::size_t k_max_vertices = std::size_t{1} << 28;
constexpr std::size_t k_max_triangles = std::size_t{1} << 28;

tinygltf::Model parse_model(const SourceFile& file, const GltfScene& scene) {
    tinygltf::TinyGLTF parser;
    tinygltf::Model model;
    std::string error;
    std::string warning;
    if (scene.document.size() > 0xffffffffu)
        throw Error(ErrorCode::too_large, file.name + ": its JSON is larger than 4 GiB");
    bool done = false;
    try {
        done = parser.LoadASCIIFromString(&model, &error, &warning, scene.document.data(),
                                          static_cast<unsigned>(scene.document.size()), "");
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        error = e.what();
    }
    if (!done) {
        // The error may quote any length of the file.
        constexpr std::size_t k_longest = 200;
        error.resize(std::min(error.size(), k_longest));
        std::replace(error.begin(), error.end(), '\n', ' ');
        bad_file(file.name, "tinygltf cannot read it: " + error);
    }
    return model;
}

glm::dmat4 local_transform(const std::string& file, const tinygltf::Node& node,
                           std::size_t number) {
    const auto fail = [&](const char* what) {
        bad_file(file, "nodes[" + std::to_string(number) + "]: " + what);
    };
    glm::dmat4 m(1.0);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
            fail("its matrix is not affine: the last row should be 0 0 0 1");
        return m;
    }
    if (node.rotation.size() == 4) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(q);
        if (!(length > 0.0) || !std::isfinite(length)) fail("its rotation is not a quaternion");
        m = glm::mat4_cast(q / length);
    }
    if (node.scale.size() == 3)
        for (int i = 0; i < 3; ++i) m[i] *= node.scale[static_cast<std::size_t>(i)];
    if (node.translation.size() == 3)
        for (int i = 0; i < 3; ++i) m[3][i] = node.translation[static_cast<std::size_t>(i)];
    return m;
}

class Flattener {
public:
    Flattener(const SourceFile& file, const tinygltf::Model& model, const GltfScene& scene,
              const GltfBuffers& buffers, BadPoints bad, const LongCall& call)
        : file_(file.name),
          materials_(scene.materials),
          model_(model),
          bad_(bad),
          call_(call),
          accessors_(file_, model, buffers, file.bytes.size() + buffers.bytes_read()) {}

    MeshSource run(const SourceFile& file, const GltfBuffers& buffers,
                   std::vector<std::string> warnings) {
        source_.is_up_known = true;
        source_.warnings = std::move(warnings);
        add_materials(file, buffers);
        visit_all();
        if (!vertex_colors_.empty()) {
            vertex_colors_.resize(source_.positions.size(), glm::vec3(1.0f));
            color_corners(source_, vertex_colors_);
        }
        if (!source_.materials.textures.empty())
            source_.materials.corner_uvs.resize(3 * source_.triangles.size(), glm::vec2(0.0f));
        return std::move(source_);
    }

private:
    void add_materials(const SourceFile& file, const GltfBuffers& buffers) {
        FaceMaterials& materials = source_.materials;
        std::map<std::string, std::shared_ptr<const std::string>> images;
        for (const GltfMaterial& material : materials_) {
            SurfaceMaterial& added = materials.materials.emplace_back(
                SurfaceMaterial{material.base_color.value_or(glm::vec3(1.0f))});
            if (!material.texture) continue;
            try {
                materials.textures.push_back(
                    material_texture(file, *material.texture, buffers, images));
                added.texture =
                    TextureId{static_cast<std::uint32_t>(materials.textures.size() - 1)};
            } catch (const Error& e) {
                add_warning(source_.warnings, std::string(e.what()) + "; the texture is missing");
            }
        }
    }

    void visit_all() {
        if (model_.nodes.empty()) {
            for (std::size_t i = 0; i < model_.meshes.size(); ++i) add_mesh(i, glm::dmat4(1.0));
            return;
        }
        visited_.assign(model_.nodes.size(), false);
        std::vector<int> roots = root_nodes();
        // An explicit stack, because a chain of nodes may be as long as the file.
        std::vector<Visit> stack;
        const auto push = [&](const std::vector<int>& numbers, const glm::dmat4& parent) {
            for (auto i = numbers.rbegin(); i != numbers.rend(); ++i) stack.push_back({*i, parent});
        };
        push(roots, glm::dmat4(1.0));
        while (!stack.empty()) {
            const Visit visit = stack.back();
            stack.pop_back();
            const std::size_t number = checked_node(visit.node);
            const tinygltf::Node& node = model_.nodes[number];
            const glm::dmat4 transform = visit.parent * local_transform(file_, node, number);
            if (node.mesh >= 0) {
                if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size())
                    bad_file(file_, "nodes[" + std::to_string(number) + "].mesh: mesh " +
                                        std::to_string(node.mesh) + " does not exist");
                add_mesh(static_cast<std::size_t>(node.mesh), transform);
            }
            push(node.children, transform);
        }
    }

    struct Visit {
        int node;
        glm::dmat4 parent;
    };

    // The roots of the default scene, else of the first scene, else all nodes without a parent.
    std::vector<int> root_nodes() const {
        if (model_.defaultScene >= 0 || !model_.scenes.empty()) {
            const auto scene = static_cast<std::size_t>(std::max(model_.defaultScene, 0));
            if (scene >= model_.scenes.size())
                bad_file(file_, "scene: scene " + std::to_string(scene) + " does not exist");
            return model_.scenes[scene].nodes;
        }
        std::vector<bool> is_child(model_.nodes.size(), false);
        for (const tinygltf::Node& node : model_.nodes)
            for (const int child : node.children)
                if (static_cast<std::size_t>(child) < is_child.size())
                    is_child[static_cast<std::size_t>(child)] = true;
        std::vector<int> roots;
        for (std::size_t i = 0; i < is_child.size(); ++i)
            if (!is_child[i]) roots.push_back(static_cast<int>(i));
        if (roots.empty())
            bad_file(file_, "nodes: every node is another's child; they form a cycle");
        return roots;
    }

    std::size_t checked_node(int node) {
        const auto number = static_cast<std::size_t>(node);
        if (node < 0 || number >= model_.nodes.size())
            bad_file(file_, "nodes: node " + std::to_string(node) + " does not exist");
        if (visited_[number])
            bad_file(file_, "nodes[" + std::to_string(number) +
                                "]: is reached twice; nodes should form trees, without cycles");
        visited_[number] = true;
        return number;
    }

    void add_mesh(std::size_t mesh, const glm::dmat4& transform) {
        const auto& primitives = model_.meshes[mesh].primitives;
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            // The number of instances is unknown, so this reports no progress and only checks for
            // cancellation.
            if (call_.stop.stop_requested()) parse_checkpoint(call_, 1.0);
            place_ = "meshes[" + std::to_string(mesh) + "].primitives[" + std::to_string(p) + "]";
            add_primitive(primitives[p], transform);
        }
    }

    [[noreturn]] void fail(const std::string& what) const { bad_file(file_, place_ + ": " + what); }

    void add_primitive(const tinygltf::Primitive& primitive, const glm::dmat4& transform) {
        const auto position = primitive.attributes.find("POSITION");
        if (position == primitive.attributes.end()) return;
        const std::vector<glm::dvec3> positions = accessors_.positions(position->second);
        if (positions.size() > k_max_vertices - source_.positions.size())
            throw Error(ErrorCode::too_large,
                        file_ + ": its instances have more than 2^28 vertices together");
        const auto first = static_cast<std::uint32_t>(source_.positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const glm::dvec3 p(transform * glm::dvec4(positions[i], 1.0));
            for (int axis = 0; axis < 3; ++axis)
                if (!(std::abs(p[axis]) <= static_cast<double>(k_max_coordinate)) &&
                    (std::isfinite(p[axis]) || bad_ == BadPoints::refuse))
                    fail("vertex " + std::to_string(i) + " is " +
                         (std::isfinite(p[axis]) ? "beyond 2^60 in size; scale the model down"
                                                 : "not a finite position"));
            source_.positions.emplace_back(p);
        }

        std::vector<std::uint32_t> corners;
        const auto indices = primitive.attributes.find(k_gltf_indices);
        if (indices != primitive.attributes.end()) {
            // The number of triangles is limited, that of points and lines is not. For points and
            // lines each accessor is therefore read only once.
            const bool has_triangles = primitive.mode >= TINYGLTF_MODE_TRIANGLES;
            const auto known = min_vertices_.find(indices->second);
            if (!has_triangles && known != min_vertices_.end() && known->second <= positions.size())
                return;
            corners = accessors_.indices(indices->second);
            std::uint64_t min_vertices = 0;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                if (corners[i] >= positions.size())
                    fail("index " + std::to_string(corners[i]) + " (number " + std::to_string(i) +
                         ") is out of range; there are " + std::to_string(positions.size()) +
                         " vertices");
                min_vertices = std::max(min_vertices, std::uint64_t{corners[i]} + 1);
            }
            min_vertices_[indices->second] = min_vertices;
        } else {
            corners.resize(positions.size());
            for (std::size_t i = 0; i < corners.size(); ++i)
                corners[i] = static_cast<std::uint32_t>(i);
        }
        const bool mirrored = glm::determinant(glm::dmat3(transform)) < 0.0;
        add_triangles(primitive.mode, corners, first, mirrored);
        if (primitive.mode >= TINYGLTF_MODE_TRIANGLES)
            add_colors(primitive, positions.size(), first);
    }

    // Call it after add_triangles().
    void add_colors(const tinygltf::Primitive& primitive, std::size_t count, std::uint32_t first) {
        MaterialId material = k_no_material;
        if (primitive.material >= 0) {
            const auto number = static_cast<std::size_t>(primitive.material);
            if (number >= materials_.size())
                fail("material " + std::to_string(number) + " does not exist");
            if (materials_[number].base_color || materials_[number].texture)
                material = MaterialId{static_cast<std::uint32_t>(number)};
        }
        const auto color = primitive.attributes.find("COLOR_0");
        if (color != primitive.attributes.end()) {
            const std::vector<glm::vec3> colors = accessors_.colors(color->second);
            if (colors.size() != count)
                fail("COLOR_0 has " + std::to_string(colors.size()) + " colors for " +
                     std::to_string(count) + " vertices");
            vertex_colors_.resize(first, glm::vec3(1.0f));
            vertex_colors_.insert(vertex_colors_.end(), colors.begin(), colors.end());
            if (material == k_no_material) {
                if (white_ == k_no_material) white_ = add_white_material(source_.materials);
                material = white_;
            }
        }
        const std::size_t first_triangle = source_.materials.of_face.size();
        source_.materials.of_face.resize(source_.triangles.size(), material);
        if (material != k_no_material &&
            source_.materials.materials[index(material)].texture != k_no_texture)
            add_uvs(primitive, *materials_[index(material)].texture, count, first, first_triangle);
    }

    // Of the triangles from `first_triangle` on, whose vertices are the `count` ones from `first` on.
    void add_uvs(const tinygltf::Primitive& primitive, const GltfTexture& texture,
                 std::size_t count, std::uint32_t first, std::size_t first_triangle) {
        std::vector<glm::vec2> uvs;
        try {
            const auto accessor = primitive.attributes.find(texture.coordinates);
            if (accessor == primitive.attributes.end())
                fail("has no " + texture.coordinates + " for its texture");
            uvs = accessors_.uvs(accessor->second, count);
        } catch (const Error& e) {
            add_warning(source_.warnings,
                        std::string(e.what()) + "; its texture is one color there");
            return;
        }
        for (glm::vec2& uv : uvs) uv = finite_uv(texture.transform * glm::vec3(uv, 1.0f));
        std::vector<glm::vec2>& corners = source_.materials.corner_uvs;
        corners.resize(3 * first_triangle, glm::vec2(0.0f));
        for (std::size_t t = first_triangle; t < source_.triangles.size(); ++t)
            for (const std::uint32_t vertex : source_.triangles[t])
                corners.push_back(uvs[vertex - first]);
    }

    void add_triangles(int mode, const std::vector<std::uint32_t>& corners, std::uint32_t first,
                       bool mirrored) {
        if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN)
            fail("mode " + std::to_string(mode) + " is not glTF's");
        if (mode < TINYGLTF_MODE_TRIANGLES) return;
        const bool separate = mode == TINYGLTF_MODE_TRIANGLES;
        const std::size_t n = corners.size();
        if (separate ? n % 3 != 0 : n < 3)
            fail(std::to_string(n) + " corners do not make triangles");
        const std::size_t count = separate ? n / 3 : n - 2;
        if (count > k_max_triangles - source_.triangles.size())
            throw Error(ErrorCode::too_large,
                        file_ + ": its instances have more than 2^28 triangles together");
        for (std::size_t i = 0; i < count; ++i) {
            std::array<std::size_t, 3> at{3 * i, 3 * i + 1, 3 * i + 2};
            if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) at = {i, i + 1 + i % 2, i + 2 - i % 2};
            if (mode == TINYGLTF_MODE_TRIANGLE_FAN) at = {i + 1, i + 2, 0};
            if (mirrored) std::swap(at[1], at[2]);
            source_.triangles.push_back(
                {first + corners[at[0]], first + corners[at[1]], first + corners[at[2]]});
        }
    }

    const std::string& file_;
    const std::vector<GltfMaterial>& materials_;
    const tinygltf::Model& model_;
    BadPoints bad_;
    const LongCall& call_;
    GltfAccessors accessors_;
    MeshSource source_;
    std::vector<glm::vec3> vertex_colors_;  // Of the first positions; white where they end.
    MaterialId white_ = k_no_material;      // Made for the first primitive that needs it.
    std::vector<bool> visited_;
    std::map<int, std::uint64_t> min_vertices_;  // The vertices that an index accessor requires.
    std::string place_;
};

MeshSource read_document(const SourceFile& file, std::string_view json, std::size_t first_byte,
                         std::string_view binary_chunk, BadPoints bad, const LongCall& call) {
    const GltfScene scene = read_gltf_scene(file.name, json, first_byte);
    parse_checkpoint(call, 0.3);
    const GltfBuffers buffers(file, scene.buffers, binary_chunk, call.stop);
    const tinygltf::Model model = parse_model(file, scene);
    parse_checkpoint(call, 0.6);
    return Flattener(file, model, scene, buffers, bad, call).run(file, buffers, scene.warnings);
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
