#pragma once

// The time of a frame's silhouette for growing meshes, from moving the viewpoint to slots on the GPU: the
// tracker and its stream, against extraction from scratch in compute shaders. Also the time of a whole
// frame with lines from slots, against the adjacency path, which needs no slots. Runs on any device; a GPU
// reports its own times beside the clock's.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/vulkan/device.h"
#include "tools/bench/record_time.h"
#include "tools/command.h"

namespace rimline::tools {

struct EngineGrowthOptions {
    std::uint32_t min_faces = 10'000;
    std::uint32_t max_faces = 300'000;
    std::uint32_t frames = 24;  ///< Of an orbit, half a degree a frame.
};

/// Medians over the frames of an orbit, half a degree a frame.
struct EngineGrowthStep {
    std::uint32_t faces = 0;
    std::uint32_t silhouette = 0;         ///< Edges in the last frame.
    std::string difference{};             ///< Between tracker and compute shaders; empty if none.
    double move_ms = 0.0;                 ///< The tracker, on one CPU thread.
    double stream_ms = 0.0;               ///< The same, and scattering the change set on the GPU.
    std::optional<double> stream_gpu_ms;  ///< The device's share of stream_ms.
    double compute_ms = 0.0;
    std::optional<double> compute_gpu_ms;
    double lines_ms = 0.0;      ///< A frame with lines from slots, tracker and stream included.
    double adjacency_ms = 0.0;  ///< 0 without geometry shaders.
    RecordTimes record;
};

/// Measures knots of 10,000, 30,000, 100,000 ... faces and calls `on_step` after each.
std::vector<EngineGrowthStep> bench_engine_growth(
    const EngineGrowthOptions& options, const Device& device,
    const std::function<void(const EngineGrowthStep&)>& on_step, const Context& context);

/// The least size from which on the stream is faster than compute shaders, by the clock. Nothing where it is
/// slower at the largest size.
std::optional<std::uint32_t> stream_overtakes_at(const std::vector<EngineGrowthStep>& steps);

}  // namespace rimline::tools
