#pragma once

// How many triangles may lie in a row before a light, so that a stencil of eight bits never wraps from
// 256 to zero: what is counted in one batch is bounded by 255, or by 127 in each of several
// (shadow_volume_pass.h).
//
// The silhouette bounds it. Let K(r) be how many triangles the ray r from the light meets, as the volume
// counts them. K only changes where the ray crosses the volume's sides, by as many as are drawn there.
// Turn the ray along a meridian, in a half plane through the light and an axis, from one pole to the
// other: K goes from what it is at the one pole to what it is at the other, and any K(r) on the way is at
// most half of both and of all sides crossed. So
//
//     K(r)  <=  (K(pole) + K(other pole) + sides that span the meridian of r) / 2
//
// The axis is one of the mesh's own coordinates and runs past its bounds, so that both poles see
// nothing, unless the light is within them; then the faces at the axis are counted. Meridians are
// counted in bins, a little wider than they are. The cost is that of reading the silhouette once: some
// nanoseconds an edge, and a pass over the faces where the light is within the bounds.
//
// Where that is too much for one mesh, its faces are counted one by one: K is at most the faces that
// span a meridian, whatever faces those are, and a run of faces makes a batch for as long as they fit.

#include <cstdint>
#include <span>
#include <vector>

#include "engine/frame/draw_list.h"
#include "engine/shadow_choice.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The most that one batch counts to, alone and among several.
constexpr std::uint32_t k_single_batch_limit = 255;
constexpr std::uint32_t k_batch_limit = 127;

/// What one volume is counted from, as a SilhouetteTracker has it at `light`.
struct CountedVolume {
    const Mesh* mesh = nullptr;
    std::span<const EdgeId> silhouette;
    std::span<const std::uint32_t> face_words;
    HomogeneousPoint light{};
    ShadowForm form = ShadowForm::general;
};

/// Counts volumes; keeps its memory from one to the next. One thread at a time.
class ShadowCounter {
public:
    /// No ray from the light meets more triangles of the volume than this.
    std::uint32_t bound(const CountedVolume& volume);

    /// Adds a volume, drawn as instance `instance`, to the batches of its light. Call begin() before
    /// the first and end() after the last.
    void begin() noexcept;
    /// Returns its bound.
    std::uint32_t add(std::uint32_t instance, const CountedVolume& volume);
    /// The same for a volume whose silhouette only the GPU knows. It is taken to count to no more than
    /// k_batch_limit: not shown, but for small meshes.
    std::uint32_t add_unseen(std::uint32_t instance, std::uint32_t face_count);
    /// One batch where all that was added counts to no more than 255, else several.
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

    std::vector<std::int32_t> steps_;  // By bin: how much more spans it than the one before.
    std::vector<Added> added_;
    std::uint64_t total_ = 0;
};

}  // namespace rimline
