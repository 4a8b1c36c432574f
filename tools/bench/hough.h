#pragma once

// The time of silhouettes of one model: the octree and its tracker against brute force, in one run.
//
// Every case checks its results first, and is not timed where one differs. The cases:
//   extraction   static, from viewpoints spread over the sphere at one, two and three radii;
//   update       with its change set, half a degree a frame on an orbit at two radii;
//   worst        with its change set, on a random path with jumps, against a fresh extraction a frame.
//
// Up to a million faces a case takes all requested points. Above, it takes fewer in proportion, at least
// k_min_points, so that its time is about the same for any model. Every result is compared with
// brute_force_packed.h, and that is compared with the scalar oracle at so many points that the oracle tests about
// k_scalar_faces faces.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/bench/ceiling.h"
#include "tools/bench/contenders.h"
#include "tools/bench/vtk.h"
#include "tools/command.h"
#include "tools/commands/stream_bytes.h"

namespace rimline::tools {

constexpr std::uint32_t k_min_points = 60;
constexpr std::uint64_t k_scalar_faces = 50'000'000;

struct HoughBenchOptions {
    std::uint32_t viewpoints = 300;
    std::uint32_t frames = 720;         ///< Of the orbit.
    std::uint32_t worst_frames = 2000;  ///< Of the random path; 0 leaves the case out.
    std::uint32_t rounds = 5;
    std::uint32_t builds = 3;  ///< Of the octree; the median counts.
    bool vtk = true;           ///< Where it is installed.
};

struct CaseResult {
    std::string name;
    std::uint64_t points = 0;
    double mean_size = 0.0;        ///< Edges of the silhouette of a point.
    double mean_flips = 0.0;       ///< Faces that turn in a frame; 0 for extraction.
    std::string difference{};      ///< The first from brute force; the case is not timed then.
    std::vector<Times> methods{};  ///< The octree or tracker first.
};

/// The updates of the worst case compared with fresh extractions frame by frame.
struct WorstUpdate {
    double work = 0.0;        ///< The greatest ratio of box, face and edge checks.
    double p999 = 0.0;        ///< The ratio of the two p99.9.
    double frame_p999 = 0.0;  ///< The p99.9 of the ratios of single frames.
};

struct ModelResult {
    std::string model;
    std::uint32_t faces = 0;
    std::uint32_t edges = 0;
    double build_ms = 0.0;  ///< Of the octree, on all threads.
    std::uint64_t octree_bytes = 0;
    std::uint64_t tracker_bytes = 0;
    CaseResult extraction{"extraction"};
    CaseResult update{"update"};
    CaseResult worst{"worst"};
    StreamBytes stream;  ///< Of all frames of the update.
    std::optional<WorstUpdate> worst_update;
    std::optional<BruteForceCeiling> ceiling;
    VtkResult vtk;
    double vtk_mean_size = 0.0;  ///< Mean of our silhouettes' edges in VTK's frames.

    double bytes_a_face() const {
        return static_cast<double>(octree_bytes + tracker_bytes) / faces;
    }
    /// The first difference of all cases; empty if none.
    std::string difference() const;
};

ModelResult bench_hough(const std::string& model, const Mesh& mesh,
                        const HoughBenchOptions& options, const Context& context);

/// The number of points for a mesh of `faces` faces, where `asked` are requested.
std::uint32_t point_count(std::uint32_t asked, std::uint32_t faces);

/// The baseline's median over ours, at the points of the baseline.
double ratio(const Times& baseline, const Times& ours);

}  // namespace rimline::tools
