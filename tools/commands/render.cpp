// rimline render: one picture of a model, or of the built-in scene.

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/renderer.h"
#include "engine/vulkan/heap_room.h"
#include "tools/command.h"
#include "tools/options/drawing_device.h"
#include "tools/options/model_list.h"
#include "tools/options/model_octree.h"
#include "tools/options/outline_options.h"
#include "tools/options/picture_options.h"
#include "tools/options/picture_scene.h"
#include "tools/options/scene_lights.h"
#include "tools/options/scene_options.h"
#include "tools/options/shadow_framing.h"
#include "tools/options/three_point.h"
#include "tools/options/up_option.h"
#include "tools/options/view_camera.h"
#include "tools/output/camera_report.h"
#include "tools/output/json_vector.h"
#include "tools/output/picture_file.h"
#include "tools/output/same_picture.h"
#include "tools/output/shown_lines.h"
#include "tools/output/still_scene.h"
#include "tools/progress.h"
#include "tools/run_times.h"

namespace rimline::tools {

namespace {

constexpr const char* k_default_output = "rimline.png";

class RenderCommand final : public Command {
public:
    std::string name() const override { return "render"; }
    std::string summary() const override { return "Draw one picture, as a PNG"; }

    void add_options(CLI::App& app) override {
        app_ = &app;
        models_.add_to(app);
        add_output(app, "-o,--output", output_, ".png", "PNG file to write; - is standard output")
            ->group("Output");
        add_output(app, "--save-scene", scene_output_, ".json",
                   "Also write a scene file that draws this picture again")
            ->group("Output");
        options_.add_to(app);
        options_.add_palette_to(app);
        options_.add_exact_lines_to(app);
        picture_.add_silhouette_to(app);
        outline_.add_to(app);
        picture_.add_camera_to(app);
        models_.add_to_camera(app);
        picture_.add_ground_up_to(app);
        picture_.add_lights_to(app);
        picture_.add_image_to(app, PictureOptions::Background::any);
        picture_.add_machine_to(app);
        app.add_flag("--pass-times", pass_times_,
                     "Report the time of each pass on the device, where its queue has timestamps")
            ->group("Machine");
        app.footer(
            "Without a model, a built-in scene is drawn. Camera and light are chosen if they are "
            "not given.\n"
            "All lights have the same intensity. A chosen camera need not look at the model's "
            "center exactly:\n"
            "it is placed so that the model fills the picture, and with --ground its shadow is in "
            "it, too.\n"
            "Lines are visible exactly where no face of the model hides them. Times are by the "
            "clock and add up\n"
            "to the run; `frame_ms` is the part of drawing after everything is on the device.\n\n"
            "Several models make a scene. --at, --turn, --scale, --paint and --up belong to the "
            "MODEL "
            "before them:\n"
            "first the model is scaled, then turned, then moved. The scene has the coordinates of "
            "its "
            "first model.\n\n"
            "Examples:\n"
            "  rimline render\n"
            "  rimline render shape:knot shape:box --at 2.2,0,0 --turn 30 --ground -o two.png\n"
            "  rimline render scene.json --camera front -o front.png\n"
            "  rimline render horse.ply -o horse.png --style toon --ground --sun auto\n"
            "  rimline render shape:knot --eye 3,2,4 --light 2,5,1 --style ink -o knot.png");
    }

    ExitStatus run(const Context& context) override {
        RunTimes& times = context.times;
        models_.settle(picture_, {});
        options_.has_painted_models = models_.has_paint();
        models_.check_usage([&] {
            options_.check_usage(picture_);
            if (!models_.has_scene_file())
                options_.check_lines();  // A file may set them for later.
            outline_.check_usage(*app_);
        });
        check_output(context, output_);
        check_outputs();
        OutputFile output(output_);  // Reports a bad path before the work.
        std::optional<OutputFile> scene_output;
        if (!scene_output_.empty()) scene_output.emplace(scene_output_);
        const Mesh mesh = models_.load_mesh(
            picture_, {options_.textures(), options_.shows_file_colors()}, context);
        context.checkpoint();
        choose_view(mesh, context);
        times.end("choosing the view");
        const DrawingDevice device(picture_);
        times.end("device");
        const HoughOctree octree = build_octree(models_.name(), mesh, context);
        context.checkpoint();

        times.end("index");
        StillScene still = [&] {
            Progress progress(context, "choosing the light");
            return StillScene(models_.name(), octree, options_, picture_, progress.call());
        }();
        times.end("choosing the light");
        std::optional<ShownLines> lines;
        if (still.has_exact_lines() && outline_.draws_lines()) {
            lines.emplace(prepare_lines(octree, context));
            Progress progress(context, "drawing lines");
            still.add_lines(*lines, progress.call());
        }
        times.end("lines");
        Renderer renderer(device.context(),
                          {.pass_times = pass_times_, .outline = outline_.outline()});
        Picture picture = [&] {
            const Progress progress(context, "drawing the picture");
            return renderer.render(still.scene(), picture_.size.width, picture_.size.height);
        }();
        context.checkpoint();
        times.end("drawing");
        options_.finish(picture_).apply(picture);
        const Scene& scene = still.scene();
        const glm::dvec3 ground_up = still.ground_up();

        write_png(output, picture);
        if (scene_output) write_scene(*scene_output, scene, ground_up);
        times.end("writing");
        FrameReport report = renderer.report();
        if (scene.instances.front().picture_lines) {
            report.silhouette = lines->silhouette_count();
            report.creases = lines->crease_count();
        }
        if (is_out_of_view(mesh, scene.camera, double(picture_.size.width) / picture_.size.height))
            print_warning(models_.name() + ": none of it is in the picture");
        if (context.json)
            print_result(context, device, renderer, report, scene, ground_up);
        else
            print_summary(device, report, scene, ground_up, times);
        return ExitStatus::success;
    }

private:
    void check_outputs() const {
        models_.check_output_is_no_input(output_);
        if (scene_output_.empty()) return;
        models_.check_output_is_no_input(scene_output_);
        if (scene_output_ == k_standard_output)
            throw UsageError(
                "--save-scene: the paths in a scene file need its folder; give a file");
    }

    void write_scene(OutputFile& file, const Scene& scene, const glm::dvec3& up) const {
        // Its first camera draws this picture.
        const std::string name = models_.camera_name().empty() ? "camera" : models_.camera_name();
        nlohmann::ordered_json cameras{{name, scene_camera_json(scene.camera)}};
        const nlohmann::ordered_json of_file = models_.scene_cameras();
        for (const auto& [other, camera] : of_file.items())
            if (other != name) cameras[other] = camera;
        file.write(scene_text({.up = up,
                               .models = models_.models(),
                               .lights = scene_lights_json(scene.lights),
                               .cameras = std::move(cameras),
                               .picture = picture_json(*app_)},
                              scene_output_));
        file.commit();
    }

    void choose_view(const Mesh& mesh, const Context& context) {
        if (picture_.eye) return;
        Progress progress(context, "choosing the view");
        picture_.view.choose(models_.name(), mesh, models_.up().up, progress.call());
    }

    static nlohmann::ordered_json shadows_of(const FrameReport& report) {
        nlohmann::ordered_json shadows = nlohmann::ordered_json::array();
        for (const ShadowReport& shadow : report.shadows)
            shadows.push_back({{"instance", shadow.instance},
                               {"light", shadow.light},
                               {"method", name_of(shadow.choice.method)},
                               {"method_reason", shadow.choice.method_reason},
                               {"form", name_of(shadow.choice.form)},
                               {"form_reason", shadow.choice.form_reason},
                               {"bound", shadow.bound},
                               {"runs", shadow.runs},
                               {"light_moved", shadow.light_moved}});
        return shadows;
    }

    // Budget and use only where the device knows them (VK_EXT_memory_budget).
    static nlohmann::ordered_json heaps_of(const DeviceContext& context) {
        nlohmann::ordered_json heaps = nlohmann::ordered_json::array();
        for (const HeapRoom& room :
             heap_rooms(*context.vk, context.physical_device, context.features.memory_budget)) {
            nlohmann::ordered_json heap{{"size_bytes", room.size_bytes},
                                        {"device_local", room.is_device_local}};
            if (context.features.memory_budget)
                heap.update({{"budget_bytes", room.budget_bytes}, {"used_bytes", room.used_bytes}});
            heaps.push_back(std::move(heap));
        }
        return heaps;
    }

    static nlohmann::ordered_json passes_of(const FrameReport& report) {
        nlohmann::ordered_json passes = nlohmann::ordered_json::array();
        for (const PassTime& pass : report.passes)
            passes.push_back({{"name", pass.name}, {"ms", pass.time_ms}});
        return passes;
    }

    void print_result(const Context& context, const DrawingDevice& device, const Renderer& renderer,
                      const FrameReport& report, const Scene& scene,
                      const glm::dvec3& ground_up) const {
        nlohmann::ordered_json result = models_.json();
        result.update(device_json(&device));
        result.update({{"silhouette", report.silhouette},
                       {"creases", report.creases},
                       {"shadow_edges", report.shadow_edges},
                       {"shadows", shadows_of(report)},
                       {"bytes_streamed", report.bytes_streamed},
                       {"bytes_full", report.bytes_full},
                       {"bytes_uploaded", report.bytes_uploaded},
                       {"stream_memory_bytes", renderer.stream_bytes()},
                       {"tracker_memory_bytes", renderer.tracker_bytes()},
                       {"device_heaps", heaps_of(device.context())},
                       {"frame_ms", report.frame_ms},
                       {"output", output_}});
        result.update(camera_json(scene.camera));
        result["up_from"] = up_source_name(models_.up().source);
        result.update(clip_planes_json(scene));
        result["lights"] = lights_json(scene.lights);
        if (options_.ground || !models_.is_plain()) result["ground_up"] = json_vector(ground_up);
        if (pass_times_) result["passes"] = passes_of(report);
        print_json(context, std::move(result));
    }

    void print_summary(const DrawingDevice& device, const FrameReport& report, const Scene& scene,
                       const glm::dvec3& ground_up, const RunTimes& times) const {
        std::printf("%s\n", output_.c_str());
        if (outline_.draws_lines())
            std::printf("  lines       %u silhouette and border edges, %u creases\n",
                        report.silhouette, report.creases);
        std::printf("  shadows     %u edges extruded\n", report.shadow_edges);
        std::printf("  streamed    %llu bytes\n",
                    static_cast<unsigned long long>(report.bytes_streamed));
        std::printf("  time        %s\n", times.sentence().c_str());
        std::printf("  device      %s\n", device.device.facts().name.c_str());
        for (const PassTime& pass : report.passes)
            std::printf("    %-28s %8.3f ms\n", pass.name.c_str(), pass.time_ms);
        if (pass_times_ && report.passes.empty())
            std::printf("    the device's queue has no timestamps\n");
        print_up(models_.up());
        print_validation(device);
        std::vector<std::string> arguments = camera_arguments(scene.camera, scene.lights);
        if ((options_.ground || !models_.is_plain()) && ground_up != scene.camera.up)
            arguments.push_back(vector_argument("--ground-up", ground_up));
        // --up after several models would belong to the last one.
        std::string words = models_.words();
        if (models_.has_several()) {
            const std::string up = vector_argument("--up", scene.camera.up);
            std::erase(arguments, up);
            words = up + " " + words;
        }
        arguments.push_back("-o " + quoted_for_shell(output_));
        std::printf("  again       %s\n", render_command(*app_, words, arguments).c_str());
    }

    ModelList models_;
    PictureOptions picture_;
    std::string output_ = k_default_output, scene_output_;
    SceneOptions options_;
    OutlineOptions outline_;
    bool pass_times_ = false;
    const CLI::App* app_ = nullptr;
};

}  // namespace

std::unique_ptr<Command> make_render_command() { return std::make_unique<RenderCommand>(); }

}  // namespace rimline::tools
