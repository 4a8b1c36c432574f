#pragma once

// The options of every subcommand that draws pictures: camera, lights, image, device.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli_classes.h"
#include "tools/options/option_types.h"
#include "tools/options/up_option.h"
#include "tools/options/view_option.h"

namespace rimline::tools {

struct PictureOptions : UpOptions {
    // Camera. The command chooses what is not given. --fov and --ortho exclude each other.
    std::optional<glm::vec3> eye;
    ViewOption view;  ///< Where the camera stands without `eye`.
    std::optional<glm::vec3> target;
    std::optional<double> fov_degrees;  ///< Vertical. Not set: fov().
    std::optional<double> ortho_height;
    // Whose silhouette is drawn: that of the camera, of a point, or of a direction towards the viewer.
    std::optional<glm::vec3> silhouette_from, silhouette_direction;

    // Lights. The command chooses a sun if none is given.
    std::vector<glm::vec3> lights;  ///< Positions of point lights.
    std::vector<glm::vec3> suns;    ///< Directions from the model towards the light.
    std::string lighting = "sun";   ///< sun or three-point.
    bool has_chosen_sun = false;    ///< One more sun, computed for the camera (scene_lights.h).

    // Image.
    ImageSize size{1280, 960};
    std::optional<Color> background;  ///< Not set: the style's own.
    bool has_no_background = false;   ///< Transparent. Surfaces are those on the style's own.
    std::uint32_t seed = 1;

    // Machine.
    std::string device;  ///< gpu, cpu, an index or a name. Empty: the best device.
    bool validate = false;

    /// --fov or its default. A camera with an eye and neither target nor --fov shows the whole model instead.
    double fov() const { return fov_degrees.value_or(35.0); }

    bool has_own_silhouette() const { return silhouette_from || silhouette_direction; }
    bool is_three_point() const { return lighting == "three-point"; }

    void add_camera_to(CLI::App& app);
    /// The same without eye and target.
    void add_lens_to(CLI::App& app);
    void add_ground_up_to(CLI::App& app);
    void add_silhouette_to(CLI::App& app);
    void add_lights_to(CLI::App& app);
    enum class Background { opaque, any };
    void add_image_to(CLI::App& app, Background kind = Background::opaque);
    void add_machine_to(CLI::App& app);
};

}  // namespace rimline::tools
