#include "silhouette/methods/followed_silhouette.h"

namespace rimline {

FollowedSilhouette::FollowedSilhouette(const Mesh& mesh) : mesh_(&mesh) {}

void FollowedSilhouette::start(std::span<const std::uint32_t> face_words,
                               TraversalCounters& counters) {
    RIMLINE_CHECK(face_words.size() == face_word_count(mesh_->face_count()));
    face_words_.assign(face_words.begin(), face_words.end());
    const std::uint32_t edge_count = mesh_->edges_of_class(EdgeClass::border).first;
    slot_of_.assign(edge_count, k_no_slot);
    edges_.clear();
    for (std::uint32_t e = 0; e < edge_count; ++e)
        if (is_on_silhouette(*mesh_, EdgeId{e}, face_words_)) join(EdgeId{e});
    counters.edge_checks += edge_count;
    started_ = true;
}

void FollowedSilhouette::turn(std::span<const FaceId> flipped, TraversalCounters& counters) {
    for (const FaceId face : flipped) face_words_[index(face) / 32] ^= 1u << (index(face) % 32);
    for (const FaceId face : flipped) {
        for (const EdgeId edge : mesh_->edges_of(face)) {
            if (index(edge) >= slot_of_.size()) continue;  // A border, or none.
            ++counters.edge_checks;
            const bool was = slot_of_[index(edge)] != k_no_slot;
            const bool is = is_on_silhouette(*mesh_, edge, face_words_);
            if (is && !was) join(edge);
            if (was && !is) leave(edge);
        }
    }
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
