#pragma once

// The MODEL arguments of commands that draw a scene: models, each with the options of its place after it, or
// one scene file (scene_file.h).

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/cli_classes.h"
#include "tools/command.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/options/placed_model.h"
#include "tools/options/scene_file.h"
#include "tools/options/up_option.h"
#include "tools/progress.h"

namespace rimline::tools {

/// Which way of a model is up: what `choice` says, else its format, else its mesh, as choose_up() says it.
ChosenUp up_of(const PlacedModel& model, const MeshSource& source,
               const std::optional<UpChoice>& choice, const BeginCall& begin);

/// The arguments that give these models at their places.
std::vector<std::string> arguments_of(std::span<const PlacedModel> models);
/// The same as words of a command line, quoted for a shell.
std::string words_of(std::span<const PlacedModel> models);

class ModelList {
public:
    /// What commands call differently.
    struct Words {
        const char* scale = "--scale";
        const char* painted = "in ink, toon and hatch";  ///< Where --paint is seen.
    };
    /// Adds MODEL, --subdivide, and --at, --turn, --scale and --paint, which belong to the MODEL before them; and
    /// --format, if standard input is read.
    void add_to(CLI::App& app, StandardInput input, const Words& words);
    void add_to(CLI::App& app, StandardInput input = StandardInput::read) {
        add_to(app, input, Words());
    }
    /// Lets --up, which `app` must have, occur once for each MODEL.
    void add_to_up(CLI::App& app);
    /// The same, and adds --camera, of a scene file.
    void add_to_camera(CLI::App& app);

    /// What a scene file gives beside its models and what they say of up: its first camera, where --camera names none,
    /// and its lights and picture.
    struct Uses {
        bool first_camera = true, picture = true;
    };
    /// Reads the command line in its order, and the scene file. Call it first in Command::run(). Gives options
    /// that a scene file sets and the user has not. Without a MODEL, the built-in scene is the model. Throws
    /// UsageError for options without a MODEL before them, and what read_scene_file() and use_settings() throw.
    void settle(UpOptions& up, const Uses& uses);

    /// For messages: the model, the scene file, or the models with commas between them. Empty before settle() if no
    /// MODEL is given.
    const std::string& name() const noexcept { return name_; }
    const std::vector<PlacedModel>& models() const noexcept { return models_; }
    /// Whether all is one model as its file has it.
    bool is_plain() const noexcept {
        return !scene_ && models_.size() == 1 && !models_.front().is_placed();
    }
    bool has_scene_file() const noexcept { return scene_.has_value(); }
    /// Runs `check`. A UsageError that begins with an option which the scene file has set becomes Error{bad_input} at
    /// its place in the file.
    void check_usage(const std::function<void()>& check) const;
    /// The name of the scene file's camera that is used; empty if none is.
    const std::string& camera_name() const noexcept { return camera_; }
    /// "cameras" of the scene file, as it has them.
    nlohmann::ordered_json scene_cameras() const;
    /// "size" of the scene file, whatever the user's --size is.
    std::optional<ImageSize> scene_size() const;
    /// The keys of "picture" for which the command has no option, as the file has them.
    nlohmann::ordered_json unused_picture() const;
    /// Of what the command has no option for. They are printed already.
    std::vector<std::string> warnings() const;
    bool has_paint() const noexcept;
    /// Throws UsageError if `output` is one of the files that are read.
    void check_output_is_no_input(const std::string& output) const;

    /// Subdivides each model as the one at its place in `models` is. Options say it of all models only. After settle();
    /// both lists must have the same length.
    void subdivide_as(std::span<const PlacedModel> models);
    struct Reading {
        TexturePictures textures = TexturePictures::skip;
        bool keeps_file_colors = true;  ///< Where others are painted.
        /// Double faces stay (double_faces.h), and classes of edges that cannot are a warning.
        bool for_file = false;
    };
    /// The models as one source, unless is_plain(). Settles --up: afterwards `up.up` and `up.ground_up` are set.
    MeshSource load(UpOptions& up, const Reading& reading, const BeginCall& begin);
    /// The same with progress and warnings, also for a plain model, whose up direction its mesh has to say: then
    /// settle_up() is to be called.
    MeshSource load_source(UpOptions& up, const Reading& reading, const Context& context);
    /// Settles the up direction of a plain model.
    void settle_up(const Mesh& mesh, UpOptions& up, const Context& context);
    /// The models as one mesh, with progress and warnings. Settles --up: afterwards `up.up` is set.
    Mesh load_mesh(UpOptions& up, const Reading& reading, const Context& context);
    /// Of the scene, after load() or settle_up().
    const ChosenUp& up() const noexcept { return up_; }

    /// "model", and where models are placed, the list "models".
    nlohmann::ordered_json json() const;
    /// The words of a command line, quoted for a shell, that give these models again.
    std::string words() const;
    /// Whether --up must stand before the models in a command line.
    bool has_several() const noexcept { return !scene_ && !is_plain(); }

private:
    // An option that says how a model lies, and how its value is read into the model, or is checked.
    struct PlaceOption {
        const CLI::Option* option;
        void (*read)(const std::string& option, const std::string& text, PlacedModel& model);
    };

    void read_command_line(UpOptions& up);
    void read_scene(UpOptions& up, const Uses& uses);
    void use(const std::vector<SceneFile::Setting>& settings);
    // Calls `read`. Where it cannot read the file of `model`, one of models_, the message begins with the place in the
    // scene file that names it.
    void at_place(const PlacedModel& model, const std::function<void()>& read) const;

    CLI::App* app_ = nullptr;
    CLI::Option *model_option_ = nullptr, *up_option_ = nullptr;
    std::vector<PlaceOption> place_options_;
    std::vector<std::string> arguments_;
    std::uint32_t subdivide_ = 0;
    std::string format_, camera_, name_;
    std::optional<SceneFile> scene_;
    std::vector<UnusedSetting> unused_;  // Of scene_.
    std::optional<UpChoice> scene_up_;
    std::vector<PlacedModel> models_;
    ChosenUp up_;
};

}  // namespace rimline::tools
