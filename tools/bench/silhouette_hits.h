#pragma once

// How well silhouettes of points find a mesh's silhouette again where its faces are thrown away, beside
// thresholding normals (Zakaria and Seidel 2004: |n·v| < t).
//
// True are the vertices of the mesh's silhouette edges, without borders, from the same viewpoint: sixteen,
// evenly around, 2.5 radii from the center, counted together. A point that is found is right where it is
// true, and near where it or a neighbor of it in the mesh is; a true vertex likewise is found or near.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "silhouette/points/point_surface.h"
#include "tools/command.h"

namespace rimline::tools {

/// Over all viewpoints. Shares are in [0, 1]; 1 where nothing is asked for.
struct SilhouetteHits {
    std::uint64_t truth = 0;       ///< True vertices.
    std::uint64_t found = 0;       ///< Points said to be on the silhouette.
    std::uint64_t hits = 0;        ///< Of these, true.
    std::uint64_t near_found = 0;  ///< Of the found, near.
    std::uint64_t near_truth = 0;  ///< Of the true, near.

    double recall() const noexcept { return share(hits, truth); }
    double precision() const noexcept { return share(hits, found); }
    double near_recall() const noexcept { return share(near_truth, truth); }
    double near_precision() const noexcept { return share(near_found, found); }
    /// Their harmonic mean.
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

/// t, from 0.002 to 0.86: each the fourth root of two times the one before.
constexpr std::uint32_t k_threshold_count = 36;
double threshold(std::uint32_t number);

struct SilhouetteComparison {
    SilhouetteHits umbrellas;
    std::vector<SilhouetteHits> thresholds;  ///< By number, with the normals of the umbrellas.
};

/// `surface` is of the mesh's vertices, in their order. O(viewpoints * (vertices + edges)).
SilhouetteComparison compare_silhouettes(const Mesh& mesh, const PointSurface& surface,
                                         const LongCall& call);

struct ComparedModel {
    std::string name;
    std::string kind;  ///< Means are of each by itself, and of all.
    const SilhouetteComparison* silhouettes;
};

/// The number of the threshold with the best score, in the mean over `models`, which may be none.
std::uint32_t best_threshold(const std::vector<ComparedModel>& models);

/// A line a model, and the means.
void print_silhouettes(const std::vector<ComparedModel>& models);
nlohmann::ordered_json to_json(const SilhouetteComparison& silhouettes);

}  // namespace rimline::tools
