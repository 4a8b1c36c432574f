#pragma once

// A scene as a JSON file: models with their places, lights, cameras, and how the picture looks. docs/scenes.md
// describes the format.
//
// Each value has the form and the limits of an option of `render`, and becomes that option where the user has
// not given it. Therefore a picture from a scene file and one from the same options are the same, byte for
// byte.

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli_classes.h"
#include "tools/options/placed_model.h"
#include "tools/options/scene_mark.h"

namespace rimline::tools {

constexpr int k_scene_version = 1;

struct SceneFile {
    /// An option and its value. `place` is where the file says it: "cameras.front.eye".
    struct Setting {
        std::string option, value, place;
    };
    struct Camera {
        std::string name;
        std::vector<Setting> settings;
        nlohmann::ordered_json json;  ///< As the file has it.
    };

    std::string path;
    std::optional<UpChoice> up;  ///< Of the scene.
    std::vector<PlacedModel> models;
    std::vector<Setting> lights;
    std::vector<Camera> cameras;
    std::vector<Setting> picture;
    nlohmann::ordered_json picture_json;  ///< As the file has it.
};

/// Throws Error{io} and Error{bad_input}; the message begins with the path and the place, as
/// "scene.json:4:7: ..." for a fault of JSON and "scene.json:models[1].at: ..." for another one.
/// Checks names, types and keys; the values of `lights`, `cameras` and `picture` are checked by use_settings().
SceneFile read_scene_file(const std::string& path);

/// The camera of this name, or without a name the first one; null if there is none. Throws Error{bad_input} for
/// a name that no camera has.
const SceneFile::Camera* find_camera(const SceneFile& scene, const std::string& name);

/// An option that the command does not have, and the warning that says so.
struct UnusedSetting {
    std::string option, warning;
};
/// Gives the options of `app` that the user has not given the values of a scene file. Call it after parsing.
/// Prints a warning of each option that the command does not have, and returns these. Throws Error{bad_input} for a
/// value that the option does not take.
std::vector<UnusedSetting> use_settings(CLI::App& app, const SceneFile& scene,
                                        const std::vector<SceneFile::Setting>& settings);

/// The object of a model, as the file has it; without what is the default.
nlohmann::ordered_json to_json(const PlacedModel& model);
/// The object "picture" of the options of `app` that are given.
nlohmann::ordered_json picture_json(const CLI::App& app);

/// A vector as short numbers that are read as the same floats.
nlohmann::ordered_json short_vector(const glm::dvec3& v);

struct WrittenScene {
    glm::dvec3 up{0, 1, 0};  ///< Rounded to float, as all vectors.
    std::vector<PlacedModel> models;
    nlohmann::ordered_json lights, cameras, picture;
};
/// The text of a scene file at `path`, from whose folder relative paths of models begin. Throws UsageError if a
/// model is standard input.
std::string scene_text(const WrittenScene& scene, const std::string& path);

}  // namespace rimline::tools
