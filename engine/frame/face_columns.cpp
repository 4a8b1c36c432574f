#include "engine/frame/face_columns.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace rimline {

namespace {

// With four faces a column, a face of a closed mesh is about as wide as a column.
constexpr double k_faces_a_column = 4.0;

}  // namespace

FaceColumns::FaceColumns(const Mesh& mesh) : low_(mesh.bounds().low) {
    const glm::dvec3 extent = glm::dvec3(mesh.bounds().high) - low_;
    for (int axis = 1; axis < 3; ++axis)
        if (extent[axis] < extent[axis_]) axis_ = axis;
    side_ =
        static_cast<std::size_t>(std::max(1.0, std::sqrt(mesh.face_count() / k_faces_a_column)));
    for (int axis = 0; axis < 3; ++axis)
        if (extent[axis] > 0.0)
            columns_per_length_[axis] = static_cast<double>(side_) / extent[axis];

    // A face adds one to a rectangle of columns: four steps, of which sums along both directions make counts.
    const double slack = 0x1p-18 * mesh.radius();
    const std::size_t row = side_ + 1;
    std::vector<std::uint32_t> steps(row * row, 0);
    for (const Triangle& triangle : mesh.triangles()) {
        glm::dvec3 low(mesh.positions()[index(triangle[0])]);
        glm::dvec3 high = low;
        for (const VertexId vertex : triangle) {
            low = glm::min(low, glm::dvec3(mesh.positions()[index(vertex)]));
            high = glm::max(high, glm::dvec3(mesh.positions()[index(vertex)]));
        }
        low -= slack;
        high += slack;
        const std::size_t x0 = column(0, low), x1 = column(0, high) + 1;
        const std::size_t y0 = column(1, low), y1 = column(1, high) + 1;
        ++steps[x0 + row * y0];
        --steps[x1 + row * y0];
        --steps[x0 + row * y1];
        ++steps[x1 + row * y1];
    }
    counts_.resize(side_ * side_);
    for (std::size_t y = 0; y < side_; ++y) {
        std::uint32_t sum = 0;
        for (std::size_t x = 0; x < side_; ++x) {
            sum += steps[x + row * y];
            counts_[x + side_ * y] = sum + (y > 0 ? counts_[x + side_ * (y - 1)] : 0);
        }
    }
}

std::size_t FaceColumns::column(int direction, const glm::dvec3& place) const noexcept {
    const int axis = (axis_ + 1 + direction) % 3;
    const double column = std::floor((place[axis] - low_[axis]) * columns_per_length_[axis]);
    return static_cast<std::size_t>(std::clamp(column, 0.0, static_cast<double>(side_) - 1.0));
}

}  // namespace rimline
