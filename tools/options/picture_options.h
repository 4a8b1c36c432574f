#pragma once

// The options that every subcommand which draws pictures shares: camera, lights, image, device.

#include <CLI/App.hpp>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/options/option_types.h"

namespace rimline::tools {

struct PictureOptions {
    // Camera. Chosen by the command where not given; --fov and --ortho exclude each other.
    std::optional<glm::vec3> eye;
    std::optional<glm::vec3> target;
    std::optional<glm::vec3> up;
    double fov_degrees = 35.0;  ///< Vertical.
    std::optional<double> ortho_height;

    // Lights. Chosen by the command where none is given.
    std::vector<glm::vec3> lights;  ///< Points.
    std::vector<glm::vec3> suns;    ///< Directions from the model towards the light.
    bool has_chosen_sun = false;    ///< One more sun, the best for the camera (sun_choice.h).

    // Image.
    ImageSize size{1280, 960};
    std::optional<Color> background;  ///< Chosen by the style where not given.
    std::uint32_t seed = 1;

    // Machine.
    std::string device;  ///< gpu, cpu, an index or a name; empty: the best there is.
    bool validate = false;

    void add_camera_to(CLI::App& app);
    /// The same but for eye and target.
    void add_lens_to(CLI::App& app);
    void add_lights_to(CLI::App& app);
    void add_image_to(CLI::App& app);
    void add_machine_to(CLI::App& app);
};

}  // namespace rimline::tools
