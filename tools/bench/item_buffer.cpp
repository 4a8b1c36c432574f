#include "tools/bench/item_buffer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "silhouette/error.h"

namespace rimline::tools {

namespace {

// The point where the ray meets the plane through three points, as a multiple of the ray. Infinite if none.
double share_of_ray(const glm::dvec3& ray, const glm::dvec3& a, const glm::dvec3& b,
                    const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double along = glm::dot(normal, ray);
    if (along == 0.0) return std::numeric_limits<double>::infinity();
    return glm::dot(normal, a) / along;
}

double twice_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

ItemBuffer::ItemBuffer(const Mesh& mesh, const Camera& camera, std::uint32_t width,
                       std::uint32_t height)
    : mesh_(mesh),
      eye_(camera.eye),
      axes_(camera_from_world(camera)),
      width_(width),
      height_(height),
      faces_(std::size_t{width} * height, k_no_face) {
    RIMLINE_CHECK(!camera.is_orthographic() && width > 0 && height > 0);
    const double tangent = std::tan(0.5 * glm::radians(camera.fov_y_deg));
    half_size_ = tangent * glm::dvec2(double(width) / height, 1.0);
    std::vector<glm::dvec2> on_screen;
    for (const glm::vec3& position : mesh.positions()) {
        const glm::dvec3 p = axes_ * (glm::dvec3(position) - eye_);
        RIMLINE_CHECK(p.z < 0.0);
        in_camera_.push_back(p);
        on_screen.push_back(pixel_of(p));
    }
    std::vector<double> nearness(faces_.size(), 0.0);  // 1 / distance along the view.
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Triangle& triangle = mesh.triangles()[f];
        const glm::dvec2 a = on_screen[index(triangle[0])];
        const glm::dvec2 b = on_screen[index(triangle[1])];
        const glm::dvec2 c = on_screen[index(triangle[2])];
        const double area = twice_area(a, b, c);
        if (area == 0.0) continue;
        // 1/z of a plane is linear on the screen.
        const double za = -1.0 / in_camera_[index(triangle[0])].z;
        const double zb = -1.0 / in_camera_[index(triangle[1])].z;
        const double zc = -1.0 / in_camera_[index(triangle[2])].z;
        const auto first = [](double v) { return std::max(0, int(std::ceil(v - 0.5))); };
        const auto last = [](double v, std::uint32_t size) {
            return std::min(int(size) - 1, int(std::floor(v - 0.5)));
        };
        const int top = first(std::min({a.y, b.y, c.y}));
        const int bottom = last(std::max({a.y, b.y, c.y}), height);
        const int left = first(std::min({a.x, b.x, c.x}));
        const int right = last(std::max({a.x, b.x, c.x}), width);
        for (int y = top; y <= bottom; ++y)
            for (int x = left; x <= right; ++x) {
                const glm::dvec2 p(x + 0.5, y + 0.5);
                const double wa = twice_area(b, c, p) / area;
                const double wb = twice_area(c, a, p) / area;
                const double wc = twice_area(a, b, p) / area;
                if (wa < 0.0 || wb < 0.0 || wc < 0.0) continue;
                const std::size_t pixel = std::size_t(y) * width + std::size_t(x);
                const double near = wa * za + wb * zb + wc * zc;
                if (near <= nearness[pixel]) continue;
                nearness[pixel] = near;
                faces_[pixel] = FaceId{f};
            }
    }
}

glm::dvec2 ItemBuffer::pixel_of(const glm::dvec3& p) const {
    const glm::dvec2 place = glm::dvec2(p.x, -p.y) / -p.z / half_size_;
    return 0.5 * (place + 1.0) * glm::dvec2(width_, height_);
}

glm::dvec3 ItemBuffer::ray_through(const glm::dvec2& pixel) const {
    const glm::dvec2 place = 2.0 * pixel / glm::dvec2(width_, height_) - 1.0;
    return {place.x * half_size_.x, -place.y * half_size_.y, -1.0};
}

std::uint32_t ItemBuffer::covered_pixels() const noexcept {
    return static_cast<std::uint32_t>(faces_.size()) -
           static_cast<std::uint32_t>(std::count(faces_.begin(), faces_.end(), k_no_face));
}

glm::dvec3 ItemBuffer::corner_weights(std::uint32_t x, std::uint32_t y) const {
    const FaceId shown = face(x, y);
    RIMLINE_CHECK(shown != k_no_face);
    const Triangle& triangle = mesh_.triangles()[index(shown)];
    const glm::dvec3& a = in_camera_[index(triangle[0])];
    const glm::dvec3& b = in_camera_[index(triangle[1])];
    const glm::dvec3& c = in_camera_[index(triangle[2])];
    const glm::dvec3 ray = ray_through({x + 0.5, y + 0.5});
    const glm::dvec3 p = share_of_ray(ray, a, b, c) * ray;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = glm::dot(normal, normal);
    const double wb = glm::dot(normal, glm::cross(p - a, c - a)) / area;
    const double wc = glm::dot(normal, glm::cross(b - a, p - a)) / area;
    return {1.0 - wb - wc, wb, wc};
}

// The depth along the view where a ray to `p` meets the face's plane. A plane seen edge-on meets the ray
// anywhere: the depth is limited to the face's own extent in depth beyond the face.
double ItemBuffer::depth_of(FaceId face, const glm::dvec3& p) const {
    const Triangle& triangle = mesh_.triangles()[index(face)];
    const glm::dvec3& a = in_camera_[index(triangle[0])];
    const glm::dvec3& b = in_camera_[index(triangle[1])];
    const glm::dvec3& c = in_camera_[index(triangle[2])];
    const double nearest = -std::max({a.z, b.z, c.z});
    const double farthest = -std::min({a.z, b.z, c.z});
    const double depth = farthest - nearest;
    return std::clamp(share_of_ray(p, a, b, c) * -p.z, nearest - depth, farthest + depth);
}

bool ItemBuffer::sees(const glm::dvec3& point, double tolerance) const {
    const glm::dvec3 p = axes_ * (point - eye_);
    const glm::dvec2 pixel = pixel_of(p);
    if (!(pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < width_ && pixel.y < height_)) return false;
    const auto x = static_cast<int>(pixel.x);
    const auto y = static_cast<int>(pixel.y);
    const auto is_before = [&](FaceId shown) { return -p.z <= depth_of(shown, p) + tolerance; };
    const FaceId shown = face(std::uint32_t(x), std::uint32_t(y));
    if (shown != k_no_face) return is_before(shown);
    // On the outline: the neighbors show whether the point belongs to the near or the far side.
    bool is_alone = true;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, int(height_) - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, int(width_) - 1); ++u) {
            const FaceId beside = face(std::uint32_t(u), std::uint32_t(v));
            if (beside == k_no_face) continue;
            if (is_before(beside)) return true;
            is_alone = false;
        }
    return is_alone;
}

}  // namespace rimline::tools
