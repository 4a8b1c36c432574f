#pragma once

// What the service costs a program that draws: one camera and many lights around models, at a steady
// frame rate.
//
// The calling thread plays the renderer. At the beginning of each frame it takes all change sets and
// posts where every point is now, then it sleeps until the next. The camera turns by half a degree a
// frame; each light turns slower, around an axis and at a distance of its own; a few are directions,
// and every fourth stands still and is posted all the same. Trackers take the models in turn.
//
// First some frames are followed by change sets alone and compared with brute force. The processor time
// of the workers is the process's without the calling thread's. Beside it stands what the same moves
// cost when one thread makes them in a loop, without a service: the rest is queues, copies and wake-ups.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "silhouette/mesh/mesh.h"
#include "tools/command.h"

namespace rimline::tools {

struct ServiceBenchOptions {
    std::uint32_t trackers = 64;  ///< The camera and the lights.
    std::uint32_t frames = 600;
    double frames_per_second = 60.0;
    std::uint32_t workers = 0;  ///< As SilhouetteServiceOptions::workers.
};

struct ServiceBenchModel {
    std::string name;
    const Mesh* mesh;
};

struct Quantiles {
    double median_us = 0.0;
    double p99_us = 0.0;
    double p999_us = 0.0;
    double max_us = 0.0;
};

struct ServiceResult {
    std::vector<std::string> models;
    std::uint64_t faces = 0;  ///< Of all models.
    std::uint32_t trackers = 0;
    std::uint32_t workers = 0;
    std::uint32_t frames = 0;
    double seconds = 0.0;
    std::string difference{};  ///< From brute force; nothing is measured then.

    std::uint64_t posts = 0;
    std::uint64_t moves = 0;
    std::uint64_t superseded = 0;   ///< Points replaced before a worker began with them.
    std::uint64_t lost = 0;         ///< Change sets lost for want of memory.
    std::uint64_t late_frames = 0;  ///< Begun a whole frame late: the machine was busy.

    double core_share = 0.0;           ///< Of one core, what the workers took.
    double renderer_core_share = 0.0;  ///< What posting and taking took on the calling thread.
    double service_move_us = 0.0;      ///< Processor time of the workers, a move.
    double direct_move_us = 0.0;       ///< The same moves in a loop on one thread.
    Quantiles post;                    ///< Duration of post(), clock reading included.
    Quantiles take;                    ///< Duration of a take() that had something.
    Quantiles latency;         ///< From post to publication, the wait behind others included.
    Quantiles camera_latency;  ///< Of the first tracker, which is posted first.
};

/// Takes frames / frames_per_second seconds, and some for building and checking. Throws what making
/// trackers and threads throws.
ServiceResult bench_service(std::span<const ServiceBenchModel> models,
                            const ServiceBenchOptions& options, const Context& context);

}  // namespace rimline::tools
