#pragma once

// The options that define a path, one point per frame: --path, --frames, --radius and --step.
// `track` moves the silhouette point along it, `animate` the camera. Only `track` has random paths and --seed: they
// jump through the model and far away.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"
#include "tools/cli_classes.h"
#include "tools/command.h"

namespace rimline::tools {

struct PathOptions {
    enum class Random { offered, not_offered };

    std::string path = "orbit";  ///< orbit, a file name, or, where offered, random.
    std::uint32_t frames = 360;
    /// Radius of an orbit in the model's radii. Not set: the command's default.
    std::optional<double> radius;
    std::optional<double> step_degrees;
    std::uint32_t seed = 1;

    /// `radius_default` describes the default radius of an orbit in the help.
    void add_to(CLI::App& app, const std::string& radius_default, Random random);

    /// Checks the options, and reads the points if the path is a file. Call it before a long load, so that a
    /// bad file or an option that does not belong to the path is reported at once. Throws UsageError, and
    /// what read_path() throws.
    void read(const Context& context);
    /// The points: `frames` of them, or those of the file.
    /// An orbit starts at `start_rad`.
    std::vector<HomogeneousPoint> points(const Mesh& mesh, glm::vec3 up, double default_radius,
                                         double start_rad = 0.0) const;

    /// Throws UsageError if `option` is given and the path is not `required_path`.
    void require_path(const CLI::Option* option, const std::string& required_path) const;
    bool is_orbit() const { return path == "orbit"; }
    /// Whether an option of the path is given. --frames does not count.
    bool is_moving() const;

private:
    bool is_random() const { return seed_option_ != nullptr && path == "random"; }
    bool is_file() const { return !is_orbit() && !is_random(); }
    [[noreturn]] void fail_path(const std::string& meant) const;

    CLI::Option* path_option_ = nullptr;
    CLI::Option* frames_option_ = nullptr;
    std::vector<CLI::Option*> orbit_options_;
    CLI::Option* seed_option_ = nullptr;  // Null: no random path.
    std::vector<HomogeneousPoint> file_points_;
};

}  // namespace rimline::tools
