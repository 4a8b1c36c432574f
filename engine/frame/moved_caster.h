#pragma once

// A mesh that deforms, as the CPU needs it to bound its shadow volumes (SceneInstance::has_deep_shadows).
//
// The GPU moves a mesh and finds its silhouettes without the CPU, which then knows no bound of the triangles in a
// row. Here the CPU does the same: it has the positions, from the caller or from the formula of the wave, and gives
// them to the GPU, so that both decide face bits from the same floats by the same expression (moving_face.h). Then a
// volume can be bounded and divided as that of a mesh at rest (counted_volume.h).

#include <vector>

#include "engine/deformation.h"
#include "engine/frame/counted_volume.h"

namespace rimline {

class MovedCaster {
public:
    /// `mesh` must outlive it. O(vertices).
    explicit MovedCaster(const Mesh& mesh) : caster_(mesh) {}

    /// Moves the mesh. Returns the deformation as positions, which are valid until the next call. O(vertices).
    MovedPositions move(const Deformation& deformation);

    /// The volume from a light, where move() left the mesh. Valid until the next call of either. O(faces + edges):
    /// about 50 ns a face.
    CountedVolume volume(const HomogeneousPoint& light, ShadowForm form);

private:
    CasterMesh caster_;
    std::vector<glm::vec3> positions_;
    Bounds bounds_{};
    std::vector<std::uint32_t> face_words_;
    std::vector<EdgeId> silhouette_;
};

}  // namespace rimline
