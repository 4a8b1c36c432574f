#pragma once

// What changed between two silhouettes of one mesh: the interface between the CPU library and its users.
//
// A SilhouetteTracker makes change sets. A ChangeStream, or any program without a GPU, consumes them.
// A consumer has the slots and face words of sequence s. It writes `slots` and `words` of sequence s + 1 into
// them, in any order. Then it has exactly the tracker's state again:
//
//     slots   [ e12 | e7 | e31 | e4 | .  .  . ]      the silhouette's edges, unordered, without gaps
//     words   [ 32 face bits | 32 face bits | .. ]   silhouette/mesh/face_bits.h
//
// Writes hold final values, and each place is written once, so they can be scattered in parallel. A face that
// turns and turns back, or an edge that leaves and returns, is in no list. Borders are in no list
// (EdgeClass::border).

#include <cstdint>
#include <span>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/ids.h"

namespace rimline {

/// Work done, to compare methods without measuring time. The index counts whole nodes of eight boxes and
/// whole blocks of sixteen faces or edges.
struct TraversalCounters {
    std::uint64_t box_checks = 0;   ///< Boxes tested against v-spheres.
    std::uint64_t face_checks = 0;  ///< Face bits evaluated from planes.
    std::uint64_t edge_checks = 0;  ///< Edges examined for being on the silhouette.

    TraversalCounters& operator+=(const TraversalCounters& other) noexcept {
        box_checks += other.box_checks;
        face_checks += other.face_checks;
        edge_checks += other.edge_checks;
        return *this;
    }
};

/// slots[slot] = edge. Has the layout of PlacedWrite in shaders/layout.h.
struct SlotWrite {
    std::uint32_t slot;
    EdgeId edge;
    bool operator==(const SlotWrite&) const noexcept = default;
};

/// face_words[word] = bits. Has the layout of PlacedWrite in shaders/layout.h.
struct WordWrite {
    std::uint32_t word;
    std::uint32_t bits;
    bool operator==(const WordWrite&) const noexcept = default;
};

/// The spans are valid until the tracker moves again. Copy a change set to keep it.
struct ChangeSet {
    HomogeneousPoint point{};           ///< The silhouette point after the change.
    std::uint64_t sequence = 0;         ///< One more than the previous change set of its tracker.
    std::uint32_t silhouette_size = 0;  ///< Slots in use after the change: [0, silhouette_size).
    std::span<const FaceId> flipped;    ///< Faces that turned, each once.
    std::span<const EdgeId> added;      ///< Edges that joined the silhouette, each once.
    std::span<const EdgeId> removed;    ///< Edges that left it, each once.
    std::span<const SlotWrite> slots;  ///< Final value of each slot in use that changed, each once.
    /// Final value of each word of face bits that changed, each once.
    std::span<const WordWrite> words;
    TraversalCounters counters;  ///< Work done.
};

}  // namespace rimline
