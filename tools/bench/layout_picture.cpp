#include "tools/bench/layout_picture.h"

#include <cmath>
#include <glm/vec3.hpp>

#include "silhouette/hough/box_walk.h"
#include "silhouette/hough/hough_point.h"
#include "silhouette/hough/plane_block.h"

namespace rimline::tools {

namespace {

LayoutPicture::End end_of(WalkedBox::Side side) {
    switch (side) {
        case WalkedBox::Side::inside: return LayoutPicture::End::inside;
        case WalkedBox::Side::outside: return LayoutPicture::End::outside;
        case WalkedBox::Side::straddles: break;
    }
    return LayoutPicture::End::looked_at;
}

// Counts an end of the traversal, and adds its box where it meets the plane.
void add_end(const WalkedBox& walked, double unit, LayoutPicture& picture) {
    const LayoutPicture::End end = end_of(walked.side);
    (end == LayoutPicture::End::looked_at ? picture.blocks_looked_at : picture.blocks_settled) +=
        walked.block_count;
    if (std::abs(walked.center.z) > walked.extent.z) return;
    LayoutPicture::Box box{{}, {}, walked.height, end};
    for (int axis = 0; axis < 2; ++axis) {
        const double c = walked.center[axis];
        const double e = walked.extent[axis];
        const auto i = static_cast<std::size_t>(axis);
        box.low[i] = (c - e) / unit;
        box.high[i] = (c + e) / unit;
    }
    picture.boxes.push_back(box);
}

}  // namespace

std::string_view name_of(LayoutPicture::End end) noexcept {
    switch (end) {
        case LayoutPicture::End::inside: return "inside";
        case LayoutPicture::End::outside: return "outside";
        case LayoutPicture::End::looked_at: return "looked_at";
    }
    return "";
}

LayoutPicture picture_layout(const HoughOctree& octree, double radii, double angle_rad,
                             double thickness) {
    LayoutPicture picture;
    const Mesh& mesh = octree.mesh();
    if (octree.block_count() == 0) return picture;
    const double unit = mesh.radius();
    const glm::dvec3& origin = octree.origins()[0];
    picture.pole = {radii * std::cos(angle_rad), radii * std::sin(angle_rad)};

    const HoughBoxes boxes(octree, 0);
    // The blocks of the first origin come first.
    for (std::uint32_t position = 0; position < boxes.block_count() * k_block_size; ++position) {
        const FaceId face = octree.face_at(position);
        if (face == k_no_face) continue;
        const glm::dvec3 at = hough_point(mesh.plane(face), origin).position / unit;
        if (std::abs(at.z) <= thickness)
            picture.points.push_back({at.x, at.y, position / k_block_size});
    }
    const glm::dvec3 from = origin + unit * glm::dvec3(picture.pole[0], picture.pole[1], 0.0);
    picture.blocks = boxes.block_count();
    for (const WalkedBox& walked : boxes.walk(HomogeneousPoint::viewpoint(glm::vec3(from)))) {
        ++picture.boxes_tested;
        if (walked.is_end()) add_end(walked, unit, picture);
    }
    return picture;
}

}  // namespace rimline::tools
