#include "silhouette/mesh/formats/gltf_document.h"

#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <utility>

#include "silhouette/mesh/formats/gltf_materials.h"
#include "silhouette/mesh/formats/gltf_place.h"

namespace rimline {

namespace {

constexpr const char* k_quantization = "KHR_mesh_quantization";

// Extensions that do not affect the positions of triangles, or that are supported here.
bool is_harmless(std::string_view extension) noexcept {
    for (const std::string_view prefix :
         {"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_", "KHR_lights_",
          "EXT_lights_", k_quantization, k_gltf_edges, "KHR_xmp", "KHR_animation_",
          "ADOBE_materials_"})
        if (extension.starts_with(prefix)) return true;
    return false;
}

void check_version_and_extensions(const GltfPlace& root, GltfScene& scene) {
    const GltfPlace asset = root.at("asset").object();
    const std::string_view version = asset.at("version").string();
    if (!version.starts_with("2."))
        asset.fail("glTF version " + excerpt(version) + " is not supported; version 2 is");
    // minVersion is the version that a reader must support. Later versions only add to 2.0.
    if (const auto min_version = asset.find("minVersion")) {
        const std::string_view text = min_version->string();
        if (text != "2.0" && !text.starts_with("1.") && !text.starts_with("0."))
            min_version->fail("the file needs a reader of glTF version " + excerpt(text) +
                              "; this one reads 2.0, so export it for that");
    }
    if (const auto required = root.find("extensionsRequired"))
        required->each([&](JsonValue value, std::size_t i) {
            const GltfPlace extension = required->item(value, i);
            scene.is_quantized = scene.is_quantized || extension.string() == k_quantization;
            if (!is_harmless(extension.string()))
                extension.fail("the file requires the extension " + excerpt(extension.string()) +
                               ", which is not supported; export it without");
        });
    if (const auto used = root.find("extensionsUsed"))
        used->each([&](JsonValue value, std::size_t i) {
            const GltfPlace extension = used->item(value, i);
            scene.is_quantized = scene.is_quantized || extension.string() == k_quantization;
            if (extension.string() == "EXT_mesh_gpu_instancing")
                extension.fail(
                    "instances by EXT_mesh_gpu_instancing are not supported; export "
                    "them as nodes");
        });
}

GltfView read_view(const GltfPlace& place) {
    const GltfView view{.buffer = place.at("buffer").integer(),
                        .offset_bytes = place.integer("byteOffset").value_or(0),
                        .size_bytes = place.at("byteLength").integer(),
                        .stride_bytes = place.integer("byteStride").value_or(0)};
    if (view.stride_bytes > 252 || view.stride_bytes % 4 != 0)
        place.at("byteStride")
            .fail(std::to_string(view.stride_bytes) + " should be a multiple of 4, at most 252");
    return view;
}

GltfType accessor_type(const GltfPlace& place) {
    constexpr std::array<std::pair<std::string_view, GltfType>, 7> k_types{
        {{"SCALAR", GltfType::scalar},
         {"VEC2", GltfType::vec2},
         {"VEC3", GltfType::vec3},
         {"VEC4", GltfType::vec4},
         {"MAT2", GltfType::matrix},
         {"MAT3", GltfType::matrix},
         {"MAT4", GltfType::matrix}}};
    for (const auto& [name, type] : k_types)
        if (place.string() == name) return type;
    place.fail(excerpt(place.string()) + " is none of glTF's");
}

GltfSparse read_sparse(const GltfPlace& place) {
    const GltfPlace indices = place.at("indices").object();
    const GltfPlace values = place.at("values").object();
    return {.count = place.at("count").integer(),
            .indices_view = indices.at("bufferView").integer(),
            .indices_offset_bytes = indices.integer("byteOffset").value_or(0),
            .indices_component = indices.at("componentType").integer(),
            .values_view = values.at("bufferView").integer(),
            .values_offset_bytes = values.integer("byteOffset").value_or(0)};
}

GltfAccessor read_accessor(const GltfPlace& place) {
    GltfAccessor accessor{.view = place.integer("bufferView"),
                          .offset_bytes = place.integer("byteOffset").value_or(0),
                          .count = place.at("count").integer(),
                          .component = place.at("componentType").integer(),
                          .type = accessor_type(place.at("type")),
                          .is_normalized = false,
                          .sparse = {}};
    if (const auto normalized = place.find("normalized"))
        accessor.is_normalized = normalized->boolean();
    if (const auto sparse = place.find("sparse")) accessor.sparse = read_sparse(sparse->object());
    return accessor;
}

std::uint32_t size_of(const auto& vector) { return static_cast<std::uint32_t>(vector.size()); }

// The number of a primitive's edges in scene.edges.
std::optional<std::uint32_t> read_edges(const GltfPlace& primitive, GltfScene& scene) {
    const auto extensions = primitive.find("extensions");
    if (!extensions) return std::nullopt;
    const auto place = extensions->object().find(k_gltf_edges);
    if (!place) return std::nullopt;
    GltfEdges edges{.visibility = place->object().integer("visibility"),
                    .silhouette_normals = place->integer("silhouetteNormals"),
                    .line_strings = {size_of(scene.line_strings), 0}};
    place->each_object("lineStrings", [&](const GltfPlace& line_string) {
        scene.line_strings.push_back(line_string.at("indices").integer());
    });
    edges.line_strings.end = size_of(scene.line_strings);
    if (!edges.visibility && edges.line_strings.begin == edges.line_strings.end)
        place->fail("has neither 'visibility' nor 'lineStrings'");
    scene.edges.push_back(edges);
    return size_of(scene.edges) - 1;
}

GltfPrimitive read_primitive(const GltfPlace& place, GltfScene& scene) {
    const GltfPlace attributes = place.at("attributes").object();
    GltfPrimitive primitive{.mode = place.integer("mode").value_or(k_gltf_triangles),
                            .positions = attributes.integer("POSITION"),
                            .indices = place.integer("indices"),
                            .colors = attributes.integer("COLOR_0"),
                            .uvs = {},
                            .material = place.integer("material"),
                            .edges = read_edges(place, scene)};
    if (!primitive.material || *primitive.material >= scene.materials.size()) return primitive;
    const auto texture = scene.materials[*primitive.material].texture;
    if (!texture) return primitive;
    // A fault of texture coordinates is no error.
    const std::string key = "TEXCOORD_" + std::to_string(scene.textures[*texture].coordinate_set);
    const auto uvs = attributes.value().find(key);
    if (uvs && uvs->is(JsonType::natural) && uvs->natural() <= 0x7fffffff)
        primitive.uvs = static_cast<std::uint32_t>(uvs->natural());
    return primitive;
}

GltfRange read_primitives(const GltfPlace& place, GltfScene& scene) {
    const std::uint32_t begin = size_of(scene.primitives);
    const GltfPlace primitives = place.at("primitives");
    primitives.each([&](JsonValue value, std::size_t i) {
        scene.primitives.push_back(read_primitive(primitives.item(value, i).object(), scene));
    });
    if (size_of(scene.primitives) == begin) place.fail("has no primitives");
    return {begin, size_of(scene.primitives)};
}

GltfTransform read_matrix(const GltfPlace& place) {
    const auto m = place.numbers<16>();
    GltfTransform transform{glm::dmat4x3(1.0), nullptr};
    for (int i = 0; i < 16; ++i)
        if (i % 4 < 3) transform.parent_from_node[i / 4][i % 4] = m[static_cast<std::size_t>(i)];
    if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0)
        transform.fault = "its matrix is not affine: the last row should be 0 0 0 1";
    return transform;
}

// The transform of a node that has no matrix, if it has any.
std::optional<GltfTransform> read_parts(const GltfPlace& place) {
    const auto translation = place.find("translation");
    const auto rotation = place.find("rotation");
    const auto scale = place.find("scale");
    if (!translation && !rotation && !scale) return std::nullopt;
    glm::dmat4 m(1.0);
    const char* fault = nullptr;
    if (rotation) {
        const auto r = rotation->numbers<4>();
        const glm::dquat q(r[3], r[0], r[1], r[2]);
        const double length = glm::length(q);
        if (!(length > 0.0) || !std::isfinite(length)) fault = "its rotation is not a quaternion";
        m = glm::mat4_cast(q / length);
    }
    if (scale) {
        const auto s = scale->numbers<3>();
        for (int i = 0; i < 3; ++i) m[i] *= s[static_cast<std::size_t>(i)];
    }
    if (translation) {
        const auto t = translation->numbers<3>();
        for (int i = 0; i < 3; ++i) m[3][i] = t[static_cast<std::size_t>(i)];
    }
    return GltfTransform{glm::dmat4x3(m), fault};
}

// Appends the numbers of an array.
void add_integers(const GltfPlace& place, std::vector<std::uint32_t>& to) {
    place.each([&](JsonValue value, std::size_t i) {
        if (!value.is(JsonType::natural) || value.natural() > 0x7fffffff)
            place.item(value, i).integer();  // Throws.
        to.push_back(static_cast<std::uint32_t>(value.natural()));
    });
}

GltfNode read_node(const GltfPlace& place, GltfScene& scene) {
    GltfNode node{.mesh = place.integer("mesh"), .transform = {}, .children = {}};
    node.children.begin = size_of(scene.children);
    if (const auto children = place.find("children")) add_integers(*children, scene.children);
    node.children.end = size_of(scene.children);
    std::optional<GltfTransform> transform;
    if (const auto matrix = place.find("matrix")) {
        for (const char* key : {"translation", "rotation", "scale"})
            if (const auto part = place.find(key))
                part->fail("stands beside a matrix; a node has one or the other");
        transform = read_matrix(*matrix);
    } else {
        transform = read_parts(place);
    }
    if (transform) {
        node.transform = size_of(scene.transforms);
        scene.transforms.push_back(*transform);
    }
    return node;
}

void read_roots(const std::string& name, const GltfPlace& root, GltfScene& scene) {
    const std::optional<std::uint32_t> named = root.integer("scene");
    const std::uint32_t wanted = named.value_or(0);
    std::uint32_t scenes = 0;
    std::vector<std::uint32_t> others;  // Only checked.
    root.each_object("scenes", [&](const GltfPlace& place) {
        others.clear();
        if (const auto nodes = place.find("nodes"))
            add_integers(*nodes, scenes == wanted ? scene.roots : others);
        ++scenes;
    });
    if (scene.nodes.empty()) return;
    if (named || scenes > 0) {
        if (wanted >= scenes)
            bad_file(name, "scene: scene " + std::to_string(wanted) + " does not exist");
        return;
    }
    std::vector<bool> is_child(scene.nodes.size(), false);
    for (const std::uint32_t child : scene.children)
        if (child < is_child.size()) is_child[child] = true;
    for (std::uint32_t i = 0; i < size_of(is_child); ++i)
        if (!is_child[i]) scene.roots.push_back(i);
    if (scene.roots.empty())
        bad_file(name, "nodes: every node is another's child; they form a cycle");
}

}  // namespace

GltfScene read_gltf_scene(const std::string& name, std::string_view text, std::size_t first_byte,
                          const LongCall& call) {
    constexpr double k_parsed = 0.6;
    JsonDocument document(name, text, first_byte, call.part(0.0, k_parsed));
    const GltfPlace root(name, document.root());
    root.object();

    GltfScene scene;
    check_version_and_extensions(root, scene);
    // Fills a list, whose size is known, so it does not take twice its memory while it grows.
    const auto read_list = [&](const char* key, auto& list, const auto& read) {
        list.reserve(root.count(key));
        root.each_object(key, [&](const GltfPlace& place) {
            if (list.size() % k_checkpoint_interval == 0) call.checkpoint(k_parsed);
            list.push_back(read(place));
        });
    };
    read_list("buffers", scene.buffers, [](const GltfPlace& place) {
        GltfBuffer buffer{place.at("byteLength").integer(), {}};
        if (const auto uri = place.find("uri")) buffer.uri = uri->string();
        return buffer;
    });
    read_list("bufferViews", scene.views, read_view);
    read_list("accessors", scene.accessors, read_accessor);
    read_gltf_materials(root, scene, call.part(k_parsed, 1.0));
    read_list("meshes", scene.meshes,
              [&](const GltfPlace& place) { return read_primitives(place, scene); });
    read_list("nodes", scene.nodes,
              [&](const GltfPlace& place) { return read_node(place, scene); });
    read_roots(name, root, scene);
    scene.strings = document.take_strings();
    call.checkpoint(1.0);
    return scene;
}

}  // namespace rimline
