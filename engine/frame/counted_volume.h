#pragma once

// A shadow volume and the upper bound of its count, kept for as long as its light rests.
//
// If the bound is too large for a batch of volumes (shadow_batches.h), the faces are divided into parts. Each part
// is a volume of its own: its sides are the edges between faces that cast differently, and the edges between
// parts. Its bound comes from these sides. Runs of the faces are halved until every bound fits a batch, in the
// mesh's order, which often has one component after the other. Where that gives many parts, the faces are sorted
// by their distance from the light, because the counts of parts along a ray add up. A part of n faces has a bound
// of at most n.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/frame/caster_mesh.h"
#include "engine/frame/ray_bound.h"
#include "engine/frame/volume_sides.h"
#include "engine/shadow_choice.h"
#include "shaders/layout.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Where the vertices of a mesh that deforms are now.
struct MovedGeometry {
    std::span<const glm::vec3> positions;  ///< As Mesh::positions().
    Bounds bounds;
};

/// The data that one volume is counted from: the state of a SilhouetteTracker at `light`. The silhouette of a mesh
/// that deforms need only have regular edges.
struct CountedVolume {
    CasterMesh* caster = nullptr;
    std::span<const EdgeId> silhouette;
    std::span<const std::uint32_t> face_words;
    HomogeneousPoint light{};
    ShadowForm form = ShadowForm::general;
    std::optional<MovedGeometry> moved{};  ///< Empty: the mesh is at rest.

    std::span<const glm::vec3> positions() const noexcept {
        return moved ? moved->positions : caster->mesh().positions();
    }
    const Bounds& bounds() const noexcept {
        return moved ? moved->bounds : caster->mesh().bounds();
    }
};

/// The volume of some of the faces.
struct VolumePart {
    std::uint32_t first_face = 0, face_count = 0;  ///< In VolumeCount::faces.
    std::uint32_t first_side = 0, side_count = 0;  ///< In VolumeCount::sides.
    std::uint32_t bound = 0;
};

/// What is known of one volume. Valid for one mesh, and for one place of its vertices.
struct VolumeCount {
    std::optional<HomogeneousPoint> light;  ///< Empty if nothing is known.
    ShadowForm form = ShadowForm::general;
    /// Upper bound of the triangles that a ray from the light meets.
    std::uint32_t bound = 0;
    std::vector<VolumePart> parts;
    std::vector<std::uint32_t> faces;    ///< Of all parts: every face that casts, once.
    std::vector<gpu::EdgeRecord> sides;  ///< Of all parts, one record a side, with f1 = k_no_face.
    /// The index in `parts` of each face of the mesh; 0 for those that cast none. Empty without parts.
    std::vector<std::uint32_t> part_of;
    /// Of each edge of the silhouette of a mesh at rest, in its order. Kept while the light moves: few edges change.
    std::vector<EdgePlaces> places;
};

/// Faces that make a volume of their own: a run of an order of all faces.
struct FaceRun {
    std::span<const std::uint32_t> order;  ///< A permutation of the faces, ...
    std::span<const std::uint32_t> ranks;  ///< ... and the place of each face in it.
    std::uint32_t first = 0, end = 0;

    std::uint32_t size() const noexcept { return end - first; }
    bool has(FaceId face) const noexcept { return ranks[index(face)] - first < size(); }
    std::span<const std::uint32_t> faces() const noexcept { return order.subspan(first, size()); }
};

/// Keeps its memory between calls. One thread at a time.
class VolumeCounter {
public:
    /// Brings `count` up to `volume`, without parts. If the light or the form is another than before, it costs
    /// O(silhouette + edges that are not regular), some nanoseconds each, and a few reads far apart in memory for each
    /// edge of the silhouette that was not there, in its place, before; else nothing. The first light within
    /// the mesh's bounds needs CasterMesh::faces(), or, of a mesh that deforms, O(faces). Where a bound is above
    /// `enough`, more axes are tried.
    void update(const CountedVolume& volume, std::uint32_t enough, VolumeCount& count);

    /// Adds parts whose bounds are at most `limit`, if there are none yet. `limit` must not be 0. O(faces log
    /// parts), tens of nanoseconds each; then it keeps 12 bytes a face.
    void divide(const CountedVolume& volume, std::uint32_t limit, VolumeCount& count);

private:
    void follow_places(const CountedVolume& volume, std::vector<EdgePlaces>& places);
    void sort_faces(const CountedVolume& volume);
    void divide(const CountedVolume& volume, std::uint32_t limit, std::uint32_t first,
                std::uint32_t end, VolumeCount& count);
    std::uint32_t bound_of_run(const CountedVolume& volume, std::uint32_t enough,
                               const FaceRun& run, std::span<const gpu::EdgeRecord> records);

    template <typename CountFaces>
    std::uint32_t bound_from_within(const VolumeSides& sides, const Bounds& bounds,
                                    const HomogeneousPoint& light, std::uint32_t enough,
                                    const CountFaces& faces_on_line);

    RayBound rays_;
    std::vector<VolumeSide> sides_;       // Those that are not of regular edges of the silhouette.
    std::vector<std::uint32_t> changed_;  // Of VolumeCount::places.
    std::vector<std::uint32_t> order_, ranks_;  // Of FaceRun.
};

/// Appends the faces of a run that cast and the sides of their volume, as VolumeCount has them.
void append_run(const CountedVolume& volume, const FaceRun& run, VolumeCount& count);

}  // namespace rimline
