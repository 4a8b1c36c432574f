#pragma once

// Planning a camera path through chosen views, and its report, for `path` with a device and without.

#include <cstdint>
#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "silhouette/field/camera_path.h"
#include "silhouette/field/camera_tour.h"
#include "tools/cli_classes.h"
#include "tools/options/view_choice.h"

namespace rimline::tools {

/// Equally spaced cameras along a path, which look at its center. The first is at its first node.
struct PathSamples {
    std::vector<glm::dvec3> eyes;
    std::vector<glm::dvec3>
        ups;  ///< Up axes (steady_ups.h). They hardly depend on the number of cameras.
};
PathSamples sample_path(const CameraPath& path, const glm::dvec3& center, const glm::dvec3& up,
                        std::uint32_t count);

struct PlannedPath {
    std::vector<TourNode> nodes;
    CameraPath path;
    std::vector<glm::dvec3> samples;   ///< Equally spaced along the path; the first is a view.
    std::vector<glm::dvec3> ups;       ///< Up axis of the camera at each sample (steady_ups.h).
    std::vector<double> sample_votes;  ///< Field value at each sample, before any discount.
    double min_distance;  ///< Of the whole path from the mesh's center, densely sampled.
    double ms;            ///< Nodes and path, without choosing the views.
};

struct PathPlan {
    std::uint32_t frames = 120;

    void add_to(CLI::App& app);
    /// Needs at least two views.
    PlannedPath plan(const ChosenViews& chosen, const glm::dvec3& up, const Context& context) const;
};

/// `nodes samples ups min_distance ms` and further keys of nodes, samples and views.
nlohmann::ordered_json path_json(const std::string& model, const Mesh& mesh,
                                 const ChosenViews& chosen, const PlannedPath& planned);
void print_path(const std::string& title, const ChosenViews& chosen, const PlannedPath& planned);

}  // namespace rimline::tools
