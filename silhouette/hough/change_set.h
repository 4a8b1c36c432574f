#pragma once

// What changed between two silhouettes of one mesh: the small interface where everything meets.
//
// A SilhouetteTracker makes change sets; a ChangeStream, or any program without a GPU, consumes them.
// A consumer that holds slots and face words of sequence s, and writes `slots` and `words` of sequence
// s + 1 into them in any order, holds exactly the tracker's state again:
//
//     slots   [ e12 | e7 | e31 | e4 | .  .  . ]      the silhouette's edges, in no order, without gaps
//     words   [ 32 face bits | 32 face bits | .. ]   silhouette/mesh/face_bits.h
//
// Writes carry final values and name each place once, so they can be scattered in parallel. Changes
// net out: a face that turns and turns back, an edge that leaves and returns, are in no list. Borders
// are never in one (EdgeClass::border).

#include <cstdint>
#include <span>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/ids.h"

namespace rimline {

/// Work done, to compare methods without a clock. The index counts in whole nodes of eight boxes and whole
/// blocks of sixteen faces or edges.
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

/// slots[slot] = edge. Shared with shaders/layout.h (PlacedWrite).
struct SlotWrite {
    std::uint32_t slot;
    EdgeId edge;
    bool operator==(const SlotWrite&) const noexcept = default;
};

/// face_words[word] = bits. Shared with shaders/layout.h (PlacedWrite).
struct WordWrite {
    std::uint32_t word;
    std::uint32_t bits;
    bool operator==(const WordWrite&) const noexcept = default;
};

/// The spans live until the tracker moves again; whoever keeps a change set copies it.
struct ChangeSet {
    HomogeneousPoint point{};           ///< Where the silhouette is now seen from.
    std::uint64_t sequence = 0;         ///< One more than the previous change set of its tracker.
    std::uint32_t silhouette_size = 0;  ///< Slots in use now: [0, silhouette_size).
    std::span<const FaceId> flipped;    ///< Faces that turned, each once.
    std::span<const EdgeId> added;      ///< Edges that joined the silhouette, each once.
    std::span<const EdgeId> removed;    ///< Edges that left it, each once.
    std::span<const SlotWrite> slots;  ///< Final value of each slot in use that changed, each once.
    std::span<const WordWrite>
        words;                   ///< Final value of each word of face bits that changed, each once.
    TraversalCounters counters;  ///< Work done.
};

}  // namespace rimline
