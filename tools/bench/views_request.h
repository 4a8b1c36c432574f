#pragma once

// What `rimline bench views` is asked for; free of Vulkan, for builds without the engine.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/command.h"

namespace rimline::tools {

struct ViewsBenchOptions {
    std::uint32_t views = 4;
    std::uint32_t candidates = 256;  ///< Of the other measures.
    std::uint32_t random_sets = 20;
    std::uint32_t random_lights = 10;
    std::uint32_t seed = 1;
};

struct ViewsBenchRequest {
    std::vector<std::string> models;
    std::uint32_t subdivide = 0;
    std::string device;
    bool check = false;
    /// Where not empty: the experiments as pictures into this folder, in place of the measures.
    std::string pictures;
    std::optional<glm::vec3> up;  ///< Of pictures.
    ViewsBenchOptions options;
};

/// The whole suite, printed. In a build without the engine, an Error that says so.
ExitStatus run_bench_views(const ViewsBenchRequest& request, const Context& context);

}  // namespace rimline::tools
