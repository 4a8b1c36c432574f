// rimline light: the directional light that shows most of what is visible from a viewpoint.

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "silhouette/field/sun_choice.h"
#include "tools/command.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/output/json_vector.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

class LightCommand final : public Command {
public:
    std::string name() const override { return "light"; }
    std::string summary() const override {
        return "Choose the directional light that shows a view best";
    }

    void add_options(CLI::App& app) override {
        model_.add_to(app);
        add_point(app, "--eye", eye_, "Position of the viewer")->required()->group("Camera");
        app.footer(
            "Faces seen from the front vote for light at a grazing angle, which shows small "
            "changes "
            "of\n"
            "slope, and against directions that leave them unlit. If no face is seen from the "
            "front, as of a\n"
            "sheet seen from behind, the back sides vote. `sun` is a direction from the model "
            "towards the light,\n"
            "as in --sun. render --sun auto chooses this light.\n\n"
            "Examples:\n"
            "  rimline light horse.ply --eye 2,1,2\n"
            "  rimline light shape:knot --eye 3,2,4 --json");
    }

    ExitStatus run(const Context& context) override {
        const Mesh mesh = model_.load_mesh(context);
        context.checkpoint();
        using Clock = std::chrono::steady_clock;
        const Clock::time_point start = Clock::now();
        Progress progress(context, "choosing a light");
        const std::optional<ChosenSun> sun = about_model(
            model_.model, [&] { return choose_sun(mesh, glm::dvec3(*eye_), progress.call()); });
        const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        context.times.end("choosing the sun");
        if (!sun)
            throw Error(ErrorCode::bad_input,
                        model_.model + ": no face turns a side towards --eye: move it");
        const glm::dvec3& direction = sun->direction;
        if (context.json) {
            print_json(context, {{"model", model_.model},
                                 {"sun", json_vector(direction)},
                                 {"score", sun->votes},
                                 {"faces", sun->faces},
                                 {"sees_backs", sun->sees_backs},
                                 {"ms", ms}});
            return ExitStatus::success;
        }
        std::printf("%s\n", model_.model.c_str());
        std::printf("  sun         %.6g,%.6g,%.6g\n", direction.x, direction.y, direction.z);
        std::printf("  score       %.1f, by %u faces that turn %s\n", sun->votes, sun->faces,
                    sun->sees_backs ? "their backs to the viewer" : "towards the viewer");
        std::printf("  time        %.1f ms\n", ms);
        return ExitStatus::success;
    }

private:
    ModelArgument model_;
    std::optional<glm::vec3> eye_;
};

}  // namespace

std::unique_ptr<Command> make_light_command() { return std::make_unique<LightCommand>(); }

}  // namespace rimline::tools
