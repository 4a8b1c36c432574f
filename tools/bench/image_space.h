#pragma once

// `rimline bench engine --image-space`: lines by slots beside the techniques of programs that have no edges
// (Outline, engine/renderer_options.h), and beside lines of exact visibility, which the CPU draws.
//
// Masks: all draw black lines, two pixels wide, on a white model without light, one sample a pixel. A pixel that
// is at least half covered is marked. The pixels are compared with rays (silhouette_pixels.h), over views spread
// evenly around the model. The Sobel operator has two thresholds: its masks are counted at many pairs of them,
// too.
//
// Times: frames of an orbit of half a degree at two radii, 1024 x 1024, without light and shadows; the ways
// alternate frame by frame. The time by the clock is from moving the trackers to the picture in memory.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/renderer_options.h"
#include "engine/vulkan/device.h"
#include "silhouette/mesh/mesh.h"
#include "tools/bench/silhouette_pixels.h"
#include "tools/command.h"

namespace rimline::tools {

struct ImageSpaceOptions {
    std::uint32_t views = 8;    ///< Of masks.
    std::uint32_t frames = 24;  ///< Of times.
};

/// One technique. Medians of a frame; for lines of exact visibility with the time of drawing them.
struct OutlineWay {
    std::string name;
    OutlineHits hits;
    double frame_ms = 0.0;   ///< By the clock.
    double cpu_ms = 0.0;     ///< Of it, on the CPU: lines, and FrameReport::record_ms.
    double passes_ms = 0.0;  ///< On the device, by its timestamps. 0 without.
};

/// The Sobel operator at one pair of thresholds.
struct SobelHits {
    Outline outline;
    OutlineHits hits;
};

struct ImageSpaceResult {
    std::string model;
    std::uint32_t faces = 0;
    bool is_closed = false;
    std::vector<OutlineWay> ways;
    std::vector<SobelHits> sobel;
};

/// Only where no rays are missing (PieceRays::missing()). The mesh must have an extent. Throws the errors of
/// devices and renderers.
ImageSpaceResult bench_image_space(const std::string& model, const Mesh& mesh, const Device& device,
                                   const ImageSpaceOptions& options, const Context& context);

void print_result(const ImageSpaceResult& result);
nlohmann::ordered_json to_json(const ImageSpaceResult& result);

}  // namespace rimline::tools
