#include "engine/frame/moved_caster.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/moving_face.h"

namespace rimline {

namespace {

// The formula of engine/deformation.h; shaders/deform_wave.comp computes it in floats.
void move_by_wave(const Mesh& mesh, const Wave& wave, std::vector<glm::vec3>& positions) {
    RIMLINE_CHECK(wave.length > 0.0);
    positions.clear();
    positions.reserve(mesh.vertex_count());
    for (const glm::vec3& position : mesh.positions()) {
        const glm::dvec3 rest(position);
        const double turns = glm::dot(wave.travel, rest - wave.center) / wave.length - wave.turns;
        const double height = wave.amplitude * std::sin(2.0 * std::numbers::pi * turns);
        positions.emplace_back(rest + height * wave.direction);
    }
}

}  // namespace

MovedPositions MovedCaster::move(const Deformation& deformation) {
    const Mesh& mesh = caster_.mesh();
    const BoundingSphere sphere = bounding_sphere(mesh, deformation);
    if (const auto* moved = std::get_if<MovedPositions>(&deformation)) {
        RIMLINE_CHECK(moved->positions.size() == mesh.vertex_count());
        positions_.assign(moved->positions.begin(), moved->positions.end());
    } else {
        move_by_wave(mesh, std::get<Wave>(deformation), positions_);
    }
    bounds_ = {};
    if (!positions_.empty()) bounds_ = {positions_[0], positions_[0]};
    for (const glm::vec3& position : positions_)
        bounds_ = {glm::min(bounds_.low, position), glm::max(bounds_.high, position)};
    return {.positions = positions_, .center = sphere.center, .radius = sphere.radius};
}

CountedVolume MovedCaster::volume(const HomogeneousPoint& light, ShadowForm form) {
    const Mesh& mesh = caster_.mesh();
    face_words_ = moving_face_bits(mesh.triangles(), positions_, light);
    silhouette_.clear();
    // Only edges of this class are asked of a silhouette: VolumeCounter looks at all others itself.
    const Mesh::EdgeRange regular = mesh.edges_of_class(EdgeClass::regular);
    for (std::uint32_t e = regular.first; e < regular.last; ++e) {
        const auto& [f0, f1] = mesh.edge(EdgeId{e}).faces;
        if (face_bit(face_words_, f0) != face_bit(face_words_, f1))
            silhouette_.push_back(EdgeId{e});
    }
    return {.caster = &caster_,
            .silhouette = silhouette_,
            .face_words = face_words_,
            .light = light,
            .form = form,
            .moved = MovedGeometry{.positions = positions_, .bounds = bounds_}};
}

}  // namespace rimline
