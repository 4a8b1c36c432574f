#pragma once

// The page of a drawing, in mm: --page, --margin, --scale.

#include <CLI/App.hpp>

#include "tools/output/drawing_page.h"

namespace rimline::tools {

struct LinePageOptions {
    PageFormat format;

    void add_to(CLI::App& app);
    bool has_scale() const noexcept { return format.mm_per_unit.has_value(); }
};

}  // namespace rimline::tools
