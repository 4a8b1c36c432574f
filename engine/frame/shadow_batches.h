#pragma once

// Upper bounds of the triangles that one ray from a light meets, so that a stencil of eight bits never wraps
// from 255 to zero: a batch of volumes counts to at most 255, or to 127 where there are several batches
// (shadow_volume_pass.h).
//
// The silhouette gives the bound. Let K(r) be the number of triangles that the ray r from the light meets, as
// the volume counts them. K changes only where the ray crosses the volume's sides, by the number of sides
// drawn there. Turn the ray along a meridian (in a half plane through the light and an axis) from one pole to
// the other. Then K goes from its value at one pole to its value at the other, and every K(r) in between is
// at most half of the sum of both values and of all sides crossed. So
//
//     K(r)  <=  (K(pole) + K(other pole) + sides that span the meridian of r) / 2
//
// The axis is parallel to a coordinate axis of the mesh and passes outside its bounds, so that K is 0 at both
// poles, unless the light is within the bounds; then the faces that may meet the axis are counted. Meridians
// are counted in bins, and each side in slightly more bins than it spans. Cost: one pass over the silhouette,
// some nanoseconds an edge, and a pass over the faces if the light is within the bounds.
//
// If the bound of one mesh is too large for a batch, its faces are counted one by one: K is at most the
// number of faces that span a meridian. Consecutive faces make a batch for as long as they fit.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/passes/draw_list.h"
#include "engine/shadow_choice.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The greatest count of a batch, alone and among several.
constexpr std::uint32_t k_single_batch_limit = 255;
constexpr std::uint32_t k_batch_limit = 127;

/// The data that one volume is counted from: the state of a SilhouetteTracker at `light`.
struct CountedVolume {
    const Mesh* mesh = nullptr;
    std::span<const EdgeId> silhouette;
    std::span<const std::uint32_t> face_words;
    HomogeneousPoint light{};
    ShadowForm form = ShadowForm::general;
};

/// Counts volumes. Keeps its memory between calls. One thread at a time.
class ShadowCounter {
public:
    /// Upper bound of the triangles of the volume that a ray from the light meets. O(silhouette), and
    /// O(faces) if the light is within the mesh's bounds.
    std::uint32_t bound(const CountedVolume& volume);

    /// Adds a volume, drawn as instance `instance`, to the batches of its light. Call begin() before
    /// the first and end() after the last.
    void begin() noexcept;
    /// Returns its bound.
    std::uint32_t add(std::uint32_t instance, const CountedVolume& volume);
    /// Adds a volume whose silhouette only the GPU knows. It is assumed to count to at most k_batch_limit.
    /// That is proven only for meshes of at most as many faces.
    std::uint32_t add_unseen(std::uint32_t instance, std::uint32_t face_count);
    /// One batch if the bounds of all added volumes sum up to at most 255, else several.
    std::vector<ShadowBatch> end();

private:
    class Meridians;
    struct Added {
        std::uint32_t instance;
        std::uint32_t face_count;
        CountedVolume volume;
        std::uint32_t bound;
    };

    void add_faces(const Added& added, std::vector<ShadowBatch>& batches);

    std::vector<std::int32_t>
        steps_;  // By bin: sides that span it, minus those that span the bin before.
    std::vector<Added> added_;
    std::uint64_t total_ = 0;
};

}  // namespace rimline
