#pragma once

// The silhouette and its changes: face bits, slots, and the change set of a move. A tracker finds which faces
// turned; the record stores the result.
//
// Edges that join take the slots of those that left. Slots still empty below the new end are filled from the
// tail. So each slot is written at most once in a move. Order of calls:
//
//     begin_move   flip_faces   toggle_edges or replace_edges   end_move
//
// Nothing allocates after construction. Memory is reserved for the largest possible move: up to 34 bytes an
// edge and 5 a face. Most of it is not touched until such a move.

#include <cstdint>
#include <span>
#include <vector>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

class SilhouetteRecord {
public:
    /// `mesh` must outlive the record. `face_words` and `silhouette` are those seen from `point`.
    SilhouetteRecord(const Mesh& mesh, const HomogeneousPoint& point,
                     std::vector<std::uint32_t> face_words, std::span<const EdgeId> silhouette);

    // No copies: a copy's change set would refer to the original, and its memory would not be reserved.
    SilhouetteRecord(SilhouetteRecord&&) noexcept = default;
    SilhouetteRecord& operator=(SilhouetteRecord&&) noexcept = default;

    void begin_move() noexcept;
    /// Where the faces that flip are to be written, each once: space for all, and for 16 more.
    FaceId* flip_space() noexcept { return flipped_.data(); }
    /// Flips the first `count` faces of the space.
    void flip_faces(std::size_t count) noexcept;
    /// Where the edges are to be written of which one face flipped and the other did not, regular and
    /// inconsistent ones, each once, with k_joins (face_links.h) where the edge is on the silhouette now. The space is
    /// for one more than there are edges. The record finds non-manifold edges from the flipped faces.
    std::uint32_t* toggle_space() noexcept { return toggled_.data(); }
    /// Toggles the first `count` edges of the space.
    void toggle_edges(std::size_t count) noexcept;
    /// Toggles edges such that `silhouette` is left, each of its edges once.
    void replace_edges(std::span<const EdgeId> silhouette) noexcept;
    /// Completes the change set, which is valid until the next move.
    const ChangeSet& end_move(const HomogeneousPoint& point,
                              const TraversalCounters& counters) noexcept;

    const Mesh& mesh() const noexcept { return *mesh_; }
    const ChangeSet& change_set() const noexcept { return changes_; }
    std::span<const EdgeId> slots() const noexcept { return std::span(slots_).first(slot_count_); }
    std::span<const std::uint32_t> face_words() const noexcept { return face_words_; }
    /// Memory reserved.
    std::uint64_t size_bytes() const noexcept;

private:
    bool is_on(EdgeId edge) const noexcept;
    void join(EdgeId edge) noexcept;
    void leave(EdgeId edge) noexcept;
    void reexamine_nonmanifold() noexcept;
    void fill_slots() noexcept;
    void write_slot(std::uint32_t slot, EdgeId edge) noexcept;

    const Mesh* mesh_;
    ChangeSet changes_;
    std::vector<std::uint32_t> face_words_;
    std::vector<EdgeId> slots_;
    std::uint32_t slot_count_ = 0;
    // By edge. It is on the silhouette if that slot is in use and holds it, so nothing is written when it leaves.
    std::vector<std::uint32_t> slot_of_;

    // The arrays of the change set: the maximum that a move can need, and one more. Values are stored before
    // it is known whether they count. (To test first would be an unpredictable branch.)
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

    std::vector<std::uint32_t> toggled_;
    std::vector<std::uint32_t> word_flips_;     // By word; all zero between moves.
    std::vector<std::uint8_t> slot_is_kept_;    // By slot; all zero between moves.
    std::vector<std::uint64_t> last_examined_;  // By non-manifold edge: the number of the move.
};

}  // namespace rimline
