#include "tools/view/hough_inspection.h"

#include <glm/geometric.hpp>

#include "silhouette/hough/hough_point.h"
#include "silhouette/hough/plane_block.h"

namespace rimline::tools {

HoughInspection::HoughInspection(const ModelDocument& model)
    : unit_(model.mesh().radius() > 0.0 ? model.mesh().radius() : 1.0) {
    const HoughOctree& octree = model.octree();
    const std::uint32_t positions = octree.block_count() * k_block_size;
    point_count_ = octree.statistics().faces;
    const std::uint32_t stride = point_count_ / k_max_points + 1;
    for (std::uint32_t position = 0; position < positions; position += stride) {
        const FaceId face = octree.face_at(position);
        if (face == k_no_face) continue;
        const glm::dvec3 hough_position =
            hough_point(model.mesh().plane(face), octree.origins()[0]).position / unit_;
        points_.push_back({.position = glm::vec3(hough_position)});
    }
}

void HoughInspection::update(const ModelDocument& model, const HomogeneousPoint& point) {
    if (silhouette_point_ == point) return;
    silhouette_point_ = point;
    const glm::dvec3 origin = model.octree().origins()[0];
    is_plane_ = point.is_direction();
    const glm::dvec3 from(point.xyz());
    const glm::dvec3 pole = is_plane_ ? glm::normalize(from) : (from - origin) / unit_;
    pole_ = glm::vec3(pole);
    const double w = is_plane_ ? 0.0 : 1.0;
    for (Point& shown : points_) {
        const glm::dvec3 h(shown.position);
        shown.inside = w * glm::dot(h, h) - glm::dot(h, pole) < 0.0;
    }

    boxes_ = model.hough_boxes().walk(point);
    blocks_ = {.all = model.hough_boxes().block_count()};
    for (WalkedBox& box : boxes_) {
        box.center /= float(unit_);
        box.extent /= float(unit_);
        if (!box.is_end()) continue;
        (box.side == WalkedBox::Side::inside    ? blocks_.inside
         : box.side == WalkedBox::Side::outside ? blocks_.outside
                                                : blocks_.tested) += box.block_count;
    }
}

}  // namespace rimline::tools
