#pragma once

// `rimline bench points`: how well PointSurface finds borders and normals again where a mesh's faces are
// thrown away, with one set of options for all models, beside the rule that people use (gap_rule.h).
//
// The truth is the mesh (point_truth.h). Missed are border vertices not labeled so, extra the others that
// are, both counted against the border vertices (Table 5.1 of the thesis). An open model is found where
// at most 4% are missed and 7% extra, a closed one where at most 10 are extra but for those around holes
// in its samples, of fandisk none at all.

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
    std::uint32_t missed_wide = 0;  ///< Of the missed, those where the opening is wide.
    /// Of the extra ones of a closed model (count_around_holes); not counted while extra is at most 10.
    std::uint32_t around_holes = 0;
};

struct PointsBenchResult {
    enum class Kind { wide, open, smooth, closed, unfit };  ///< As point_truth.h has them.
    std::string model;
    Kind kind = Kind::unfit;
    std::uint32_t points = 0, border = 0;
    std::uint32_t border_wide = 0;  ///< Of the border, where the opening is wide.
    /// robust, thesis, the gap rule by threshold, then other libraries' where they are installed.
    std::vector<BorderCount> counts;
    std::uint32_t feature = 0, undecided = 0;
    double median_error_deg = 0.0, high_error_deg = 0.0;  ///< Of normals; the 99th percentile.
    std::uint32_t wrong_normals = 0;  ///< Above 60 degrees from every face at the point.
    std::uint32_t wrong_apart = 0;    ///< Of these, where no other sheet crowds the point.
    SilhouetteComparison silhouettes;
    double points_per_second = 0.0;  ///< robust, one thread, the best of three.

    /// Of a closed model: the most extra points, and those that count.
    std::uint32_t extra_allowed() const;
    std::uint32_t charged(const BorderCount& count) const;
    /// By one of counts.
    bool is_found(const BorderCount& count) const;
};

/// Each coordinate of each vertex is moved by normally distributed noise first, the same for the same mesh, of
/// standard deviation `noise` times the mean length of the vertex's edges.
PointsBenchResult bench_points(const std::string& model, const Mesh& mesh, double noise,
                               const Context& context);

}  // namespace rimline::tools
