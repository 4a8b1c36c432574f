// rimline render: one picture of a model, or of the built-in scene.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/device.h"
#include "engine/renderer.h"
#include "engine/view_defaults.h"
#include "engine/vulkan_instance.h"
#include "silhouette/hough/hough_octree.h"
#include "tools/command.h"
#include "tools/model_argument.h"
#include "tools/output_file.h"
#include "tools/picture_options.h"
#include "tools/progress.h"

namespace rimline::tools {

namespace {

constexpr const char* k_default_model = "shape:scene";
constexpr const char* k_default_output = "rimline.png";
// From where the built-in scene looks best.
constexpr glm::dvec3 k_scene_view(0.22, 0.45, 1.0);
// Of a ground, in the model's radii: where it has faded out, and where it ends.
constexpr double k_ground_fade = 7.0;
constexpr double k_ground_end = 8.0;

glm::vec3 linear_from_srgb(const Color& color) {
    const auto linear = [](std::uint8_t channel) {
        const float c = static_cast<float>(channel) / 255.0f;
        return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
    };
    return {linear(color.red), linear(color.green), linear(color.blue)};
}

class RenderCommand final : public Command {
public:
    std::string name() const override { return "render"; }
    std::string summary() const override { return "Draw one picture, as a PNG"; }

    void add_options(CLI::App& app) override {
        model_.add_to(app, ModelArgument::Presence::optional);
        app.add_option("-o,--output", output_, "The PNG to write")
            ->type_name("FILE.png")
            ->capture_default_str()
            ->group("Output");
        constexpr const char* k_group = "Style";
        app.add_option("--style", style_, "ink, toon, or mask (where light arrives)")
            ->check(CLI::IsMember({"ink", "toon", "mask"}))
            ->capture_default_str()
            ->group(k_group);
        app.add_option("--lines", lines_, "Silhouettes and borders: on or off")
            ->check(CLI::IsMember({"on", "off"}))
            ->capture_default_str()
            ->group(k_group);
        add_number(app, "--line-width", line_width_, 0.1, 100.0, "In pixels")->group(k_group);
        app.add_flag("--hidden", hidden_, "Draw hidden lines too, faintly")->group(k_group);
        app.add_option("--shadows", shadows_, "auto, fail (volumes by depth fail) or off")
            ->check(CLI::IsMember({"auto", "fail", "off"}))
            ->capture_default_str()
            ->group(k_group);
        app.add_flag("--ground", ground_, "A ground that catches the shadow")->group(k_group);
        picture_.add_camera_to(app);
        picture_.add_lights_to(app);
        picture_.add_image_to(app);
        picture_.add_machine_to(app);
        app.footer(
            "Without a model a built-in scene is drawn. Camera and light are chosen when not "
            "given.\n"
            "Every light adds an equal share. A camera that is chosen looks past the model's "
            "center where\n"
            "that fills the picture better.\n\n"
            "Examples:\n"
            "  rimline render\n"
            "  rimline render horse.ply -o horse.png --style toon --ground\n"
            "  rimline render shape:knot --eye 3,2,4 --light 2,5,1 --style ink -o knot.png");
    }

    ExitStatus run(const Context& context) override {
        OutputFile output(output_);  // A bad path is known before the work.
        if (model_.model.empty()) model_.model = k_default_model;
        const Mesh mesh = model_.load_mesh(context);
        context.checkpoint();
        const VulkanInstance instance({.validate = picture_.validate});
        const Device device(instance, picture_.device);
        const HoughOctree octree = about_model(model_.model, [&] {
            Progress progress(context, "building the octree");
            return HoughOctree(mesh, {}, progress.call());
        });
        context.checkpoint();

        Scene scene = make_scene(mesh, octree);
        check_size(scene, mesh);
        std::optional<Mesh> ground;
        std::optional<HoughOctree> ground_octree;
        if (ground_) {
            ground.emplace(make_ground(mesh, up_of(mesh), k_ground_end * mesh.radius()));
            ground_octree.emplace(*ground);
            scene.instances.push_back(ground_instance(scene, mesh, *ground_octree));
        }
        Renderer renderer(device.context());
        const Picture picture = renderer.render(scene, picture_.size.width, picture_.size.height);
        context.checkpoint();

        const std::vector<std::byte> png = encode_png(picture);
        output.write({reinterpret_cast<const char*>(png.data()), png.size()});
        output.commit();
        if (context.json)
            print_result(device, instance, renderer.report());
        else
            print_summary(device, instance, renderer.report());
        return ExitStatus::success;
    }

private:
    // What is drawn beside the model must lie within the coordinates that silhouettes are found in.
    void check_size(const Scene& scene, const Mesh& mesh) const {
        const double ground = ground_ ? 1.5 * k_ground_end * mesh.radius() : 0.0;
        const glm::dvec3 reach =
            glm::max(glm::abs(scene.camera.eye), glm::abs(mesh.center()) + ground);
        if (std::max({reach.x, reach.y, reach.z}) > double{k_max_coordinate})
            throw Error(ErrorCode::too_large, model_.model + ": too large to stand before" +
                                                  (ground_ ? " or to lay a ground under" : "") +
                                                  ": scale it down, coordinates end at 2^60");
    }

    Style style() const {
        return style_ == "toon" ? Style::toon : style_ == "mask" ? Style::mask : Style::ink;
    }

    glm::dvec3 up_of(const Mesh& mesh) const {
        if (picture_.up) return glm::dvec3(*picture_.up);
        return mesh.up() == UpAxis::z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    }

    Camera make_camera(const Mesh& mesh) const {
        const glm::dvec3 up = up_of(mesh);
        const double aspect = double(picture_.size.width) / picture_.size.height;
        Camera camera{.eye = {},
                      .target = {},
                      .up = up,
                      .fov_y_deg = picture_.fov_degrees,
                      .ortho_height = picture_.ortho_height.value_or(0.0)};
        if (picture_.eye) {
            camera.eye = glm::dvec3(*picture_.eye);
            camera.target = picture_.target ? glm::dvec3(*picture_.target) : mesh.center();
            if (camera.eye == camera.target)
                throw UsageError(picture_.target ? "--eye and --target are the same point"
                                                 : "--eye is the model's center, where it looks");
            return camera;
        }
        const bool own_scene = model_.model == k_default_model;
        camera =
            fit_camera(camera, mesh, own_scene ? k_scene_view : default_view_direction(up), aspect);
        if (picture_.target) {
            camera.eye += glm::dvec3(*picture_.target) - camera.target;
            camera.target = glm::dvec3(*picture_.target);
        }
        return camera;
    }

    Scene make_scene(const Mesh& mesh, const HoughOctree& octree) const {
        const glm::vec3 background = linear_from_srgb(picture_.background);
        Scene scene{.camera = make_camera(mesh),
                    .style = style(),
                    .palette = default_palette(style(), background),
                    .shadows = shadows_ != "off",
                    .lines = lines_ == "on",
                    .line_width_px = static_cast<float>(line_width_),
                    .hidden_line_strength = hidden_ ? 0.25f : 0.0f};
        scene.instances.push_back(
            {.octree = &octree, .color = default_surface_color(style(), background)});
        for (const glm::vec3& light : picture_.lights)
            scene.lights.push_back({.vector = glm::dvec3(light), .directional = false});
        for (const glm::vec3& sun : picture_.suns)
            scene.lights.push_back({.vector = glm::dvec3(sun), .directional = true});
        if (scene.lights.empty()) scene.lights.push_back(default_sun(scene.camera));
        return scene;
    }

    static SceneInstance ground_instance(const Scene& scene, const Mesh& mesh,
                                         const HoughOctree& octree) {
        return {.octree = &octree,
                .color = scene.style == Style::mask ? glm::vec3(1.0f) : scene.palette.background,
                .has_lines = false,
                .casts_shadows = false,
                .fade_radius = k_ground_fade * mesh.radius(),
                .fade_center = mesh.center()};
    }

    void print_result(const Device& device, const VulkanInstance& instance,
                      const FrameReport& report) const {
        nlohmann::ordered_json messages = nullptr;
        if (const auto count = instance.validation_message_count()) messages = *count;
        print_json({{"model", model_.model},
                    {"device", device.facts().name},
                    {"driver", device.facts().driver},
                    {"validation_messages", std::move(messages)},
                    {"silhouette", report.silhouette},
                    {"shadow_edges", report.shadow_edges},
                    {"bytes_streamed", report.bytes_streamed},
                    {"bytes_full", report.bytes_full},
                    {"frame_ms", report.frame_ms},
                    {"output", output_}});
    }

    void print_summary(const Device& device, const VulkanInstance& instance,
                       const FrameReport& report) const {
        std::printf("%s\n", output_.c_str());
        std::printf("  lines       %u silhouette and border edges\n", report.silhouette);
        std::printf("  shadows     %u edges extruded\n", report.shadow_edges);
        std::printf("  streamed    %llu bytes\n",
                    static_cast<unsigned long long>(report.bytes_streamed));
        std::printf("  time        %.1f ms on %s\n", report.frame_ms, device.facts().name.c_str());
        if (const auto count = instance.validation_message_count())
            std::printf("  validation  %u messages%s%s\n", *count, *count ? ", the first: " : "",
                        *count ? instance.first_validation_message().c_str() : "");
    }

    ModelArgument model_;
    PictureOptions picture_;
    std::string output_ = k_default_output;
    std::string style_ = "ink";
    std::string lines_ = "on";
    double line_width_ = 2.5;
    bool hidden_ = false;
    std::string shadows_ = "auto";
    bool ground_ = false;
};

}  // namespace

std::unique_ptr<Command> make_render_command() { return std::make_unique<RenderCommand>(); }

}  // namespace rimline::tools
