// rimline path: a closed camera path through the best views of a model, as positions and pictures.

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/renderer.h"
#include "tools/command.h"
#include "tools/options/animation.h"
#include "tools/options/model_argument.h"
#include "tools/options/model_octree.h"
#include "tools/options/option_types.h"
#include "tools/options/picture_scene.h"
#include "tools/options/scene_lights.h"
#include "tools/options/scene_options.h"
#include "tools/options/shadow_framing.h"
#include "tools/options/three_point.h"
#include "tools/options/up_option.h"
#include "tools/output/camera_report.h"
#include "tools/output/frame_output.h"
#include "tools/output/frame_sink.h"
#include "tools/output/json_vector.h"
#include "tools/output/path_report.h"
#include "tools/output/view_pictures.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

class PathCommand final : public Command {
public:
    std::string name() const override { return "path"; }
    std::string summary() const override { return "Plan a camera path through the best views"; }

    void add_options(CLI::App& app) override {
        app_ = &app;
        model_.add_to(app);
        choice_.add_to(app, 2);
        plan_.add_to(app);
        output_option_ = app.add_option("-o,--output", output_,
                                        "Folder for the pictures frame_0000.png ..., or a film: a "
                                        "name that ends in .apng, or, with ffmpeg, in .mp4, .gif "
                                        "or .webm (default: no pictures)")
                             ->type_name("FOLDER|FILE")
                             ->group("Output");
        fps_option_ =
            add_count(app, "--fps", fps_, 1, 240, "Frames a second of a film")->group("Output");
        style_.add_to(app);
        style_.add_palette_to(app);
        style_.add_frame_lines_to(app);
        add_up_or_auto(app, picture_.up, picture_.is_up_auto)->group("Camera");
        picture_.add_lights_to(app);
        app.add_flag("--light-follow", light_follow_, "Move the lights with the camera")
            ->group("Light");
        picture_.add_image_to(app, PictureOptions::Background::any);
        picture_.add_machine_to(app);
        app.footer(
            "The path is closed and smooth. It passes through the best views, and between each two "
            "of them\n"
            "through another good view. Its distance from the model's center is at least 1.73 of "
            "the model's\n"
            "radii. The camera moves at constant speed and looks at the center.\n\n"
            "Examples:\n"
            "  rimline path horse.ply --json\n"
            "  rimline path horse.ply --frames 240 -o path --style toon --ground");
    }

    ExitStatus run(const Context& context) override {
        style_.check_usage(picture_);
        style_.check_lines();
        if (output_option_->count() > 0) check_fps(*fps_option_, output_);
        std::unique_ptr<FrameSink> sink;
        if (output_option_->count() > 0)
            sink = make_frame_sink(output_, {.frame_count = plan_.frames,
                                             .fps = fps_,
                                             .size = picture_.size,
                                             .finish = style_.finish(picture_)});
        else
            refuse_options(*app_, {"Style", "Light", "Image", "--fps"},
                           "there are no pictures; give -o FOLDER");
        if (choice_.no_ratio && !sink)
            refuse_options(*app_, {"--device", "--validate"}, "nothing is drawn; give -o FOLDER");
        const Mesh mesh =
            model_.load_drawn_mesh(context, sink ? style_.textures() : TexturePictures::skip);
        context.checkpoint();
        up_ = settle_up(mesh, picture_.up, picture_.is_up_auto, context.stop);
        const ViewDevice device(model_.model, mesh, picture_, !choice_.no_ratio || sink, context);
        about_model(model_.model, [&] {
            const ChosenViews chosen =
                choose_views(choice_, model_.model, mesh, up_.up, device, 2, context);
            context.times.end("choosing the views");
            const PlannedPath planned = plan_.plan(chosen, up_of(mesh, picture_), context);
            context.times.end("planning");
            if (sink) draw(*sink, device, planned, context);
            if (sink) context.times.end("drawing");
            if (context.json)
                print_result(context, mesh, chosen, planned, device);
            else {
                print_path(sink ? output_ : model_.model, chosen, planned);
                std::printf("  in all      %s\n", context.times.sentence().c_str());
                print_up(up_);
            }
        });
        return ExitStatus::success;
    }

private:
    // The least field of view that shows the whole model from every position on the path.
    double fitting_fov_deg(const Mesh& mesh, const PlannedPath& planned) const {
        const double aspect = double(picture_.size.width) / picture_.size.height;
        double tangent = 0.0;
        for (std::size_t i = 0; i < planned.samples.size(); ++i) {
            const glm::dvec3& eye = planned.samples[i];
            const glm::dmat3 axes =
                camera_from_world({.eye = eye, .target = mesh.center(), .up = planned.ups[i]});
            for (const glm::vec3& position : mesh.positions()) {
                const glm::dvec3 p = axes * (glm::dvec3(position) - eye);
                tangent = std::max({tangent, std::abs(p.y) / -p.z, std::abs(p.x) / -p.z / aspect});
            }
        }
        return 2.0 * glm::degrees(std::atan(k_view_margin * tangent));
    }

    Motion make_motion(const PlannedPath& planned, const Camera& first) const {
        Motion motion;
        for (const glm::dvec3& sample : planned.samples)
            motion.eyes.push_back(HomogeneousPoint::viewpoint(glm::vec3(sample)));
        motion.ups = planned.ups;
        motion.distance = glm::distance(first.eye, first.target);
        if (light_follow_) motion.lights = LightMotion::with_camera;
        return motion;
    }

    void draw(FrameSink& sink, const ViewDevice& device, const PlannedPath& planned,
              const Context& context) {
        const Mesh& mesh = device.octree->mesh();
        const Camera camera{.eye = planned.samples[0],
                            .target = mesh.center(),
                            .up = planned.ups[0],
                            .fov_y_deg = fitting_fov_deg(mesh, planned)};
        const double aspect = double(picture_.size.width) / picture_.size.height;
        const SceneLights lights(picture_, mesh, style_.ground, {context.stop, {}});
        Scene first = style_.make_scene(camera, lights.lights(camera, aspect), picture_);
        Motion motion = make_motion(planned, camera);
        if (lights.chooses_sun() && motion.lights == LightMotion::still) {
            Progress progress(context, "choosing lights");
            motion.suns = lights.moving_sun(shots_of(first, mesh, motion, plan_.frames), aspect,
                                            progress.call());
            suns_ = motion.suns;
        }
        if (style_.ground && first.shadows) {
            const double tangent = tangent_for_shadows(shots_of(first, mesh, motion, plan_.frames),
                                                       mesh, up_of(mesh, picture_), aspect);
            first.camera.fov_y_deg =
                std::max(first.camera.fov_y_deg, 2.0 * glm::degrees(std::atan(tangent)));
        }
        motion.has_fill_and_rim = picture_.is_three_point();
        if (motion.has_fill_and_rim) add_fill_and_rim(first);
        first.instances.push_back({.octree = &*device.octree,
                                   .name = model_.model,
                                   .material = style_.material(picture_),
                                   .is_solid = check_solid(mesh, context)});
        std::optional<Ground> ground;
        if (style_.ground) {
            ground.emplace(mesh, up_of(mesh, picture_), 0.0);
            first.instances.push_back(
                ground->instance(first, fade_of_ground(mesh, first.lights, up_of(mesh, picture_))));
        }
        Animation animation(std::move(first), mesh, std::move(motion));
        std::optional<FrameLines> lines;
        if (style_.draws_exact_lines())
            lines.emplace(*device.octree, style_, picture_.size, context);
        Renderer renderer(device.device->context());
        Progress progress(context, "drawing frames");
        draw_frames(animation, plan_.frames, lines ? &*lines : nullptr, renderer, picture_.size,
                    sink, progress.call());
    }

    void print_result(const Context& context, const Mesh& mesh, const ChosenViews& chosen,
                      const PlannedPath& planned, const ViewDevice& device) const {
        nlohmann::ordered_json result = path_json(model_.model, mesh, chosen, planned);
        result.update(device_json(device.device_or_null()));
        result["up"] = json_vector(up_.up);
        result["up_from"] = up_source_name(up_.source);
        result["suns"] = suns_json(suns_);
        result["output"] = nullptr;
        if (output_option_->count() > 0) result["output"] = output_;
        print_json(context, std::move(result));
    }

    ModelArgument model_;
    ViewChoice choice_;
    PathPlan plan_;
    SceneOptions style_;
    PictureOptions picture_;
    ChosenUp up_;
    bool light_follow_ = false;
    std::vector<glm::dvec3> suns_;
    std::string output_;
    const CLI::Option* fps_option_ = nullptr;
    std::uint32_t fps_ = 30;
    CLI::Option* output_option_ = nullptr;
    const CLI::App* app_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_path_command() { return std::make_unique<PathCommand>(); }

}  // namespace rimline::tools
