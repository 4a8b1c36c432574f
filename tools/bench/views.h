#pragma once

// `rimline bench views`: the views that planes vote for beside those of other measures (view_measures.h),
// and the light they vote for beside others.
//
// Of k views of each way of choosing: the share of faces whose middle is seen from at least one; how far
// apart they are; whether two look from opposite sides, which of models that are nearly flat or symmetric
// shows the same outline twice. Of the first view: by how many degrees it moves when the model has a
// quarter of its faces, or its vertices have moved by a thousandth of its radius.

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

/// What one way of choosing views is worth.
struct ViewSet {
    std::string name;
    std::vector<glm::dvec3> eyes;  ///< Of random choice none: it stands for the mean of many.
    double seen = 0.0;             ///< Share of the faces.
    double min_apart_deg = 0.0, mean_apart_deg = 0.0, max_apart_deg = 0.0;
    /// By which the first view moves; of a mesh so small that a quarter of its faces is none, only by noise.
    std::optional<double> simplified_deg, noisy_deg;
};

/// One way of lighting the best views: means over them.
struct LightSet {
    std::string name;
    double away = 0.0;      ///< Share of visible pixels that turn away from the light.
    double unlit = 0.0;     ///< The same, and those in a cast shadow.
    double contrast = 0.0;  ///< Mean gradient of shading, for each hundredth of the picture's side.
};

struct ViewsResult {
    std::string model;
    std::uint32_t faces = 0;
    std::vector<ViewSet> sets;             ///< Ours first.
    std::vector<LightSet> lights;          ///< Ours first.
    std::uint64_t renders = 0;             ///< Of ours: viewpoints drawn ...
    std::uint64_t own_candidates = 0;      ///< ... of so many candidates,
    std::uint64_t lattice_candidates = 0;  ///< and so many if all of the lattice's samples were.
    double ms = 0.0;                       ///< Of ours: field and views.
};

/// Of a mesh with an extent (check_has_extent). Throws what devices throw.
ViewsResult bench_views(const std::string& model, const Mesh& mesh, const Device& device,
                        const ViewsBenchOptions& options, const Context& context);

/// What performance.md asks of the bunny, and of every model's first view.
std::vector<Target> targets_of(const ViewsResult& result);

}  // namespace rimline::tools
