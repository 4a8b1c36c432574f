#include "tools/options/model_list.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "silhouette/srgb.h"
#include "tools/options/default_view.h"
#include "tools/options/exact_text.h"
#include "tools/options/option_types.h"
#include "tools/options/replaced_settings.h"
#include "tools/options/standard_input.h"

namespace rimline::tools {

namespace {

Color parse_paint(const std::string& option, const std::string& text) {
    const std::optional<Color> color = color_of(text);
    if (!color || color->alpha != 255)
        throw CLI::ValidationError(option, "expected #rgb, #rrggbb or a CSS color name, not '" +
                                               text + "'" + nearest_color(text));
    return *color;
}

glm::vec3 linear(const Color& color) {
    return linear_from_srgb(glm::vec3(float(color.red), float(color.green), float(color.blue)) /
                            255.0f);
}

glm::dmat3 matrix_of(const PlacedModel& model, const glm::dmat3& upright, const glm::dvec3& up) {
    glm::dmat3 turn(1.0);
    if (model.turn.degrees != 0.0) {
        const glm::dvec3 axis = model.turn.axis ? glm::dvec3(*model.turn.axis) : up;
        turn = glm::dmat3(
            glm::rotate(glm::dmat4(1.0), glm::radians(model.turn.degrees), glm::normalize(axis)));
    }
    return model.scale * turn * upright;
}

MeshSource read_model(const PlacedModel& model, const ModelList::Reading& reading,
                      const BeginCall& begin) {
    if (reading.for_file)
        return load_model(model.model, model.subdivide, FaceRequirement::faces, begin,
                          reading.textures, model.format);
    return load_drawn_model(model.model, model.subdivide, begin, reading.textures, model.format);
}

void warn_of_lost_edges(std::span<const PlacedSource> placed, MeshSource& all) {
    const auto has_codes = [](const PlacedSource& model) {
        return !model.source->edge_codes.empty();
    };
    const auto without = std::ranges::find_if_not(placed, has_codes);
    if (without != placed.end() && std::ranges::any_of(placed, has_codes))
        all.warnings.push_back(without->name +
                               ": has no classes of edges; those of the other models are left out");
}

// Files that are read once, though they occur several times.
class LoadedModels {
public:
    LoadedModels(const BeginCall& begin, const ModelList::Reading& reading)
        : begin_(begin), reading_(reading) {}

    const MeshSource& source(const PlacedModel& model) { return loaded(model).source; }

    ChosenUp up(const PlacedModel& model, const std::optional<UpChoice>& choice) {
        if (choice && choice->direction) return up_of(model, {}, choice, begin_);
        Loaded& from = loaded(model);
        std::optional<ChosenUp>& known = choice ? from.automatic : from.own;
        if (!known) known = up_of(model, from.source, choice, begin_);
        return *known;
    }

private:
    struct Loaded {
        MeshSource source;
        std::optional<ChosenUp> own, automatic;
    };

    Loaded& loaded(const PlacedModel& model) {
        std::unique_ptr<Loaded>& entry = loaded_[{model.model, model.subdivide}];
        if (!entry) {
            entry = std::make_unique<Loaded>();
            entry->source = read_model(model, reading_, begin_);
        }
        return *entry;
    }

    const BeginCall& begin_;
    ModelList::Reading reading_;
    std::map<std::pair<std::string, std::uint32_t>, std::unique_ptr<Loaded>> loaded_;
};

}  // namespace

ChosenUp up_of(const PlacedModel& model, const MeshSource& source,
               const std::optional<UpChoice>& choice, const BeginCall& begin) {
    const bool is_auto = choice && !choice->direction;
    if (choice && choice->direction)
        return {glm::dvec3(*choice->direction), ChosenUp::Source::option};
    if (source.is_up_known && !is_auto) return {direction_of(source.up), ChosenUp::Source::format};
    const LongCall call = begin("joining the faces of " + model.model);
    return about_model(model.model, [&] {
        return choose_up(Mesh(source, Welding::equal_positions, call), {}, is_auto);
    });
}

void ModelList::add_to(CLI::App& app, StandardInput input, const Words& words) {
    app_ = &app;
    constexpr const char* k_group = "Model";
    model_option_ =
        app.add_option_function<std::vector<std::string>>(
               "MODEL",
               [this](const std::vector<std::string>& texts) {
                   for (const std::string& text : texts) check_model_name(text);
                   arguments_ = texts;
               },
               model_description(input) + "; several make a scene. Or one scene file, FILE.json")
            ->type_name("");
    const auto add = [&](const std::string& name, const char* type, const std::string& description,
                         auto read) {
        const CLI::Option* option = app.add_option_function<std::vector<std::string>>(
                                           name,
                                           [name, read](const std::vector<std::string>& texts) {
                                               PlacedModel unused;
                                               for (const std::string& text : texts)
                                                   read(name, text, unused);
                                           },
                                           description)
                                        ->type_name(type)
                                        ->allow_extra_args(false)
                                        ->group(k_group);
        place_options_.push_back({option, read});
    };
    using Text = const std::string&;
    add("--at", "X,Y,Z",
        "Moves the MODEL before it: where the origin of its file lies in the scene (default: "
        "0,0,0)",
        [](Text option, Text text, PlacedModel& model) { model.at = parse_point(option, text); });
    add("--turn", "[AXIS,]DEGREES",
        "Turns the MODEL before it about its origin: counterclockwise about the scene's up, or "
        "about x, y, z or X,Y,Z",
        [](Text option, Text text, PlacedModel& model) { model.turn = parse_turn(option, text); });
    add(words.scale, "NUMBER", "Scales the MODEL before it about its origin",
        [](Text option, Text text, PlacedModel& model) {
            model.scale = parse_scale(option, text);
        });
    add("--paint", "COLOR",
        std::string("Color of the MODEL before it, instead of those of its file, ") + words.painted,
        [](Text option, Text text, PlacedModel& model) {
            model.paint = parse_paint(option, text);
        });
    add_subdivide(app, subdivide_)->group(k_group);
    if (input == StandardInput::read) add_input_format(app, format_);
}

void ModelList::add_to_up(CLI::App& app) {
    up_option_ = app.get_option("--up");
    up_option_->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeFirst)
        ->description(up_option_->get_description() +
                      ". After the second MODEL or a later one: the direction of that model which "
                      "becomes the scene's up");
}

void ModelList::add_to_camera(CLI::App& app) {
    add_to_up(app);
    app.add_option("--camera", camera_, "Camera of a scene file (default: its first)")
        ->type_name("NAME")
        ->group("Camera");
}

// CLI11 keeps the order in which options occur, once for each value.
void ModelList::read_command_line(UpOptions& up) {
    std::map<const CLI::Option*, std::size_t> taken;
    std::set<std::pair<const CLI::Option*, std::size_t>> seen;
    for (const CLI::Option* option : app_->parse_order()) {
        const std::size_t at = taken[option]++;
        if (option == model_option_) {
            models_.push_back({.model = arguments_[at], .subdivide = subdivide_});
            if (models_.back().model == k_standard_input) models_.back().format = format_;
            continue;
        }
        const bool is_up = option == up_option_;
        const auto place = std::ranges::find(place_options_, option, &PlaceOption::option);
        if (!is_up && place == place_options_.end()) continue;
        if (!seen.insert({option, models_.size()}).second)
            throw UsageError(option->get_name() + ": give it only once" +
                             (arguments_.size() > 1 ? " for each MODEL" : ""));
        const std::string& value = option->results()[at];
        if (!is_up && models_.empty())
            throw UsageError(option->get_name() +
                             ": name a MODEL before it; it says where that model lies");
        if (!is_up)
            place->read(option->get_name(), value, models_.back());
        else if (models_.empty())
            scene_up_ = parse_up_choice("--up", value);
        else
            models_.back().up = parse_up_choice("--up", value);
    }
    if (models_.empty()) models_.push_back({.model = k_default_model, .subdivide = subdivide_});
    const auto is_input = [](const PlacedModel& m) { return m.model == k_standard_input; };
    if (std::ranges::count_if(models_, is_input) > 1)
        throw UsageError("MODEL: standard input can be read only once");
    if (std::ranges::none_of(models_, is_input))
        check_format_is_of_input(models_.front().model, format_);
    // The scene has the up direction of its first model.
    if (!scene_up_) std::swap(scene_up_, models_.front().up);
    up.is_up_auto = scene_up_ && !scene_up_->direction;
    up.up = scene_up_ ? scene_up_->direction : std::nullopt;
}

void ModelList::use(const std::vector<SceneFile::Setting>& settings) {
    for (UnusedSetting& unused : use_settings(*app_, *scene_, settings))
        unused_.push_back(std::move(unused));
}

void ModelList::read_scene(UpOptions& up, const Uses& uses) {
    const std::string path = models_.front().model;
    if (models_.front().is_placed() || subdivide_ > 0 || models_.front().up)
        throw UsageError(path + " is a scene: it places and refines its models itself");
    scene_ = read_scene_file(path);
    models_ = scene_->models;
    const auto given = [&](std::initializer_list<const char*> names) {
        return std::ranges::any_of(names, [&](const char* name) {
            const CLI::Option* option = app_->get_option_no_throw(name);
            return option && option->count() > 0;
        });
    };
    const bool wants_camera = !camera_.empty() || uses.first_camera;
    const SceneFile::Camera* camera = wants_camera ? find_camera(*scene_, camera_) : nullptr;
    const bool has_own_eye = given({"--eye", "--azimuth", "--elevation", "--target"});
    if (has_own_eye && !camera_.empty())
        throw UsageError("--camera: leave out --eye, --azimuth, --elevation and --target");
    if (camera && !has_own_eye) {
        camera_ = camera->name;
        std::vector<SceneFile::Setting> settings;
        const bool has_own_lens = given({"--fov", "--ortho"});
        for (const SceneFile::Setting& setting : camera->settings)
            if (!has_own_lens || (setting.option != "--fov" && setting.option != "--ortho"))
                settings.push_back(setting);
        use(settings);
    }
    if (uses.picture) {
        if (given({"--sun", "--light"})) scene_->lights.clear();
        drop_replaced(*app_, scene_->lights);
        drop_replaced(*app_, scene_->picture);
        use(scene_->lights);
        use(scene_->picture);
    }
    // The up direction of the camera may be another one than that of the scene.
    if (!scene_up_) scene_up_ = scene_->up;  // Else it is the command line's.
    if (!scene_up_) std::swap(scene_up_, models_.front().up);
    if (!up.up && !up.is_up_auto && scene_up_) {
        up.is_up_auto = !scene_up_->direction;
        up.up = scene_up_->direction;
    }
}

void ModelList::settle(UpOptions& up, const Uses& uses) {
    read_command_line(up);
    const auto is_scene = [](const PlacedModel& m) { return is_scene_file(m.model); };
    if (std::ranges::any_of(models_, is_scene)) {
        if (models_.size() > 1)
            throw UsageError("MODEL: a scene file stands alone; add other models to the file");
        name_ = models_.front().model;
        read_scene(up, uses);
    } else {
        if (!camera_.empty()) throw UsageError("--camera: belongs to a scene file");
        for (const PlacedModel& model : models_) name_ += (name_.empty() ? "" : ", ") + model.model;
    }
}

void ModelList::check_usage(const std::function<void()>& check) const {
    try {
        check();
    } catch (const UsageError& error) {
        if (!scene_) throw;
        const std::string message = error.what();
        const std::string option = message.substr(0, message.find_first_of(": "));
        const auto of_file =
            std::ranges::find(scene_->picture, option, &SceneFile::Setting::option);
        if (of_file == scene_->picture.end()) throw;
        const CLI::Option* given = app_->get_option_no_throw(option);
        if (!given || given->results().back() != of_file->value) throw;
        const std::size_t colon = message.find(": ");
        throw Error(ErrorCode::bad_input,
                    scene_->path + ":" + of_file->place + ": " +
                        (colon == std::string::npos ? message : message.substr(colon + 2)));
    }
}

nlohmann::ordered_json ModelList::scene_cameras() const {
    nlohmann::ordered_json cameras = nlohmann::ordered_json::object();
    if (scene_)
        for (const SceneFile::Camera& camera : scene_->cameras) cameras[camera.name] = camera.json;
    return cameras;
}

std::optional<ImageSize> ModelList::scene_size() const {
    if (scene_)
        for (const SceneFile::Setting& setting : scene_->picture)
            if (setting.option == "--size") return parse_image_size("--size", setting.value);
    return std::nullopt;
}

nlohmann::ordered_json ModelList::unused_picture() const {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const UnusedSetting& unused : unused_) {
        const std::string key = unused.option.substr(2);  // Without the dashes.
        if (scene_->picture_json.contains(key)) json[key] = scene_->picture_json[key];
    }
    return json;
}

std::vector<std::string> ModelList::warnings() const {
    std::vector<std::string> warnings;
    for (const UnusedSetting& unused : unused_) warnings.push_back(unused.warning);
    return warnings;
}

bool ModelList::has_paint() const noexcept {
    return std::ranges::any_of(models_, [](const PlacedModel& m) { return m.paint.has_value(); });
}

void ModelList::check_output_is_no_input(const std::string& output) const {
    const auto check = [&](const std::string& input) {
        std::error_code ignored;
        if (input != k_standard_input && std::filesystem::equivalent(output, input, ignored))
            throw UsageError(output + ": this is the model itself; name another file to write");
    };
    if (scene_) check(scene_->path);
    for (const PlacedModel& model : models_) check(model.model);
}

void ModelList::subdivide_as(std::span<const PlacedModel> models) {
    RIMLINE_CHECK(models.size() == models_.size());
    for (std::size_t i = 0; i < models.size(); ++i) models_[i].subdivide = models[i].subdivide;
}

void ModelList::at_place(const PlacedModel& model, const std::function<void()>& read) const {
    try {
        read();
    } catch (const Error& error) {
        if (!scene_ || error.code() != ErrorCode::io) throw;
        throw Error(error.code(), scene_->path + ":models[" +
                                      std::to_string(&model - models_.data()) +
                                      "].model: " + error.what());
    }
}

MeshSource ModelList::load(UpOptions& options, const Reading& reading, const BeginCall& begin) {
    LoadedModels loaded(begin, reading);
    const PlacedModel& first = models_.front();
    at_place(first, [&] { up_ = loaded.up(first, scene_up_); });
    if (!options.up || options.is_up_auto) options.up = glm::vec3(up_.up);
    const glm::dvec3 up = options.ground_up ? glm::dvec3(*options.ground_up) : up_.up;
    options.ground_up = glm::vec3(up);

    std::map<const MeshSource*, MeshSource> without_colors;
    std::vector<PlacedSource> placed;
    for (const PlacedModel& model : models_) {
        const MeshSource* source = nullptr;
        at_place(model, [&] { source = &loaded.source(model); });
        glm::dmat3 upright(1.0);
        if (&model != &first || model.up) {
            const glm::dvec3 own = loaded.up(model, model.up).up;
            upright = rotation_between(own, up);
        }
        if (has_paint() && !reading.keeps_file_colors && !source->materials.empty()) {
            MeshSource& plain = without_colors[source];
            if (plain.positions.empty()) {
                plain = *source;
                plain.materials = {};
            }
            source = &plain;
        }
        placed.push_back({.source = source,
                          .matrix = matrix_of(model, upright, up),
                          .at = glm::dvec3(model.at),
                          .paint = model.paint ? std::optional(linear(*model.paint)) : std::nullopt,
                          .name = model.model});
    }
    begin("placing the models").checkpoint(0.0);
    MeshSource all = join_sources(placed);
    if (reading.for_file) warn_of_lost_edges(placed, all);
    return all;
}

MeshSource ModelList::load_source(UpOptions& up, const Reading& reading, const Context& context) {
    MeshSource source = follow_progress(context, [&](const BeginCall& begin) {
        return is_plain() ? read_model(models_.front(), reading, begin) : load(up, reading, begin);
    });
    for (const std::string& warning : source.warnings) print_warning(warning);
    context.times.end("reading");
    return source;
}

void ModelList::settle_up(const Mesh& mesh, UpOptions& up, const Context& context) {
    if (is_plain()) up_ = tools::settle_up(mesh, up.up, up.is_up_auto, context.stop);
}

Mesh ModelList::load_mesh(UpOptions& up, const Reading& reading, const Context& context) {
    Mesh mesh = make_mesh(name_, load_source(up, reading, context), context);
    check_is_no_point(name_, mesh);
    settle_up(mesh, up, context);
    return mesh;
}

nlohmann::ordered_json ModelList::json() const {
    nlohmann::ordered_json json{{"model", name_}};
    if (is_plain()) return json;
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const PlacedModel& model : models_) list.push_back(to_json(model));
    json["models"] = std::move(list);
    return json;
}

std::string ModelList::words() const {
    return scene_ ? quoted_for_shell(name_) : words_of(models_);
}

std::vector<std::string> arguments_of(std::span<const PlacedModel> models) {
    std::vector<std::string> arguments;
    const auto add = [&](const std::string& option, const std::string& value) {
        if (value.starts_with('-')) {
            arguments.push_back(option + "=" + value);
            return;
        }
        arguments.push_back(option);
        arguments.push_back(value);
    };
    for (const PlacedModel& model : models) {
        // Else it would be an option.
        const bool has_dash = model.model.starts_with('-') && model.model != k_standard_input;
        arguments.push_back((has_dash ? "./" : "") + model.model);
        if (model.at != glm::vec3(0.0f))
            add("--at", exact_text(model.at.x) + "," + exact_text(model.at.y) + "," +
                            exact_text(model.at.z));
        if (model.turn != Turn{}) add("--turn", text_of(model.turn));
        if (model.scale != 1.0) add("--scale", exact_text(model.scale));
        if (model.up) add("--up", text_of(*model.up));
        if (model.paint) add("--paint", to_json(model)["paint"].get<std::string>());
    }
    // The option is of all models.
    const std::uint32_t steps = models.empty() ? 0 : models.front().subdivide;
    const bool is_of_all = std::ranges::all_of(
        models, [&](const PlacedModel& model) { return model.subdivide == steps; });
    if (steps > 0 && is_of_all) add("--subdivide", std::to_string(steps));
    return arguments;
}

std::string words_of(std::span<const PlacedModel> models) {
    std::string words;
    for (const std::string& argument : arguments_of(models))
        words += (words.empty() ? "" : " ") + quoted_for_shell(argument);
    return words;
}

}  // namespace rimline::tools
