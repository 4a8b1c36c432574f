#pragma once

// One bit per face, 1 for front and 0 for back, 32 in a word: face f is bit f % 32 of word f / 32.
// The GPU reads the same words. Bits after the last face are 0.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/mesh/ids.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

constexpr std::uint32_t face_word_count(std::uint32_t face_count) noexcept {
    return (face_count + 31) / 32;
}

inline bool face_bit(std::span<const std::uint32_t> words, FaceId face) noexcept {
    return (words[index(face) / 32] >> (index(face) % 32) & 1u) != 0;
}

/// Whether an edge is on the silhouette, by the rule of its class (EdgeClass). Always false for
/// borders.
inline bool is_on_silhouette(const Mesh& mesh, EdgeId edge,
                             std::span<const std::uint32_t> face_words) noexcept {
    const std::uint32_t e = index(edge);
    if (e < mesh.edges_of_class(EdgeClass::inconsistent).last) {
        const std::array<FaceId, 2>& faces = mesh.edge(edge).faces;
        const bool differ = face_bit(face_words, faces[0]) != face_bit(face_words, faces[1]);
        return differ != (e >= mesh.edges_of_class(EdgeClass::inconsistent).first);
    }
    const std::span<const FaceId> faces = mesh.faces_of(edge);
    for (const FaceId face : faces)
        if (face_bit(face_words, face) != face_bit(face_words, faces[0])) return true;
    return false;
}

}  // namespace rimline
