#pragma once

// Results of `rimline bench lines` for tests, without a measurement.

#include <cstdint>

#include "tools/bench/lines.h"

namespace rimline::tools {

/// A model whose drawings take `ms`, and whose rays take `ratio` times as long.
inline LinesResult line_result_of(std::uint32_t faces, double ms, double ratio) {
    LinesResult result;
    result.faces = faces;
    result.views = 3;
    result.check.samples = 100;
    result.drawing.ms = {ms, ms, ms};
    result.extraction.ms = {1.0, 1.0, 1.0};
    result.rays = {{"made", {{ratio * ms, ratio * ms, ratio * ms}}, 0.0}};
    result.whole = WholeResult{.all_ms = 79.0};
    return result;
}

}  // namespace rimline::tools
