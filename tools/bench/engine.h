#pragma once

// `rimline bench engine`: bytes streamed, frames with lines against the paths that read the whole mesh,
// shadow volumes, and visible ratios against one target with a barrier for each viewpoint.
//
// The ways to one result alternate frame by frame; the time of a way is the median. Pictures and counts are
// compared first. Times are the clock's, from moving the trackers to the finished picture.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/vulkan/device.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/picture.h"
#include "tools/bench/pass_medians.h"
#include "tools/bench/record_time.h"
#include "tools/bench/targets.h"
#include "tools/command.h"

namespace rimline::tools {

struct EngineBenchOptions {
    std::uint32_t viewpoints = 64;  ///< Of the visible ratio.
    std::uint32_t frames = 24;      ///< Of an orbit, half a degree a frame.
    std::uint32_t rounds = 5;       ///< Of the visible ratio.
};

/// Bytes of frames of one step size.
struct StreamedBytes {
    double step_deg = 0.0;
    double streamed = 0.0;  ///< Mean of a frame.
    double full = 0.0;      ///< Mean of the smallest full rewrite.
};

/// One way to a result.
struct EngineTime {
    std::string name;
    double median_ms = 0.0;  ///< Of a frame, or of all viewpoints.
};

struct EngineResult {
    std::string model;
    std::uint32_t faces = 0;
    bool is_closed = false;
    bool is_solid = false;     ///< Frames are drawn without the backs of its faces (SceneInstance).
    std::string difference{};  ///< The first difference between two ways; the rest is empty then.
    std::vector<StreamedBytes> bytes;
    std::vector<EngineTime>
        lines;  ///< Frames with lines; the slots by geometry shader or pulling first.
    std::vector<EngineTime> shadows;  ///< Frames with shadows and without lines.
    RecordTimes record;
    /// Frames with lines and a sun, without and with timestamps: what they cost.
    std::vector<EngineTime> timestamps;
    std::vector<PassTime> passes;    ///< Of these frames, medians by timestamps; empty without.
    std::vector<EngineTime> ratios;  ///< Ours first, then the baseline.

    const EngineTime* find_line_path(const std::string& name) const;
};

/// Whether two pictures of one size differ in more than the rare pixel where two ways round a corner
/// differently.
bool draws_other_pixels(const Picture& a, const Picture& b);

/// The mesh must have an extent (check_has_extent). Throws the errors of devices and renderers.
EngineResult bench_engine(const std::string& model, const Mesh& mesh, const Device& device,
                          const EngineBenchOptions& options, const Context& context);

/// Targets for bytes of igea, and for times of closed meshes of 60,000 to 110,000 faces; that of visible ratios only
/// where the device is of the CPU type. None for other meshes.
std::vector<Target> targets_of(const EngineResult& result, bool is_cpu);

}  // namespace rimline::tools
