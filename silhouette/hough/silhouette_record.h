#pragma once

// What the silhouette is and how it changes: face bits, slots and the change set of a move. A tracker
// finds what turned; the record writes it down.
//
// Edges that join take the slots of those that left; what is still open below the new end is filled from
// the tail, so each slot is written at most once a move.
//
//     begin_move   flip_faces ...   end_faces   toggle_edges or replace_edges   end_move
//
// Nothing allocates after construction: everything is reserved for the greatest move there can be, up to
// 30 bytes an edge and 5 a face, most of it untouched until such a move comes.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class SilhouetteRecord {
public:
    /// `mesh` must outlive the record. `face_words` and `silhouette` are what `point` sees.
    SilhouetteRecord(const Mesh& mesh, const HomogeneousPoint& point,
                     std::vector<std::uint32_t> face_words, std::span<const EdgeId> silhouette);

    // A copy would have neither the reserve nor spans of its own.
    SilhouetteRecord(SilhouetteRecord&&) noexcept = default;
    SilhouetteRecord& operator=(SilhouetteRecord&&) noexcept = default;

    void begin_move() noexcept;
    /// Each face at most once a move.
    void flip_faces(std::span<const FaceId> faces) noexcept;
    void flip_face(FaceId face) noexcept { flip_faces({&face, 1}); }
    /// After the last face: makes the face words final.
    void end_faces() noexcept;
    /// Regular and inconsistent edges of which one face flipped and the other did not, each once;
    /// non-manifold edges follow from the flipped faces.
    void toggle_edges(std::span<const EdgeId> edges) noexcept;
    /// The same from a whole silhouette, each edge once.
    void replace_edges(std::span<const EdgeId> silhouette) noexcept;
    const ChangeSet& end_move(const HomogeneousPoint& point,
                              const TraversalCounters& counters) noexcept;

    const Mesh& mesh() const noexcept { return *mesh_; }
    const ChangeSet& change_set() const noexcept { return changes_; }
    std::span<const EdgeId> slots() const noexcept { return std::span(slots_).first(slot_count_); }
    std::span<const std::uint32_t> face_words() const noexcept { return face_words_; }
    /// Memory reserved.
    std::uint64_t size_bytes() const noexcept;

private:
    void toggle(std::span<const EdgeId> edges) noexcept;
    void reexamine_nonmanifold() noexcept;
    void fill_slots() noexcept;
    void write_slot(std::uint32_t slot, EdgeId edge) noexcept;

    const Mesh* mesh_;
    ChangeSet changes_;
    std::vector<std::uint32_t> face_words_;
    std::vector<EdgeId> slots_;  // One more than there can be, for what leaves no slot.
    std::uint32_t slot_count_ = 0;
    std::vector<std::uint32_t> slot_of_;  // By edge; k_no_slot when not on the silhouette.

    // What the change set's spans show: as long as a move can make them, and one more, because what may
    // or may not count is stored first. (Asking first is a branch taken at random.)
    std::vector<FaceId> flipped_;
    std::vector<EdgeId> added_;
    std::vector<EdgeId> removed_;
    std::vector<std::uint32_t> removed_slots_;  // Where removed_[i] was.
    std::vector<SlotWrite> slot_writes_;
    std::vector<WordWrite> word_writes_;
    std::uint32_t flipped_count_ = 0;
    std::uint32_t added_count_ = 0;
    std::uint32_t removed_count_ = 0;
    std::uint32_t slot_write_count_ = 0;
    std::uint32_t word_count_ = 0;

    std::vector<std::uint32_t> word_flips_;   // By word; all zero between moves.
    std::vector<std::uint8_t> slot_is_kept_;  // By slot; all zero between moves.
};

}  // namespace rimline
