#pragma once

// `rimline bench points`: the borders and normals that PointSurface finds from the vertices of a mesh
// alone, with one set of options for all models, beside the common rule (gap_rule.h).
//
// The truth is the mesh (point_truth.h). A border vertex without the label is missed; another vertex with
// the label is extra. Both are counted relative to the border vertices (Table 5.1 of the thesis). An open
// model is found if at most 4% are missed and 7% extra. A closed model is found if at most 10 are extra
// without those around holes in its samples; fandisk must have none.

#include <cstdint>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/bench/perturbed_points.h"
#include "tools/bench/silhouette_hits.h"
#include "tools/command.h"

namespace rimline::tools {

struct BorderCount {
    std::string method;
    std::uint32_t missed = 0, extra = 0;
    std::uint32_t missed_wide = 0;  ///< Those missed where the opening is wide.
    /// Extra points of a closed model around holes (count_around_holes). 0 where `extra` is at most 10.
    std::uint32_t around_holes = 0;
};

/// How narrow the creases are that a method finds: the vertices on edges where faces turn by more than 40 degrees, and
/// their neighbors that are on none.
struct CreaseCount {
    std::string method;
    std::uint32_t on = 0, labeled = 0;    ///< Of those on edges, those labeled as features.
    std::uint32_t beside = 0, heavy = 0;  ///< Of the neighbors, those with a weight above 0.4.
    std::uint32_t extra = 0;  ///< Labeled as features where no edge turns by 25 degrees.
};

/// The angle of a point's normal to the mean of the faces there. Of a point with several normals the greatest angle
/// from one of the faces to the nearest of them.
struct NormalErrors {
    double median_deg = 0.0, high_deg = 0.0;  ///< High: the 99th percentile.
    std::uint32_t wrong = 0;                  ///< Above 60 degrees from every face at the point.
    std::uint32_t wrong_apart = 0;  ///< Those of them without another sheet near the point.
};

struct PointsBenchResult {
    enum class Kind { wide, open, smooth, closed, unfit };  ///< See point_truth.h.
    std::string model;
    Kind kind = Kind::unfit;
    std::uint32_t points = 0, border = 0;
    std::uint32_t border_wide = 0;  ///< Border points where the opening is wide.
    /// robust, thesis, the gap rule by threshold, then the installed libraries.
    std::vector<BorderCount> counts;
    std::uint32_t feature = 0, undecided = 0;
    std::vector<CreaseCount> creases;  ///< robust, thesis.
    NormalErrors normals;              ///< Of the umbrellas.
    NormalErrors
        fitted_normals;  ///< Of the planes fitted to the nearest neighbors (pca_normals.h), what libraries do.
    SilhouetteComparison silhouettes;
    double points_per_second = 0.0;  ///< robust, on one thread, the best of three runs.

    /// Of a closed model: the greatest number of extra points allowed, and the number that counts.
    std::uint32_t extra_allowed() const;
    std::uint32_t charged(const BorderCount& count) const;
    /// Whether the method of `count` finds the model.
    bool is_found(const BorderCount& count) const;
};

struct PointsBenchOptions {
    /// Where points are added or left out, only borders and normals are measured.
    Perturbation perturbation;
    /// About as many points spread evenly over the mesh are measured in place of its vertices
    /// (even_samples.h), without perturbation. Their borders alone are measured. The kind is that of the mesh.
    bool is_even = false;
    /// Without Open3D and PCL, which take most of the time.
    bool without_libraries = false;
    /// Of the method that they name; the other has its defaults.
    PointSurfaceOptions surface;
};

PointsBenchResult bench_points(const std::string& model, const Mesh& mesh,
                               const PointsBenchOptions& options, const Context& context);

}  // namespace rimline::tools
