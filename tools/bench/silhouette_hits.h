#pragma once

// How well silhouettes of a mesh's vertices alone agree with the mesh's silhouette, beside a threshold for
// normals (Zakaria and Seidel 2004: |n·v| < t).
//
// The true points are the vertices of the mesh's silhouette edges, without borders, from the same
// viewpoint. There are sixteen viewpoints, distributed evenly at 2.5 radii from the center; their counts
// are added. A found point is right if it is true, and near if it or one of its neighbors in the mesh is
// true. In the same way a true vertex is found or near.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "silhouette/points/point_surface.h"
#include "tools/command.h"

namespace rimline::tools {

/// Sums over all viewpoints. Shares are in [0, 1], and 1 where the divisor is 0.
struct SilhouetteHits {
    std::uint64_t truth = 0;       ///< True vertices.
    std::uint64_t found = 0;       ///< Points reported as silhouette points.
    std::uint64_t hits = 0;        ///< Found points that are true.
    std::uint64_t near_found = 0;  ///< Found points that are near.
    std::uint64_t near_truth = 0;  ///< True points that are near.

    double recall() const noexcept { return share(hits, truth); }
    double precision() const noexcept { return share(hits, found); }
    double near_recall() const noexcept { return share(near_truth, truth); }
    double near_precision() const noexcept { return share(near_found, found); }
    /// The harmonic mean of both.
    double score() const noexcept { return mean(recall(), precision()); }
    double near_score() const noexcept { return mean(near_recall(), near_precision()); }

private:
    static double share(std::uint64_t part, std::uint64_t all) noexcept {
        return all == 0 ? 1.0 : double(part) / double(all);
    }
    static double mean(double a, double b) noexcept {
        return a + b > 0.0 ? 2.0 * a * b / (a + b) : 0.0;
    }
};

/// The values of t, from 0.002 to 0.86. Each is the fourth root of two times the one before.
constexpr std::uint32_t k_threshold_count = 36;
double threshold(std::uint32_t number);

struct SilhouetteComparison {
    SilhouetteHits umbrellas;
    std::vector<SilhouetteHits>
        thresholds;  ///< One a threshold, with the normals of the umbrellas.
};

/// `surface` must be that of the mesh's vertices, in their order. O(viewpoints * (vertices + edges)).
SilhouetteComparison compare_silhouettes(const Mesh& mesh, const PointSurface& surface,
                                         const LongCall& call);

struct ComparedModel {
    std::string name;
    std::string kind;  ///< Means are computed for each kind and for all.
    const SilhouetteComparison* silhouettes;
};

/// The number of the threshold with the best mean score over `models`, which may be empty.
std::uint32_t best_threshold(const std::vector<ComparedModel>& models);

/// Prints a line a model, and the means.
void print_silhouettes(const std::vector<ComparedModel>& models);
nlohmann::ordered_json to_json(const SilhouetteComparison& silhouettes);

}  // namespace rimline::tools
