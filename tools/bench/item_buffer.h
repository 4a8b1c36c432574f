#pragma once

// The face that each pixel of a picture shows, drawn on the CPU: an item buffer (Weghorst, Hooper, Greenberg
// 1984). Measures of views count its pixels, so that their results do not depend on a device.
//
// A pixel shows the face whose plane is nearest along the ray through its center, of those whose triangle
// contains the center; of equally near ones the one with the lower number. Faces are drawn from both sides.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/camera.h"
#include "silhouette/mesh/mesh.h"

namespace rimline::tools {

class ItemBuffer {
public:
    /// The mesh must outlive the buffer and lie in front of the camera. The camera must be a perspective one.
    /// O(faces + pixels they cover).
    ItemBuffer(const Mesh& mesh, const Camera& camera, std::uint32_t width, std::uint32_t height);

    std::uint32_t width() const noexcept { return width_; }
    std::uint32_t height() const noexcept { return height_; }
    /// k_no_face for the background. Rows from the top.
    FaceId face(std::uint32_t x, std::uint32_t y) const noexcept { return faces_[y * width_ + x]; }
    std::uint32_t covered_pixels() const noexcept;

    /// The point where the ray through a pixel's center meets the face's plane, as weights of the face's
    /// corners. The pixel must show a face.
    glm::dvec3 corner_weights(std::uint32_t x, std::uint32_t y) const;

    /// Whether a point of the surface is seen: it is inside the picture, and behind the plane of the face
    /// shown there by no more than `tolerance`, in units of the mesh. The same rule holds for points of
    /// faces smaller than a pixel, which are not in the buffer.
    bool sees(const glm::dvec3& point, double tolerance) const;

private:
    glm::dvec2 pixel_of(const glm::dvec3& in_camera) const;
    double depth_of(FaceId face, const glm::dvec3& p) const;
    glm::dvec3 ray_through(const glm::dvec2& pixel) const;  // In the camera's axes, with z = -1.

    const Mesh& mesh_;
    glm::dvec3 eye_;
    glm::dmat3 axes_;
    std::uint32_t width_, height_;
    glm::dvec2 half_size_;               // Of the picture at unit distance.
    std::vector<glm::dvec3> in_camera_;  // The vertices.
    std::vector<FaceId> faces_;
};

}  // namespace rimline::tools
