#pragma once

// How many faces of a mesh a line parallel to an axis may meet, at most, in O(1). The mesh is divided into
// columns along the axis. Each has the number of faces whose boxes reach into it.

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

class FaceColumns {
public:
    /// `mesh` is not needed afterwards. O(faces); a byte a face.
    explicit FaceColumns(const Mesh& mesh);

    /// The coordinate axis of all columns: that of the mesh's least extent.
    int axis() const noexcept { return axis_; }
    /// Upper bound of the faces that the line through `place` along the axis meets. `place` must lie within
    /// the mesh's bounds, or at most 2^-20 of their diagonal outside. That also holds for each line that is by
    /// at most 2^-18 of the mesh's radius beside it.
    std::uint32_t faces_on_line(const glm::dvec3& place) const noexcept {
        return counts_[column(0, place) + side_ * column(1, place)];
    }

private:
    // Across the axis, along the first or second direction.
    std::size_t column(int direction, const glm::dvec3& place) const noexcept;

    int axis_ = 0;
    std::size_t side_ = 1;  // Columns in each direction.
    glm::dvec3 low_{0.0};
    glm::dvec3 columns_per_length_{0.0};
    std::vector<std::uint32_t> counts_;
};

}  // namespace rimline
