#pragma once

// The supporting planes of a mesh in unit coordinates, where its bounding sphere (Mesh::center,
// Mesh::radius) is the unit sphere. Tangential distance functions use these coordinates (thesis 4.3).
//
// The distance of a point p is n·p - d. Faces without a plane are skipped. Each plane passes through a
// corner of its face, computed in double, so a mesh far from the file's origin keeps its precision.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <stop_token>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// In loops on one thread: the planes between two checkpoints.
constexpr std::uint32_t k_planes_a_checkpoint = 1u << 16;

/// Converts between unit coordinates and model coordinates.
struct UnitFrame {
    glm::dvec3 center{0.0};
    double radius = 1.0;  ///< The model's radius. 1 if that is 0.

    glm::dvec3 from_model(const glm::dvec3& point) const { return (point - center) / radius; }
    glm::dvec3 to_model(const glm::dvec3& point) const { return center + point * radius; }
};

/// The frame of a mesh, as UnitPlanes uses it.
UnitFrame unit_frame(const Mesh& mesh);

/// Immutable. Holds no reference to the mesh.
class UnitPlanes {
public:
    /// O(faces). Throws Error{cancelled} if `stop` is requested.
    explicit UnitPlanes(const Mesh& mesh, const std::stop_token& stop = {});
    /// Planes of some faces only, for example those that face a viewpoint. The frame is that of the
    /// whole mesh.
    UnitPlanes(const Mesh& mesh, std::span<const FaceId> faces);

    const UnitFrame& frame() const noexcept { return frame_; }
    std::size_t size() const noexcept { return faces_.size(); }

    // By number, [0, size()), in the order of the faces.
    const glm::dvec3& normal(std::size_t i) const noexcept { return normals_[i]; }  ///< Unit.
    double offset(std::size_t i) const noexcept { return offsets_[i]; }             ///< d
    FaceId face(std::size_t i) const noexcept { return faces_[i]; }
    /// The area of the face, in unit coordinates.
    double area(std::size_t i) const noexcept { return areas_[i]; }

    double distance(std::size_t i, const glm::dvec3& p) const noexcept {
        const glm::dvec3& n = normals_[i];
        return (n.x * p.x + n.y * p.y + n.z * p.z) - offsets_[i];
    }

private:
    void add(const Mesh& mesh, FaceId face);

    UnitFrame frame_;
    std::vector<glm::dvec3> normals_;
    std::vector<double> offsets_;
    std::vector<double> areas_;
    std::vector<FaceId> faces_;
};

/// The planes of a mesh with their fronts outwards: those of a closed inside-out mesh (winding.h) are reversed.
UnitPlanes outward_planes(const Mesh& mesh, const std::stop_token& stop = {});

}  // namespace rimline
