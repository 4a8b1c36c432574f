#include "tools/layout_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <utility>

#include "silhouette/hough/box_tree.h"
#include "silhouette/hough/hough_point.h"
#include "silhouette/hough/plane_block.h"

namespace rimline::tools {

namespace {

// Follows one query from the root, as block_kernels.cpp does eight boxes at a time.
class Walk {
public:
    Walk(const BoxTree& tree, const BoxQuery& query, double unit, LayoutPicture& picture)
        : tree_(tree), query_(query), unit_(unit), picture_(picture) {}

    void visit(std::uint32_t level, std::uint32_t number) {
        const BoxNode& node = tree_.level(level)[number];
        for (std::uint32_t lane = 0; lane < k_node_width; ++lane) {
            if (std::isnan(node.reach[lane])) continue;
            ++picture_.boxes_tested;
            const std::uint32_t above_blocks = tree_.level_count() - 1 - level;
            const std::uint32_t child = number * k_node_width + lane;
            const double side = side_of(node, lane);
            if (side == 0.0 && above_blocks > 0) {
                visit(level + 1, child);
                continue;
            }
            if (side == 0.0)
                ++picture_.blocks_looked_at;
            else
                picture_.blocks_settled += blocks_below(above_blocks, child);
            draw(node, lane, above_blocks,
                 side == 0.0  ? LayoutPicture::End::looked_at
                 : side < 0.0 ? LayoutPicture::End::inside
                              : LayoutPicture::End::outside);
        }
    }

private:
    // Of g (box_tree.h): its sign where that is certain, else 0.
    double side_of(const BoxNode& node, std::uint32_t lane) const {
        double value = 0.0;
        double range = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double c = node.center[axis][lane];
            const double e = node.extent[axis][lane];
            value += c * (query_.w * c - query_.q[axis]);
            range += e * (std::abs(2.0 * query_.w * c - query_.q[axis]) + query_.w * e);
        }
        range += double{node.reach[lane]} * query_.margin + query_.least_margin;
        return std::abs(value) > range ? value : 0.0;
    }

    std::uint32_t blocks_below(std::uint32_t above_blocks, std::uint32_t child) const {
        const std::uint64_t width = std::uint64_t{1} << (3 * above_blocks);  // 8 to that power.
        const std::uint64_t begin = child * width;
        return static_cast<std::uint32_t>(std::min(width, tree_.block_count() - begin));
    }

    void draw(const BoxNode& node, std::uint32_t lane, std::uint32_t level,
              LayoutPicture::End end) {
        if (std::abs(node.center[2][lane]) > node.extent[2][lane]) return;
        LayoutPicture::Box box{{}, {}, level, end};
        for (int axis = 0; axis < 2; ++axis) {
            const double c = node.center[axis][lane];
            const double e = node.extent[axis][lane];
            const auto i = static_cast<std::size_t>(axis);
            box.low[i] = (c - e) / unit_;
            box.high[i] = (c + e) / unit_;
        }
        picture_.boxes.push_back(box);
    }

    const BoxTree& tree_;
    const BoxQuery& query_;
    double unit_;
    LayoutPicture& picture_;
};

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

    // The first origin's blocks come first.
    const std::uint32_t faces = octree.statistics().group_faces[0];
    std::vector<HoughBounds> bounds((faces + k_block_size - 1) / k_block_size);
    for (std::uint32_t block = 0; block < bounds.size(); ++block) {
        for (std::uint32_t lane = 0; lane < k_block_size; ++lane) {
            const FaceId face = octree.face_at(block * k_block_size + lane).face;
            if (face == k_no_face) continue;
            const HoughPoint point = hough_point(mesh.plane(face), origin);
            bounds[block].include(point);
            const glm::dvec3 at = point.position / unit;
            if (std::abs(at.z) <= thickness) picture.points.push_back({at.x, at.y, block});
        }
    }
    const BoxTree tree(std::move(bounds));
    const glm::dvec3 from = origin + unit * glm::dvec3(picture.pole[0], picture.pole[1], 0.0);
    const BoxQuery query(HomogeneousPoint::viewpoint(glm::vec3(from)), origin,
                         tree.greatest_reach());
    picture.blocks = tree.block_count();
    Walk(tree, query, unit, picture).visit(0, 0);
    return picture;
}

}  // namespace rimline::tools
