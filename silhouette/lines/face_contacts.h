#pragma once

// Where the faces of a mesh meet outside of the corners and edges that they share. Independent of the view, so
// found once a mesh. All are decided by exact signs (exact_signs.h). A solid (solid.h) has none.
//
//   piercing     an edge passes through the inside of a face
//   crossing     two edges meet in a point inside both
//   foothold     a vertex lies inside an edge
//   touch        a vertex lies inside a face, or inside one of its sides
//
// Faces without an area hide nothing. They are pierced by nothing, but their edges pierce others.

#include <compare>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "silhouette/mesh/face_tree.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

struct FaceContacts {
    struct Piercing {
        std::uint32_t edge, face;
        auto operator<=>(const Piercing&) const = default;
    };
    struct EdgeCrossing {
        std::uint32_t edge, other;
        auto operator<=>(const EdgeCrossing&) const = default;
    };
    struct Foothold {
        std::uint32_t edge, vertex;
        auto operator<=>(const Foothold&) const = default;
    };
    struct Touch {
        std::uint32_t vertex, face;
        /// The side of the face, from corner `side` to the next. k_inside where it lies in none.
        std::uint32_t side;
        static constexpr std::uint32_t k_inside = 3;
        auto operator<=>(const Touch&) const = default;
    };

    // Each ascending and each once. Both edges of a crossing have it.
    std::vector<Piercing> piercings;
    std::vector<EdgeCrossing> crossings;
    std::vector<Foothold> footholds;
    std::vector<Touch> touches;

    bool empty() const noexcept {
        return piercings.empty() && crossings.empty() && footholds.empty() && touches.empty();
    }
    /// The touches of a vertex. O(log touches).
    std::span<const Touch> touches_of(std::uint32_t vertex) const noexcept;
};

/// For each face, whether its three corners lie on one line, exactly. O(n) on all threads of oneTBB. Throws
/// Error{cancelled}.
std::vector<std::uint8_t> find_flat_faces(const Mesh& mesh, const std::stop_token& stop = {});

/// O(n log n + pairs of faces whose boxes overlap) on all threads of oneTBB. The result does not depend on
/// their number. `tree` is that of `mesh`, and `is_flat` what find_flat_faces() says of it. Throws Error{cancelled}.
FaceContacts find_face_contacts(const Mesh& mesh, const FaceTree& tree,
                                std::span<const std::uint8_t> is_flat, const LongCall& call = {});

}  // namespace rimline
