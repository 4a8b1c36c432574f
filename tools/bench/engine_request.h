#pragma once

// What `rimline bench engine` is asked for; free of Vulkan, for builds without the engine.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/command.h"

namespace rimline::tools {

struct EngineBenchOptions {
    std::uint32_t viewpoints = 64;  ///< Of the visible ratio.
    std::uint32_t frames = 24;      ///< Of an orbit, half a degree a frame.
    std::uint32_t rounds = 5;       ///< Of the visible ratio.
};

struct EngineBenchRequest {
    std::vector<std::string> models;
    std::uint32_t subdivide = 0;
    std::string device;
    bool check = false;
    bool growth = false;
    std::uint32_t min_faces = 10'000;
    std::uint32_t max_faces = 300'000;  ///< Of --growth.
    EngineBenchOptions options;
};

/// The whole suite, printed. In a build without the engine, an Error that says so.
ExitStatus run_bench_engine(const EngineBenchRequest& request, const Context& context);

}  // namespace rimline::tools
