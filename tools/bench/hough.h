#pragma once

// What silhouettes of one model cost: the octree and its tracker against the best brute force there is,
// in one run.
//
// Every case first checks its results, and times nothing where one differs. Cases:
//   extraction   static, from viewpoints spread over the sphere at one, two and three radii;
//   update       with its change set, half a degree a frame on an orbit at two radii;
//   worst        with its change set, on a random path with jumps, against a fresh extraction a frame.
//
// Up to a million faces all points are taken that are asked for; above, fewer in proportion, at least
// k_min_points, so that a case takes about as long on any model. Every result is compared with packed
// brute force, and that with the scalar oracle at about k_scalar_faces faces' worth of points.

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
    double mean_size = 0.0;        ///< Edges on the silhouette, a point.
    double mean_flips = 0.0;       ///< Faces that turn, a frame; 0 where nothing moves.
    std::string difference{};      ///< The first from brute force; the case is not timed then.
    std::vector<Times> methods{};  ///< Ours first.
};

/// The updates of the worst case against fresh extractions, frame by frame.
struct WorstUpdate {
    double work = 0.0;        ///< The greatest ratio of box, face and edge checks.
    double p999 = 0.0;        ///< The ratio of both p99.9.
    double frame_p999 = 0.0;  ///< p99.9 of the frames' own ratios.
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
    double vtk_mean_size = 0.0;  ///< Edges on our silhouettes of VTK's frames.

    double bytes_a_face() const {
        return static_cast<double>(octree_bytes + tracker_bytes) / faces;
    }
    /// Empty when all is as it should be.
    std::string difference() const;
};

ModelResult bench_hough(const std::string& model, const Mesh& mesh,
                        const HoughBenchOptions& options, const Context& context);

/// How many of `asked` points a mesh of so many faces gets.
std::uint32_t point_count(std::uint32_t asked, std::uint32_t faces);

/// The baseline's median over ours, at the points that the baseline was given.
double ratio(const Times& baseline, const Times& ours);

}  // namespace rimline::tools
