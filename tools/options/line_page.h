#pragma once

// The page of a drawing, in mm: --page, --margin, --scale.

#include <glm/vec2.hpp>
#include <optional>

#include "tools/cli_classes.h"

namespace rimline::tools {

/// A PDF page is at most 5,080 mm wide and high.
constexpr double k_max_page_mm = 5000.0;

struct LinePage {
    std::optional<glm::dvec2> size_mm{
        {210.0, 297.0}};  ///< Not set: as large as drawing and margins.
    double margin_mm = 10.0;
    std::optional<double> mm_per_unit;  ///< Not set: as large as the page allows.

    void add_to(CLI::App& app);
    /// The space between the margins. `size_mm` must be set. Throws UsageError if there is none.
    glm::dvec2 space_mm() const;
    /// Width over height of that space; 4:3 where the size is not set.
    double aspect() const;
};

}  // namespace rimline::tools
