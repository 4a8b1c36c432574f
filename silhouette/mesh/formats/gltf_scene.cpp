#include "silhouette/mesh/formats/gltf_scene.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>

#include "silhouette/mesh/formats/file_colors.h"

namespace rimline {

namespace {

using nlohmann::json;

// A value of the document, with its path for messages.
class Place {
public:
    Place(const std::string& file, const json& value, std::string path = {})
        : file_(file), value_(value), path_(std::move(path)) {}

    const json& value() const noexcept { return value_; }
    const std::string& path() const noexcept { return path_; }
    [[noreturn]] void fail(const std::string& what) const {
        bad_file(file_, (path_.empty() ? "the document" : path_) + ": " + what);
    }

    const Place& object() const {
        if (!value_.is_object()) fail("should be an object");
        return *this;
    }
    std::optional<Place> find(const char* key) const {
        const auto found = value_.find(key);
        if (found == value_.end()) return std::nullopt;
        return Place(file_, *found, path_.empty() ? key : path_ + "." + key);
    }
    Place at(const char* key) const {
        if (auto found = find(key)) return *found;
        fail(std::string("has no '") + key + "'");
    }
    std::vector<Place> items() const {
        if (!value_.is_array()) fail("should be an array");
        std::vector<Place> places;
        places.reserve(value_.size());
        for (std::size_t i = 0; i < value_.size(); ++i) places.push_back(item(i));
        return places;
    }
    Place item(std::size_t i) const {
        return Place(file_, value_[i], path_ + "[" + std::to_string(i) + "]");
    }
    /// The objects of an array, or nothing if the array is missing.
    std::vector<Place> objects(const char* key) const {
        std::vector<Place> places;
        if (const auto array = find(key)) places = array->items();
        for (const Place& place : places) place.object();
        return places;
    }

    std::string string() const {
        if (!value_.is_string()) fail("should be a string");
        return value_.get<std::string>();
    }
    // Limited to 31 bits, because tinygltf stores most integers in an int.
    std::int64_t integer() const {
        if (!value_.is_number_unsigned()) fail("should be an integer, 0 or greater");
        const auto i = value_.get<std::uint64_t>();
        if (i > 0x7fffffff) fail(std::to_string(i) + " is too large; it should be below 2^31");
        return static_cast<std::int64_t>(i);
    }
    bool boolean() const {
        if (!value_.is_boolean()) fail("should be true or false");
        return value_.get<bool>();
    }
    json numbers(std::size_t count) const {
        const std::vector<Place> places = items();
        if (places.size() != count) fail("should have " + std::to_string(count) + " numbers");
        for (const Place& place : places)
            if (!place.value().is_number()) place.fail("should be a number");
        return value_;
    }
    json integers() const {
        for (const Place& place : items()) place.integer();
        return value_;
    }

private:
    const std::string& file_;
    const json& value_;
    std::string path_;
};

void copy_integers(const Place& from, json& to, std::initializer_list<const char*> required,
                   std::initializer_list<const char*> optional) {
    for (const char* key : required) to[key] = from.at(key).integer();
    for (const char* key : optional)
        if (const auto place = from.find(key)) to[key] = place->integer();
}

json accessor(const Place& place) {
    json copy;
    copy_integers(place, copy, {"componentType", "count"}, {"bufferView", "byteOffset"});
    copy["type"] = place.at("type").string();
    if (const auto normalized = place.find("normalized"))
        copy["normalized"] = normalized->boolean();
    if (const auto sparse = place.find("sparse")) {
        json& s = copy["sparse"];
        copy_integers(sparse->object(), s, {"count"}, {});
        copy_integers(sparse->at("indices").object(), s["indices"], {"bufferView", "componentType"},
                      {"byteOffset"});
        copy_integers(sparse->at("values").object(), s["values"], {"bufferView"}, {"byteOffset"});
    }
    return copy;
}

// `materials` are those of the document.
json mesh(const Place& place, const std::vector<GltfMaterial>& materials) {
    json primitives = json::array();
    const std::vector<Place> places = place.at("primitives").items();
    if (places.empty()) place.fail("has no primitives");
    for (const Place& primitive : places) {
        json copy;
        copy_integers(primitive.object(), copy, {}, {"mode", "material"});
        json& attributes = copy["attributes"] = json::object();
        const Place named = primitive.at("attributes").object();
        copy_integers(named, attributes, {}, {"POSITION", "COLOR_0"});
        // Of texture coordinates only those that are used. A fault of them is no error.
        if (copy.contains("material"))
            if (const auto number = copy["material"].get<std::size_t>();
                number < materials.size() && materials[number].texture) {
                const char* key = materials[number].texture->coordinates.c_str();
                const auto found = named.find(key);
                if (found && found->value().is_number_unsigned() &&
                    found->value().get<std::uint64_t>() <= 0x7fffffff)
                    attributes[key] = found->value();
            }
        if (const auto indices = primitive.find("indices"))
            attributes[k_gltf_indices] = indices->integer();
        primitives.push_back(std::move(copy));
    }
    return {{"primitives", std::move(primitives)}};
}

std::optional<glm::vec3> base_color(const Place& pbr) {
    const auto factor = pbr.find("baseColorFactor");
    if (!factor) return std::nullopt;
    const json numbers = factor->numbers(4);
    return clamped_color(
        {numbers[0].get<float>(), numbers[1].get<float>(), numbers[2].get<float>()});
}

// The object that place.key numbers in the root's array of this name.
Place referenced(const Place& root, const Place& place, const char* key, const char* array) {
    const Place number = place.at(key);
    const auto i = static_cast<std::size_t>(number.integer());
    const auto objects = root.find(array);
    if (!objects || !objects->value().is_array() || i >= objects->value().size())
        number.fail(std::to_string(i) + " does not exist in " + array);
    return objects->item(i).object();
}

GltfImage image(const Place& root, const Place& place) {
    GltfImage found{.place = place.path()};
    if (const auto uri = place.find("uri")) {
        found.uri = uri->string();
        if (found.uri.empty()) uri->fail("is empty");
        return found;
    }
    const Place view = referenced(root, place, "bufferView", "bufferViews");
    found.buffer = static_cast<std::size_t>(view.at("buffer").integer());
    found.size_bytes = static_cast<std::uint64_t>(view.at("byteLength").integer());
    if (const auto offset = view.find("byteOffset"))
        found.offset_bytes = static_cast<std::uint64_t>(offset->integer());
    return found;
}

TextureWrap texture_wrap(const Place& sampler, const char* key) {
    const auto place = sampler.find(key);
    if (!place) return TextureWrap::repeat;
    switch (place->integer()) {
        case 33071: return TextureWrap::clamp;
        case 33648: return TextureWrap::mirror;
        case 10497: return TextureWrap::repeat;
        default: place->fail("is none of glTF's");
    }
}

// Scales, then rotates, then moves coordinates. Angles are counter-clockwise on a picture whose v points down.
glm::mat3x2 texture_transform(const Place& place) {
    const auto pair = [&](const char* key, const glm::vec2& otherwise) {
        const auto values = place.find(key);
        if (!values) return otherwise;
        const json numbers = values->numbers(2);
        return glm::vec2(numbers[0].get<float>(), numbers[1].get<float>());
    };
    const glm::vec2 scale = pair("scale", glm::vec2(1.0f));
    double angle_rad = 0.0;
    if (const auto rotation = place.find("rotation")) {
        if (!rotation->value().is_number()) rotation->fail("should be a number");
        angle_rad = rotation->value().get<double>();
    }
    const auto c = static_cast<float>(std::cos(angle_rad));
    const auto s = static_cast<float>(std::sin(angle_rad));
    return {scale.x * glm::vec2(c, -s), scale.y * glm::vec2(s, c), pair("offset", glm::vec2(0.0f))};
}

GltfTexture texture(const Place& root, const Place& use) {
    const Place texture = referenced(root, use, "index", "textures");
    if (!texture.find("source"))
        texture.fail(
            "has no 'source': its picture is in a format of an extension, not PNG or JPEG");
    GltfTexture made{.image = image(root, referenced(root, texture, "source", "images"))};
    if (texture.find("sampler")) {
        const Place sampler = referenced(root, texture, "sampler", "samplers");
        made.wrap_u = texture_wrap(sampler, "wrapS");
        made.wrap_v = texture_wrap(sampler, "wrapT");
        constexpr std::int64_t k_nearest = 9728;
        const auto filter = sampler.find("magFilter");
        made.is_pixelated = filter && filter->integer() == k_nearest;
    }
    auto set = use.find("texCoord");
    if (const auto extensions = use.find("extensions"))
        if (const auto transform = extensions->object().find("KHR_texture_transform")) {
            made.transform = texture_transform(transform->object());
            if (const auto other = transform->find("texCoord")) set.emplace(*other);
        }
    made.coordinates = "TEXCOORD_" + std::to_string(set ? set->integer() : 0);
    return made;
}

GltfMaterial material(const Place& root, const Place& place, std::vector<std::string>& warnings) {
    GltfMaterial made;
    const auto pbr = place.find("pbrMetallicRoughness");
    if (!pbr) return made;
    made.base_color = base_color(pbr->object());
    const auto use = pbr->find("baseColorTexture");
    if (!use) return made;
    try {
        made.texture = texture(root, use->object());
    } catch (const Error& e) {
        add_warning(warnings, std::string(e.what()) + "; the texture is missing");
    }
    return made;
}

json node(const Place& place) {
    json copy = json::object();
    copy_integers(place, copy, {}, {"mesh"});
    if (const auto children = place.find("children")) copy["children"] = children->integers();
    const auto matrix = place.find("matrix");
    if (matrix) copy["matrix"] = matrix->numbers(16);
    for (const auto& [key, count] : {std::pair{"translation", 3}, {"rotation", 4}, {"scale", 3}}) {
        const auto part = place.find(key);
        if (!part) continue;
        if (matrix) part->fail("stands beside a matrix; a node has one or the other");
        copy[key] = part->numbers(static_cast<std::size_t>(count));
    }
    return copy;
}

// Extensions that do not affect the positions of triangles, or that are supported here.
bool is_harmless(std::string_view extension) noexcept {
    for (const std::string_view prefix :
         {"KHR_materials_", "KHR_texture_", "EXT_texture_", "MSFT_texture_", "KHR_lights_",
          "EXT_lights_", "KHR_mesh_quantization", "KHR_xmp", "KHR_animation_", "ADOBE_materials_"})
        if (extension.starts_with(prefix)) return true;
    return false;
}

void check_version_and_extensions(const Place& root) {
    const Place asset = root.at("asset").object();
    const std::string version = asset.at("version").string();
    if (!version.starts_with("2."))
        asset.fail("glTF version " + excerpt(version) + " is not supported; version 2 is");
    // minVersion is the version that a reader must support. Later versions only add to 2.0.
    if (const auto min_version = asset.find("minVersion")) {
        const std::string text = min_version->string();
        if (text != "2.0" && !text.starts_with("1.") && !text.starts_with("0."))
            min_version->fail("the file needs a reader of glTF version " + excerpt(text) +
                              "; this one reads 2.0, so export it for that");
    }
    if (const auto required = root.find("extensionsRequired"))
        for (const Place& extension : required->items())
            if (!is_harmless(extension.string()))
                extension.fail("the file requires the extension " + excerpt(extension.string()) +
                               ", which is not supported; export it without");
    if (const auto used = root.find("extensionsUsed"))
        for (const Place& extension : used->items())
            if (extension.string() == "EXT_mesh_gpu_instancing")
                extension.fail(
                    "instances by EXT_mesh_gpu_instancing are not supported; export "
                    "them as nodes");
}

// Deeper than any glTF. Recursion over a document of this depth is safe.
constexpr int k_max_depth = 64;

json parse(const std::string& name, std::string_view text, std::size_t first_byte) {
    const auto check_depth = [&](int depth, json::parse_event_t, json&) {
        if (depth > k_max_depth)
            bad_file(name, "the document nests more than 64 levels deep, which no glTF does");
        return true;
    };
    try {
        return json::parse(text.begin(), text.end(), check_depth);
    } catch (const json::parse_error& e) {
        bad_byte(name, first_byte + std::min(e.byte, text.size()),
                 "this is not JSON; the file is truncated or damaged");
    } catch (const json::exception& e) {
        bad_file(name, std::string("its JSON cannot be used: ") + e.what());
    }
}

}  // namespace

GltfScene read_gltf_scene(const std::string& name, std::string_view text, std::size_t first_byte) {
    const json document = parse(name, text, first_byte);
    const Place root(name, document);
    root.object();
    check_version_and_extensions(root);

    GltfScene scene;
    json copy = {{"asset", {{"version", "2.0"}}}};
    for (const Place& place : root.objects("buffers")) {
        GltfBuffer buffer{static_cast<std::uint64_t>(place.at("byteLength").integer()), {}};
        if (const auto uri = place.find("uri")) buffer.uri = uri->string();
        scene.buffers.push_back(std::move(buffer));
    }
    for (const Place& place : root.objects("bufferViews")) {
        json view;
        copy_integers(place, view, {"buffer", "byteLength"}, {"byteOffset", "byteStride"});
        copy["bufferViews"].push_back(std::move(view));
    }
    for (const Place& place : root.objects("accessors"))
        copy["accessors"].push_back(accessor(place));
    for (const Place& place : root.objects("materials"))
        scene.materials.push_back(material(root, place, scene.warnings));
    for (const Place& place : root.objects("meshes"))
        copy["meshes"].push_back(mesh(place, scene.materials));
    for (const Place& place : root.objects("nodes")) copy["nodes"].push_back(node(place));
    for (const Place& place : root.objects("scenes")) {
        json nodes = json::array();
        if (const auto list = place.find("nodes")) nodes = list->integers();
        copy["scenes"].push_back({{"nodes", std::move(nodes)}});
    }
    if (const auto number = root.find("scene")) copy["scene"] = number->integer();
    scene.document = copy.dump();
    return scene;
}

}  // namespace rimline
