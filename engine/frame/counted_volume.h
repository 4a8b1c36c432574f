#pragma once

// A shadow volume and the upper bound of its count, kept for as long as its light rests.
//
// If the bound is too large for a batch of volumes (shadow_batches.h), the faces are divided into runs of
// consecutive faces, the parts. Each part is a volume of its own: its sides are the edges between faces that
// cast differently, and the edges at which the run ends. Its bound comes from these sides. Runs are halved until
// every bound fits a batch. A part of n faces has a bound of at most n.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/frame/face_columns.h"
#include "engine/frame/ray_bound.h"
#include "engine/shadow_choice.h"
#include "shaders/layout.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The data that one volume is counted from: the state of a SilhouetteTracker at `light`.
struct CountedVolume {
    const Mesh* mesh = nullptr;
    const FaceColumns* columns = nullptr;  ///< Of the mesh.
    std::span<const EdgeId> silhouette;
    std::span<const std::uint32_t> face_words;
    HomogeneousPoint light{};
    ShadowForm form = ShadowForm::general;
};

/// The volume of a run of consecutive faces.
struct VolumePart {
    std::uint32_t first_face = 0, face_count = 0;
    std::uint32_t first_side = 0, side_count = 0;  ///< In VolumeCount::sides.
    std::uint32_t bound = 0;
};

/// What is known of one volume. Valid for one mesh.
struct VolumeCount {
    std::optional<HomogeneousPoint> light;  ///< Empty if nothing is known.
    ShadowForm form = ShadowForm::general;
    /// Upper bound of the triangles that a ray from the light meets.
    std::uint32_t bound = 0;
    std::vector<VolumePart> parts;       ///< A partition of the faces, or empty.
    std::vector<gpu::EdgeRecord> sides;  ///< Of all parts, one record a side, with f1 = k_no_face.
};

/// Keeps its memory between calls. One thread at a time.
class VolumeCounter {
public:
    /// Brings `count` up to `volume`, without parts. If the light or the form is another than before, it costs
    /// O(silhouette + edges that are not regular), some nanoseconds each; else nothing. A bound above `enough` is
    /// made as small as it can be.
    void update(const CountedVolume& volume, std::uint32_t enough, VolumeCount& count);

    /// Adds parts whose bounds are at most `limit`, if there are none yet. `limit` must not be 0. O(faces log
    /// parts).
    void divide(const CountedVolume& volume, std::uint32_t limit, VolumeCount& count);

private:
    void divide(const CountedVolume& volume, std::uint32_t limit, std::uint32_t first,
                std::uint32_t end, VolumeCount& count);
    std::uint32_t bound_of_run(const CountedVolume& volume, std::uint32_t enough,
                               std::uint32_t first, std::uint32_t end,
                               std::span<const gpu::EdgeRecord> records);

    RayBound rays_;
    std::vector<VolumeSide> sides_;
};

/// Appends the sides of the volume of faces [first, end), as VolumeCount::sides has them.
void append_sides_of_run(const CountedVolume& volume, std::uint32_t first, std::uint32_t end,
                         std::vector<gpu::EdgeRecord>& sides);

}  // namespace rimline
