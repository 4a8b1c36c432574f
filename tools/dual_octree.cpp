#include "tools/dual_octree.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/hough/hough_point.h"
#include "silhouette/mesh/face_bits.h"

namespace rimline::tools {

void DualOctree::Box::include(const Box& other) noexcept {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
}

DualOctree::DualOctree(const Mesh& mesh, const glm::dvec3& origin) : mesh_(&mesh), origin_(origin) {
    std::vector<FaceId> faces;
    std::vector<glm::dvec3> points;
    std::vector<Box> boxes;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Plane& plane = mesh.plane(FaceId{f});
        if (!plane.has_normal()) continue;
        const HoughPoint hough = hough_point(plane, origin);
        const glm::dvec3 n(plane.nx, plane.ny, plane.nz);
        const double distance = static_cast<double>(plane.d) - glm::dot(n, origin);
        const double error = hough.error;  // Twice that of the distance.
        if (hough.side == 0 || !(std::abs(distance) > error)) {
            at_infinity_.push_back(FaceId{f});
            continue;
        }
        // 1/(distance ± error/2) is within error/|distance| of 1/distance.
        const glm::dvec3 point = n / distance;
        const glm::dvec3 spread = glm::abs(point) * (error / std::abs(distance) + 0x1p-50);
        faces.push_back(FaceId{f});
        points.push_back(point);
        boxes.push_back({point - spread, point + spread});
    }

    octree_ = build_point_octree(points);
    for (const std::uint32_t i : octree_.order) {
        const Plane& plane = mesh.plane(faces[i]);
        faces_.push_back(faces[i]);
        points_.push_back(points[i]);
        sides_.push_back(static_cast<std::int8_t>(hough_point(plane, origin).side));
    }
    boxes_.resize(octree_.nodes.size());
    for (std::size_t i = octree_.nodes.size(); i-- > 0;) {  // Children come after their parents.
        const OctreeNode& node = octree_.nodes[i];
        if (node.is_leaf())
            for (std::uint32_t k = node.begin; k < node.end; ++k)
                boxes_[i].include(boxes[octree_.order[k]]);
        for (const std::uint32_t child : node.children)
            if (child != k_no_node) boxes_[i].include(boxes_[child]);
    }
}

class DualOctree::Move {
public:
    Move(const DualOctree& octree, const HomogeneousPoint& from, const HomogeneousPoint& to,
         std::span<std::uint32_t> face_words)
        : octree_(octree),
          before_(from, octree.origin_),
          after_(to, octree.origin_),
          to_(to),
          face_words_(face_words) {}

    void visit(std::uint32_t number) {
        const OctreeNode& node = octree_.octree_.nodes[number];
        if (!node.is_leaf() || node.size() > 1) {
            ++work_.pbv_checks;
            const int before = before_.side_of(octree_.boxes_[number]);
            const int after = after_.side_of(octree_.boxes_[number]);
            if (before == after && after != 0) return;
            if (before != 0 && after != 0) {
                turn(node, after);
                return;
            }
        }
        if (node.is_leaf())
            for (std::uint32_t i = node.begin; i < node.end; ++i) check(octree_.faces_[i]);
        for (const std::uint32_t child : node.children)
            if (child != k_no_node) visit(child);
    }

    void check(FaceId face) {
        ++work_.face_checks;
        set_bit(face, is_front(octree_.mesh_->plane(face), to_));
    }

    const LiteralCounters& work() const noexcept { return work_; }

private:
    // The plane D·q = w of a silhouette point. A face's bit is that of the real value where
    // |dO||D·q - w| > 3.1u|n||p| (v_sphere.h), and |D| = |n|/|dO|.
    class DualPlane {
    public:
        DualPlane(const HomogeneousPoint& point, const glm::dvec3& origin)
            : q_(glm::dvec3(point.xyz()) - static_cast<double>(point.w) * origin),
              w_(point.w),
              margin_(0x1p-22 * glm::length(glm::dvec3(point.xyz())) + 0x1p-48 * glm::length(q_)) {}

        /// 1 or -1 when the bits of all planes in the box are certainly those of that side, else 0.
        int side_of(const Box& box) const {
            const glm::dvec3 center = 0.5 * box.low + 0.5 * box.high;
            const glm::dvec3 extent = 0.5 * box.high - 0.5 * box.low;
            const double reach = glm::length(glm::max(glm::abs(box.low), glm::abs(box.high)));
            const double value = glm::dot(center, q_) - w_;
            const double doubt =
                glm::dot(extent, glm::abs(q_)) + reach * margin_ + 0x1p-48 * w_ + 0x1p-140;
            return value > doubt ? 1 : (value < -doubt ? -1 : 0);
        }

    private:
        glm::dvec3 q_;
        double w_;
        double margin_;  // Times a box's reach.
    };

    void turn(const OctreeNode& node, int after) {
        work_.contained_faces += node.size();
        for (std::uint32_t i = node.begin; i < node.end; ++i)
            set_bit(octree_.faces_[i], after == octree_.sides_[i]);
    }

    void set_bit(FaceId face, bool front) {
        const std::uint32_t bit = 1u << (index(face) % 32);
        std::uint32_t& word = face_words_[index(face) / 32];
        word = front ? word | bit : word & ~bit;
    }

    const DualOctree& octree_;
    DualPlane before_;
    DualPlane after_;
    HomogeneousPoint to_;
    std::span<std::uint32_t> face_words_;
    LiteralCounters work_;
};

LiteralCounters DualOctree::move(const HomogeneousPoint& from, const HomogeneousPoint& to,
                                 std::span<std::uint32_t> face_words) const {
    RIMLINE_CHECK(from.is_valid() && to.is_valid());
    RIMLINE_CHECK(face_words.size() == face_word_count(mesh_->face_count()));
    Move move(*this, from, to, face_words);
    if (!octree_.nodes.empty()) move.visit(0);
    for (const FaceId face : at_infinity_) move.check(face);
    return move.work();
}

}  // namespace rimline::tools
