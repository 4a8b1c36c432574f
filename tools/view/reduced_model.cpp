#include "tools/view/reduced_model.h"

#include "silhouette/mesh/solid.h"
#include "tools/options/simplified_mesh.h"

namespace rimline::tools {

ReducedModel::ReducedModel(const Mesh& mesh, const LongCall& call)
    : mesh_(simplified(mesh, k_faces, {call.stop, {}}), Welding::equal_positions, call),
      octree_(mesh_, {}, call),
      is_solid_(rimline::is_solid(mesh_, call)) {}

void ReducedModel::stand_in(SceneInstance& instance) const {
    instance.octree = &octree_;
    instance.is_solid = is_solid_;
}

}  // namespace rimline::tools
