#pragma once

// The CLOUD argument: a file of points, or with --as-points any model without its faces.

#include <cstdint>
#include <string>

#include "silhouette/points/point_cloud.h"
#include "tools/cli_classes.h"
#include "tools/command.h"
#include "tools/options/model_argument.h"

namespace rimline::tools {

struct CloudArgument {
    std::string model;
    std::uint32_t subdivide = 0;
    std::string format = {};  ///< Of standard input.
    bool as_points = false;
    bool drop_bad = false;

    void add_to(CLI::App& app);
    /// Adds only the flags, for a command whose argument is a model or a cloud.
    void add_flags_to(CLI::App& app);

    /// Reads the cloud and shows progress. Throws Error, also for a model with faces without --as-points.
    PointCloud load(const Context& context) const;
    /// The same with progress of another kind (begin_call.h).
    PointCloud load(const BeginCall& begin) const;
};

}  // namespace rimline::tools
