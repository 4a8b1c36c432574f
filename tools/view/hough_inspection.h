#pragma once

// Hough space prepared for display: the Hough points of the faces, the v-sphere of the silhouette point, and
// the boxes of the octree that a query visits (silhouette/hough/hough_octree.h). Lengths are in the model's
// radii, so the points of every model lie within the unit sphere around the origin.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "silhouette/hough/box_walk.h"
#include "tools/view/model_document.h"

namespace rimline::tools {

class HoughInspection {
public:
    /// Of more points than this a subset is shown, spread evenly over the order of the octree.
    static constexpr std::uint32_t k_max_points = 6000;

    struct Point {
        glm::vec3 position;
        bool inside = false;  ///< Inside the v-sphere.
    };

    /// Copies the points of `model`. O(faces shown).
    explicit HoughInspection(const ModelDocument& model);

    /// Sets the silhouette point. `model` is the model that was given to the constructor. Does nothing if
    /// `point` has not changed. O(boxes visited + points shown).
    void update(const ModelDocument& model, const HomogeneousPoint& point);

    const std::vector<Point>& points() const noexcept { return points_; }
    /// Of all points, shown or not.
    std::uint32_t point_count() const noexcept { return point_count_; }
    /// All boxes that the query visits, in the model's radii.
    const std::vector<WalkedBox>& boxes() const noexcept { return boxes_; }
    /// The pole q of the v-sphere opposite the origin. For a direction the v-sphere is a plane, and this is
    /// its normal.
    const glm::vec3& pole() const noexcept { return pole_; }
    bool is_plane() const noexcept { return is_plane_; }

    struct Blocks {
        std::uint32_t all = 0;
        std::uint32_t inside = 0;   ///< Certainly inside the v-sphere, by a box of theirs or above.
        std::uint32_t outside = 0;  ///< Certainly outside, likewise.
        std::uint32_t tested = 0;   ///< Neither: tested face by face.
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
    std::optional<HomogeneousPoint> silhouette_point_;
};

}  // namespace rimline::tools
