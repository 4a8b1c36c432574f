#pragma once

// The data of the thesis's Figures 3.1 and 3.8 to 3.11 and of the single-origin columns of Table 4.2,
// reproduced (docs/results/hough.md): the literal octree and tracker, the same octree in dual space, and our index.
// Work is counted and not timed, so the numbers are the same on every machine. Every result is compared with
// brute force.
//
// The text does not define the following; we choose: the origin, the unit and the viewpoints on three spheres
// are those of unit_sphere.h; the circle has two radii and half-degree steps; random points lie between one
// and three radii. `bench hough --readings` measures other choices (readings.h).

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/methods/literal/literal_counters.h"
#include "tools/bench/layout_picture.h"
#include "tools/bench/unit_sphere.h"
#include "tools/command.h"

namespace rimline::tools {

struct FigureOptions {
    std::uint32_t viewpoints = 3865;
    std::uint32_t frames = 720;  ///< Frames of a full turn.
    double orbit_radii = 2.0;
    std::uint32_t random_points = 10;  ///< At each resolution.
    /// Numbers of faces to cluster to (vertex_clustering.h). Those above the mesh's own are ignored.
    std::vector<std::uint32_t> resolutions{2000, 4000, 8000, 16000, 32000, 64000, 128000};
    /// A mesh with more faces is clustered to this number first.
    std::uint32_t max_faces = 0xffffffffu;
    std::uint32_t sample = 6000;  ///< Points of a scatter plot.
};

/// Figures 3.1 and 3.11: one space.
struct PointSpread {
    std::uint32_t points = 0;
    std::uint32_t left_out = 0;  ///< Faces without a point in this space.
    double farthest = 0.0;       ///< In units of the radius; in dual space, of its inverse.
    double percentile_99 = 0.0;  ///< Of the distances from the origin.
    std::vector<std::uint32_t> distances;  ///< Counts in equal steps from 0 to the farthest.
    std::vector<std::array<double, 3>> sample;
    std::vector<std::uint32_t> leaf_depths;
    std::uint32_t nodes = 0;
};

/// Static extraction (Table 4.2, Figure 3.8). Values are means over points.
struct ExtractionWork {
    double radius = 0.0;  ///< Of the sphere of viewpoints; 0 for random ones.
    std::uint32_t points = 0;
    double silhouette = 0.0;
    std::array<double, 2> literal_boxes{};      ///< PBVs and EBVs; leaves of one point have none.
    std::array<double, 2> literal_all_boxes{};  ///< With the boxes of leaves of one point.
    double literal_faces = 0.0;
    double index_boxes = 0.0;  ///< Eight a node.
    double index_faces = 0.0;  ///< Thirty-two a block of edges.
};

struct ResolutionWork {
    std::uint32_t faces = 0;
    ExtractionWork work;
};

/// Figures 3.9 and 3.10. One value a frame: the move to the angle of that frame.
struct OrbitWork {
    struct Counts {
        std::vector<std::uint32_t> boxes, faces;
    };
    Counts full, incremental, as_written;    ///< The three of LiteralUpdate.
    Counts dual;                             ///< Full traversal of the dual octree, tight boxes.
    Counts full_octants, dual_octants;       ///< Full traversals by whole octants.
    Counts index;                            ///< SilhouetteTracker: eight boxes a node.
    std::vector<std::uint32_t> turned;       ///< Faces that turn.
    std::vector<std::uint32_t> wrong_faces;  ///< Wrong bits of `as_written`.
    std::vector<std::uint32_t> contained;    ///< Faces that full traversal turns untested.
    /// Box checks of the full traversal above all active-set candidates: the most that a walk can save.
    std::vector<std::uint32_t> above_candidates;
};

struct FigureData {
    std::string model;
    std::uint32_t faces = 0;
    std::uint32_t edges = 0;
    UnitSphere unit;
    std::uint32_t sfo_edges = 0;  ///< On the silhouette from the origin.
    PointSpread hough, dual;
    std::vector<ExtractionWork> extraction;  ///< One a sphere.
    OrbitWork orbit;
    std::vector<ResolutionWork> resolutions;  ///< The last one is the mesh itself.
    LayoutPicture layout;
    std::string difference{};  ///< The first from brute force; counts are invalid then.
};

/// Takes some minutes for a quarter of a million faces. All numbers of a mesh without faces are zero.
FigureData bench_figures(const std::string& model, const Mesh& mesh, const FigureOptions& options,
                         const Context& context);

/// Prints a table of means on standard output.
void print_summary(const FigureData& data);

/// The format that tools/figures/plot_figures.py reads.
nlohmann::ordered_json to_json(const FigureData& data);

}  // namespace rimline::tools
