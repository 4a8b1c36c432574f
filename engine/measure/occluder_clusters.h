#pragma once

// Which faces need to be drawn to know what is visible of some lines.
//
// Only depth at the lines' own pixels is asked for, and lines touch few of a picture's pixels. For each
// pixel, and for square tiles of them, stands how far away the farthest line in it is; a face that
// covers the middle of no pixel with a line behind it hides nothing. Faces lie in clusters of neighbors,
// in octree order, and a cluster is left out whole
//
//   where all its faces turn their backs, if backs are culled: its normals lie in a cone, its corners in
//     a sphere, and the viewpoint is behind all planes that these allow;
//   where its sphere touches no tile with a line behind it.
//
// Faces of what is left can be looked at one by one, by the boxes around them on the screen. That takes
// a CPU less than drawing them takes one, and more than a GPU. All errs on the side of drawing, so what is
// counted at the lines does not change. Of 70,000 faces in a picture of 256² six tenths are left by
// clusters, a tenth by faces.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/mesh/mesh.h"

namespace rimline {

/// A perspective camera with a square picture, as the passes of a visible ratio see through it.
struct SquareView {
    glm::mat3 eye_from_object{1.0f};  ///< x right, y up, z towards the viewer.
    glm::vec3 eye{};
    float focal = 1.0f;  ///< Half the picture's side at unit distance is 1 / focal.
    float near_distance = 0.0f;
    float side_px = 0.0f;
};

/// How far away the lines in each pixel of a picture are. Used again from view to view.
class LineReach {
public:
    /// Forgets all lines.
    void begin(const SquareView& view);
    const SquareView& view() const noexcept { return view_; }

    /// Marks where the line between two points of the mesh may be drawn.
    void add(const glm::vec3& from, const glm::vec3& to);

    /// Whether something within `radius` of `center` may lie in front of a line.
    bool may_hide_line(const glm::vec3& center, float radius) const noexcept;

    /// A corner on the screen: its place in pixels and its distance; of distance 0 behind the near
    /// plane, without a place.
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
        int left, top, right, bottom;  // Cells, the last ones included; may be empty.
    };
    // Cells in rows, of side `cell_px`.
    struct Grid {
        float cell_px = 1.0f;
        int side = 0;
        // The distance of the farthest line in each cell; 0 where there is none.
        std::vector<float> farthest;

        void begin(float cell, float side_px);
        // The cells whose centers lie within the box from `low` to `high`, widened by `margin`.
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

class OccluderClusters {
public:
    /// Faces without a plane cover nothing and are left out. `mesh` is not needed afterwards.
    /// O(faces log faces).
    explicit OccluderClusters(const Mesh& mesh);

    /// Three vertex numbers a face.
    std::span<const Triangle> triangles() const noexcept { return triangles_; }

    /// Replaces `runs` by the clusters that may hide one of the lines in `lines`; without those that turn
    /// their backs on the viewpoint if `culls_backs`. O(clusters).
    void select(const LineReach& lines, bool culls_backs, std::vector<IndexRun>& runs) const;

    /// Replaces `faces` by those of the faces in `runs` that may hide one of the lines in `lines`. Backs
    /// are left to the GPU. `corners` are the mesh's vertices as LineReach::on_screen says.
    /// O(faces in runs).
    void select_faces(const LineReach& lines, std::span<const IndexRun> runs,
                      std::span<const glm::vec3> corners, std::vector<Triangle>& faces) const;

private:
    struct Cluster {
        glm::vec3 center;
        float radius;
        glm::vec3 axis;        // Of the cone that holds all normals.
        float sine_of_spread;  // Of its half angle; over 1 where that is not acute.
    };

    std::vector<Triangle> triangles_;
    std::vector<Cluster> clusters_;  // k_cluster_faces each, the last fewer.
};

}  // namespace rimline
