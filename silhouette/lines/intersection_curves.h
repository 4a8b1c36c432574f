#pragma once

// The curves along which faces of a mesh pass through each other: where a spout meets its pot. They do not depend
// on the view, so they are found once a mesh, from the contacts of its faces (face_contacts.h).
//
// Two faces that are not coplanar meet in one segment at most. Its ends are nodes: a piercing, a crossing of two
// edges, or a vertex. Segments that share a node go on into each other. Nodes have rounded positions; which faces
// meet there is exact.
//
//            face f, from the side
//               |
//     g --------x-------- g       x: the segment of f and g, seen end-on
//               |

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/lines/face_contacts.h"
#include "silhouette/lines/vertex_stars.h"
#include "silhouette/mesh/face_tree.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class IntersectionCurves {
public:
    /// A face that contains a node.
    struct NodeFace {
        std::uint32_t face;
        /// The side of the face that the node lies on, FaceContacts::Touch::k_inside, or k_corner.
        std::uint32_t place;
        static constexpr std::uint32_t k_corner = 4;
        auto operator<=>(const NodeFace&) const = default;
    };
    /// A place of a segment, as a share of its length, where a face that does not contain it may hide it from
    /// there on.
    struct Passage {
        enum class Kind : std::uint8_t {
            through,   ///< The segment passes through the face.
            doubtful,  ///< It passes the border of the face so near that doubles cannot tell.
            touch,     ///< It begins or ends to lie in the plane of the face, and on it.
        } kind;
        std::uint32_t face;
        double share;
    };
    struct Segment {
        std::array<std::uint32_t, 2> nodes;
        std::array<std::uint32_t, 2> faces;  ///< The first pair of faces that meet in it.
    };

    IntersectionCurves() = default;
    /// O(contacts log contacts + segments log faces) on all threads of oneTBB. `is_flat` as find_flat_faces().
    /// Throws Error{cancelled}.
    IntersectionCurves(const Mesh& mesh, const VertexStars& stars, const FaceTree& tree,
                       const FaceContacts& contacts, std::span<const std::uint8_t> is_flat,
                       const LongCall& call);

    std::span<const Segment> segments() const noexcept { return segments_; }
    std::uint32_t node_count() const noexcept {
        return static_cast<std::uint32_t>(positions_.size());
    }
    const glm::dvec3& position(std::uint32_t node) const noexcept { return positions_[node]; }
    /// The vertex that the node is, or k_no_contact_vertex.
    std::uint32_t vertex(std::uint32_t node) const noexcept { return vertices_[node]; }
    static constexpr std::uint32_t k_no_contact_vertex = 0xffffffffu;
    /// Ascending.
    std::span<const NodeFace> faces_at(std::uint32_t node) const noexcept {
        return {node_faces_.data() + node_face_begin_[node],
                node_faces_.data() + node_face_begin_[node + 1]};
    }
    /// By share. Passages through faces that contain an end are up to the local rule (curve_rule.h).
    std::span<const Passage> passages(std::uint32_t segment) const noexcept {
        return {passages_.data() + passage_begin_[segment],
                passages_.data() + passage_begin_[segment + 1]};
    }
    /// Whether a face contains both ends of a segment, and therefore all of it. O(log faces), as contains().
    bool is_own(const Segment& segment, std::uint32_t face) const noexcept {
        return contains(segment.nodes[0], face) && contains(segment.nodes[1], face);
    }
    /// Whether a face contains a node.
    bool contains(std::uint32_t node, std::uint32_t face) const noexcept;

private:
    // What a node is: a piercing of an edge and a face, a crossing of two edges, or a vertex.
    struct Key {
        enum class Kind : std::uint32_t { piercing, crossing, vertex } kind;
        std::uint32_t a, b;
        auto operator<=>(const Key&) const = default;
    };
    // A node of the segment of two faces.
    struct PairNode {
        std::array<std::uint32_t, 2> faces;
        Key key;
        auto operator<=>(const PairNode&) const = default;
    };
    class Builder;

    std::vector<Segment> segments_;
    std::vector<glm::dvec3> positions_;
    std::vector<std::uint32_t> vertices_;
    std::vector<std::uint32_t> node_face_begin_;
    std::vector<NodeFace> node_faces_;
    std::vector<std::uint32_t> passage_begin_;
    std::vector<Passage> passages_;
};

}  // namespace rimline
