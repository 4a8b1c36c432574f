#include "silhouette/methods/followed_silhouette.h"

#include <utility>

namespace rimline {

FollowedSilhouette::FollowedSilhouette(const Mesh& mesh) : mesh_(&mesh) {}

void FollowedSilhouette::start(std::span<const std::uint32_t> face_words,
                               TraversalCounters& counters) {
    start(face_words, std::span<const EdgeId>());
    for (std::uint32_t e = 0; e < slot_of_.size(); ++e)
        if (is_on_silhouette(*mesh_, EdgeId{e}, face_words_)) join(EdgeId{e});
    counters.edge_checks += slot_of_.size();
}

void FollowedSilhouette::start(std::span<const std::uint32_t> face_words,
                               std::span<const EdgeId> edges) {
    RIMLINE_CHECK(face_words.size() == face_word_count(mesh_->face_count()));
    face_words_.assign(face_words.begin(), face_words.end());
    // Borders come last and never join.
    slot_of_.assign(mesh_->edges_of_class(EdgeClass::border).first, k_no_slot);
    last_examined_.assign(mesh_->edges_of_class(EdgeClass::nonmanifold).size(), 0);
    updates_ = 0;
    edges_.clear();
    for (const EdgeId edge : edges) join(edge);
    started_ = true;
}

void FollowedSilhouette::turn(std::span<const FaceId> flipped, TraversalCounters& counters) {
    for (const FaceId face : flipped) face_words_[index(face) / 32] ^= 1u << (index(face) % 32);
    counters.edge_checks += update_edges(flipped);
}

bool FollowedSilhouette::set_bit(FaceId face, bool is_front) noexcept {
    if (face_bit(face_words_, face) == is_front) return false;
    face_words_[index(face) / 32] ^= 1u << (index(face) % 32);
    return true;
}

std::uint64_t FollowedSilhouette::update_edges(std::span<const FaceId> turned) {
    const Mesh::EdgeRange nonmanifold = mesh_->edges_of_class(EdgeClass::nonmanifold);
    ++updates_;
    std::uint64_t examined = 0;
    for (const FaceId face : turned) {
        for (const EdgeId edge : mesh_->edges_of(face)) {
            if (index(edge) >= slot_of_.size()) continue;  // A border, or none.
            // To look at a non-manifold edge is to look at all its faces.
            if (index(edge) >= nonmanifold.first && index(edge) < nonmanifold.last &&
                std::exchange(last_examined_[index(edge) - nonmanifold.first], updates_) ==
                    updates_)
                continue;
            ++examined;
            const bool was = slot_of_[index(edge)] != k_no_slot;
            const bool is = is_on_silhouette(*mesh_, edge, face_words_);
            if (is && !was) join(edge);
            if (was && !is) leave(edge);
        }
    }
    return examined;
}

void FollowedSilhouette::join(EdgeId edge) {
    slot_of_[index(edge)] = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back(edge);
}

void FollowedSilhouette::leave(EdgeId edge) {
    const std::uint32_t slot = slot_of_[index(edge)];
    const EdgeId last = edges_.back();
    edges_[slot] = last;
    slot_of_[index(last)] = slot;
    slot_of_[index(edge)] = k_no_slot;
    edges_.pop_back();
}

}  // namespace rimline
