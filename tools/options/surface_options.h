#pragma once

// The options of finding umbrellas. Angles are in degrees on the command line.

#include <cstdint>
#include <optional>
#include <string>

#include "silhouette/points/point_surface.h"
#include "tools/cli_classes.h"

namespace rimline::tools {

class SurfaceOptions {
public:
    void add_to(CLI::App& app);
    /// Throws UsageError for an option that belongs to the other method.
    PointSurfaceOptions options() const;

private:
    std::uint32_t k_ = PointSurfaceOptions{}.k;
    std::string method_;  // Empty: the method that the given options belong to.
    bool drops_outliers_ = false;
    std::optional<double> gap_ratio_;
    std::optional<double> omega_, omega_t_, phi_;  // Degrees.
    std::optional<double> gamma_;
};

}  // namespace rimline::tools
