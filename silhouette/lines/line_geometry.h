#pragma once

// The content of a LineSurface: what line drawings of a mesh need, once a mesh and for all cameras.

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "silhouette/lines/face_contacts.h"
#include "silhouette/lines/intersection_curves.h"
#include "silhouette/lines/vertex_stars.h"
#include "silhouette/mesh/face_tree.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class LineGeometry {
public:
    /// As LineSurface's constructor.
    LineGeometry(const Mesh& mesh, bool finds_contacts, const LongCall& call);

    const Mesh& mesh() const noexcept { return mesh_; }
    const VertexStars& stars() const noexcept { return stars_; }
    const FaceTree& tree() const noexcept { return tree_; }
    const FaceContacts& contacts() const noexcept { return contacts_; }
    /// Whether a vertex has touches: most have none.
    bool has_touches(std::uint32_t vertex) const noexcept {
        return !is_touched_.empty() && is_touched_[vertex] != 0;
    }
    const IntersectionCurves& curves() const noexcept { return curves_; }
    /// By edge, its bend in radians (creases.h).
    std::span<const float> bends_rad() const noexcept { return bends_rad_; }
    /// By vertex, the greatest bend of its edges.
    std::span<const float> sharpest_bends_rad() const noexcept { return sharpest_bends_rad_; }
    /// Faces whose plane (Mesh::plane()) may be far from their corners: slivers. Ascending.
    std::span<const std::uint32_t> slivers() const noexcept { return slivers_; }
    /// Edges that can hide others though they are not on a silhouette: non-manifold ones, and those of faces
    /// without an area.
    std::span<const EdgeId> special_edges() const noexcept { return special_edges_; }

private:
    void find_bends(const std::stop_token& stop);
    void find_slivers(const std::stop_token& stop);
    void find_special_edges(std::span<const std::uint8_t> is_flat);

    const Mesh& mesh_;
    VertexStars stars_;
    FaceTree tree_;
    FaceContacts contacts_;
    std::vector<std::uint8_t> is_touched_;
    IntersectionCurves curves_;
    std::vector<float> bends_rad_, sharpest_bends_rad_;
    std::vector<std::uint32_t> slivers_;
    std::vector<EdgeId> special_edges_;
};

}  // namespace rimline
