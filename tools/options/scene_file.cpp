#include "tools/options/scene_file.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>

#include "silhouette/error.h"
#include "silhouette/printable_text.h"
#include "tools/command.h"
#include "tools/nearest_name.h"
#include "tools/options/exact_text.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/options/standard_input.h"
#include "tools/usage_words.h"

namespace rimline::tools {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Setting = SceneFile::Setting;

namespace {

enum class Kind { text, number, number_or_word, vector, on_or_off, flag };

struct PictureKey {
    std::string_view name;
    Kind kind;
};
// Each is the name of an option.
constexpr std::array<PictureKey, 21> k_picture_keys{{{"style", Kind::text},
                                                     {"palette", Kind::text},
                                                     {"color", Kind::text},
                                                     {"materials", Kind::on_or_off},
                                                     {"line-color", Kind::text},
                                                     {"lines", Kind::on_or_off},
                                                     {"line-width", Kind::number},
                                                     {"crease", Kind::number_or_word},
                                                     {"hidden", Kind::flag},
                                                     {"shadows", Kind::text},
                                                     {"lighting", Kind::text},
                                                     {"ground", Kind::flag},
                                                     {"intersections", Kind::on_or_off},
                                                     {"min-length", Kind::number},
                                                     {"outline", Kind::text},
                                                     {"depth-step", Kind::number},
                                                     {"normal-step", Kind::number},
                                                     {"silhouette-from", Kind::vector},
                                                     {"silhouette-direction", Kind::vector},
                                                     {"background", Kind::text},
                                                     {"size", Kind::text}}};

[[noreturn]] void fail(const std::string& path, const std::string& place, const std::string& what) {
    throw Error(ErrorCode::bad_input, path + (place.empty() ? "" : ":" + printable_text(place)) +
                                          ": " + printable_text(what));
}

// Without the name of the option before it.
std::string without_name(const std::string& message) {
    const std::size_t colon = message.find(": ");
    return colon == std::string::npos ? message : message.substr(colon + 2);
}

// A value of the file and its place.
class Node {
public:
    Node(const std::string& path, const Json& value, std::string place)
        : path_(path), value_(value), place_(std::move(place)) {}

    const std::string& place() const noexcept { return place_; }
    const Json& value() const noexcept { return value_; }
    [[noreturn]] void fail(const std::string& what) const { tools::fail(path_, place_, what); }
    [[noreturn]] void reject(const std::string& expected) const {
        std::string found = value_.dump(-1, ' ', false, Json::error_handler_t::replace);
        if (found.size() > 60) found = found.substr(0, 57) + "...";
        fail("expected " + expected + ", not " + found);
    }

    bool has(const char* key) const { return value_.contains(key); }
    Node at(const std::string& key) const {
        return {path_, value_.at(key), place_.empty() ? key : place_ + "." + key};
    }
    std::vector<Node> items(const std::string& expected) const {
        if (!value_.is_array()) reject(expected);
        std::vector<Node> nodes;
        for (std::size_t i = 0; i < value_.size(); ++i)
            nodes.emplace_back(path_, value_[i], place_ + "[" + std::to_string(i) + "]");
        return nodes;
    }
    // It must be an object with no other keys.
    void check_keys(const std::vector<std::string>& known) const {
        if (!value_.is_object()) reject("an object {...}");
        for (const auto& [key, unused] : value_.items()) {
            if (std::ranges::find(known, key) != known.end()) continue;
            std::string names;
            for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
            at(key).fail("there is no such key here; there are " + names +
                         did_you_mean(key, known));
        }
    }

    std::string text() const {
        if (!value_.is_string()) reject("a text");
        return value_.get<std::string>();
    }
    std::string number() const {
        if (!value_.is_number()) reject("a number");
        return exact_text(value_.get<double>());
    }
    // Not a number or vector within a text.
    bool is_word() const {
        if (!value_.is_string()) return false;
        const std::string word = value_.get<std::string>();
        const std::size_t sign = word.starts_with('-') ? 1 : 0;  // Of an axis.
        return word.size() > sign && std::isalpha(static_cast<unsigned char>(word[sign])) != 0;
    }
    std::string number_or_word() const {
        if (is_word()) return text();
        if (!value_.is_number()) reject("a number or a name");
        return number();
    }
    bool truth() const {
        if (!value_.is_boolean()) reject("true or false");
        return value_.get<bool>();
    }
    // Numbers with commas between them.
    std::string numbers(std::size_t count, const std::string& expected) const {
        if (!value_.is_array() || value_.size() != count) reject(expected);
        std::string text;
        for (const Json& number : value_) {
            if (!number.is_number()) reject(expected);
            text += (text.empty() ? "" : ",") + exact_text(number.get<double>());
        }
        return text;
    }
    std::string vector() const { return numbers(3, "[x, y, z]"); }
    // A vector, or a word that the option knows.
    std::string vector_or_word() const {
        return is_word() ? text() : numbers(3, "[x, y, z] or a name");
    }

    // The result of a parser of option_types.h.
    template <typename Parse>
    auto parsed(Parse&& parse) const {
        try {
            return parse();
        } catch (const CLI::ParseError& error) {
            fail(without_name(error.what()));
        }
    }

private:
    const std::string& path_;
    const Json& value_;
    std::string place_;
};

std::string read_text(const std::string& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        throw FileError(path, "is a folder; give a scene file", EISDIR);
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) throw FileError::of_system(path, "cannot open it", errno);
    std::ostringstream text;
    text << file.rdbuf();
    if (file.bad()) throw FileError(path, "cannot read it");
    return text.str();
}

// nlohmann's message is "[...] parse error at line 3, column 5: syntax error ...".
[[noreturn]] void fail_syntax(const std::string& path, const std::string& message) {
    unsigned line = 0, column = 0;
    const std::size_t at = message.find("at line ");
    const std::size_t colon = at == std::string::npos ? at : message.find(": ", at);
    if (colon == std::string::npos ||
        std::sscanf(message.c_str() + at, "at line %u, column %u", &line, &column) != 2)
        throw Error(ErrorCode::bad_input, path + ": is not JSON");
    fail(path, std::to_string(line) + ":" + std::to_string(column),
         "is not JSON: " + message.substr(colon + 2));
}

// The objects and lists that a parser is in, from its events.
class OpenValues {
public:
    // Returns false for a key that its object has already: the parser would keep the last one.
    bool follow(Json::parse_event_t event, const Json& parsed) {
        switch (event) {
            case Json::parse_event_t::object_start: open_.push_back({}); break;
            case Json::parse_event_t::array_start: open_.push_back({.is_list = true}); break;
            case Json::parse_event_t::object_end:
            case Json::parse_event_t::array_end:
                open_.pop_back();
                end_value();
                break;
            case Json::parse_event_t::value: end_value(); break;
            case Json::parse_event_t::key:
                open_.back().key = parsed.get<std::string>();
                return open_.back().keys.insert(open_.back().key).second;
        }
        return true;
    }

    bool are_too_many() const noexcept { return open_.size() > k_max_depth; }

    // Of the value that comes next, as Node has it.
    std::string place() const {
        std::string place;
        for (const Open& open : open_) {
            if (open.is_list)
                place += "[" + std::to_string(open.index) + "]";
            else
                place += (place.empty() ? "" : ".") + open.key;
        }
        return place;
    }

private:
    struct Open {
        bool is_list = false;
        std::size_t index = 0;
        std::string key;
        std::set<std::string> keys;
    };

    void end_value() {
        if (!open_.empty()) ++open_.back().index;
    }

    static constexpr std::size_t k_max_depth = 64;

    std::vector<Open> open_;
};

Json parse_json(const std::string& path, const std::string& text) {
    OpenValues open;
    const auto check = [&](int, Json::parse_event_t event, Json& parsed) {
        if (!open.follow(event, parsed))
            fail(path, open.place(),
                 "the key \"" + parsed.get<std::string>() + "\" occurs twice in one object");
        if (open.are_too_many())
            fail(path, "", "it nests more than 64 levels deep, which no scene file does");
        return true;
    };
    try {
        return Json::parse(text, check);
    } catch (const Json::parse_error& error) {
        fail_syntax(path, error.what());
    } catch (const Json::exception&) {
        fail(path, open.place(), "this number is out of range; the largest one is about 1.8e308");
    }
}

UpChoice up_of(const Node& node) {
    const std::string text = node.vector_or_word();
    return node.parsed([&] { return parse_up_choice("up", text); });
}

Turn turn_of(const Node& node) {
    const std::string text =
        node.value().is_array() ? node.numbers(4, "degrees or [x, y, z, degrees]") : node.number();
    return node.parsed([&] { return parse_turn("turn", text); });
}

Color paint_of(const Node& node) {
    const std::string text = node.text();
    const std::optional<Color> color = color_of(text);
    if (!color || color->alpha != 255)
        node.fail("expected #rgb, #rrggbb or a CSS color name, not '" + text + "'" +
                  nearest_color(text));
    return *color;
}

std::string model_name_of(const Node& node, const fs::path& folder) {
    const std::string name = node.text();
    node.parsed([&] { check_model_name(name); });
    if (name == k_standard_input) node.fail("a scene file cannot name standard input");
    if (is_scene_file(name)) node.fail("a scene file cannot hold another one");
    if (is_built_in_shape(name) || fs::path(name).is_absolute()) return name;
    return (folder / name).lexically_normal().string();
}

PlacedModel model_of(const Node& node, const fs::path& folder) {
    node.check_keys({"model", "subdivide", "at", "turn", "scale", "up", "paint"});
    if (!node.has("model")) node.fail("it needs a \"model\", a file or shape:NAME");
    PlacedModel model{.model = model_name_of(node.at("model"), folder)};
    if (node.has("subdivide")) {
        const Node steps = node.at("subdivide");
        const double count = steps.value().is_number() ? steps.value().get<double>() : -1.0;
        if (count != std::floor(count) || count < 0.0 || count > k_max_subdivisions)
            steps.reject("a whole number from 0 to " + std::to_string(k_max_subdivisions));
        model.subdivide = static_cast<std::uint32_t>(count);
    }
    if (node.has("at")) {
        const Node at = node.at("at");
        const std::string text = at.vector();
        model.at = at.parsed([&] { return parse_point("at", text); });
    }
    if (node.has("turn")) model.turn = turn_of(node.at("turn"));
    if (node.has("scale")) {
        const Node scale = node.at("scale");
        const std::string text = scale.number();
        model.scale = scale.parsed([&] { return parse_scale("scale", text); });
    }
    if (node.has("up")) model.up = up_of(node.at("up"));
    if (node.has("paint")) model.paint = paint_of(node.at("paint"));
    return model;
}

Setting light_of(const Node& node) {
    node.check_keys({"sun", "lamp"});
    if (node.has("sun") == node.has("lamp")) node.fail("expected one of \"sun\" and \"lamp\"");
    if (node.has("lamp")) {
        const Node lamp = node.at("lamp");
        return {"--light", lamp.vector(), lamp.place()};
    }
    const Node sun = node.at("sun");
    return {"--sun", sun.vector_or_word(), sun.place()};
}

SceneFile::Camera camera_of(const std::string& name, const Node& node) {
    node.check_keys({"eye", "azimuth", "elevation", "target", "up", "fov", "ortho"});
    const bool has_angle = node.has("azimuth") || node.has("elevation");
    if (node.has("eye") && has_angle) node.fail("\"eye\" excludes \"azimuth\" and \"elevation\"");
    if (node.has("fov") && node.has("ortho")) node.fail("\"fov\" excludes \"ortho\"");
    SceneFile::Camera camera{.name = name, .settings = {}, .json = node.value()};
    for (const char* key : {"eye", "up"})
        if (node.has(key))
            camera.settings.push_back(
                {std::string("--") + key, node.at(key).vector_or_word(), node.at(key).place()});
    if (node.has("target")) {
        const Node target = node.at("target");
        camera.settings.push_back({"--target", target.vector(), target.place()});
        if (node.has("eye") && node.at("eye").value() == target.value())
            target.fail("is the same point as \"eye\"");
    }
    for (const char* key : {"azimuth", "elevation", "fov", "ortho"})
        if (node.has(key))
            camera.settings.push_back(
                {std::string("--") + key, node.at(key).number(), node.at(key).place()});
    return camera;
}

std::vector<Setting> picture_of(const Node& node) {
    std::vector<std::string> names;
    for (const PictureKey& key : k_picture_keys) names.emplace_back(key.name);
    node.check_keys(names);
    if (node.has("silhouette-from") && node.has("silhouette-direction"))
        node.fail("\"silhouette-from\" excludes \"silhouette-direction\"");
    std::vector<Setting> settings;
    for (const PictureKey& key : k_picture_keys) {
        const std::string name(key.name);
        if (!node.has(name.c_str())) continue;
        const Node value = node.at(name);
        Setting setting{"--" + name, {}, value.place()};
        switch (key.kind) {
            case Kind::text: setting.value = value.text(); break;
            case Kind::number: setting.value = value.number(); break;
            case Kind::number_or_word: setting.value = value.number_or_word(); break;
            case Kind::vector: setting.value = value.vector(); break;
            case Kind::on_or_off: setting.value = value.truth() ? "on" : "off"; break;
            case Kind::flag:
                if (!value.truth()) continue;
                setting.value = "true";
                break;
        }
        settings.push_back(std::move(setting));
    }
    return settings;
}

// Lists and objects without further ones stand in one line, unless they are long.
void append_json(std::string& text, const Json& json, std::size_t depth) {
    constexpr std::size_t k_max_line = 100;
    const std::string line = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    const bool is_flat =
        std::ranges::none_of(json, [](const Json& j) { return j.is_structured(); });
    if (!json.is_structured() || json.empty() || (is_flat && line.size() <= k_max_line)) {
        text += line;
        return;
    }
    const std::string indent(2 * depth + 2, ' ');
    text += json.is_array() ? "[" : "{";
    const char* before = "\n";
    for (const auto& [key, value] : json.items()) {
        text += before + indent;
        if (json.is_object())
            text += Json(key).dump(-1, ' ', false, Json::error_handler_t::replace) + ": ";
        append_json(text, value, depth + 1);
        before = ",\n";
    }
    text.append("\n").append(2 * depth, ' ').append(json.is_array() ? "]" : "}");
}

// "0.1" instead of "0.10000000149011612".
double short_number(float value) { return std::stod(exact_text(value)); }

}  // namespace

SceneFile read_scene_file(const std::string& path) {
    const Json json = parse_json(path, read_text(path));
    const Node root(path, json, "");
    if (!json.is_object() || !json.contains(k_scene_key))
        throw Error(ErrorCode::bad_input,
                    path + ": is not a scene: expected an object with \"rimline_scene\": 1");
    const Node version = root.at(k_scene_key);
    if (version.value() != k_scene_version)
        version.reject("version " + std::to_string(k_scene_version));
    root.check_keys({k_scene_key, "up", "models", "lights", "cameras", "picture"});

    SceneFile scene{.path = path};
    if (root.has("up")) scene.up = up_of(root.at("up"));
    if (!root.has("models"))
        throw Error(ErrorCode::bad_input, path + ": it needs \"models\", a list");
    const fs::path folder = fs::path(path).parent_path();
    for (const Node& node : root.at("models").items("a list of models"))
        scene.models.push_back(model_of(node, folder));
    if (scene.models.empty()) root.at("models").fail("expected at least one model");
    if (root.has("lights"))
        for (const Node& node : root.at("lights").items("a list of lights"))
            scene.lights.push_back(light_of(node));
    if (root.has("cameras")) {
        const Node cameras = root.at("cameras");
        if (!cameras.value().is_object()) cameras.reject("an object with a camera for each name");
        for (const auto& [name, unused] : cameras.value().items())
            scene.cameras.push_back(camera_of(name, cameras.at(name)));
    }
    if (root.has("picture")) {
        scene.picture = picture_of(root.at("picture"));
        scene.picture_json = root.at("picture").value();
    }
    return scene;
}

const SceneFile::Camera* find_camera(const SceneFile& scene, const std::string& name) {
    if (name.empty()) return scene.cameras.empty() ? nullptr : &scene.cameras.front();
    const auto found = std::ranges::find(scene.cameras, name, &SceneFile::Camera::name);
    if (found != scene.cameras.end()) return &*found;
    std::vector<std::string> names;
    std::string list;
    for (const SceneFile::Camera& camera : scene.cameras) {
        names.push_back(camera.name);
        list += (list.empty() ? "; there are " : ", ") + camera.name;
    }
    fail(scene.path, "cameras",
         "there is no camera '" + name + "'" + list + did_you_mean(name, names));
}

std::vector<UnusedSetting> use_settings(CLI::App& app, const SceneFile& scene,
                                        const std::vector<Setting>& settings) {
    // Those that the file sets several times, lights, are not given by the user.
    std::set<std::string> given;
    for (const Setting& setting : settings) {
        const CLI::Option* option = app.get_option_no_throw(setting.option);
        if (option && option->count() > 0) given.insert(setting.option);
    }
    std::vector<UnusedSetting> unused;
    for (const Setting& setting : settings) {
        if (given.contains(setting.option)) continue;
        CLI::Option* option = app.get_option_no_throw(setting.option);
        if (!option) {
            unused.push_back({setting.option, scene.path + ":" + setting.place + ": " +
                                                  app.get_name() + " has no " + setting.option +
                                                  "; it is not used"});
            print_warning(unused.back().warning);
            continue;
        }
        try {
            // One value at a time, so that a message has its place. Repeatable options append it.
            option->clear();
            option->add_result(setting.value);
            option->run_callback();
        } catch (const CLI::ParseError& error) {
            fail(scene.path, setting.place, without_name(usage_words(error, app)));
        }
    }
    return unused;
}

Json short_vector(const glm::dvec3& v) {
    return Json::array(
        {short_number(float(v.x)), short_number(float(v.y)), short_number(float(v.z))});
}

Json to_json(const PlacedModel& model) {
    Json json{{"model", model.model}};
    if (model.subdivide > 0) json["subdivide"] = model.subdivide;
    if (model.at != glm::vec3(0.0f)) json["at"] = short_vector(glm::dvec3(model.at));
    if (model.turn.axis) {
        json["turn"] = short_vector(glm::dvec3(*model.turn.axis));
        json["turn"].push_back(model.turn.degrees);
    } else if (model.turn.degrees != 0.0) {
        json["turn"] = model.turn.degrees;
    }
    if (model.scale != 1.0) json["scale"] = model.scale;
    if (model.up && model.up->direction)
        json["up"] = short_vector(glm::dvec3(*model.up->direction));
    else if (model.up)
        json["up"] = "auto";
    if (model.paint) {
        std::array<char, 8> text{};
        std::snprintf(text.data(), text.size(), "#%02x%02x%02x", model.paint->red,
                      model.paint->green, model.paint->blue);
        json["paint"] = text.data();
    }
    return json;
}

Json picture_json(const CLI::App& app) {
    Json json = Json::object();
    for (const PictureKey& key : k_picture_keys) {
        const std::string name(key.name);
        const CLI::Option* option = app.get_option_no_throw("--" + name);
        if (!option || option->count() == 0) continue;
        const std::string& value = option->results().back();
        switch (key.kind) {
            case Kind::text: json[name] = value; break;
            case Kind::number: json[name] = std::stod(value); break;
            case Kind::number_or_word: {
                const Json number = Json::parse(value, nullptr, false);
                json[name] = number.is_number() ? number : Json(value);
                break;
            }
            case Kind::vector:
                json[name] = short_vector(glm::dvec3(parse_point(name, value)));
                break;
            case Kind::on_or_off: json[name] = value == "on"; break;
            case Kind::flag: json[name] = value == "true"; break;
        }
    }
    return json;
}

std::string scene_text(const WrittenScene& scene, const std::string& path) {
    const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
    Json models = Json::array();
    for (PlacedModel model : scene.models) {
        if (model.model == k_standard_input)
            throw UsageError("a scene file cannot name standard input; save the model in a file");
        if (!is_built_in_shape(model.model) && !fs::path(model.model).is_absolute())
            model.model =
                fs::absolute(model.model).lexically_normal().lexically_proximate(folder).string();
        models.push_back(to_json(model));
    }
    const Json json{{k_scene_key, k_scene_version}, {"up", short_vector(scene.up)},
                    {"models", std::move(models)},  {"lights", scene.lights},
                    {"cameras", scene.cameras},     {"picture", scene.picture}};
    std::string text;
    append_json(text, json, 0);
    return text + "\n";
}

}  // namespace rimline::tools
