#include "silhouette/hough/silhouette_tracker.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_no_slot = 0xffffffffu;
// An edge that has joined in this move and has no slot yet: on the silhouette all the same.
constexpr std::uint32_t k_joining = 0xfffffffeu;

}  // namespace

SilhouetteTracker::SilhouetteTracker(const HoughOctree& octree, const HomogeneousPoint& point)
    : octree_(&octree) {
    RIMLINE_CHECK(point.is_valid());
    const Mesh& m = octree.mesh();
    tree_words_.resize(octree.tree_word_count());
    octree.evaluate_faces(point, tree_words_);
    face_words_.assign(face_word_count(m.face_count()), 0);
    for (std::uint32_t f = 0; f < m.face_count(); ++f)
        if (rimline::is_front(m.plane(FaceId{f}), point)) face_words_[f / 32] |= 1u << (f % 32);
    construction_counters_.face_checks = 2 * std::uint64_t{m.face_count()};

    // Borders come last and never join.
    const std::uint32_t edge_count = m.edges_of_class(EdgeClass::border).first;
    slots_.reserve(edge_count);
    octree.extract(point, slots_, construction_counters_);
    slot_of_.assign(edge_count, k_no_slot);
    for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) slot_of_[index(slots_[slot])] = slot;

    flipped_.reserve(m.face_count());
    added_.reserve(edge_count);
    removed_.reserve(edge_count);
    removed_slots_.reserve(edge_count);
    slot_writes_.reserve(edge_count);
    word_writes_.reserve(face_words_.size());
    word_flips_.assign(face_words_.size(), 0);
    changes_.point = point;
    changes_.silhouette_size = static_cast<std::uint32_t>(slots_.size());
}

const ChangeSet& SilhouetteTracker::move_to(const HomogeneousPoint& point) noexcept {
    RIMLINE_CHECK(point.is_valid());
    flipped_.clear();
    added_.clear();
    removed_.clear();
    removed_slots_.clear();
    slot_writes_.clear();
    word_writes_.clear();
    changes_.counters = {};

    octree_->find_flips(changes_.point, point, tree_words_, flipped_, changes_.counters);
    turn_faces();
    find_changed_edges();
    update_slots();

    changes_.point = point;
    ++changes_.sequence;
    changes_.silhouette_size = static_cast<std::uint32_t>(slots_.size());
    changes_.flipped = flipped_;
    changes_.added = added_;
    changes_.removed = removed_;
    changes_.slots = slot_writes_;
    changes_.words = word_writes_;
    return changes_;
}

void SilhouetteTracker::turn_faces() noexcept {
    // A face flips once a move, so a word's flips are zero until the first of them.
    for (const FaceId face : flipped_) {
        const std::uint32_t word = index(face) / 32;
        if (word_flips_[word] == 0) word_writes_.push_back({word, 0});
        word_flips_[word] |= 1u << (index(face) % 32);
    }
    for (WordWrite& write : word_writes_) {
        face_words_[write.word] ^= word_flips_[write.word];
        word_flips_[write.word] = 0;
        write.bits = face_words_[write.word];
    }
}

void SilhouetteTracker::find_changed_edges() noexcept {
    // All bits are final here, and slot_of_ follows at once: an edge met again, from another face that
    // flipped, is seen to be where it belongs.
    for (const FaceId face : flipped_) {
        for (const EdgeId edge : mesh().edges_of(face)) {
            if (index(edge) >= slot_of_.size()) continue;  // A border.
            ++changes_.counters.edge_checks;
            std::uint32_t& slot = slot_of_[index(edge)];
            const bool was = slot != k_no_slot;
            if (was == is_on_silhouette(mesh(), edge, face_words_)) continue;
            if (was) {
                removed_.push_back(edge);
                removed_slots_.push_back(slot);
                slots_[slot] = k_no_edge;
                slot = k_no_slot;
            } else {
                added_.push_back(edge);
                slot = k_joining;
            }
        }
    }
}

// With r edges removed and a added, the new end is e = size - r + a. Below e, holes are filled by the
// added and, when those run out, by the survivors of the tail [e, size): exactly as many as are needed.
void SilhouetteTracker::update_slots() noexcept {
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

void SilhouetteTracker::write_slot(std::uint32_t slot, EdgeId edge) noexcept {
    slots_[slot] = edge;
    slot_of_[index(edge)] = slot;
    slot_writes_.push_back({slot, edge});
}

}  // namespace rimline
