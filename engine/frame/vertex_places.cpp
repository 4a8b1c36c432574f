#include "engine/frame/vertex_places.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace rimline {

VertexPlaces::VertexPlaces(const Mesh& mesh) : mesh_(&mesh) {
    // One bucket for each two vertices, and at least two, because a shift by 64 bits is not defined.
    const std::uint32_t buckets = std::bit_ceil(std::max(mesh.vertex_count() / 2, 2u));
    shift_ = 64 - static_cast<std::uint32_t>(std::countr_zero(buckets));
    begins_.assign(std::size_t{buckets} + 1, 0);
    for (const glm::vec3& place : mesh.positions()) ++begins_[bucket_of(place) + 1];
    for (std::size_t b = 0; b < buckets; ++b) begins_[b + 1] += begins_[b];
    // Each vertex is placed at the begin of its bucket, which moves on: it ends as the begin of the next.
    vertices_.resize(mesh.vertex_count());
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
        vertices_[begins_[bucket_of(mesh.positions()[v])]++] = v;
    std::copy_backward(begins_.begin(), begins_.end() - 2, begins_.end() - 1);
    begins_[0] = 0;
}

std::size_t VertexPlaces::bucket_of(const glm::vec3& place) const noexcept {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis)
        // A sum with 0 makes both zeros equal.
        hash = (hash ^ std::bit_cast<std::uint32_t>(place[axis] + 0.0f)) * 0x9e3779b97f4a7c15u;
    return hash >> shift_;
}

bool VertexPlaces::has(const glm::vec3& place) const noexcept {
    const std::size_t bucket = bucket_of(place);
    for (std::uint32_t i = begins_[bucket]; i < begins_[bucket + 1]; ++i)
        if (mesh_->positions()[vertices_[i]] == place) return true;
    return false;
}

HomogeneousPoint light_off_vertices(const VertexPlaces& vertices, const HomogeneousPoint& light) {
    const Mesh& mesh = vertices.mesh();
    const glm::vec3 place = light.xyz();
    if (light.is_direction() || !vertices.has(place)) return light;
    const glm::vec3 reach = glm::max(glm::abs(mesh.bounds().low), glm::abs(mesh.bounds().high));
    const float greatest = std::max({reach.x, reach.y, reach.z});
    const float step = std::max(0x1p-16f * greatest, k_min_point_component);
    const glm::vec3 center(mesh.center());
    for (float steps = 1.0f;; steps += 1.0f) {
        glm::vec3 beside;
        for (int axis = 0; axis < 3; ++axis) {
            const float away = place[axis] < center[axis] ? -steps * step : steps * step;
            beside[axis] = place[axis] + away;
            // Beyond the range of coordinates, the other direction is taken.
            if (std::abs(beside[axis]) > k_max_coordinate) beside[axis] = place[axis] - away;
        }
        if (!vertices.has(beside)) return HomogeneousPoint::viewpoint(beside);
    }
}

}  // namespace rimline
