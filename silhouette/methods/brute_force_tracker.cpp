#include "silhouette/methods/brute_force_tracker.h"

#include <bit>

#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

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
    const std::span<const std::uint32_t> places = brute_force_.places();
    neighbors_.resize(mesh.face_count());
    for (std::uint32_t place = 0; place < mesh.face_count(); ++place) {
        const FaceId face = brute_force_.face_at(place);
        for (std::size_t k = 0; k < 3; ++k) {
            const EdgeId edge = mesh.edges_of(face)[k];
            const bool has_other = edge != k_no_edge && index(edge) < two_faced;
            neighbors_[place].edges[k] = has_other ? edge : k_no_edge;
            neighbors_[place].places[k] = place;
            if (!has_other) continue;
            const std::array<FaceId, 2>& faces = mesh.edge(edge).faces;
            neighbors_[place].places[k] = places[index(faces[faces[0] == face ? 1 : 0])];
        }
    }
    bits_.assign(brute_force_.bits().begin(), brute_force_.bits().end());
    flips_.resize(bits_.size());
    flipped_at_.reserve(mesh.face_count());
    flipped_.reserve(mesh.face_count());
    toggled_.resize(mesh.edges_of_class(EdgeClass::border).first + 1);
}

SilhouetteRecord BruteForceTracker::make_record(const HomogeneousPoint& point) {
    brute_force_.look_from(point);
    const std::span<const std::uint16_t> bits = brute_force_.bits();
    std::vector<std::uint32_t> words(face_word_count(mesh_->face_count()), 0);
    for (std::uint32_t place = 0; place < mesh_->face_count(); ++place) {
        const std::uint32_t f = index(brute_force_.face_at(place));
        words[f / 32] |= (bits[place / k_block_size] >> place % k_block_size & 1u) << f % 32;
    }
    extracted_.reserve(mesh_->edges_of_class(EdgeClass::border).first);
    brute_force_.silhouette(extracted_);
    return SilhouetteRecord(*mesh_, point, words, extracted_);
}

const ChangeSet& BruteForceTracker::move_to(const HomogeneousPoint& point) noexcept {
    RIMLINE_CHECK(point.is_valid());
    brute_force_.look_from(point);
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
        brute_force_.silhouette(extracted_);
        record_.replace_edges(extracted_);
    } else {
        counters.edge_checks = cost_of_update;
        record_.toggle_edges(changed_edges());
    }
    return record_.end_move(point, counters);
}

void BruteForceTracker::find_flips() noexcept {
    flipped_at_.clear();
    flipped_.clear();
    const std::span<const std::uint16_t> bits = brute_force_.bits();
    // Most windows have no face that flipped.
    for (std::size_t first = 0; first < bits.size(); first += k_window_blocks) {
        std::uint16_t any = 0;
        for (std::size_t b = first; b < first + k_window_blocks; ++b) {
            flips_[b] = bits[b] ^ bits_[b];
            any |= flips_[b];
        }
        if (any == 0) continue;
        for (std::size_t b = first; b < first + k_window_blocks; ++b) {
            bits_[b] = bits[b];
            for (std::uint32_t flips = flips_[b]; flips != 0; flips &= flips - 1)
                flipped_at_.push_back(static_cast<std::uint32_t>(k_block_size * b) +
                                      static_cast<std::uint32_t>(std::countr_zero(flips)));
        }
    }
    for (const std::uint32_t place : flipped_at_) flipped_.push_back(brute_force_.face_at(place));
}

// Every result is stored and the count advanced only if it is valid: a branch would be unpredictable.
std::span<const EdgeId> BruteForceTracker::changed_edges() noexcept {
    std::size_t count = 0;
    for (std::size_t i = 0; i < flipped_at_.size(); ++i) {
        if (i + k_prefetch_ahead < flipped_at_.size())
            __builtin_prefetch(&neighbors_[flipped_at_[i + k_prefetch_ahead]]);
        const Neighbors& neighbors = neighbors_[flipped_at_[i]];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t place = neighbors.places[k];
            toggled_[count] = neighbors.edges[k];
            count += (flips_[place / k_block_size] >> place % k_block_size & 1u) != 0 ? 0 : 1;
        }
    }
    return std::span(toggled_).first(count);
}

}  // namespace rimline
