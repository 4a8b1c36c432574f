#pragma once

// What a Renderer reports of one frame.

#include <cstdint>
#include <string>
#include <vector>

#include "engine/shadow_choice.h"
#include "engine/silhouette_changes.h"

namespace rimline {

/// How the shadow of one caster from one light was drawn.
struct ShadowReport {
    std::uint32_t instance = 0;
    std::uint32_t light = 0;
    ShadowChoice choice;
    /// Where its volume was counted; all of the picture without RendererOptions::limits_shadows.
    ShadowReach reach;
    /// Upper bound of the triangles that a ray from the light meets (ray_bound.h).
    std::uint32_t bound = 0;
    /// Number of parts of the volume that were drawn for themselves (counted_volume.h). 0: it was drawn whole.
    std::uint32_t runs = 0;
    /// All that is seen is in its shadow, which is counted once everywhere: the light is inside a closed mesh.
    bool shades_all = false;
    /// The light lay exactly on a vertex and was moved (light_off_vertices()).
    bool light_moved = false;
};

/// The time of one pass on the GPU.
struct PassTime {
    /// "silhouettes", "surfaces, unlit", "shadow volumes, light 0", "surfaces, light 0", "resolve", "lines",
    /// "picture". With one light the surfaces may be drawn at once (docs/drawing.md): "surfaces", and, if it casts
    /// shadows, "shadow volumes, light 0" and "surfaces, in shadow". With another outline than lines also "shapes",
    /// the first after "silhouettes", or "backs", before "resolve".
    std::string name;
    double time_ms = 0.0;
};

/// Work of one frame. Instances that deform are counted by the GPU: their counts are added when the frame is
/// finished, and are missing from a frame that a caller submits.
struct FrameReport {
    /// Silhouette edges of the camera and borders drawn as lines. A line path without slots knows no
    /// silhouette: then the borders alone.
    std::uint32_t silhouette = 0;
    std::uint32_t creases = 0;  ///< Creases drawn as lines, on the silhouette or not.
    /// Segments of the lines that instances have instead (SceneInstance::picture_lines).
    std::uint32_t segments = 0;
    /// Sides of shadow volumes over all lights: one for each regular silhouette edge, and one for each
    /// face of every other edge.
    std::uint32_t shadow_edges = 0;
    std::vector<ShadowReport> shadows;  ///< Each caster before each light.
    std::uint64_t bytes_streamed = 0;   ///< Bytes of silhouettes and face bits sent to the GPU.
    std::uint64_t bytes_full = 0;       ///< Bytes if all of them were sent whole.
    /// Wall-clock time from moving the trackers to the last recorded command. Includes the first
    /// extraction of silhouettes, not the upload of meshes drawn for the first time.
    double record_ms = 0.0;
    /// The part of record_ms in which trackers were sent to their points and change sets were taken from them. Includes
    /// the wait for trackers that had not finished: where no processor is free, a tracker may run instead of the caller
    /// as soon as it is sent.
    double follow_ms = 0.0;
    std::uint32_t meshes_uploaded = 0;  ///< Meshes drawn for the first time.
    std::uint64_t bytes_uploaded = 0;   ///< Bytes of these meshes.
    /// With RendererOptions::pass_times, in the order of the frame; see there. Empty where the device's queue
    /// has no timestamps. Of a frame that a caller submits they are known later: record() reports those of
    /// the frame that had the ring slot before, RendererOptions::frames_in_flight frames ago.
    std::vector<PassTime> passes;
    /// Wall-clock time from the same start to the finished picture; 0 for a frame that a caller submits.
    double frame_ms = 0.0;
    SilhouetteChanges camera;  ///< Of the silhouettes drawn as lines, over all instances.
    /// With RendererOptions::check_silhouettes: words on the GPU that differ from the trackers'. For a
    /// frame that a caller submits they are known later: Renderer::differences().
    std::uint64_t differences = 0;
};

}  // namespace rimline
