#pragma once

// A mesh's supporting planes, moved so that its bounding sphere (Mesh::center, Mesh::radius) is the unit
// sphere: the coordinates in which tangential distance fields have their scales (thesis 4.3).
//
// Distances are n·p - d there. Faces without a plane are left out. Planes are taken through a corner of
// their face, in double: a mesh far from the file's origin keeps its precision.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// Unit coordinates and the model's own.
struct UnitFrame {
    glm::dvec3 center{0.0};
    double radius = 1.0;  ///< The model's; 1 for one that has none.

    glm::dvec3 from_model(const glm::dvec3& point) const { return (point - center) / radius; }
    glm::dvec3 to_model(const glm::dvec3& point) const { return center + point * radius; }
};

/// Of a mesh: what UnitPlanes uses.
UnitFrame unit_frame(const Mesh& mesh);

/// Immutable; keeps nothing of the mesh.
class UnitPlanes {
public:
    /// O(faces).
    explicit UnitPlanes(const Mesh& mesh);
    /// Of these faces alone, in the frame of the whole mesh: those that face a viewpoint, say.
    UnitPlanes(const Mesh& mesh, std::span<const FaceId> faces);

    const UnitFrame& frame() const noexcept { return frame_; }
    std::size_t size() const noexcept { return faces_.size(); }

    // By number, [0, size()), in the order of the faces.
    const glm::dvec3& normal(std::size_t i) const noexcept { return normals_[i]; }  ///< Unit.
    double offset(std::size_t i) const noexcept { return offsets_[i]; }             ///< d
    FaceId face(std::size_t i) const noexcept { return faces_[i]; }
    /// Of the face, in unit coordinates.
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

}  // namespace rimline
