// rimline animate: a sequence of pictures along a path. Change sets update the GPU from frame to frame.

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/trigonometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "engine/renderer.h"
#include "tools/command.h"
#include "tools/options/animation.h"
#include "tools/options/drawing_device.h"
#include "tools/options/model_list.h"
#include "tools/options/model_octree.h"
#include "tools/options/path_options.h"
#include "tools/options/picture_options.h"
#include "tools/options/picture_scene.h"
#include "tools/options/scene_lights.h"
#include "tools/options/scene_options.h"
#include "tools/options/shadow_framing.h"
#include "tools/options/three_point.h"
#include "tools/options/up_option.h"
#include "tools/options/view_camera.h"
#include "tools/output/camera_report.h"
#include "tools/output/frame_output.h"
#include "tools/output/frame_sink.h"
#include "tools/output/json_vector.h"
#include "tools/progress.h"
#include "tools/run_times.h"

namespace rimline::tools {

namespace {

constexpr const char* k_default_folder = "frames";
constexpr std::uint32_t k_framed_shots = 120;

struct Totals {
    SilhouetteChanges changes;
    std::uint64_t shadow_edges = 0;
    std::uint64_t bytes_streamed = 0, bytes_full = 0;
    double frame_ms = 0.0;
    double max_us = 0.0, max_frame_ms = 0.0;

    void add(const FrameReport& frame) {
        changes += frame.camera;
        shadow_edges += frame.shadow_edges;
        bytes_streamed += frame.bytes_streamed;
        bytes_full += frame.bytes_full;
        frame_ms += frame.frame_ms;
        max_us = std::max(max_us, frame.camera.update_us);
        max_frame_ms = std::max(max_frame_ms, frame.frame_ms);
    }
};

nlohmann::ordered_json to_json(const SilhouetteChanges& changes, std::uint64_t shadow_edges,
                               std::uint64_t bytes_streamed, std::uint64_t bytes_full,
                               double frame_ms) {
    return {{"flips", changes.flips},
            {"added", changes.added},
            {"removed", changes.removed},
            {"silhouette", changes.edges},
            {"box_checks", changes.counters.box_checks},
            {"face_checks", changes.counters.face_checks},
            {"edge_checks", changes.counters.edge_checks},
            {"shadow_edges", shadow_edges},
            {"bytes_streamed", bytes_streamed},
            {"bytes_full", bytes_full},
            {"us", changes.update_us},
            {"frame_ms", frame_ms}};
}

class AnimateCommand final : public Command {
public:
    std::string name() const override { return "animate"; }
    std::string summary() const override {
        return "Draw a sequence of pictures, as PNGs or a film";
    }

    void add_options(CLI::App& app) override {
        models_.add_to(app);
        app.add_option("-o,--output", output_,
                       "Folder for the pictures frame_0000.png ..., or a film: a name that ends in "
                       ".apng, or, with ffmpeg, in .mp4, .gif or .webm")
            ->type_name("FOLDER|FILE")
            ->capture_default_str()
            ->group("Output");
        fps_option_ =
            add_count(app, "--fps", fps_, 1, 240, "Frames a second of a film")->group("Output");
        path_.frames = 120;
        path_.add_to(app, "chosen to show the whole model", PathOptions::Random::not_offered);
        constexpr const char* k_group = "Motion";
        light_step_option_ = add_number(app, "--light-step", light_step_degrees_, -360.0, 360.0,
                                        "Turn the lights around the model by this angle per frame, "
                                        "in degrees")
                                 ->group(k_group);
        app.add_flag("--light-follow", light_follow_, "Move the lights with the camera")
            ->excludes(light_step_option_)
            ->group(k_group);
        app.add_option("--deform", deform_, "Deform the model: a wave travels through it")
            ->check(CLI::IsMember({"wave"}))
            ->group(k_group);
        wave_step_option_ = add_number(app, "--wave-step", wave_step_degrees_, -360.0, 360.0,
                                       "Motion of the wave per frame in degrees; 360 is one "
                                       "wavelength (default: 360 in all frames together)")
                                ->default_str("")
                                ->group(k_group);
        scene_.add_to(app);
        scene_.add_palette_to(app);
        scene_.add_frame_lines_to(app);
        picture_.add_camera_to(app);
        models_.add_to_camera(app);
        picture_.add_lights_to(app);
        picture_.add_image_to(app, PictureOptions::Background::any);
        picture_.add_machine_to(app);
        app.footer(
            "The camera moves along the path and looks at the model's center, or at --target. "
            "With --eye X,Y,Z it\n"
            "does not move; with --eye VIEW an orbit begins there. For a direction in the path, "
            "the camera stands in\n"
            "that direction, at the distance of an orbit. An interrupt leaves complete files of "
            "the "
            "frames before\n"
            "it. Counts are those of the camera's silhouettes. Silhouettes of a model that deforms "
            "are computed on the\n"
            "GPU.\n"
            "Several models make a scene, as in render. Of a scene file's cameras only the one of "
            "--camera is used;\n"
            "it does not move.\n\n"
            "Examples:\n"
            "  rimline animate igea.ply --frames 120 --step 0.5 -o frames\n"
            "  rimline animate shape:scene --eye 2,4,8 --light 3,4,2 --light-step 3 --style "
            "toon\n"
            "  rimline animate shape:spring --deform wave --frames 60 --ground -o wave\n"
            "  rimline animate ogre.obj --frames 48 -o ogre.mp4");
    }

    ExitStatus run(const Context& context) override {
        RunTimes& times = context.times;
        models_.settle(picture_, {.first_camera = false});
        scene_.has_painted_models = models_.has_paint();
        models_.check_usage([&] { check_usage(); });
        if (!picture_.eye) path_.read(context);
        const std::unique_ptr<FrameSink> sink =
            make_frame_sink(output_, {.frame_count = path_.frames,
                                      .fps = fps_,
                                      .size = picture_.size,
                                      .finish = scene_.finish(picture_)});
        const Mesh mesh =
            models_.load_mesh(picture_, {scene_.textures(), scene_.shows_file_colors()}, context);
        context.checkpoint();
        if (!picture_.eye) {
            Progress progress(context, "choosing the first view");
            picture_.view.choose(models_.name(), mesh, models_.up().up, progress.call());
            times.end("choosing the view");
        }
        const DrawingDevice device(picture_);
        times.end("device");

        // A deforming mesh has no octree.
        std::optional<HoughOctree> octree;
        if (deform_.empty()) octree.emplace(build_octree(models_.name(), mesh, context));
        const glm::dvec3 up = up_of(mesh, picture_);
        const std::optional<Wave> wave =
            deform_.empty() ? std::nullopt : std::optional(default_wave(mesh, up, 0.0));
        const double reach = mesh.radius() + (wave ? wave->amplitude : 0.0);
        Motion motion = make_motion(mesh, up, reach, wave);
        const std::uint32_t frame_count =
            motion.eyes.empty() ? path_.frames : static_cast<std::uint32_t>(motion.eyes.size());
        const SceneLights lights(picture_, mesh, scene_.ground, {context.stop, {}});
        const double aspect = double(picture_.size.width) / picture_.size.height;
        const Camera first_place = first_camera(mesh, motion);
        Scene first = scene_.make_scene(first_place, lights.lights(first_place, aspect), picture_);
        if (lights.chooses_sun() && motion.lights == LightMotion::still && !motion.eyes.empty()) {
            Progress progress(context, "choosing lights");
            motion.suns = lights.moving_sun(shots_of(first, mesh, motion, frame_count), aspect,
                                            progress.call());
        }
        suns_ = motion.suns;
        times.end("choosing the light");
        if (frames_shadows(first)) {
            const double factor = distance_for_shadows(
                shots_of(first, mesh, motion, frame_count, 1 + frame_count / k_framed_shots), mesh,
                up, aspect);
            std::vector<glm::dvec3> suns = std::move(motion.suns);
            motion = make_motion(mesh, up, factor * reach, wave);
            motion.suns = std::move(suns);
            first.camera = first_camera(mesh, motion);
        }
        motion.has_fill_and_rim = picture_.is_three_point();
        if (motion.has_fill_and_rim) add_fill_and_rim(first);
        check_scene_reach(models_.name(), mesh, {&first.camera.eye, 1}, scene_.ground);
        first.instances.push_back({.octree = octree ? &*octree : nullptr,
                                   .name = models_.name(),
                                   .material = scene_.material(picture_),
                                   .is_solid = octree && check_solid(mesh, context)});
        std::optional<Ground> ground;
        if (scene_.ground) {
            const glm::dvec3 ground_up = rounded_to_float(ground_up_of(mesh, picture_));
            ground.emplace(mesh, ground_up, wave ? wave->amplitude : 0.0);
            first.instances.push_back(
                ground->instance(first, fade_of_ground(mesh, first.lights, ground_up)));
        }

        if (picture_.eye && !wave && is_out_of_view(mesh, first.camera, aspect))
            print_warning(models_.name() + ": none of it is in the pictures");
        Animation animation(std::move(first), mesh, motion);
        times.end("index");
        const Result result = about_model(models_.name(), [&] {
            std::optional<FrameLines> lines;
            if (octree && scene_.draws_exact_lines())
                lines.emplace(*octree, scene_, picture_.size, context);
            Renderer renderer(device.context());
            Progress progress(context, "drawing frames");
            return Result{.frames = draw_frames(animation, frame_count, lines ? &*lines : nullptr,
                                                renderer, picture_.size, *sink, progress.call()),
                          .stream_bytes = renderer.stream_bytes(),
                          .tracker_bytes = renderer.tracker_bytes()};
        });
        times.end("drawing");
        if (context.json)
            print_result(context, device, result);
        else
            print_summary(device, result.frames, times);
        return ExitStatus::success;
    }

private:
    struct Result {
        std::vector<FrameReport> frames;
        // GPU memory of silhouettes, and CPU memory of trackers.
        std::uint64_t stream_bytes = 0, tracker_bytes = 0;
    };

    void check_usage() const {
        scene_.check_usage(picture_);
        if (!models_.has_scene_file()) scene_.check_lines();  // A file may set them for later.
        check_fps(*fps_option_, output_);
        if (path_.radius == 0.0)
            throw UsageError(
                "--radius: the camera looks at the center of the orbit; give more than 0");
        if (picture_.eye && path_.is_moving())
            throw UsageError(
                "--eye: the camera stands there; leave out --path, --radius and --step");
        if (!path_.is_orbit() && picture_.view.given({0, 1, 0}))
            throw UsageError(
                "a named --eye, --azimuth and --elevation: say where an orbit begins; leave out "
                "--path");
        if (!deform_.empty() && (scene_.intersections || scene_.min_length))
            throw UsageError(
                std::string(scene_.intersections ? "--intersections" : "--min-length") +
                ": lines of a model that deforms are drawn edge by edge, without");
        if (wave_step_option_->count() > 0 && deform_.empty())
            throw UsageError("--wave-step: belongs to --deform wave");
    }

    // Only cameras that the command has placed move away.
    bool frames_shadows(const Scene& first) const {
        return scene_.ground && first.shadows && !picture_.eye && !picture_.target &&
               path_.path == "orbit" && !path_.radius && !first.camera.is_orthographic();
    }

    Motion make_motion(const Mesh& mesh, const glm::dvec3& up, double reach,
                       const std::optional<Wave>& wave) const {
        Motion motion{.eyes = {},
                      .distance = fitting_distance(reach > 0.0 ? reach : 1.0),
                      .lights = LightMotion::still,
                      .light_step_degrees = light_step_degrees_,
                      .wave = wave,
                      .wave_turns = 0.0};
        if (!picture_.eye)
            motion.eyes = path_.points(
                mesh, glm::vec3(up), mesh.radius() > 0.0 ? motion.distance / mesh.radius() : 1.0,
                orbit_angle_rad(picture_.view.direction(models_.name(), up), up));
        if (light_follow_) motion.lights = LightMotion::with_camera;
        if (light_step_degrees_ != 0.0) motion.lights = LightMotion::turning;
        const double frames = motion.eyes.empty() ? path_.frames : double(motion.eyes.size());
        motion.wave_turns =
            wave_step_option_->count() > 0 ? wave_step_degrees_ / 360.0 : 1.0 / frames;
        return motion;
    }

    // The distance at which a sphere of this radius fills the picture.
    double fitting_distance(double radius) const {
        if (picture_.ortho_height) return 3.0 * radius;
        const double aspect = double(picture_.size.width) / picture_.size.height;
        const double tangent = std::tan(0.5 * glm::radians(picture_.fov())) * std::min(aspect, 1.0);
        return k_view_margin * radius * std::sqrt(1.0 + tangent * tangent) / tangent;
    }

    // The camera that `render` would choose, at the first eye of the path.
    Camera first_camera(const Mesh& mesh, const Motion& motion) const {
        if (picture_.eye) return make_camera(mesh, models_.name(), picture_);
        Camera camera{.eye = {},
                      .target = picture_.target ? glm::dvec3(*picture_.target) : mesh.center(),
                      .up = up_of(mesh, picture_),
                      .fov_y_deg = picture_.fov(),
                      .ortho_height = picture_.ortho_height.value_or(0.0)};
        // The front view, if no eye of the path differs from the target.
        camera.eye = camera.target + glm::dvec3(0.0, 0.0, motion.distance);
        for (const HomogeneousPoint& point : motion.eyes) {
            if (point.is_direction()) continue;
            const glm::dvec3 eye(point.xyz());
            if (glm::distance(eye, camera.target) <= 1e-9 * motion.distance) continue;
            camera.eye = eye;
            break;
        }
        return camera;
    }

    void print_result(const Context& context, const DrawingDevice& device,
                      const Result& result) const {
        nlohmann::ordered_json frames = nlohmann::ordered_json::array();
        Totals totals;
        for (const FrameReport& report : result.frames) {
            frames.push_back(to_json(report.camera, report.shadow_edges, report.bytes_streamed,
                                     report.bytes_full, report.frame_ms));
            totals.add(report);
        }
        nlohmann::ordered_json sums =
            to_json(totals.changes, totals.shadow_edges, totals.bytes_streamed, totals.bytes_full,
                    totals.frame_ms);
        sums["max_us"] = totals.max_us;
        sums["max_frame_ms"] = totals.max_frame_ms;
        sums["stream_memory_bytes"] = result.stream_bytes;
        sums["tracker_memory_bytes"] = result.tracker_bytes;
        nlohmann::ordered_json json = models_.json();
        json["path"] = picture_.eye ? "still" : path_.path;
        json["up"] = json_vector(models_.up().up);
        json["up_from"] = up_source_name(models_.up().source);
        json["suns"] = suns_json(suns_);
        json.update(device_json(&device));
        json.update(
            {{"frames", std::move(frames)}, {"totals", std::move(sums)}, {"output", output_}});
        print_json(context, std::move(json));
    }

    void print_summary(const DrawingDevice& device, const std::vector<FrameReport>& reports,
                       const RunTimes& times) const {
        Totals totals;
        for (const FrameReport& report : reports) totals.add(report);
        const auto mean = [n = double(reports.size())](auto sum) { return double(sum) / n; };
        std::printf("%s: %zu frame%s\n", output_.c_str(), reports.size(),
                    reports.size() == 1 ? "" : "s");
        std::printf("  a frame     %.1f faces turn, %.1f edges join, %.1f leave, of %.1f\n",
                    mean(totals.changes.flips), mean(totals.changes.added),
                    mean(totals.changes.removed), mean(totals.changes.edges));
        std::printf("  streamed    %.1f bytes, of %.1f for all\n", mean(totals.bytes_streamed),
                    mean(totals.bytes_full));
        std::printf("  a frame     %.1f ms, at most %.1f ms, on %s\n", mean(totals.frame_ms),
                    totals.max_frame_ms, device.device.facts().name.c_str());
        print_up(models_.up());
        std::printf("  time        %s\n", times.sentence().c_str());
        print_validation(device);
    }

    ModelList models_;
    PathOptions path_;
    SceneOptions scene_;
    PictureOptions picture_;
    std::vector<glm::dvec3> suns_;
    std::string output_ = k_default_folder;
    const CLI::Option* fps_option_ = nullptr;
    std::uint32_t fps_ = 30;
    double light_step_degrees_ = 0.0;
    CLI::Option* light_step_option_ = nullptr;
    bool light_follow_ = false;
    std::string deform_;
    double wave_step_degrees_ = 6.0;
    CLI::Option* wave_step_option_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_animate_command() { return std::make_unique<AnimateCommand>(); }

}  // namespace rimline::tools
