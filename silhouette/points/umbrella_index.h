#pragma once

// The umbrellas of a point set in a Hough octree (thesis 5.3): what its silhouettes are found in.
//
// Each point has a patch of its own: a copy of itself in the middle, a copy of each point of its rings,
// and the triangles of all its umbrellas between them. Patches share no vertex, so together they are a
// mesh, to which the octree and its trackers are what they are to any other:
//
//       r2---r1          A spoke p-r with a triangle on either side, of one umbrella or of two that meet
//      /  \ /  \         there, can be a silhouette edge; one at an open gap, and the edges r-r, have
//    r3----p----r0       one triangle and cannot. p is on the silhouette when one of its spokes is.
//      \  / \  /         Which side is outside is not known and does not matter: patches are oriented
//       r4---r5          each for itself.
//
// p-q is a consensus edge when the spoke p-q of p's patch and the spoke q-p of q's both are on the
// silhouette; the two are twins.
//
// A patch takes about 6 triangles of 150 bytes: a thousand bytes a point.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/hough/hough_octree.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/points/point_surface.h"

namespace rimline {

/// Immutable: any number of silhouettes may share one, across threads.
class UmbrellaIndex {
public:
    /// `surface` is not needed afterwards. O(umbrellas log umbrellas). Throws Error{too_large} beyond
    /// 2^30 triangles, Error{cancelled}.
    explicit UmbrellaIndex(const PointSurface& surface, const LongCall& call = {});
    // The octree knows where the mesh is.
    UmbrellaIndex(const UmbrellaIndex&) = delete;
    UmbrellaIndex& operator=(const UmbrellaIndex&) = delete;

    /// Patches are stored about the origin in a size near 1, in float: coordinates far from zero lose
    /// nothing, but points nearer to each other than 2^-20 of the whole do. These take points and
    /// directions there; a point must be finite, and is moved to 2^20 sizes away if it lies farther.
    HomogeneousPoint viewpoint(const glm::dvec3& point) const noexcept;
    HomogeneousPoint direction(const glm::dvec3& direction) const noexcept;
    /// Of a position, as viewpoint() has it.
    glm::vec3 to_index(const glm::dvec3& position) const noexcept {
        return glm::vec3((position - center_) * scale_);
    }

    /// Of points that have umbrellas, some of them several times; and a sphere that holds them.
    std::span<const glm::vec3> positions() const noexcept { return mesh_.positions(); }
    glm::dvec3 center() const noexcept { return mesh_.center(); }
    double radius() const noexcept { return mesh_.radius(); }

    /// A length there over the same length in positions; a power of two.
    double scale() const noexcept { return scale_; }

    const Mesh& mesh() const noexcept { return mesh_; }
    const HoughOctree& octree() const noexcept { return octree_; }
    std::uint32_t point_count() const noexcept { return point_count_; }

    /// A spoke is named by the vertex of the mesh at its outer end. Whether an edge of the mesh is one:
    bool is_spoke(EdgeId edge) const noexcept { return is_middle_[inner_vertex(edge)]; }
    /// Where the spoke stands that an edge is.
    std::uint32_t spoke_of(EdgeId edge) const noexcept { return outer_vertex(edge); }
    /// The point whose patch it belongs to, and the one it leads to.
    PointId owner(std::uint32_t spoke) const noexcept { return owner_[spoke]; }
    PointId target(std::uint32_t spoke) const noexcept { return point_of_[spoke]; }
    /// The spoke back from there, k_no_spoke where the target's patch has none.
    std::uint32_t twin(std::uint32_t spoke) const noexcept { return twin_[spoke]; }
    static constexpr std::uint32_t k_no_spoke = 0xffffffffu;

private:
    std::uint32_t inner_vertex(EdgeId edge) const noexcept {
        const auto& v = mesh_.edge(edge).vertices;
        return std::min(index(v[0]), index(v[1]));
    }
    std::uint32_t outer_vertex(EdgeId edge) const noexcept {
        const auto& v = mesh_.edge(edge).vertices;
        return std::max(index(v[0]), index(v[1]));
    }
    MeshSource make_patches(const PointSurface& surface);
    void find_twins();

    std::uint32_t point_count_ = 0;
    glm::dvec3 center_{0.0};
    double scale_ = 1.0;  // A power of two.
    // Of each vertex of the mesh. The middle of a patch comes before its other vertices.
    std::vector<PointId> point_of_;
    std::vector<PointId> owner_;
    std::vector<std::uint32_t> twin_;
    std::vector<bool> is_middle_;
    std::vector<std::uint32_t> patch_begin_;  // Of each point, its first vertex.
    Mesh mesh_;
    HoughOctree octree_;
};

}  // namespace rimline
