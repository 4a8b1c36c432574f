#pragma once

// The options of a Renderer.

#include <cstdint>

#include "engine/line_path.h"
#include "engine/shadow_choice.h"

namespace rimline {

class SilhouetteService;

/// How outlines are found. The last two are comparators, the techniques of programs that have no edges: they give
/// pixels. They need no tracker and no stream for the camera, and draw neither SceneInstance::picture_lines nor
/// creases nor hidden lines. Instances without lines have no outline, but hide those of others.
enum class OutlineMethod : std::uint8_t {
    lines,  ///< Silhouettes, borders and creases, by RendererOptions::line_path.
    sobel,  ///< Steps of depth and normals between pixels (passes/sobel_pass.h). All have one color.
    backs,  ///< Back faces, moved outwards (passes/back_pass.h).
};

struct Outline {
    OutlineMethod method = OutlineMethod::lines;
    /// Of OutlineMethod::sobel: the least step of depth, beyond the slope of the surface, as a share of the height
    /// that the picture shows at this distance, not negative; and the least bend between
    /// normals, in degrees from 0 to 180, where
    /// none is found. Chosen on the Stanford bunny (`rimline bench engine --image-space`).
    float depth_step = 0.004f;
    float normal_step_deg = 40.0f;
};

struct RendererOptions {
    /// As sampling_of() (sampling.h): at most 8 samples, and fewer where the device has fewer. 0: the device's
    /// default.
    std::uint32_t samples = 0;
    std::uint32_t scale = 0;
    /// Frames that may be recorded or submitted and not yet done, at least 1. Each takes its own ring slot of
    /// every stream.
    std::uint32_t frames_in_flight = 2;
    /// Shading is smooth across edges that bend by at most this angle: not negative.
    float crease_angle_rad = 0.7f;
    /// Does not change the pixels, except as SideStage says.
    SideStage shadow_sides = SideStage::vertex;
    /// Limit of GPU memory for all silhouettes together (StreamSize, change_stream.h): 80 MiB for
    /// each silhouette point of a mesh of 10 million faces. A mesh that deforms counts with its silhouettes,
    /// its moved positions and normals, and the data that finds them (deforming_mesh.h).
    std::uint64_t stream_memory_bytes = std::uint64_t{1} << 30;
    /// Limit of memory reserved by all trackers together (SilhouetteTracker::size_bytes()): about 70 bytes
    /// a face for each silhouette point. Most of it is not touched before a large move.
    std::uint64_t tracker_memory_bytes = std::uint64_t{16} << 30;
    /// Moves the trackers. Several renderers may share one; it must outlive them. Null: the renderer makes
    /// its own.
    SilhouetteService* service = nullptr;
    /// Counts each shadow volume only where it can matter (shadow_bounds.h). Does not change the picture. False is
    /// for tests and measurements.
    bool limits_shadows = true;
    /// Keeps the stencil of Renderer::targets() after the frame, where there is one sample. For tests.
    bool keeps_stencil = false;
    /// Reads slots, face bits and draw arguments back in every frame and compares them with the trackers
    /// (consistency_check.h).
    bool check_silhouettes = false;
    /// Measures each pass on the GPU (FrameReport::passes). Timestamps are written between passes, and a GPU
    /// that would overlap passes may then be slower. A caller's command buffers must be for the context's
    /// queue family. The times miss work that a device does after the timestamp: those of Mesa's lavapipe are
    /// too small where threads still rasterize.
    bool pass_times = false;
    /// How lines are drawn; automatic: as is faster on the device. The comparators (line_path.h) throw
    /// Error{no_device} if they need geometry shaders and the device has none.
    LinePath line_path = LinePath::automatic;
    Outline outline{};
};

}  // namespace rimline
