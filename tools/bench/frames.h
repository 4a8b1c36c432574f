#pragma once

// `rimline bench frames`: what a frame's time depends on. One thing is changed at a time:
//
//   light     the sun, and lamps at 1 to 1000 radii from the center. Lines off.
//   limits    the sun and a lamp: of the model alone, on a ground, and of nine models on it; each with shadows
//             limited to where they can be seen (shadow_bounds.h), and without. Their pictures are compared.
//   scale     pixels of the passes along a side of a pixel of the picture
//   samples   1, 4, 8, where the engine and the device take them
//   lines     the ways to draw lines (line_path.h); their pictures are compared first
//   growth    knots of growing sizes
//
// The camera moves half a degree a frame. Each frame is drawn with lines and the shadows of one sun, but where the
// list says otherwise. Times are medians.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/vulkan/device.h"
#include "silhouette/mesh/mesh.h"
#include "tools/bench/pass_medians.h"
#include "tools/bench/sample_tests.h"
#include "tools/command.h"

namespace rimline::tools {

struct FramesBenchOptions {
    std::uint32_t width = 1280, height = 960;
    std::uint32_t frames = 24;
    std::uint32_t max_faces = 10'000'000;  ///< Of the growth.
    std::string only{};                    ///< One group; empty: all.

    bool has(const char* group) const { return only.empty() || only == group; }
};

/// One row of the table.
struct FrameRow {
    std::string group, name;
    std::uint32_t faces = 0;
    std::string refusal{};   ///< Why it was not measured; the rest is 0 then.
    double frame_ms = 0.0;   ///< By the clock: from moving the trackers to the picture in memory.
    double record_ms = 0.0;  ///< The processor's part of it.
    PassMedians passes;
    SampleTests tests;  ///< Of the rows of `limits`, else 0.
};

struct FramesResult {
    std::vector<FrameRow> rows;
    std::string
        difference;  ///< The first row whose picture differs from what it must equal; empty: none.
};

/// Measures all rows and calls `on_row` after each. The mesh must have an extent. A row that needs more memory
/// than there is says so. Throws the other errors of devices and renderers.
FramesResult bench_frames(const std::string& model, const Mesh& mesh, const Device& device,
                          const FramesBenchOptions& options,
                          const std::function<void(const FrameRow&)>& on_row,
                          const Context& context);

}  // namespace rimline::tools
