#pragma once

// The cost of the service in a program that draws: one camera and many lights around models, at a constant
// frame rate.
//
// The calling thread acts as the renderer. At the beginning of each frame it takes all change sets and
// posts the position of every point. Then it sleeps until the next frame. The camera turns by half a degree
// a frame. Each light turns more slowly, around its own axis and at its own distance. Some lights are
// directions. Every fourth light does not move and is posted too. The models are assigned to the trackers
// in turn.
//
// First, copies of the silhouettes are updated by change sets alone for some frames and compared with brute
// force. The processor time of the workers is the process's without the calling thread's. It is compared
// with the time of the same moves in a loop on one thread, without a service. The difference is the cost of
// queues, copies and wake-ups.

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
    std::string difference{};  ///< The first from brute force; nothing is measured then.

    std::uint64_t posts = 0;
    std::uint64_t moves = 0;
    std::uint64_t superseded = 0;   ///< Points replaced before a worker took them.
    std::uint64_t lost = 0;         ///< Change sets lost because memory ran out.
    std::uint64_t late_frames = 0;  ///< Frames that began a whole frame late.

    double core_share = 0.0;           ///< The share of one core that the workers used.
    double renderer_core_share = 0.0;  ///< The same of posting and taking, on the calling thread.
    double service_move_us = 0.0;      ///< Processor time of the workers for a move.
    double direct_move_us = 0.0;       ///< The same moves in a loop on one thread.
    Quantiles post;                    ///< Duration of post(), clock reading included.
    Quantiles take;                    ///< Duration of a take() with a result.
    Quantiles latency;                 ///< From post to publication, with the wait for others.
    Quantiles camera_latency;          ///< The same of the first tracker, which is posted first.
};

/// Takes frames / frames_per_second seconds, and some for building and checking. Throws the errors of
/// trackers and threads.
ServiceResult bench_service(std::span<const ServiceBenchModel> models,
                            const ServiceBenchOptions& options, const Context& context);

}  // namespace rimline::tools
