#include "silhouette/hough/face_links.h"

namespace rimline {

namespace {

constexpr std::size_t k_links_ahead = 48;

// Links of flipped faces lie anywhere, and every third of them in two cache lines.
void prefetch(const FaceLinks& links) {
    __builtin_prefetch(&links.edges.front());
    __builtin_prefetch(&links.places.back());
}

}  // namespace

FaceLinks::FaceLinks(const Mesh& mesh, FaceId face,
                     std::span<const std::uint32_t> position_of) noexcept {
    const Mesh::EdgeRange inconsistent = mesh.edges_of_class(EdgeClass::inconsistent);
    edges.fill(0);
    places.fill(place_of(position_of[index(face)]));
    for (std::size_t k = 0; k < 3; ++k) {
        const EdgeId edge = mesh.edges_of(face)[k];
        if (index(edge) >= inconsistent.last) continue;
        const std::array<FaceId, 2>& faces = mesh.edge(edge).faces;
        edges[k] = index(edge) | (index(edge) >= inconsistent.first ? k_turned : 0u);
        places[k] = place_of(position_of[index(faces[faces[0] == face ? 1 : 0])]);
    }
}

// Whether an edge joins or leaves is told by the bits of its two faces. Results are stored before it is known whether
// they count: a branch would be unpredictable.
std::size_t find_toggled_edges(std::span<const std::uint32_t> positions,
                               std::span<const FaceLinks> links,
                               std::span<const std::uint32_t> states,
                               std::uint32_t* toggled) noexcept {
    const std::uint32_t* const state = states.data();
    std::uint32_t* end = toggled;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (i + k_links_ahead < positions.size())
            prefetch(links[positions[i + k_links_ahead] & ~k_front_position]);
        const FaceLinks& own = links[positions[i] & ~k_front_position];
        const std::uint32_t own_front = positions[i] / k_front_position;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t other = state[own.places[k] / 32] >> own.places[k] % 32;
            *end = own.edges[k] ^ (other ^ own_front) << 31;
            end += 1 - (other >> 16 & 1u);
        }
    }
    return static_cast<std::size_t>(end - toggled);
}

}  // namespace rimline
