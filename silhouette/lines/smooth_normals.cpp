#include "silhouette/lines/smooth_normals.h"

#include <glm/geometric.hpp>

namespace rimline {

namespace {

// Normals have length 1 or 0.
constexpr float k_unknown = 2.0f;

}  // namespace

void SmoothNormals::begin(const LineFrame& frame) {
    frame_ = &frame;
    normals_.resize(frame.surface->mesh().vertex_count(), glm::vec3(k_unknown));
}

double SmoothNormals::facing(std::uint32_t vertex) {
    glm::vec3& normal = normals_[vertex];
    if (normal.x == k_unknown) normal = find_normal(vertex);
    const glm::dvec3 eye(frame_->view->point().xyz());
    const glm::dvec3 towards =
        frame_->view->is_orthographic() ? eye : eye - glm::dvec3(frame_->position(vertex));
    return glm::dot(glm::dvec3(normal), towards);
}

glm::vec3 SmoothNormals::find_normal(std::uint32_t vertex) const {
    const glm::dvec3 p(frame_->position(vertex));
    glm::dvec3 normal(0.0);
    for (const auto& [a, b] : frame_->surface->stars().links(vertex)) {
        const glm::dvec3 u = glm::dvec3(frame_->position(a)) - p;
        const glm::dvec3 v = glm::dvec3(frame_->position(b)) - p;
        const double weight = glm::dot(u, u) * glm::dot(v, v);
        if (weight > 0.0) normal += glm::cross(u, v) / weight;
    }
    const double length = glm::length(normal);
    return length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f);
}

}  // namespace rimline
