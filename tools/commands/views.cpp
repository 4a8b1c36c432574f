// rimline views: the viewpoints that together show a model best, and pictures from these.

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "tools/command.h"
#include "tools/options/model_argument.h"
#include "tools/options/picture_scene.h"
#include "tools/options/scene_lights.h"
#include "tools/options/up_option.h"
#include "tools/options/view_camera.h"
#include "tools/output/camera_report.h"
#include "tools/output/contact_sheet.h"
#include "tools/output/json_vector.h"
#include "tools/output/output_folder.h"
#include "tools/output/picture_file.h"
#include "tools/output/same_picture.h"
#include "tools/output/view_pictures.h"
#include "tools/progress.h"
#include "tools/run_times.h"

namespace rimline::tools {

namespace {

// Approximate width of a contact sheet, and the gap around its pictures, in pixels.
constexpr std::uint32_t k_sheet_width = 1600;
constexpr std::uint32_t k_sheet_gap = 8;

class ViewsCommand final : public Command {
public:
    std::string name() const override { return "views"; }
    std::string summary() const override { return "Choose the views that show a model best"; }

    void add_options(CLI::App& app) override {
        app_ = &app;
        model_.add_to(app);
        choice_.add_to(app, 1);
        output_option_ =
            app.add_option("-o,--output", output_,
                           "Folder for the pictures view_1.png ... and contact_sheet.png, "
                           "instead of those of an older run (default: no pictures)")
                ->type_name("FOLDER")
                ->group("Output");
        style_.add_to(app);
        style_.add_palette_to(app);
        style_.add_exact_lines_to(app);
        add_up_or_auto(app, picture_.up, picture_.is_up_auto)->group("Camera");
        picture_.add_lights_to(app);
        picture_.add_image_to(app, PictureOptions::Background::any);
        picture_.add_machine_to(app);
        app.footer(
            "Views are 1.73 to 2 of the model's radii from its center. The planes of the faces "
            "vote for\n"
            "viewpoints that see them as a silhouette or from the front. The score of a view is "
            "its votes "
            "times\n"
            "the visible share of its silhouette, less from below and from behind. For each next "
            "view only\n"
            "those votes count that the views chosen before do not have. The best view is listed "
            "first, then\n"
            "what scores most alone. Each picture is taken from its view and shows the whole "
            "model. "
            "Files are\n"
            "written when all pictures are drawn.\n\n"
            "Examples:\n"
            "  rimline views bunny.obj -k 4 -o views\n"
            "  rimline views horse.ply -o views --style toon --sun auto --ground\n"
            "  rimline views fandisk.obj -k 6 --no-ratio --json");
    }

    ExitStatus run(const Context& context) override {
        style_.check_usage(picture_);
        style_.check_lines();
        RunTimes& times = context.times;
        std::optional<OutputFolder> folder;
        if (output_option_->count() > 0) folder.emplace(output_, "pictures");
        const Mesh mesh =
            model_.load_drawn_mesh(context, folder ? style_.textures() : TexturePictures::skip);
        context.checkpoint();
        up_ = settle_up(mesh, picture_.up, picture_.is_up_auto, context.stop);
        const ViewDevice device(model_.model, mesh, picture_, !choice_.no_ratio || folder, context);
        const ChosenViews chosen = about_model(model_.model, [&] {
            return choose_views(choice_, model_.model, mesh, up_.up, device, 1, context);
        });
        times.end("choosing");
        choose_lights(mesh, chosen, context);
        times.end("choosing lights");
        if (folder) draw(*folder, device, context);
        if (folder) times.end("drawing");
        if (context.json)
            print_result(context, mesh, chosen, device);
        else
            print_summary(mesh, chosen, times);
        return ExitStatus::success;
    }

private:
    // Nothing is written before everything is drawn.
    void draw(const OutputFolder& folder, const ViewDevice& drawn, const Context& context) const {
        const std::uint32_t columns = contact_sheet_columns(views_.size());
        about_model(model_.model, [&] {
            std::optional<ShownLines> lines;
            if (style_.draws_lines()) lines.emplace(prepare_lines(*drawn.octree, context));
            const ViewScene scene{model_.model, *drawn.octree, style_, picture_,
                                  lines ? &*lines : nullptr};
            Renderer renderer(drawn.device->context());
            const std::vector<Picture> pictures =
                draw_views(renderer, scene, views_, picture_.size, context);
            // Of small pictures the sheet's are the same.
            std::vector<Picture> smaller;
            if (cell_size(columns) != picture_.size)
                smaller = draw_views(renderer, scene, views_, cell_size(columns), context);
            context.checkpoint();
            folder.remove_numbered("view_", 1);
            for (std::size_t i = 0; i < pictures.size(); ++i)
                write(folder, "view_" + std::to_string(i + 1) + ".png", pictures[i]);
            write(folder, "contact_sheet.png",
                  make_contact_sheet(smaller.empty() ? pictures : smaller, columns, k_sheet_gap,
                                     sheet_color()));
        });
    }

    static void write(const OutputFolder& folder, const std::string& name, const Picture& picture) {
        OutputFile file(folder.path() / name);
        write_png(file, picture);
    }

    Color sheet_color() const {
        if (style_.finish(picture_).has_alpha) return {0, 0, 0, 0};
        return {255, 255, 255};
    }

    // Size of the pictures of the sheet. They are drawn, not scaled down, so that lines keep their width.
    ImageSize cell_size(std::uint32_t columns) const {
        const std::uint32_t width = std::min(picture_.size.width, k_sheet_width / columns);
        const std::uint64_t height =
            std::uint64_t{picture_.size.height} * width / picture_.size.width;
        return {width, std::max(1u, static_cast<std::uint32_t>(height))};
    }

    void print_result(const Context& context, const Mesh& mesh, const ChosenViews& chosen,
                      const ViewDevice& device) const {
        nlohmann::ordered_json result = views_json(model_.model, mesh, chosen);
        for (std::size_t i = 0; i < chosen.best.views.size(); ++i) {
            const Scene scene = make_view_scene(mesh, views_[i], style_, picture_, picture_.size);
            nlohmann::ordered_json camera = camera_json(scene.camera);
            camera.erase("eye");  // The view's own has more digits, and is rounded to this one.
            result["views"][i].update(camera);
            result["views"][i]["lights"] = lights_json(scene.lights);
            if (style_.ground) result["views"][i]["ground_up"] = json_vector(ground_up(mesh));
        }
        result.update(device_json(device.device_or_null()));
        result["up_from"] = up_source_name(up_.source);
        result["output"] = nullptr;
        if (output_option_->count() > 0) result["output"] = output_;
        print_json(context, std::move(result));
    }

    void print_summary(const Mesh& mesh, const ChosenViews& chosen, const RunTimes& times) const {
        if (output_option_->count() > 0)
            std::printf("%s: %zu picture%s and contact_sheet.png\n", output_.c_str(),
                        chosen.best.views.size(), chosen.best.views.size() == 1 ? "" : "s");
        else
            std::printf("%s\n", model_.model.c_str());
        print_views(chosen);
        std::printf("  in all      %s\n", times.sentence().c_str());
        print_up(up_);
        for (std::size_t i = 0; i < chosen.best.views.size(); ++i) {
            const Scene scene = make_view_scene(mesh, views_[i], style_, picture_, picture_.size);
            std::vector<std::string> arguments = camera_arguments(scene.camera, scene.lights);
            if (style_.ground && ground_up(mesh) != scene.camera.up)
                arguments.push_back(vector_argument("--ground-up", ground_up(mesh)));
            arguments.push_back("-o view_" + std::to_string(i + 1) + ".png");
            std::printf("  draw %-2zu     %s\n", i + 1,
                        render_command(*app_, quoted_for_shell(model_.model), arguments).c_str());
        }
    }

    glm::dvec3 ground_up(const Mesh& mesh) const {
        return rounded_to_float(ground_up_of(mesh, picture_));
    }

    void choose_lights(const Mesh& mesh, const ChosenViews& chosen, const Context& context) {
        Progress progress(context, "choosing lights");
        const LongCall call = progress.call();
        const SceneLights lights(picture_, mesh, style_.ground, call.part(0.0, 0.2));
        const double aspect = double(picture_.size.width) / picture_.size.height;
        for (const BestView& view : chosen.best.views) {
            call.checkpoint(0.2 + 0.8 * double(views_.size()) / double(chosen.best.views.size()));
            const Camera camera = make_view_camera(mesh, view.eye, picture_, picture_.size);
            views_.push_back({view.eye, lights.lights(camera, aspect)});
        }
    }

    ModelArgument model_;
    ViewChoice choice_;
    SceneOptions style_;
    PictureOptions picture_;
    ChosenUp up_;
    std::vector<LightedView> views_;
    std::string output_;
    CLI::Option* output_option_ = nullptr;
    const CLI::App* app_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_views_command() { return std::make_unique<ViewsCommand>(); }

}  // namespace rimline::tools
