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
    /// Of normals; high: the 99th percentile. Of a feature point the greatest angle from a face at the point to the
    /// nearest of its normals; of any other the angle to the mean of the faces.
    double median_error_deg = 0.0, high_error_deg = 0.0;
    std::uint32_t wrong_normals = 0;  ///< Above 60 degrees from every face at the point.
    std::uint32_t wrong_apart = 0;    ///< Those of them without another sheet near the point.
    SilhouetteComparison silhouettes;
    double points_per_second = 0.0;  ///< robust, on one thread, the best of three runs.

    /// Of a closed model: the greatest number of extra points allowed, and the number that counts.
    std::uint32_t extra_allowed() const;
    std::uint32_t charged(const BorderCount& count) const;
    /// Whether the method of `count` finds the model.
    bool is_found(const BorderCount& count) const;
};

struct PointsBenchOptions {
    /// Each coordinate of each vertex is moved by normally distributed noise first, the same for the same mesh,
    /// of standard deviation `noise` times the mean length of the vertex's edges.
    double noise = 0.0;
    /// About as many points spread evenly over the mesh are measured in place of its vertices
    /// (even_samples.h), without noise. Their borders alone are measured. The kind is that of the mesh.
    bool is_even = false;
};

PointsBenchResult bench_points(const std::string& model, const Mesh& mesh,
                               const PointsBenchOptions& options, const Context& context);

}  // namespace rimline::tools
