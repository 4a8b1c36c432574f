#pragma once

// `rimline bench views`: the views chosen by planes' votes beside those of other measures
// (view_measures.h), and the light chosen by votes beside other lights.
//
// For the k views of each way of choosing: the share of faces whose center is seen from at least one; the
// angles between them; whether two are on opposite sides, where models that are nearly flat or symmetric
// show the same outline. For the first view: the angle by which it moves when the model has a quarter of
// its faces, or when its vertices have moved by a thousandth of its radius.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/vulkan/device.h"
#include "silhouette/mesh/mesh.h"
#include "tools/bench/targets.h"
#include "tools/command.h"

namespace rimline::tools {

struct ViewsBenchOptions {
    std::uint32_t views = 4;
    std::uint32_t candidates = 256;  ///< Of the other measures.
    std::uint32_t random_sets = 20;
    std::uint32_t random_lights = 10;
    std::uint32_t seed = 1;
};

/// The measures of one way of choosing views.
struct ViewSet {
    std::string name;
    std::vector<glm::dvec3> eyes;  ///< Empty for random choice, which is the mean of many.
    double seen = 0.0;             ///< Share of the faces.
    double min_apart_deg = 0.0, mean_apart_deg = 0.0, max_apart_deg = 0.0;
    /// The angles by which the first view moves. Nothing for a simplified mesh without faces.
    std::optional<double> simplified_deg, noisy_deg;
};

/// One way of lighting the best views: means over them.
struct LightSet {
    std::string name;
    double away = 0.0;      ///< Share of visible pixels that turn away from the light.
    double unlit = 0.0;     ///< The same, and those in a cast shadow.
    double contrast = 0.0;  ///< Mean gradient of shading per hundredth of the picture's side.
};

struct ViewsResult {
    std::string model;
    std::uint32_t faces = 0;
    std::vector<ViewSet> sets;             ///< Ours first.
    std::vector<LightSet> lights;          ///< Ours first.
    std::uint64_t renders = 0;             ///< Of ours: viewpoints drawn.
    std::uint64_t own_candidates = 0;      ///< Of ours: candidates.
    std::uint64_t lattice_candidates = 0;  ///< Candidates if all samples of the lattice were.
    double ms = 0.0;                       ///< Of ours: field and views.
};

/// The mesh must have an extent (check_has_extent). Throws the errors of devices.
ViewsResult bench_views(const std::string& model, const Mesh& mesh, const Device& device,
                        const ViewsBenchOptions& options, const Context& context);

/// Targets for the bunny; none for other models.
std::vector<Target> targets_of(const ViewsResult& result);

}  // namespace rimline::tools
