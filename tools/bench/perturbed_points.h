#pragma once

// The vertices of a mesh as a scanner would give them: with noise, with points that lie on no surface, and more
// sparsely on one side than on the other. The same for the same mesh and amounts.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/bench/point_truth.h"

namespace rimline::tools {

struct Perturbation {
    /// The standard deviation by which every coordinate is moved, in mean lengths of the vertex's edges.
    double noise = 0.0;
    /// How many points are added, as a share of the vertices: evenly distributed in the bounding box, which is a tenth
    /// wider on each side.
    double outliers = 0.0;
    /// Vertices are left out with a probability that grows along the longest axis of the bounding box from 0 to this.
    double uneven = 0.0;

    bool is_none() const noexcept { return noise == 0.0 && keeps_vertices(); }
    bool keeps_vertices() const noexcept { return outliers == 0.0 && uneven == 0.0; }
};

struct PerturbedPoints {
    static constexpr std::uint32_t k_none = 0xffffffffu;

    std::vector<glm::dvec3> positions;
    std::vector<std::uint32_t>
        vertices;  ///< Of each point; k_none for those that were added, which come last.
};

PerturbedPoints perturb(const PointTruth& truth, const Perturbation& perturbation);

}  // namespace rimline::tools
