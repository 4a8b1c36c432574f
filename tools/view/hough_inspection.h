#pragma once

// Hough space to look at: the points of the faces, the v-sphere of the silhouette point, and the boxes of
// the index that it visits (silhouette/hough/hough_octree.h). Lengths are in the model's radii, so that
// every model's points lie within the unit sphere around the origin.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "silhouette/hough/box_walk.h"
#include "tools/view/model_document.h"

namespace rimline::tools {

class HoughInspection {
public:
    /// More points than this are not shown: so many of them, spread evenly over the octree's order.
    static constexpr std::uint32_t k_max_points = 6000;

    struct Point {
        glm::vec3 place;
        bool inside = false;  ///< Of the v-sphere.
    };

    /// Takes the points of `model`, which is not needed afterwards but by update(). O(faces shown).
    explicit HoughInspection(const ModelDocument& model);

    /// Looks from `point`. Does nothing where that is the point of the last time. O(boxes visited +
    /// points shown).
    void update(const ModelDocument& model, const HomogeneousPoint& point);

    const std::vector<Point>& points() const noexcept { return points_; }
    std::uint32_t point_count() const noexcept { return point_count_; }  ///< With those not shown.
    /// All that are visited, in the model's radii as well.
    const std::vector<WalkedBox>& boxes() const noexcept { return boxes_; }
    /// The pole q of the v-sphere opposite the origin; for directions, the normal of the plane that the
    /// v-sphere is then.
    const glm::vec3& pole() const noexcept { return pole_; }
    bool is_plane() const noexcept { return is_plane_; }

    struct Blocks {
        std::uint32_t all = 0;
        std::uint32_t inside = 0;     ///< Settled by a box of theirs or above.
        std::uint32_t outside = 0;    ///< The same.
        std::uint32_t looked_at = 0;  ///< Face by face.
    };
    const Blocks& blocks() const noexcept { return blocks_; }

private:
    double unit_;
    std::vector<Point> points_;
    std::uint32_t point_count_ = 0;
    std::vector<WalkedBox> boxes_;
    glm::vec3 pole_{0.0f};
    bool is_plane_ = false;
    Blocks blocks_;
    std::optional<HomogeneousPoint> seen_from_;
};

}  // namespace rimline::tools
