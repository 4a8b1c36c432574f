#pragma once

// A model of few faces in the place of one of many: for pictures that move, on a device that cannot draw all of them in
// time. At 20,000 faces it differs from the horse, Nefertiti and igea by less than a thousandth of their size.

#include <cstdint>

#include "engine/scene.h"
#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

/// Cannot be copied or moved: the octree refers to the mesh by its address, and a renderer refers to the octree by its
/// address.
class ReducedModel {
public:
    static constexpr std::uint32_t k_faces = 20'000;

    /// Whether there are many faces, and no textures, which need all of them.
    static bool is_worth_it(const Mesh& mesh) noexcept {
        return mesh.face_count() >= 2 * k_faces && !mesh.materials().has_pictures();
    }

    /// Of a mesh for which it is worth it; `mesh` need not outlive it. Takes as long as simplified().
    explicit ReducedModel(const Mesh& mesh, const LongCall& call = {});
    ReducedModel(const ReducedModel&) = delete;
    ReducedModel& operator=(const ReducedModel&) = delete;

    const Mesh& mesh() const noexcept { return mesh_; }
    const HoughOctree& octree() const noexcept { return octree_; }
    /// False where next to nothing is left, as of many separate small parts.
    bool is_useful() const noexcept { return mesh_.face_count() >= k_faces / 2; }
    /// Draws it in place of the instance's own model.
    void stand_in(SceneInstance& instance) const;

private:
    Mesh mesh_;
    HoughOctree octree_;
    bool is_solid_;
};

}  // namespace rimline::tools
