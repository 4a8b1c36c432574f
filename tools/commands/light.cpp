// rimline light: the directional light that shows a view best.

#include <CLI/App.hpp>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "silhouette/field/picture_sun.h"
#include "silhouette/field/sun_choice.h"
#include "silhouette/mesh/any_perpendicular.h"
#include "tools/command.h"
#include "tools/options/model_argument.h"
#include "tools/options/option_types.h"
#include "tools/options/up_option.h"
#include "tools/options/view_camera.h"
#include "tools/output/json_vector.h"
#include "tools/progress.h"
#include "tools/timing.h"

namespace rimline::tools {

namespace {

class LightCommand final : public Command {
public:
    std::string name() const override { return "light"; }
    std::string summary() const override {
        return "Choose the directional light that shows a view best";
    }

    void add_options(CLI::App& app) override {
        app_ = &app;
        model_.add_to(app);
        add_point(app, "--eye", eye_, "Position of the viewer")->required()->group("Camera");
        add_up_or_auto(app, up_, is_up_auto_)->group("Camera");
        app.add_flag("--by-votes", by_votes_, "Choose by votes of the faces instead (thesis 4.6)")
            ->group("Light");
        app.footer(
            "Chooses the sun that `render --eye` chooses: so that, where the model allows it, a "
            "third to two thirds\n"
            "of what the camera sees are lit, and the tones are spread; above the horizon, unless "
            "the camera looks\n"
            "up. Cast shadows count as dark. `sun` is a direction from the model towards the "
            "light, as in --sun.\n"
            "With --by-votes, faces seen from the front vote for light at a grazing angle, which "
            "shows small changes\n"
            "of slope, and against directions that leave them unlit. If no face is seen from the "
            "front, as of a\n"
            "sheet seen from behind, the back sides vote. Votes do not know cast shadows.\n\n"
            "Examples:\n"
            "  rimline light horse.ply --eye 2,1,2\n"
            "  rimline light shape:knot --eye 3,2,4 --by-votes --json");
    }

    ExitStatus run(const Context& context) override {
        if (by_votes_)
            refuse_options(*app_, {"--up"}, "votes do not depend on it; leave out --by-votes");
        const Mesh mesh = model_.load_mesh(context);
        context.checkpoint();
        if (by_votes_)
            print_voted(mesh, context);
        else
            print_toned(mesh, context);
        return ExitStatus::success;
    }

private:
    [[noreturn]] void fail_unseen() const {
        throw Error(ErrorCode::bad_input,
                    model_.model + (by_votes_ ? ": no face turns a side towards --eye: move it"
                                              : ": no face is in the picture from --eye, which "
                                                "looks at the model's center: move it"));
    }

    // The frame of a picture of the default size.
    PictureFrame frame(const Mesh& mesh) {
        chosen_up_ = settle_up(mesh, up_, is_up_auto_);
        const glm::dvec3 up = chosen_up_.up;
        constexpr double k_aspect = 4.0 / 3.0;
        const ViewCamera camera = camera_of_view(mesh, glm::dvec3(*eye_), up, k_aspect);
        if (camera.eye == camera.target)
            throw UsageError("--eye is the model's center, where it looks");
        const glm::dvec3 back = glm::normalize(camera.eye - camera.target);
        const glm::dvec3 across = glm::cross(camera.up, back);
        const glm::dvec3 right = glm::length(across) > 1e-9 * glm::length(camera.up)
                                     ? glm::normalize(across)
                                     : any_perpendicular(back);
        const double half = std::tan(0.5 * glm::radians(camera.fov_y_deg));
        return {.eye = camera.eye,
                .right = right,
                .up = glm::cross(back, right),
                .back = back,
                .half_size = {half * k_aspect, half}};
    }

    void print_toned(const Mesh& mesh, const Context& context) {
        check_has_planes(model_.model, mesh);
        const PictureFrame seen = frame(mesh);
        const Stopwatch watch;
        Progress progress(context, "choosing a light");
        const LongCall call = progress.call();
        const std::optional<PictureSun> sun = about_model(model_.model, [&] {
            return choose_picture_sun(SunSurvey(mesh, k_shading_crease_rad, call.part(0.0, 0.5)),
                                      seen, {.up = glm::dvec3(*up_)}, call.part(0.5, 1.0));
        });
        const double ms = watch.ms();
        context.times.end("choosing the light");
        if (!sun) fail_unseen();
        const glm::dvec3 direction = rounded_to_float(sun->direction);
        const SunTones& tones = sun->tones;
        if (context.json) {
            print_json(context, {{"model", model_.model},
                                 {"sun", json_vector(direction)},
                                 {"score", sun->score},
                                 {"lit", tones.lit},
                                 {"bright", tones.bright},
                                 {"detail", tones.detail},
                                 {"spread", tones.spread},
                                 {"up", json_vector(chosen_up_.up)},
                                 {"up_from", up_source_name(chosen_up_.source)},
                                 {"ms", ms}});
            return;
        }
        std::printf("%s\n", model_.model.c_str());
        print_direction(direction);
        std::printf("  tones       %.0f%% dark, %.0f%% half bright, %.0f%% bright\n",
                    100.0 * (1.0 - tones.lit), 100.0 * (tones.lit - tones.bright),
                    100.0 * tones.bright);
        std::printf("  detail      %.0f%% of it is lit\n", 100.0 * tones.detail);
        std::printf("  time        %.1f ms\n", ms);
        print_up(chosen_up_);
    }

    void print_voted(const Mesh& mesh, const Context& context) const {
        check_has_planes(model_.model, mesh);
        const Stopwatch watch;
        Progress progress(context, "choosing a light");
        const std::optional<ChosenSun> sun = about_model(
            model_.model, [&] { return choose_sun(mesh, glm::dvec3(*eye_), progress.call()); });
        const double ms = watch.ms();
        context.times.end("choosing the light");
        if (!sun) fail_unseen();
        if (context.json) {
            print_json(context, {{"model", model_.model},
                                 {"sun", json_vector(sun->direction)},
                                 {"score", sun->votes},
                                 {"faces", sun->faces},
                                 {"sees_backs", sun->sees_backs},
                                 {"ms", ms}});
            return;
        }
        std::printf("%s\n", model_.model.c_str());
        print_direction(sun->direction);
        std::printf("  score       %.1f, by %u face%s %s\n", sun->votes, sun->faces,
                    sun->faces == 1 ? " that turns" : "s that turn",
                    !sun->sees_backs  ? "towards the viewer"
                    : sun->faces == 1 ? "its back to the viewer"
                                      : "their backs to the viewer");
        std::printf("  time        %.1f ms\n", ms);
    }

    static void print_direction(const glm::dvec3& sun) {
        std::printf("  sun         %.6g,%.6g,%.6g\n", sun.x, sun.y, sun.z);
    }

    ModelArgument model_;
    const CLI::App* app_ = nullptr;
    std::optional<glm::vec3> eye_, up_;
    bool is_up_auto_ = false;
    bool by_votes_ = false;
    ChosenUp chosen_up_;  // Of a sun by tones.
};

}  // namespace

std::unique_ptr<Command> make_light_command() { return std::make_unique<LightCommand>(); }

}  // namespace rimline::tools
