// rimline view: an interactive window that shows a model or a cloud and its silhouette.

#include <utility>

#include "engine/vulkan/vulkan_instance.h"
#include "tools/command.h"
#include "tools/options/cloud_argument.h"
#include "tools/options/model_list.h"
#include "tools/options/picture_options.h"
#include "tools/options/picture_scene.h"
#include "tools/options/scene_lights.h"
#include "tools/options/scene_options.h"
#include "tools/options/shadow_framing.h"
#include "tools/options/standard_input.h"
#include "tools/options/three_point.h"
#include "tools/options/up_option.h"
#include "tools/output/output_file.h"
#include "tools/progress.h"
#include "tools/view/view_loop.h"

namespace rimline::tools {

namespace {

class ViewCommand final : public Command {
public:
    std::string name() const override { return "view"; }
    std::string summary() const override { return "Open a window that shows a model or a cloud"; }

    void add_options(CLI::App& app) override {
        models_.add_to(app);
        cloud_.add_flags_to(app);
        scene_.add_to(app);
        picture_.add_camera_to(app);
        models_.add_to_camera(app);
        add_point(app, "--silhouette-from", silhouette_from_,
                  "Freeze the silhouette of this viewpoint (default: follow the camera)")
            ->group("Camera");
        picture_.add_lights_to(app);
        picture_.add_image_to(app);
        picture_.add_machine_to(app);
        constexpr const char* k_window = "Window";
        app.add_flag("--no-panel", no_panel_, "Show only the picture, without the panel")
            ->group(k_window);
        app.add_flag("--inspect", inspect_, "Start with the Hough space window open")
            ->group(k_window);
        add_count(app, "--frames", frames_, 1, 1'000'000,
                  "Close after this number of frames (default: the user closes the window)")
            ->default_str("")
            ->group(k_window);
        add_output(app, "--screenshot", screenshot_, ".png",
                   "Save the window in the last of --frames to this PNG file")
            ->group(k_window);
        app.footer(
            "Without a model, a built-in scene is shown. Drop a file on the window to open it. A "
            "file "
            "without\n"
            "faces is shown as a cloud: its points, borders and features, and its silhouette in "
            "ink. "
            "Drag to orbit,\n"
            "drag with the right button to pan, turn the wheel to zoom, drag the handles of lights "
            "to "
            "move them. The\n"
            "panel has best views to click, flying, styles, a frozen silhouette to be viewed from "
            "other viewpoints,\n"
            "and Hough space. P saves a picture, X a scene file, which render, animate and view "
            "read, "
            "and C copies\n"
            "the command that draws the picture. Several models make a scene, as in render.\n\n"
            "Examples:\n"
            "  rimline view horse.ply\n"
            "  rimline view shape:knot --style toon --ground --inspect\n"
            "  rimline view scan.xyz\n"
            "  rimline view --frames 1 --screenshot window.png");
    }

    ExitStatus run(const Context& context) override {
        if (context.json) throw UsageError("view has nothing to say in --json");
        models_.settle(picture_, ModelList::FirstCamera::used);
        scene_.has_painted_models = models_.has_paint();
        scene_.check_usage(picture_);
        for (const PlacedModel& model : models_.models())
            if (model.model == k_standard_input)
                throw UsageError("MODEL: the window reads no standard input");
        if (!screenshot_.empty() && frames_ == 0)
            throw UsageError("--screenshot needs --frames, to know which frame is the last");
        std::optional<OutputFile> screenshot;
        if (!screenshot_.empty()) {
            models_.check_output_is_no_input(screenshot_);
            screenshot.emplace(screenshot_);
        }

        // Before the model is loaded, so that a missing display is reported at once.
        Window window("Rimline - " + models_.name(), static_cast<int>(picture_.size.width),
                      static_cast<int>(picture_.size.height));
        const VulkanInstance instance(
            {.validate = picture_.validate, .window_extensions = window.vulkan_extensions()});
        ViewSession session;
        open(session, context);
        ViewLoop loop(window, instance, session,
                      {.device = picture_.device,
                       .panel = !no_panel_,
                       .inspector = inspect_,
                       .frames = frames_,
                       .fits = !picture_.eye && !picture_.target});
        loop.run(context);
        if (screenshot) {
            const std::vector<std::byte> png = encode_png(loop.captured());
            screenshot->write({reinterpret_cast<const char*>(png.data()), png.size()});
            screenshot->commit();
        }
        if (const auto count = instance.validation_message_count(); count.value_or(0) > 0)
            throw Error(ErrorCode::no_device,
                        "validation: " + std::to_string(*count) +
                            " messages, the first: " + instance.first_validation_message());
        return ExitStatus::success;
    }

private:
    void open(ViewSession& session, const Context& context) {
        Document document =
            follow_progress(context, [&](const BeginCall& begin) { return open_models(begin); });
        for (const std::string& warning : document.warnings()) print_warning(warning);
        if (document.cloud() != nullptr)
            show_cloud(session, std::move(document));
        else
            show_model(session, std::move(document));
    }

    Document open_models(const BeginCall& begin) {
        if (models_.is_plain()) {
            CloudArgument argument = cloud_;
            argument.model = models_.models().front().model;
            argument.subdivide = models_.models().front().subdivide;
            return open_document(argument, begin);
        }
        if (cloud_.as_points || cloud_.drop_bad)
            throw UsageError("--as-points and --drop-bad: a scene has no clouds");
        const MeshSource source =
            models_.load(picture_, TexturePictures::read, scene_.shows_file_colors(), begin);
        auto document = std::make_unique<ModelDocument>(models_.name(), source, begin);
        document->set_models(models_.models(), glm::dvec3(*picture_.ground_up));
        return document;
    }

    void show_cloud(ViewSession& session, Document document) const {
        const bool is_lit = !picture_.lights.empty() || !picture_.suns.empty() ||
                            picture_.has_chosen_sun || scene_.ground;
        if (is_lit || scene_.hidden || scene_.crease_degrees || scene_.style != "ink" || inspect_)
            throw UsageError(models_.name() +
                             " is a cloud: lights, ground, styles, hidden lines, creases and Hough "
                             "space are of models");
        const CloudDocument& cloud = *document.cloud();
        const auto exact = [](const std::optional<glm::vec3>& point) {
            return point ? std::optional(glm::dvec3(*point)) : std::nullopt;
        };
        const Camera camera =
            make_cloud_camera(cloud.drawing(), cloud.umbrellas(), models_.name(),
                              exact(picture_.eye), exact(picture_.target), picture_);
        session.appearance = ViewAppearance(Style::ink);
        if (picture_.background)
            session.appearance.background = linear_from_srgb(*picture_.background);
        if (scene_.color) session.appearance.color = linear_from_srgb(*scene_.color);
        if (scene_.line_color) session.appearance.line_color = linear_from_srgb(*scene_.line_color);
        session.appearance.lines = scene_.draws_lines();
        if (scene_.line_width) session.appearance.line_width_px = float(*scene_.line_width);
        std::optional<glm::dvec3> from;
        if (silhouette_from_)
            from = glm::dvec3(cloud.umbrellas().to_index(glm::dvec3(*silhouette_from_)));
        session.show(std::move(document), camera, {});
        freeze(session, from);
    }

    void show_model(ViewSession& session, Document document) {
        const ModelDocument* const model = document.model();
        if (models_.is_plain()) {
            print_up(settle_up(model->mesh(), picture_.up, picture_.is_up_auto));
            document.model()->set_models(models_.models(), std::nullopt);
        }
        if (!picture_.eye)
            picture_.view.choose(models_.name(), model->mesh(), glm::dvec3(*picture_.up));
        const Camera camera = make_camera(model->mesh(), models_.name(), picture_);
        const double aspect = double(picture_.size.width) / picture_.size.height;
        Scene scene = scene_.make_scene(
            camera, SceneLights(picture_, model->mesh(), scene_.ground).lights(camera, aspect),
            picture_);
        if (scene_.ground) frame_ground(scene, model->mesh(), picture_);
        if (picture_.is_three_point()) add_fill_and_rim(scene);
        session.appearance = ViewAppearance(scene.style);
        session.appearance.background = scene.palette.background;
        if (scene_.color) session.appearance.color = linear_from_srgb(*scene_.color);
        if (scene_.line_color) session.appearance.line_color = linear_from_srgb(*scene_.line_color);
        session.appearance.materials = scene_.materials == "on";
        session.appearance.material_lines = scene_.has_material_lines;
        session.appearance.lines = scene.lines;
        session.appearance.line_width_px = scene.line_width_px;
        session.appearance.hidden = scene_.hidden;
        session.appearance.crease_angle_deg = scene.crease_angle_deg;
        session.appearance.only_clear_creases = scene.only_clear_creases;
        session.appearance.shadows = scene.shadows;
        session.appearance.shadow_method = scene.shadow_method;
        session.appearance.ground = scene_.ground;
        session.show(std::move(document), scene.camera, std::move(scene.lights));
        if (picture_.lights.empty() && picture_.suns.empty()) session.note_chosen_sun();
        std::optional<glm::dvec3> from;
        if (silhouette_from_) from = glm::dvec3(*silhouette_from_);
        freeze(session, from);
    }

    void freeze(ViewSession& session, const std::optional<glm::dvec3>& from) const {
        if (!from) return;
        const glm::dvec3 center = session.bounds().center;
        if (*from == center) throw UsageError("--silhouette-from is the model's center");
        session.freeze_at(
            {.eye = *from, .target = center, .up = session.camera.up, .fov_y_deg = picture_.fov()});
    }

    ModelList models_;
    CloudArgument cloud_;  // Only its flags are used.
    PictureOptions picture_;
    SceneOptions scene_;
    std::optional<glm::vec3> silhouette_from_;
    bool no_panel_ = false;
    bool inspect_ = false;
    std::uint32_t frames_ = 0;
    std::string screenshot_;
};

}  // namespace

std::unique_ptr<Command> make_view_command() { return std::make_unique<ViewCommand>(); }

}  // namespace rimline::tools
