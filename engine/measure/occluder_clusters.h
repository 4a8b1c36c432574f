#pragma once

// The faces that must be drawn to know which parts of some lines are visible.
//
// Only the depth at the lines' own pixels matters, and lines cover few pixels of a picture. For each pixel,
// and for square tiles of pixels, the distance of the farthest line in it is stored. A face that covers the
// center of no pixel with a line behind it hides nothing. Faces are grouped into clusters of neighbors, in
// octree order. A whole cluster is omitted
//
//   if backs are culled and all its faces are back faces: its normals lie in a cone, its corners in a
//     sphere, and the viewpoint is behind every plane with such a normal through such a corner;
//   if its sphere touches no tile with a line behind it.
//
// The faces of the remaining clusters can be tested one by one, by their boxes on the screen. On a CPU that
// is cheaper than drawing them there, but a GPU draws them faster. All tests are conservative: faces that do
// not hide a line may be kept, never the reverse, so the pixel counts do not change. Of 70,000 faces in a
// picture of 256 x 256, clusters keep six tenths, and faces one tenth.

#include <cstddef>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The perspective camera of a visible ratio, with a square picture.
struct SquareView {
    glm::mat3 eye_from_object{1.0f};  ///< x right, y up, z towards the viewer.
    glm::vec3 eye{};
    float focal = 1.0f;  ///< Half the picture's side at unit distance is 1 / focal.
    float near_distance = 0.0f;
    float side_px = 0.0f;
};

/// The distance of the lines in each pixel of a picture. Reusable for many views.
class LineReach {
public:
    /// Removes all lines.
    void begin(const SquareView& view);
    const SquareView& view() const noexcept { return view_; }

    /// Marks the pixels where the line between two points of the mesh may be drawn.
    void add(const glm::vec3& from, const glm::vec3& to);

    /// Whether an object within `radius` of `center` may lie in front of a line.
    bool may_hide_line(const glm::vec3& center, float radius) const noexcept;

    /// A corner on the screen: its position in pixels and its distance. Zero if it lies in front of the near
    /// plane or behind the viewer.
    glm::vec3 on_screen(const glm::vec3& position) const noexcept {
        const glm::vec3 eye = eye_from_object(position);
        const float scale = half_px_ * view_.focal / -eye.z;
        return -eye.z < view_.near_distance
                   ? glm::vec3(0.0f)
                   : glm::vec3(half_px_ + scale * eye.x, half_px_ - scale * eye.y, -eye.z);
    }

    /// Whether the triangle between three corners on the screen may cover a line's pixel in front of it.
    bool may_hide_line(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) const noexcept;

private:
    struct Box {
        int left, top, right, bottom;  // Cells, with the last ones included; may be empty.
    };
    // Cells in rows, of side `cell_px`.
    struct Grid {
        float cell_px = 1.0f;
        int side = 0;
        // The distance of the farthest line in each cell; 0 where there is none.
        std::vector<float> farthest;

        void begin(float cell, float side_px);
        // The cells whose centers lie within the box from `low` to `high`, widened by `margin_px`.
        Box cells_of(glm::vec2 low, glm::vec2 high, float margin_px) const noexcept;
        void mark(const Box& box, float distance) noexcept;
        bool has_line_beyond(const Box& box, float distance) const noexcept;
    };

    glm::vec3 eye_from_object(const glm::vec3& position) const noexcept {
        return view_.eye_from_object * (position - view_.eye);
    }

    SquareView view_{};
    float half_px_ = 0.0f;  // Half the picture's side.
    Grid pixels_;
    Grid tiles_;
};

/// Indices to draw: [first, first + count).
struct IndexRun {
    std::uint32_t first;
    std::uint32_t count;
};

/// Joins runs over the smallest gaps between them until at most `max_runs`, not 0, are left: each run is a draw call.
/// `runs` are in ascending order. O(runs).
void join_runs(std::vector<IndexRun>& runs, std::size_t max_runs);

class OccluderClusters {
public:
    /// Faces without a plane cover nothing and are omitted. `mesh` is not needed afterwards.
    /// O(faces log faces).
    explicit OccluderClusters(const Mesh& mesh);

    /// Three vertex numbers a face.
    std::span<const Triangle> triangles() const noexcept { return triangles_; }

    /// Replaces `runs` by the clusters that may hide one of the lines in `lines`; if `culls_backs`, without
    /// clusters of back faces only. O(clusters).
    void select(const LineReach& lines, bool culls_backs, std::vector<IndexRun>& runs) const;

    /// Replaces `faces` by those of the faces in `runs` that may hide one of the lines in `lines`. Does not
    /// cull backs; the GPU does. `corners` are LineReach::on_screen() of the mesh's vertices.
    /// O(faces in runs).
    void select_faces(const LineReach& lines, std::span<const IndexRun> runs,
                      std::span<const glm::vec3> corners, std::vector<Triangle>& faces) const;

private:
    struct Cluster {
        glm::vec3 center;
        float radius;
        glm::vec3 axis;        // Of the cone that holds all normals.
        float sine_of_spread;  // The sine of its half angle; 2 if that is not acute.
    };

    std::vector<Triangle> triangles_;
    std::vector<Cluster> clusters_;  // k_cluster_faces each, the last fewer.
};

}  // namespace rimline
