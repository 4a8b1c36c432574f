#include "tools/options/path_options.h"

#include <CLI/App.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/nearest_name.h"
#include "tools/options/option_types.h"
#include "tools/options/track_path.h"
#include "tools/progress.h"

namespace rimline::tools {

void PathOptions::add_to(CLI::App& app, const std::string& radius_default, Random random) {
    const bool has_random = random == Random::offered;
    constexpr const char* k_group = "Path";
    path_option_ = app.add_option("--path", path,
                                  std::string(has_random ? "orbit, random, or" : "orbit, or") +
                                      " a file with one point per line: x y z, or x y z w with "
                                      "w = 0 for a direction")
                       ->type_name("PATH")
                       ->capture_default_str()
                       ->group(k_group);
    frames_option_ = add_count(app, "--frames", frames, 1, 10'000'000,
                               "Number of frames; of a file, its first points (default: all)")
                         ->group(k_group);
    orbit_options_ = {
        add_number(app, "--radius", radius, 0.0, 1e9,
                   "Radius of the orbit in the model's radii (default: " + radius_default + ")"),
        add_number(
            app, "--step", step_degrees, -360.0, 360.0,
            "Angle of the orbit per frame in degrees (default: 360 in all frames together)")};
    for (CLI::Option* option : orbit_options_) option->group(k_group);
    if (has_random)
        seed_option_ = add_count(app, "--seed", seed, 0, 0xffffffffu, "Seed of the random path")
                           ->group(k_group);
}

void PathOptions::require_path(const CLI::Option* option, const std::string& required_path) const {
    if (option->count() > 0 && path != required_path)
        throw UsageError(option->get_name() + ": belongs to --path " + required_path +
                         ", not to --path " + path);
}

bool PathOptions::is_moving() const {
    return path_option_->count() > 0 || (seed_option_ != nullptr && seed_option_->count() > 0) ||
           std::ranges::any_of(orbit_options_,
                               [](const CLI::Option* option) { return option->count() > 0; });
}

void PathOptions::fail_path(const std::string& meant) const {
    throw UsageError(std::string("--path: expected orbit") +
                     (seed_option_ != nullptr ? ", random" : "") + " or a file of points, not '" +
                     path + "'" + meant);
}

void PathOptions::read(const Context& context) {
    if (path.empty()) fail_path("");
    for (const CLI::Option* option : orbit_options_) require_path(option, "orbit");
    if (seed_option_ != nullptr) require_path(seed_option_, "random");
    if (!is_file()) return;
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) {
        std::vector<std::string> names{"orbit"};
        if (seed_option_ != nullptr) names.emplace_back("random");
        const std::string meant = did_you_mean(path, names);
        if (path == "random") fail_path(", which only track has");
        if (!meant.empty()) fail_path(meant);
    }
    Progress progress(context, "reading " + path);
    file_points_ = read_path(path, progress.call());
    if (frames_option_->count() > 0) {
        if (frames > file_points_.size())
            throw UsageError("--frames: " + path + " holds " + std::to_string(file_points_.size()) +
                             " points, fewer than the " + std::to_string(frames) + " asked for");
        file_points_.resize(frames);
    }
}

std::vector<HomogeneousPoint> PathOptions::points(const Mesh& mesh, glm::vec3 up,
                                                  double default_radius, double start_rad) const {
    if (is_file()) return file_points_;
    if (is_random()) return random_path(mesh, seed, frames);
    return orbit_path(mesh, up, radius.value_or(default_radius),
                      step_degrees.value_or(360.0 / frames), frames, start_rad);
}

}  // namespace rimline::tools
