#include "tools/view/model_document.h"

#include <algorithm>
#include <utility>

#include "silhouette/hough/box_walk.h"
#include "silhouette/mesh/solid.h"
#include "tools/options/picture_scene.h"

namespace rimline::tools {

namespace {

// The camera, the lights and the ground around the model must stay within the range of coordinates.
const Mesh& check_size(const std::string& name, const Mesh& mesh) {
    const glm::dvec3 reach = glm::abs(mesh.center()) + 1.5 * k_ground_end * mesh.radius();
    if (std::max({reach.x, reach.y, reach.z}) > 0.01 * double{k_max_coordinate})
        throw Error(ErrorCode::too_large,
                    name + ": too large to walk around: scale it down, coordinates end at 2^60");
    return mesh;
}

}  // namespace

ModelDocument::Ground::Ground(const Mesh& model, const glm::dvec3& up_axis)
    : up(up_axis), mesh(make_ground(model, up_axis, k_ground_end * model.radius())), octree(mesh) {}

ModelDocument::ModelDocument(std::string name, const MeshSource& source, const BeginCall& begin)
    : DocumentBase(std::move(name), source.warnings),
      models_{{.model = this->name()}},
      mesh_(make_part(
          begin, "joining the faces",
          [&](const LongCall& call) { return Mesh(source, Welding::equal_positions, call); })),
      octree_(make_part(begin, "building the octree",
                        [&](const LongCall& call) {
                            return HoughOctree(check_size(this->name(), mesh_), {}, call);
                        })),
      is_solid_(rimline::is_solid(mesh_, begin("asking whether it is a solid"))),
      lines_(make_part(begin, "finding contacts of faces",
                       [&](const LongCall& call) {
                           return ShownLines(octree_,
                                             is_solid_ ? LineSurface::Contacts::none
                                                       : LineSurface::Contacts::found,
                                             call);
                       })),
      hough_boxes_(octree_, 0) {}

bool ModelDocument::has_paint() const noexcept {
    return std::ranges::any_of(models_, [](const PlacedModel& m) { return m.paint.has_value(); });
}

const HoughOctree& ModelDocument::ground(const glm::dvec3& up) {
    const auto same_up = std::ranges::find_if(
        grounds_, [&](const std::unique_ptr<Ground>& ground) { return ground->up == up; });
    if (same_up != grounds_.end()) return (*same_up)->octree;
    grounds_.push_back(std::make_unique<Ground>(mesh_, up));
    return grounds_.back()->octree;
}

}  // namespace rimline::tools
