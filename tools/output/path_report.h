#pragma once

// Planning a camera path through chosen views, and what there is to say of it: what `path` does with a
// device and without.

#include <CLI/App.hpp>
#include <cstdint>
#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "silhouette/field/camera_path.h"
#include "silhouette/field/camera_tour.h"
#include "tools/options/view_choice.h"

namespace rimline::tools {

struct PlannedPath {
    std::vector<TourNode> nodes;
    CameraPath path;
    std::vector<glm::dvec3> samples;  ///< At the same distance along the path, the first at a view.
    std::vector<glm::dvec3> ups;      ///< Of a camera at each sample (steady_ups.h).
    std::vector<double> sample_votes;  ///< Of the first field.
    double min_distance;  ///< From the mesh's center, of all the path as densely sampled.
    double ms;            ///< Nodes and path, without choosing views.
};

struct PathPlan {
    std::uint32_t frames = 120;

    void add_to(CLI::App& app);
    /// Of two views or more.
    PlannedPath plan(const ChosenViews& chosen, const glm::dvec3& up, const Context& context) const;
};

/// `nodes samples ups min_distance ms` and what belongs to them.
nlohmann::ordered_json path_json(const std::string& model, const Mesh& mesh,
                                 const ChosenViews& chosen, const PlannedPath& planned);
void print_path(const std::string& title, const ChosenViews& chosen, const PlannedPath& planned);

}  // namespace rimline::tools
