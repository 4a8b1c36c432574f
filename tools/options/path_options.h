#pragma once

// The options that say along which points something moves, one a frame: --path, --frames, --radius,
// --step and --seed. `track` follows them; `animate` looks from them.

#include <CLI/App.hpp>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

struct PathOptions {
    std::string path = "orbit";  ///< orbit, random or a file.
    std::uint32_t frames = 360;
    /// Of an orbit, in the model's radii; not given, the command chooses.
    std::optional<double> radius;
    std::optional<double> step_degrees;
    std::uint32_t seed = 1;

    /// `radius_default` tells the help what an orbit's radius is where it is not given.
    void add_to(CLI::App& app, const std::string& radius_default);

    /// Reads the points of a file; nothing for other paths. Call it before a long load, so that a bad file
    /// or an option that the path would not heed is known at once. Throws UsageError, and what read_path()
    /// does.
    void read(const Context& context);
    /// The points, `frames` of them unless a file says otherwise.
    std::vector<HomogeneousPoint> points(const Mesh& mesh, glm::vec3 up,
                                         double default_radius) const;

    /// For options of the command's own that belong to a path. Throws UsageError.
    void refuse(const CLI::Option* option, const std::string& owner) const;
    /// Whether an option says how to move, the number of frames aside.
    bool is_moving() const;

private:
    bool is_file() const { return path != "orbit" && path != "random"; }

    CLI::Option* path_option_ = nullptr;
    CLI::Option* frames_option_ = nullptr;
    std::vector<CLI::Option*> orbit_options_;
    CLI::Option* seed_option_ = nullptr;
    std::vector<HomogeneousPoint> file_points_;
};

}  // namespace rimline::tools
