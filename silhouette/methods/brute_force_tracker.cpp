#include "silhouette/methods/brute_force_tracker.h"

#include <algorithm>
#include <bit>

namespace rimline {

namespace {

// Words compared before one branch: most contain no face that flipped.
constexpr std::size_t k_words_at_once = 8;
constexpr std::size_t k_prefetch_ahead = 12;

// Unit: the examination of one edge of a flipped face, as the tracker counts it. The terms: a pass over all
// edges, and writing and comparing the silhouette's edges.
std::uint64_t cost_of_extraction(std::uint64_t edge_count, std::size_t silhouette_size) {
    return edge_count / 4 + 3 * silhouette_size;
}

}  // namespace

BruteForceTracker::BruteForceTracker(const Mesh& mesh, const HomogeneousPoint& point)
    : mesh_(&mesh), brute_force_(mesh), record_(make_record(point)) {
    const std::uint32_t two_faced = mesh.edges_of_class(EdgeClass::inconsistent).last;
    neighbors_.resize(mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        for (std::size_t k = 0; k < 3; ++k) {
            const EdgeId edge = mesh.edges_of(FaceId{f})[k];
            const bool has_other = edge != k_no_edge && index(edge) < two_faced;
            neighbors_[f].edges[k] = has_other ? edge : k_no_edge;
            neighbors_[f].faces[k] = FaceId{f};
            if (!has_other) continue;
            const std::array<FaceId, 2>& faces = mesh.edge(edge).faces;
            neighbors_[f].faces[k] = faces[faces[0] == FaceId{f} ? 1 : 0];
        }
    }
    const std::uint32_t edge_count = mesh.edges_of_class(EdgeClass::border).first;
    flips_.resize(words_.size());
    flipped_.reserve(mesh.face_count());
    toggled_.resize(edge_count + 1);
}

SilhouetteRecord BruteForceTracker::make_record(const HomogeneousPoint& point) {
    RIMLINE_CHECK(point.is_valid());
    brute_force_.face_bits(point, words_);
    extracted_.reserve(mesh_->edges_of_class(EdgeClass::border).first);
    brute_force_.silhouette(words_, extracted_);
    return SilhouetteRecord(*mesh_, point, words_, extracted_);
}

const ChangeSet& BruteForceTracker::move_to(const HomogeneousPoint& point) noexcept {
    RIMLINE_CHECK(point.is_valid());
    brute_force_.face_bits(point, words_);
    TraversalCounters counters;
    counters.face_checks = mesh_->face_count();
    find_flips();
    record_.begin_move();
    record_.flip_faces(flipped_);
    record_.end_faces();

    const std::uint64_t edge_count = mesh_->edges_of_class(EdgeClass::border).first;
    const std::uint64_t cost_of_update = 3 * flipped_.size();
    was_extracted_ = cost_of_update > cost_of_extraction(edge_count, record_.slots().size());
    if (was_extracted_) {
        counters.edge_checks = edge_count;
        brute_force_.silhouette(words_, extracted_);
        record_.replace_edges(extracted_);
    } else {
        counters.edge_checks = cost_of_update;
        record_.toggle_edges(changed_edges());
    }
    return record_.end_move(point, counters);
}

void BruteForceTracker::find_flips() noexcept {
    flipped_.clear();
    const std::span<const std::uint32_t> old_words = record_.face_words();
    for (std::size_t first = 0; first < words_.size(); first += k_words_at_once) {
        const std::size_t last = std::min(first + k_words_at_once, words_.size());
        std::uint32_t any = 0;
        for (std::size_t w = first; w < last; ++w) any |= flips_[w] = words_[w] ^ old_words[w];
        if (any == 0) continue;
        for (std::size_t w = first; w < last; ++w)
            for (std::uint32_t flips = flips_[w]; flips != 0; flips &= flips - 1)
                flipped_.push_back(FaceId{static_cast<std::uint32_t>(32 * w) +
                                          static_cast<std::uint32_t>(std::countr_zero(flips))});
    }
}

// Every result is stored and the count advanced only if it is valid: a branch would be unpredictable.
std::span<const EdgeId> BruteForceTracker::changed_edges() noexcept {
    std::size_t count = 0;
    for (std::size_t i = 0; i < flipped_.size(); ++i) {
        if (i + k_prefetch_ahead < flipped_.size())
            __builtin_prefetch(&neighbors_[index(flipped_[i + k_prefetch_ahead])]);
        const Neighbors& neighbors = neighbors_[index(flipped_[i])];
        for (std::size_t k = 0; k < 3; ++k) {
            toggled_[count] = neighbors.edges[k];
            count += face_bit(flips_, neighbors.faces[k]) ? 0 : 1;
        }
    }
    return std::span(toggled_).first(count);
}

}  // namespace rimline
