#include "tools/options/picture_options.h"

#include <CLI/App.hpp>

#include "silhouette/mesh/homogeneous_point.h"
#include "tools/options/up_option.h"

namespace rimline::tools {

void PictureOptions::add_camera_to(CLI::App& app) {
    constexpr const char* k_group = "Camera";
    view.add_to(app, eye);
    add_point(app, "--target", target,
              "Point that the camera looks at (default: the model's center; without --fov, where "
              "the model fills the picture)")
        ->group(k_group);
    add_lens_to(app);
}

void PictureOptions::add_lens_to(CLI::App& app) {
    constexpr const char* k_group = "Camera";
    add_up_or_auto(app, up, is_up_auto)->group(k_group);
    CLI::Option* fov =
        add_number(
            app, "--fov", fov_degrees, 0.01, 170.0,
            "Vertical field of view in degrees (default: 35; with --eye alone, what shows the "
            "whole model)")
            ->group(k_group);
    add_number(app, "--ortho", ortho_height, k_min_ortho_height, k_max_ortho_height,
               "Orthographic view of this height in the model's units")
        ->excludes(fov)
        ->group(k_group);
}

void PictureOptions::add_ground_up_to(CLI::App& app) {
    add_direction(app, "--ground-up", ground_up,
                  "Up direction of --ground (default: --up). They differ where the camera looks "
                  "along the up direction")
        ->group("Camera");
}

void PictureOptions::add_silhouette_to(CLI::App& app) {
    constexpr const char* k_group = "Style";
    CLI::Option* from =
        add_point(app, "--silhouette-from", silhouette_from,
                  "Freeze the silhouette: draw that of this viewpoint, to be looked at from where "
                  "the camera is (default: the camera's own)")
            ->group(k_group);
    add_direction(app, "--silhouette-direction", silhouette_direction,
                  "The same, of a viewer who is infinitely far this way")
        ->excludes(from)
        ->group(k_group);
}

void PictureOptions::add_lights_to(CLI::App& app) {
    constexpr const char* k_group = "Light";
    add_points(app, "--light", lights, "Position of a point light; repeatable (default: chosen)")
        ->group(k_group);
    add_directions_or_auto(
        app, "--sun", suns, has_chosen_sun,
        "Direction from the model towards a directional light; repeatable. auto: one from which a "
        "third to two thirds of what the camera sees is lit (default, if no light is given)")
        ->group(k_group);
    app.add_option(
           "--lighting", lighting,
           "sun: the lights above. three-point: the sun is the key light; a fill light from "
           "the camera's other side and a rim light from behind, without shadows, are added")
        ->check(CLI::IsMember({"sun", "three-point"}))
        ->capture_default_str()
        ->group(k_group);
}

void PictureOptions::add_image_to(CLI::App& app, Background kind) {
    constexpr const char* k_group = "Image";
    add_image_size(app, "--size", size, "Width and height in pixels")->group(k_group);
    constexpr const char* k_background = "Background color (default: the style's own)";
    (kind == Background::any
         ? add_background(app, "--background", background, has_no_background, k_background)
         : add_color(app, "--background", background, k_background))
        ->group(k_group);
    add_count(app, "--seed", seed, 0, 0xffffffffu, "Seed of all random numbers")->group(k_group);
}

void PictureOptions::add_machine_to(CLI::App& app) {
    constexpr const char* k_group = "Machine";
    add_device(app, device,
               "gpu, cpu, an index or a name (default: a discrete GPU if there is one, else any "
               "device)");
    app.add_flag("--validate", validate,
                 "Turn on the Vulkan validation layers; exit 1 if they are missing")
        ->group(k_group);
}

}  // namespace rimline::tools
