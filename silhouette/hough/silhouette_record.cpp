#include "silhouette/hough/silhouette_record.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_no_slot = 0xffffffffu;
// An edge that has joined in this move and has no slot yet: on the silhouette all the same.
constexpr std::uint32_t k_joining = 0xfffffffeu;

// Slots of edges lie all over memory; ahead by what a fetch from the last cache takes.
constexpr std::size_t k_prefetch_ahead = 16;

}  // namespace

SilhouetteRecord::SilhouetteRecord(const Mesh& mesh, const HomogeneousPoint& point,
                                   std::vector<std::uint32_t> face_words,
                                   std::span<const EdgeId> silhouette)
    : mesh_(&mesh), face_words_(std::move(face_words)) {
    // Borders come last and never join.
    const std::uint32_t edge_count = mesh.edges_of_class(EdgeClass::border).first;
    slots_.reserve(edge_count);
    slots_.assign(silhouette.begin(), silhouette.end());
    slot_of_.assign(edge_count, k_no_slot);
    for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) slot_of_[index(slots_[slot])] = slot;

    flipped_.reserve(mesh.face_count());
    added_.reserve(edge_count);
    removed_.reserve(edge_count);
    removed_slots_.reserve(edge_count);
    slot_writes_.reserve(edge_count);
    word_writes_.reserve(face_words_.size());
    word_flips_.assign(face_words_.size(), 0);
    slot_is_kept_.assign(edge_count, 0);
    changes_.point = point;
    changes_.silhouette_size = static_cast<std::uint32_t>(slots_.size());
}

void SilhouetteRecord::begin_move() noexcept {
    flipped_.clear();
    added_.clear();
    removed_.clear();
    removed_slots_.clear();
    slot_writes_.clear();
    word_writes_.clear();
}

void SilhouetteRecord::flip_face(FaceId face) noexcept {
    flipped_.push_back(face);
    const std::uint32_t word = index(face) / 32;
    if (word_flips_[word] == 0) word_writes_.push_back({word, 0});
    word_flips_[word] |= 1u << (index(face) % 32);
}

void SilhouetteRecord::end_faces() noexcept {
    for (WordWrite& write : word_writes_) {
        face_words_[write.word] ^= word_flips_[write.word];
        word_flips_[write.word] = 0;
        write.bits = face_words_[write.word];
    }
}

void SilhouetteRecord::add(EdgeId edge) noexcept {
    added_.push_back(edge);
    slot_of_[index(edge)] = k_joining;
}

void SilhouetteRecord::remove(EdgeId edge, std::uint32_t slot) noexcept {
    removed_.push_back(edge);
    removed_slots_.push_back(slot);
    slots_[slot] = k_no_edge;
    slot_of_[index(edge)] = k_no_slot;
}

void SilhouetteRecord::toggle_edges(std::span<const EdgeId> edges) noexcept {
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (i + k_prefetch_ahead < edges.size())
            __builtin_prefetch(&slot_of_[index(edges[i + k_prefetch_ahead])], 1);
        const std::uint32_t slot = slot_of_[index(edges[i])];
        if (slot == k_no_slot)
            add(edges[i]);
        else
            remove(edges[i], slot);
    }
    if (mesh_->edges_of_class(EdgeClass::nonmanifold).size() > 0) reexamine_nonmanifold();
}

// slot_of_ follows at once: an edge met again, from another face that flipped, is seen to be where it
// belongs.
void SilhouetteRecord::reexamine_nonmanifold() noexcept {
    const Mesh::EdgeRange range = mesh_->edges_of_class(EdgeClass::nonmanifold);
    for (const FaceId face : flipped_) {
        for (const EdgeId edge : mesh_->edges_of(face)) {
            if (index(edge) < range.first || index(edge) >= range.last) continue;
            const std::uint32_t slot = slot_of_[index(edge)];
            const bool was_on = slot != k_no_slot;
            if (was_on == is_on_silhouette(*mesh_, edge, face_words_)) continue;
            if (was_on)
                remove(edge, slot);
            else
                add(edge);
        }
    }
}

void SilhouetteRecord::replace_edges(std::span<const EdgeId> silhouette) noexcept {
    for (std::size_t i = 0; i < silhouette.size(); ++i) {
        if (i + k_prefetch_ahead < silhouette.size())
            __builtin_prefetch(&slot_of_[index(silhouette[i + k_prefetch_ahead])], 1);
        const std::uint32_t slot = slot_of_[index(silhouette[i])];
        if (slot == k_no_slot)
            add(silhouette[i]);
        else
            slot_is_kept_[slot] = 1;
    }
    for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) {
        if (slot_is_kept_[slot] == 0) remove(slots_[slot], slot);
        slot_is_kept_[slot] = 0;
    }
}

// With r edges removed and a added, the new end is e = size - r + a. Below e, holes are filled by the
// added and, when those run out, by the survivors of the tail [e, size): exactly as many as are needed.
void SilhouetteRecord::fill_slots() noexcept {
    const auto old_size = static_cast<std::uint32_t>(slots_.size());
    const auto new_size = static_cast<std::uint32_t>(old_size + added_.size() - removed_.size());
    std::size_t next_added = 0;
    std::uint32_t tail = old_size;
    for (const std::uint32_t hole : removed_slots_) {
        if (hole >= new_size) continue;
        if (next_added < added_.size()) {
            write_slot(hole, added_[next_added++]);
            continue;
        }
        do --tail;
        while (slots_[tail] == k_no_edge);
        write_slot(hole, slots_[tail]);
    }
    slots_.resize(new_size);
    for (std::uint32_t slot = old_size; slot < new_size; ++slot)
        write_slot(slot, added_[next_added++]);
}

void SilhouetteRecord::write_slot(std::uint32_t slot, EdgeId edge) noexcept {
    slots_[slot] = edge;
    slot_of_[index(edge)] = slot;
    slot_writes_.push_back({slot, edge});
}

const ChangeSet& SilhouetteRecord::end_move(const HomogeneousPoint& point,
                                            const TraversalCounters& counters) noexcept {
    fill_slots();
    changes_.point = point;
    ++changes_.sequence;
    changes_.silhouette_size = static_cast<std::uint32_t>(slots_.size());
    changes_.flipped = flipped_;
    changes_.added = added_;
    changes_.removed = removed_;
    changes_.slots = slot_writes_;
    changes_.words = word_writes_;
    changes_.counters = counters;
    return changes_;
}

}  // namespace rimline
