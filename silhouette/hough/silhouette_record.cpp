#include "silhouette/hough/silhouette_record.h"

#include <algorithm>

#include "silhouette/hough/reserved_bytes.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_no_slot = 0xffffffffu;
// An edge that joined in this move and has no slot yet. It is on the silhouette.
constexpr std::uint32_t k_joining = 0xfffffffeu;
static_assert(k_joining + 1 == k_no_slot);

// Slots of edges are scattered in memory. The distance covers the latency of the last cache.
constexpr std::size_t k_prefetch_ahead = 48;

}  // namespace

SilhouetteRecord::SilhouetteRecord(const Mesh& mesh, const HomogeneousPoint& point,
                                   std::vector<std::uint32_t> face_words,
                                   std::span<const EdgeId> silhouette)
    : mesh_(&mesh), face_words_(std::move(face_words)) {
    // Borders come last and never join.
    const std::uint32_t edge_count = mesh.edges_of_class(EdgeClass::border).first;
    slots_.resize(edge_count + 1);
    slot_count_ = static_cast<std::uint32_t>(silhouette.size());
    slot_of_.assign(edge_count, k_no_slot);
    for (std::uint32_t slot = 0; slot < slot_count_; ++slot) {
        slots_[slot] = silhouette[slot];
        slot_of_[index(silhouette[slot])] = slot;
    }
    flipped_.resize(mesh.face_count() + 1);
    added_.resize(edge_count + 1);
    removed_.resize(edge_count + 1);
    removed_slots_.resize(edge_count + 1);
    slot_writes_.resize(edge_count + 1);
    word_writes_.resize(face_words_.size() + 1);
    word_flips_.assign(face_words_.size(), 0);
    slot_is_kept_.assign(edge_count, 0);
    changes_.point = point;
    changes_.silhouette_size = slot_count_;
}

std::uint64_t SilhouetteRecord::size_bytes() const noexcept {
    return reserved_bytes(face_words_, slots_, slot_of_, flipped_, added_, removed_, removed_slots_,
                          slot_writes_, word_writes_, word_flips_, slot_is_kept_);
}

void SilhouetteRecord::begin_move() noexcept {
    flipped_count_ = added_count_ = removed_count_ = slot_write_count_ = word_count_ = 0;
}

void SilhouetteRecord::flip_faces(std::span<const FaceId> faces) noexcept {
    std::uint32_t* const word_flips = word_flips_.data();
    FaceId* flipped = flipped_.data() + flipped_count_;
    WordWrite* write = word_writes_.data() + word_count_;
    for (const FaceId face : faces) {
        const std::uint32_t word = index(face) / 32;
        *flipped++ = face;
        write->word = word;
        write += word_flips[word] == 0;
        word_flips[word] |= 1u << (index(face) % 32);
    }
    flipped_count_ = static_cast<std::uint32_t>(flipped - flipped_.data());
    word_count_ = static_cast<std::uint32_t>(write - word_writes_.data());
}

void SilhouetteRecord::end_faces() noexcept {
    for (WordWrite& write : std::span(word_writes_).first(word_count_)) {
        face_words_[write.word] ^= word_flips_[write.word];
        word_flips_[write.word] = 0;
        write.bits = face_words_[write.word];
    }
}

// Counts are local variables: stores through pointers of their type would force reloads of members.
void SilhouetteRecord::toggle(std::span<const EdgeId> edges) noexcept {
    std::uint32_t* const slot_of = slot_of_.data();
    EdgeId* const slots = slots_.data();
    const auto no_slot_at_all = static_cast<std::uint32_t>(slots_.size() - 1);
    EdgeId* added = added_.data() + added_count_;
    EdgeId* removed = removed_.data() + removed_count_;
    std::uint32_t* removed_slot = removed_slots_.data() + removed_count_;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (i + k_prefetch_ahead < edges.size())
            __builtin_prefetch(&slot_of[index(edges[i + k_prefetch_ahead])], 1);
        const EdgeId edge = edges[i];
        const std::uint32_t slot = slot_of[index(edge)];
        const std::uint32_t was_on = slot != k_no_slot;
        *added = edge;
        added += 1 - was_on;
        *removed = edge;
        removed += was_on;
        *removed_slot = slot;
        removed_slot += was_on;
        slots[std::min(slot, no_slot_at_all)] = k_no_edge;
        slot_of[index(edge)] = k_joining + was_on;
    }
    added_count_ = static_cast<std::uint32_t>(added - added_.data());
    removed_count_ = static_cast<std::uint32_t>(removed - removed_.data());
}

void SilhouetteRecord::toggle_edges(std::span<const EdgeId> edges) noexcept {
    toggle(edges);
    if (mesh_->edges_of_class(EdgeClass::nonmanifold).size() > 0) reexamine_nonmanifold();
}

// toggle() updates slot_of_ at once. So an edge that is visited again, from another flipped face, does not
// toggle again.
void SilhouetteRecord::reexamine_nonmanifold() noexcept {
    const Mesh::EdgeRange range = mesh_->edges_of_class(EdgeClass::nonmanifold);
    for (const FaceId face : std::span(flipped_).first(flipped_count_)) {
        for (const EdgeId edge : mesh_->edges_of(face)) {
            if (index(edge) < range.first || index(edge) >= range.last) continue;
            const bool was_on = slot_of_[index(edge)] != k_no_slot;
            if (was_on != is_on_silhouette(*mesh_, edge, face_words_)) toggle({&edge, 1});
        }
    }
}

void SilhouetteRecord::replace_edges(std::span<const EdgeId> silhouette) noexcept {
    for (std::size_t i = 0; i < silhouette.size(); ++i) {
        if (i + k_prefetch_ahead < silhouette.size())
            __builtin_prefetch(&slot_of_[index(silhouette[i + k_prefetch_ahead])], 1);
        const std::uint32_t slot = slot_of_[index(silhouette[i])];
        if (slot == k_no_slot)
            toggle({&silhouette[i], 1});
        else
            slot_is_kept_[slot] = 1;
    }
    for (std::uint32_t slot = 0; slot < slot_count_; ++slot) {
        const EdgeId edge = slots_[slot];
        if (slot_is_kept_[slot] == 0) toggle({&edge, 1});
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
