#pragma once

// Points without faces, each position once: the input of umbrellas.
//
// Equal positions are one point, the first of them, with its normal, color and intensity. Positions that are
// not finite are left out. Where the source holds a mesh, its points are the vertices that faces use. The
// faces are kept as the truth about borders and normals, to measure results with. No algorithm uses them to
// find results.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/mesh/point_source.h"

namespace rimline {

class PointCloud {
public:
    /// An empty source gives an empty cloud. The indices of triangles must be in range. There must be one
    /// normal, color and intensity for each position, or none. Finite positions must lie within
    /// k_max_coordinate. Throws Error{too_large} from 2^32 - 16 positions on. O(positions + triangles).
    explicit PointCloud(PointSource source);

    std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(positions_.size()); }
    /// Distinct and finite, in the file's order.
    std::span<const glm::dvec3> positions() const noexcept { return positions_; }
    /// From the file, of length 1 or zero; empty where the file has none.
    std::span<const glm::vec3> normals() const noexcept { return normals_; }
    std::span<const PointColor> colors() const noexcept { return colors_; }

    std::span<const float> intensities() const noexcept { return intensities_; }

    /// The number of a point in the file.
    std::uint32_t file_point(std::uint32_t point) const noexcept { return file_points_[point]; }
    std::span<const std::uint32_t> file_points() const noexcept { return file_points_; }
    std::uint32_t file_point_count() const noexcept { return file_point_count_; }
    /// Positions that are equal to an earlier one.
    std::uint32_t duplicate_count() const noexcept { return duplicate_count_; }
    /// Positions that are not finite.
    std::uint32_t dropped_count() const noexcept { return dropped_count_; }
    /// Positions of a mesh that no face uses.
    std::uint32_t unused_count() const noexcept { return unused_count_; }

    /// The faces of a mesh, as points. Faces with equal corners are left out.
    std::span<const std::array<std::uint32_t, 3>> triangles() const noexcept { return triangles_; }
    /// The points on edges that have only one face, ascending. Empty where there are no faces.
    std::vector<std::uint32_t> mesh_border_points() const;

    UpAxis up() const noexcept { return up_; }
    bool is_up_known() const noexcept { return is_up_known_; }  ///< As MeshSource::is_up_known.
    /// The center of the bounding box, and the maximum distance from it to a point. Zero for an empty cloud.
    const glm::dvec3& center() const noexcept { return center_; }
    double radius() const noexcept { return radius_; }

private:
    void measure();

    std::vector<glm::dvec3> positions_;
    std::vector<glm::vec3> normals_;
    std::vector<PointColor> colors_;
    std::vector<float> intensities_;
    std::vector<std::uint32_t> file_points_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::uint32_t file_point_count_ = 0;
    std::uint32_t duplicate_count_ = 0;
    std::uint32_t dropped_count_ = 0;
    std::uint32_t unused_count_ = 0;
    UpAxis up_ = UpAxis::y;
    bool is_up_known_ = false;
    glm::dvec3 center_{0.0};
    double radius_ = 0.0;
};

}  // namespace rimline
