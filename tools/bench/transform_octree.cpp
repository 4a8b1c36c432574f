#include "tools/bench/transform_octree.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "silhouette/mesh/face_bits.h"

namespace rimline::tools {

namespace {

std::optional<HoughPoint> dual_point(const Plane& plane, const glm::dvec3& origin) {
    const HoughPoint hough = hough_point(plane, origin);
    const glm::dvec3 n = plane.normal();
    const double distance = static_cast<double>(plane.d) - glm::dot(n, origin);
    const double size = std::abs(distance);
    if (!(size > hough.error)) return std::nullopt;
    // hough.error is twice the error of the distance: the relative error of 1/distance is hough.error/size.
    const glm::dvec3 point = n / distance;
    return HoughPoint{point, glm::length(point) * (hough.error / size + 0x1p-50), hough.side};
}

// 1 where all planes of a box are certainly front if dO > 0 and back if dO < 0; -1 for the opposite; 0 where
// neither is certain.
int side_of(const VSphere& sphere, const HoughBox& box, float reach) {
    switch (sphere.side_of(box, reach)) {
        case VSphereSide::inside: return 1;
        case VSphereSide::outside: return -1;
        case VSphereSide::mixed: break;
    }
    return 0;
}

// n·p - w*d = dO (D·q - w). The face bit is that of the real value where |dO||D·q - w| > 3.1u|n||p|
// (v_sphere.h), and |D| = |n|/|dO|.
class DualPlane {
public:
    DualPlane(const HomogeneousPoint& point, const glm::dvec3& origin)
        : q_(glm::dvec3(point.xyz()) - static_cast<double>(point.w) * origin),
          w_(point.w),
          margin_(0x1p-22 * glm::length(glm::dvec3(point.xyz())) + 0x1p-48 * glm::length(q_)) {}

    friend int side_of(const DualPlane& plane, const HoughBox& box, float reach) {
        double value = -plane.w_;
        double doubt = double{reach} * plane.margin_ + 0x1p-48 * plane.w_ + 0x1p-140;
        for (std::size_t i = 0; i < 3; ++i) {
            const double q = plane.q_[static_cast<int>(i)];
            value += 0.5 * (double{box.low[i]} + double{box.high[i]}) * q;
            doubt += 0.5 * (double{box.high[i]} - double{box.low[i]}) * std::abs(q);
        }
        return value > doubt ? 1 : (value < -doubt ? -1 : 0);
    }

private:
    glm::dvec3 q_;
    double w_;
    double margin_;  // Times a box's reach.
};

}  // namespace

TransformOctree::TransformOctree(const Mesh& mesh, const glm::dvec3& origin,
                                 PlaneTransform transform, NodeBoxes node_boxes)
    : mesh_(&mesh), origin_(origin), transform_(transform), node_boxes_(node_boxes) {
    std::vector<FaceId> faces;
    std::vector<HoughPoint> placed;
    std::vector<glm::dvec3> points;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        const Plane& plane = mesh.plane(FaceId{f});
        if (!plane.has_normal()) continue;
        const std::optional<HoughPoint> point = transform == PlaneTransform::hough
                                                    ? hough_point(plane, origin)
                                                    : dual_point(plane, origin);
        if (!point) {
            at_infinity_.push_back(FaceId{f});
            continue;
        }
        faces.push_back(FaceId{f});
        placed.push_back(*point);
        points.push_back(point->position);
    }
    octree_ = build_point_octree(points);
    for (const std::uint32_t i : octree_.order) {
        faces_.push_back(faces[i]);
        points_.push_back(points[i]);
        sides_.push_back(static_cast<std::int8_t>(placed[i].side));
    }
    bound_nodes(placed);
}

void TransformOctree::bound_nodes(std::span<const HoughPoint> placed) {
    boxes_.resize(octree_.nodes.size());
    if (node_boxes_ == NodeBoxes::octants && !boxes_.empty()) include_octants(0, octree_.root);
    for (std::size_t i = boxes_.size(); i-- > 0;) {  // Children are stored after their parents.
        const OctreeNode& node = octree_.nodes[i];
        HoughBox& box = boxes_[i].box;
        if (node.is_leaf())
            for (std::uint32_t k = node.begin; k < node.end; ++k)
                box.include(placed[octree_.order[k]]);
        for (const std::uint32_t child : node.children)
            if (child != k_no_node) box.include(boxes_[child].box);
        boxes_[i].reach = box.reach();
    }
}

void TransformOctree::include_octants(std::uint32_t number, const Octant& octant) {
    boxes_[number].box.include(HoughPoint{octant.low, 0.0, 0});
    boxes_[number].box.include(HoughPoint{octant.high, 0.0, 0});
    const OctreeNode& node = octree_.nodes[number];
    for (std::uint32_t i = 0; i < 8; ++i)
        if (node.children[i] != k_no_node) include_octants(node.children[i], octant.child(i));
}

class TransformOctree::Move {
public:
    Move(const TransformOctree& octree, const HomogeneousPoint& to,
         std::span<std::uint32_t> face_words)
        : octree_(octree), to_(to), face_words_(face_words) {}

    template <typename Side>
    void visit(std::uint32_t number, const Side& before, const Side& after) {
        const OctreeNode& node = octree_.octree_.nodes[number];
        if (!node.is_leaf() || node.size() > 1) {
            ++(octree_.node_boxes_ == NodeBoxes::tight ? work_.pbv_checks : work_.obv_checks);
            const Box& box = octree_.boxes_[number];
            const int side_before = side_of(before, box.box, box.reach);
            const int side_after = side_of(after, box.box, box.reach);
            if (side_before == side_after && side_after != 0) return;
            if (side_before != 0 && side_after != 0) {
                turn(node, side_after);
                return;
            }
        }
        if (node.is_leaf())
            for (std::uint32_t i = node.begin; i < node.end; ++i) check(octree_.faces_[i]);
        for (const std::uint32_t child : node.children)
            if (child != k_no_node) visit(child, before, after);
    }

    void check(FaceId face) {
        ++work_.face_checks;
        set_bit(face, is_front(octree_.mesh_->plane(face), to_));
    }

    const LiteralCounters& work() const noexcept { return work_; }

private:
    void turn(const OctreeNode& node, int side) {
        work_.contained_faces += node.size();
        for (std::uint32_t i = node.begin; i < node.end; ++i)
            set_bit(octree_.faces_[i], side == octree_.sides_[i]);
    }

    void set_bit(FaceId face, bool front) {
        const std::uint32_t bit = 1u << (index(face) % 32);
        std::uint32_t& word = face_words_[index(face) / 32];
        word = front ? word | bit : word & ~bit;
    }

    const TransformOctree& octree_;
    HomogeneousPoint to_;
    std::span<std::uint32_t> face_words_;
    LiteralCounters work_;
};

LiteralCounters TransformOctree::move(const HomogeneousPoint& from, const HomogeneousPoint& to,
                                      std::span<std::uint32_t> face_words) const {
    RIMLINE_CHECK(from.is_valid() && to.is_valid());
    RIMLINE_CHECK(face_words.size() == face_word_count(mesh_->face_count()));
    Move move(*this, to, face_words);
    if (!boxes_.empty()) {
        if (transform_ == PlaneTransform::hough) {
            const float reach = boxes_[0].reach;  // Every other box lies within the root's.
            move.visit(0, VSphere(from, origin_, reach), VSphere(to, origin_, reach));
        } else {
            move.visit(0, DualPlane(from, origin_), DualPlane(to, origin_));
        }
    }
    for (const FaceId face : at_infinity_) move.check(face);
    return move.work();
}

}  // namespace rimline::tools
