// The commands that need Vulkan in a build without the engine. Views and paths are chosen, but not drawn.

#include <cstdio>
#include <nlohmann/json.hpp>

#include "silhouette/field/ray_ratios.h"
#include "tools/absent_part.h"
#include "tools/options/model_argument.h"
#include "tools/options/model_octree.h"
#include "tools/options/offered_values.h"
#include "tools/options/up_option.h"
#include "tools/options/view_camera.h"
#include "tools/options/view_choice.h"
#include "tools/output/json_vector.h"
#include "tools/output/path_report.h"
#include "tools/output/points_picture.h"

namespace rimline::tools {

std::vector<std::string> offered_palettes() { return {}; }

namespace {

constexpr double k_aspect = 4.0 / 3.0;  // Of the pictures that `render` draws.
constexpr const char* k_footer = "This rimline was built without the engine: it draws nothing.";

ChosenViews choose_views(const ViewChoice& choice, const std::string& model, const Mesh& mesh,
                         std::uint32_t min_count, const Context& context) {
    const glm::dvec3 up = choose_up(mesh, {}, false).up;
    if (choice.no_ratio) return choice.choose(model, mesh, up, {}, min_count, context);
    const HoughOctree octree = build_octree(model, mesh, context);
    const RayRatios rays(octree, {}, {context.stop, {}});
    return choice.choose(
        model, mesh, up,
        [&](std::span<const glm::dvec3> eyes) { return rays.measure(eyes, context.stop); },
        min_count, context);
}

class ViewsCommand final : public Command {
public:
    std::string name() const override { return "views"; }
    std::string summary() const override { return "Choose the views that show a model best"; }
    void add_options(CLI::App& app) override {
        model_.add_to(app);
        choice_.add_to(app, 1);
        app.footer(k_footer);
    }
    ExitStatus run(const Context& context) override {
        const Mesh mesh = model_.load_mesh(context);
        const ChosenViews chosen = about_model(
            model_.model, [&] { return choose_views(choice_, model_.model, mesh, 1, context); });
        if (context.json) {
            nlohmann::ordered_json result = views_json(model_.model, mesh, chosen);
            for (std::size_t i = 0; i < chosen.best.views.size(); ++i) {
                const ViewCamera camera = camera_of_view(mesh, chosen.best.views[i].eye,
                                                         choose_up(mesh, {}, false).up, k_aspect);
                result["views"][i].update({{"target", json_vector(camera.target)},
                                           {"up", json_vector(camera.up)},
                                           {"fov", camera.fov_y_deg}});
            }
            print_json(context, std::move(result));
        } else {
            std::printf("%s\n", model_.model.c_str());
            print_views(chosen);
        }
        return ExitStatus::success;
    }

private:
    ModelArgument model_;
    ViewChoice choice_;
};

class PathCommand final : public Command {
public:
    std::string name() const override { return "path"; }
    std::string summary() const override { return "Plan a camera path through the best views"; }
    void add_options(CLI::App& app) override {
        model_.add_to(app);
        choice_.add_to(app, 2);
        plan_.add_to(app);
        app.footer(k_footer);
    }
    ExitStatus run(const Context& context) override {
        const Mesh mesh = model_.load_mesh(context);
        about_model(model_.model, [&] {
            const ChosenViews chosen = choose_views(choice_, model_.model, mesh, 2, context);
            context.times.end("choosing the views");
            const PlannedPath planned = plan_.plan(chosen, choose_up(mesh, {}, false).up, context);
            context.times.end("planning");
            if (context.json)
                print_json(context, path_json(model_.model, mesh, chosen, planned));
            else
                print_path(model_.model, chosen, planned);
        });
        return ExitStatus::success;
    }

private:
    ModelArgument model_;
    ViewChoice choice_;
    PathPlan plan_;
};

}  // namespace

std::unique_ptr<Command> make_render_command() {
    return std::make_unique<AbsentCommand>(BuildPart::engine, "render", "Draw one picture");
}

std::unique_ptr<Command> make_animate_command() {
    return std::make_unique<AbsentCommand>(BuildPart::engine, "animate",
                                           "Draw a sequence of pictures");
}

std::unique_ptr<Command> make_devices_command() {
    return std::make_unique<AbsentCommand>(BuildPart::engine, "devices", "List the Vulkan devices");
}

std::unique_ptr<Command> make_views_command() { return std::make_unique<ViewsCommand>(); }
std::unique_ptr<Command> make_path_command() { return std::make_unique<PathCommand>(); }

PointsPictureReport draw_points(const PointsPicture&, OutputFile&) {
    throw absent_part_error("points -o", BuildPart::engine);
}

}  // namespace rimline::tools
