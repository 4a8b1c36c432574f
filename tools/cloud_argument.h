#pragma once

// The CLOUD argument: a file of points, or with --as-points any model whose faces are dropped.

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

#include "silhouette/points/point_cloud.h"
#include "tools/command.h"

namespace rimline::tools {

struct CloudArgument {
    std::string model;
    std::uint32_t subdivide = 0;
    bool as_points = false;
    bool drop_bad = false;

    void add_to(CLI::App& app);

    /// Reads it, with progress. Throws Error: also for a model with faces without --as-points.
    PointCloud load(const Context& context) const;
};

}  // namespace rimline::tools
