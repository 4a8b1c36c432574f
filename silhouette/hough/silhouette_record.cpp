#include "silhouette/hough/silhouette_record.h"

#include <algorithm>
#include <utility>

#include "silhouette/hough/face_links.h"
#include "silhouette/hough/reserved_bytes.h"

namespace rimline {

namespace {

// The slot of an edge that joined in this move and has none yet. It is on the silhouette.
constexpr std::uint32_t k_joining = 0xffffffffu;
constexpr std::size_t k_slack = 16;  // Whole vectors are stored.

// Slots of edges are scattered in memory. The distance covers the latency of the last cache.
constexpr std::size_t k_prefetch_ahead = 48;

}  // namespace

SilhouetteRecord::SilhouetteRecord(const Mesh& mesh, const HomogeneousPoint& point,
                                   std::vector<std::uint32_t> face_words,
                                   std::span<const EdgeId> silhouette)
    : mesh_(&mesh), face_words_(std::move(face_words)) {
    // Borders come last and never join.
    const std::uint32_t edge_count = mesh.edges_of_class(EdgeClass::border).first;
    slots_.resize(edge_count);
    slot_count_ = static_cast<std::uint32_t>(silhouette.size());
    slot_of_.assign(edge_count, 0);
    for (std::uint32_t slot = 0; slot < slot_count_; ++slot) {
        slots_[slot] = silhouette[slot];
        slot_of_[index(silhouette[slot])] = slot;
    }
    flipped_.resize(mesh.face_count() + k_slack);
    toggled_.resize(edge_count + 1);
    added_.resize(edge_count + 1);
    removed_.resize(edge_count + 1);
    removed_slots_.resize(edge_count + 1);
    slot_writes_.resize(edge_count + 1);
    word_writes_.resize(face_words_.size() + 1);
    word_flips_.assign(face_words_.size(), 0);
    slot_is_kept_.assign(edge_count, 0);
    last_examined_.assign(mesh.edges_of_class(EdgeClass::nonmanifold).size(), 0);
    changes_.point = point;
    changes_.silhouette_size = slot_count_;
}

std::uint64_t SilhouetteRecord::size_bytes() const noexcept {
    return reserved_bytes(face_words_, slots_, slot_of_, flipped_, added_, removed_, removed_slots_,
                          slot_writes_, word_writes_, toggled_, word_flips_, slot_is_kept_,
                          last_examined_);
}

void SilhouetteRecord::begin_move() noexcept {
    flipped_count_ = added_count_ = removed_count_ = slot_write_count_ = word_count_ = 0;
}

void SilhouetteRecord::flip_faces(std::size_t count) noexcept {
    flipped_count_ = static_cast<std::uint32_t>(count);
    std::uint32_t* const word_flips = word_flips_.data();
    WordWrite* write = word_writes_.data();
    for (const FaceId face : std::span(flipped_).first(count)) {
        const std::uint32_t word = index(face) / 32;
        write->word = word;
        write += word_flips[word] == 0;
        word_flips[word] |= 1u << (index(face) % 32);
    }
    word_count_ = static_cast<std::uint32_t>(write - word_writes_.data());
    for (WordWrite& changed : std::span(word_writes_).first(word_count_)) {
        face_words_[changed.word] ^= word_flips[changed.word];
        word_flips[changed.word] = 0;
        changed.bits = face_words_[changed.word];
    }
}

// Counts are local variables: stores through pointers of their type would force reloads of members.
void SilhouetteRecord::toggle_edges(std::size_t count) noexcept {
    std::uint32_t* const slot_of = slot_of_.data();
    EdgeId* added = added_.data();
    EdgeId* removed = removed_.data();
    for (const std::uint32_t toggled : std::span(toggled_).first(count)) {
        const EdgeId edge{toggled & ~k_joins};
        const std::uint32_t joins = toggled / k_joins;
        __builtin_prefetch(&slot_of[index(edge)], 1);
        *added = edge;
        added += joins;
        *removed = edge;
        removed += 1 - joins;
    }
    added_count_ = static_cast<std::uint32_t>(added - added_.data());
    removed_count_ = static_cast<std::uint32_t>(removed - removed_.data());
    for (std::uint32_t i = 0; i < removed_count_; ++i)
        removed_slots_[i] = slot_of[index(removed_[i])];
    if (mesh_->edges_of_class(EdgeClass::nonmanifold).size() > 0) reexamine_nonmanifold();
}

inline bool SilhouetteRecord::is_on(EdgeId edge) const noexcept {
    const std::uint32_t slot = slot_of_[index(edge)];
    return slot == k_joining || (slot < slot_count_ && slots_[slot] == edge);
}

inline void SilhouetteRecord::join(EdgeId edge) noexcept {
    added_[added_count_++] = edge;
    slot_of_[index(edge)] = k_joining;
}

inline void SilhouetteRecord::leave(EdgeId edge) noexcept {
    const std::uint32_t slot = slot_of_[index(edge)];
    removed_[removed_count_] = edge;
    removed_slots_[removed_count_++] = slot;
    slots_[slot] = k_no_edge;
}

// Each edge once, whichever of its faces flipped: to look at it is to look at all of them.
void SilhouetteRecord::reexamine_nonmanifold() noexcept {
    const Mesh::EdgeRange range = mesh_->edges_of_class(EdgeClass::nonmanifold);
    const std::uint64_t move = changes_.sequence + 1;
    for (const FaceId face : std::span(flipped_).first(flipped_count_)) {
        for (const EdgeId edge : mesh_->edges_of(face)) {
            if (index(edge) < range.first || index(edge) >= range.last) continue;
            if (std::exchange(last_examined_[index(edge) - range.first], move) == move) continue;
            const bool was_on = is_on(edge);
            if (was_on == is_on_silhouette(*mesh_, edge, face_words_)) continue;
            was_on ? leave(edge) : join(edge);
        }
    }
}

void SilhouetteRecord::replace_edges(std::span<const EdgeId> silhouette) noexcept {
    for (std::size_t i = 0; i < silhouette.size(); ++i) {
        if (i + k_prefetch_ahead < silhouette.size())
            __builtin_prefetch(&slot_of_[index(silhouette[i + k_prefetch_ahead])], 1);
        const EdgeId edge = silhouette[i];
        if (is_on(edge))
            slot_is_kept_[slot_of_[index(edge)]] = 1;
        else
            join(edge);
    }
    for (std::uint32_t slot = 0; slot < slot_count_; ++slot) {
        if (slot_is_kept_[slot] == 0) leave(slots_[slot]);
        slot_is_kept_[slot] = 0;
    }
}

// With r edges removed and a added, the new end is e = size - r + a. Holes below e are filled with the added
// edges, then with the edges that remain in the tail [e, size): there are exactly as many as needed.
void SilhouetteRecord::fill_slots() noexcept {
    const std::uint32_t old_count = slot_count_;
    const std::uint32_t new_count = old_count + added_count_ - removed_count_;
    std::uint32_t next_added = 0;
    std::uint32_t tail = old_count;
    if (new_count < old_count)
        for (const std::uint32_t hole : std::span(removed_slots_).first(removed_count_))
            slots_[hole] = k_no_edge;
    for (const std::uint32_t hole : std::span(removed_slots_).first(removed_count_)) {
        if (hole >= new_count) continue;
        if (next_added < added_count_) {
            write_slot(hole, added_[next_added++]);
            continue;
        }
        do --tail;
        while (slots_[tail] == k_no_edge);
        write_slot(hole, slots_[tail]);
    }
    for (std::uint32_t slot = old_count; slot < new_count; ++slot)
        write_slot(slot, added_[next_added++]);
    slot_count_ = new_count;
}

inline void SilhouetteRecord::write_slot(std::uint32_t slot, EdgeId edge) noexcept {
    slots_[slot] = edge;
    slot_of_[index(edge)] = slot;
    slot_writes_[slot_write_count_++] = {slot, edge};
}

const ChangeSet& SilhouetteRecord::end_move(const HomogeneousPoint& point,
                                            const TraversalCounters& counters) noexcept {
    fill_slots();
    changes_.point = point;
    ++changes_.sequence;
    changes_.silhouette_size = slot_count_;
    changes_.flipped = std::span(flipped_).first(flipped_count_);
    changes_.added = std::span(added_).first(added_count_);
    changes_.removed = std::span(removed_).first(removed_count_);
    changes_.slots = std::span(slot_writes_).first(slot_write_count_);
    changes_.words = std::span(word_writes_).first(word_count_);
    changes_.counters = counters;
    return changes_;
}

}  // namespace rimline
