#pragma once

// How `render` finds outlines: as lines, or by a comparator of pixels.

#include <optional>
#include <string>

#include "engine/renderer_options.h"
#include "tools/cli_classes.h"

namespace rimline::tools {

class OutlineOptions {
public:
    void add_to(CLI::App& app);
    /// Throws UsageError for an option of another way to outlines than the one chosen. `app` has the options of
    /// lines too.
    void check_usage(const CLI::App& app) const;

    bool draws_lines() const { return method_ == "lines"; }
    Outline outline() const;

private:
    std::string method_ = "lines";
    std::optional<double> depth_step_, normal_step_;
};

}  // namespace rimline::tools
