#pragma once

// `rimline bench hough --readings`: counts that depend on what the thesis leaves open, for each choice
// (docs/results/hough.md).
//
//   Box tests   Table 4.2 does not say how a box is tested against a v-sphere. The box checks of static
//               extraction by each test of box_tests.h, from the viewpoints of unit_sphere.h.
//   Orbits      Figure 3.9 gives neither the radius of its circle nor the step. The box checks of full
//               traversals in Hough and in dual space (transform_octree.h) for radii and steps, means of a
//               frame over a full turn in the xz plane.
//
// Every count of --readings is of a traversal with a correct result: box tests decide only what is certain,
// and the face bits of orbits are compared with brute force.

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/bench/box_tests.h"
#include "tools/command.h"

namespace rimline::tools {

struct ReadingOptions {
    std::uint32_t viewpoints = 3865;
    std::vector<double> radii{1.05, 1.5, 2.0, 3.0, 5.0, 10.0};  ///< Of the unit sphere.
    std::vector<double> steps_degrees{0.5, 1.0, 2.0, 5.0};      ///< Divisors of a full turn.
    /// A mesh with more faces is clustered to this number first.
    std::uint32_t max_faces = 0xffffffffu;
};

struct OrbitReading {
    double radii = 0.0;
    double step_degrees = 0.0;
    /// Mean box checks of a frame: tight boxes, then whole octants.
    std::array<double, 2> hough{}, dual{};
};

struct Readings {
    std::string model;
    std::uint32_t faces = 0;
    std::array<double, k_box_tests.size()> boxes{};  ///< Mean PBVs and EBVs of an extraction.
    double ebv_first = 0.0;  ///< By the exact test, EBVs tested before PBVs.
    std::vector<OrbitReading> orbits;
    std::string difference{};  ///< The first from brute force; empty if none.
};

Readings bench_readings(const std::string& model, const Mesh& mesh, const ReadingOptions& options,
                        const Context& context);

void print_result(const Readings& readings);
nlohmann::ordered_json to_json(const Readings& readings);

}  // namespace rimline::tools
