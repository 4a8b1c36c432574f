#include "silhouette/mesh/formats/gltf_materials.h"

#include <cmath>
#include <map>
#include <variant>
#include <vector>

#include "silhouette/mesh/formats/file_colors.h"

namespace rimline {

namespace {

// The objects of one of the document's arrays, by number. Each is read once, however many others name it.
template <typename Made>
class SharedObjects {
public:
    SharedObjects(const GltfPlace& root, const char* array) : name_(array) {
        const auto found = root.find(array);
        if (!found || !found->value().is(JsonType::array)) return;
        array_.emplace(*found);
        elements_.reserve(root.count(array));
        found->each([&](JsonValue element, std::size_t) { elements_.push_back(element); });
    }

    /// What make(object) returned for the object that `from` numbers in its member `key`. Throws what it threw.
    template <typename Make>
    const Made& get(const GltfPlace& from, const char* key, const Make& make) {
        const GltfPlace place = from.at(key);
        const std::uint32_t number = place.integer();
        if (number >= elements_.size())
            place.fail(std::to_string(number) + " does not exist in " + name_);
        auto found = made_.find(number);
        if (found == made_.end()) {
            std::variant<Made, Error> made = Made{};
            try {
                made = make(array_->item(elements_[number], number).object(), number);
            } catch (const Error& e) {
                made = e;
            }
            found = made_.emplace(number, std::move(made)).first;
        }
        if (const Error* fault = std::get_if<Error>(&found->second)) throw Error(*fault);
        return std::get<Made>(found->second);
    }

private:
    const char* name_;
    std::optional<GltfPlace> array_;
    std::vector<JsonValue> elements_;
    std::map<std::uint32_t, std::variant<Made, Error>> made_;
};

struct Sampler {
    TextureWrap wrap_u = TextureWrap::repeat;
    TextureWrap wrap_v = TextureWrap::repeat;
    bool is_pixelated = false;
};

TextureWrap texture_wrap(const GltfPlace& sampler, const char* key) {
    const auto place = sampler.find(key);
    if (!place) return TextureWrap::repeat;
    switch (place->integer()) {
        case 33071: return TextureWrap::clamp;
        case 33648: return TextureWrap::mirror;
        case 10497: return TextureWrap::repeat;
        default: place->fail("is none of glTF's");
    }
}

Sampler read_sampler(const GltfPlace& place) {
    constexpr std::uint32_t k_nearest = 9728;
    return {.wrap_u = texture_wrap(place, "wrapS"),
            .wrap_v = texture_wrap(place, "wrapT"),
            .is_pixelated = place.integer("magFilter") == k_nearest};
}

// Scales, then rotates, then moves coordinates. Angles are counter-clockwise on a picture whose v points down.
glm::mat3x2 texture_transform(const GltfPlace& place) {
    const auto pair = [&](const char* key, const glm::vec2& otherwise) {
        const auto values = place.find(key);
        if (!values) return otherwise;
        const auto numbers = values->numbers<2>();
        return glm::vec2(numbers[0], numbers[1]);
    };
    const glm::vec2 scale = pair("scale", glm::vec2(1.0f));
    const auto rotation = place.find("rotation");
    const double angle_rad = rotation ? rotation->number() : 0.0;
    const auto c = static_cast<float>(std::cos(angle_rad));
    const auto s = static_cast<float>(std::sin(angle_rad));
    return {scale.x * glm::vec2(c, -s), scale.y * glm::vec2(s, c), pair("offset", glm::vec2(0.0f))};
}

std::optional<glm::vec3> base_color(const GltfPlace& pbr, const char* key) {
    const auto factor = pbr.find(key);
    if (!factor) return std::nullopt;
    const auto numbers = factor->numbers<4>();
    return clamped_color(glm::vec3(numbers[0], numbers[1], numbers[2]));
}

// Why a surface is not opaque; empty if it is. The alpha of a texture's pixels is not known here. A material that is
// cut out by it says so; one that blends with it may have a texture without alpha.
std::string transparency(const GltfPlace& material, const std::optional<GltfPlace>& model,
                         const char* factor_key, const char* texture_key) {
    const auto mode = material.find("alphaMode");
    if (!mode || !model) return {};
    const auto factor = model->find(factor_key);
    const double alpha = factor ? factor->numbers<4>()[3] : 1.0;
    const bool is_mask = mode->string() == "MASK";
    const auto cutoff_place = material.find("alphaCutoff");
    const double cutoff = cutoff_place ? cutoff_place->number() : 0.5;
    if ((mode->string() == "BLEND" && alpha < 1.0) || (is_mask && alpha < cutoff))
        return "the material is translucent";
    if (is_mask && cutoff > 0.0 && model->find(texture_key))
        return "the material is cut out by the alpha of its texture";
    return {};
}

class MaterialReader {
public:
    MaterialReader(const GltfPlace& root, GltfScene& scene)
        : scene_(scene),
          textures_(root, "textures"),
          samplers_(root, "samplers"),
          images_(root, "images") {}

    // The model of metal and roughness counts, unless it says less than that of KHR_materials_pbrSpecularGlossiness:
    // a material can have both, and of metals only the first one has the color that is seen.
    GltfMaterial material(const GltfPlace& place) {
        const auto pbr = object_in(place, "pbrMetallicRoughness");
        const auto extensions = object_in(place, "extensions");
        const auto glossy = extensions
                                ? object_in(*extensions, "KHR_materials_pbrSpecularGlossiness")
                                : std::nullopt;
        const bool is_glossy = glossy && richness(pbr, "baseColorFactor", "baseColorTexture") <
                                             richness(glossy, "diffuseFactor", "diffuseTexture");
        const auto& model = is_glossy ? glossy : pbr;
        const char* factor = is_glossy ? "diffuseFactor" : "baseColorFactor";
        const char* texture = is_glossy ? "diffuseTexture" : "baseColorTexture";
        if (const std::string why = transparency(place, model, factor, texture); !why.empty())
            add_warning(scene_.warnings, place.message(why + "; it is taken as opaque"));
        if (!model) return {};
        return material_of(*model, factor, texture);
    }

private:
    static std::optional<GltfPlace> object_in(const GltfPlace& place, const char* key) {
        const auto found = place.find(key);
        if (!found) return std::nullopt;
        return found->object();
    }

    // 2 with a texture, 1 with a color alone, 0 with neither.
    static int richness(const std::optional<GltfPlace>& model, const char* factor,
                        const char* texture) {
        if (!model) return 0;
        return model->find(texture) ? 2 : model->find(factor) ? 1 : 0;
    }

    GltfMaterial material_of(const GltfPlace& model, const char* factor, const char* texture) {
        GltfMaterial made;
        made.base_color = base_color(model, factor);
        const auto use = model.find(texture);
        if (!use) return made;
        try {
            scene_.textures.push_back(used_texture(use->object()));
            made.texture = static_cast<std::uint32_t>(scene_.textures.size() - 1);
        } catch (const Error& e) {
            add_warning(scene_.warnings, std::string(e.what()) + "; the texture is missing");
        }
        return made;
    }

    GltfTexture used_texture(const GltfPlace& use) {
        GltfTexture made = textures_.get(
            use, "index", [&](const GltfPlace& place, std::uint32_t) { return texture(place); });
        auto set = use.find("texCoord");
        if (const auto extensions = use.find("extensions"))
            if (const auto transform = extensions->object().find("KHR_texture_transform")) {
                made.transform = texture_transform(transform->object());
                if (const auto other = transform->find("texCoord")) set.emplace(*other);
            }
        made.coordinate_set = set ? set->integer() : 0;
        return made;
    }

    GltfTexture texture(const GltfPlace& place) {
        if (!place.find("source"))
            place.fail(
                "has no 'source': its picture is in a format of an extension, not PNG or JPEG");
        GltfTexture made{
            .image = images_.get(place, "source",
                                 [&](const GltfPlace& image_place, std::uint32_t number) {
                                     scene_.images.push_back(image(image_place, number));
                                     return static_cast<std::uint32_t>(scene_.images.size() - 1);
                                 })};
        if (place.find("sampler")) {
            const Sampler& sampler =
                samplers_.get(place, "sampler", [](const GltfPlace& sampler_place, std::uint32_t) {
                    return read_sampler(sampler_place);
                });
            made.wrap_u = sampler.wrap_u;
            made.wrap_v = sampler.wrap_v;
            made.is_pixelated = sampler.is_pixelated;
        }
        return made;
    }

    GltfImage image(const GltfPlace& place, std::uint32_t number) const {
        GltfImage made{.number = number, .uri = {}};
        if (const auto uri = place.find("uri")) {
            made.uri = uri->string();
            if (made.uri.empty()) uri->fail("is empty");
            return made;
        }
        const GltfPlace view = place.at("bufferView");
        if (view.integer() >= scene_.views.size())
            view.fail(std::to_string(view.integer()) + " does not exist in bufferViews");
        made.view = scene_.views[view.integer()];
        return made;
    }

    GltfScene& scene_;
    SharedObjects<GltfTexture> textures_;
    SharedObjects<Sampler> samplers_;
    SharedObjects<std::uint32_t> images_;
};

}  // namespace

void read_gltf_materials(const GltfPlace& root, GltfScene& scene, const LongCall& call) {
    MaterialReader reader(root, scene);
    scene.materials.reserve(root.count("materials"));
    root.each_object("materials", [&](const GltfPlace& place) {
        if (scene.materials.size() % k_checkpoint_interval == 0) call.checkpoint(0.0);
        scene.materials.push_back(reader.material(place));
    });
}

}  // namespace rimline
