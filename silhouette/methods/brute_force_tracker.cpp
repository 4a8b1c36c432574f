#include "silhouette/methods/brute_force_tracker.h"

#include "silhouette/hough/block_kernels.h"
#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

// Unit: the examination of one edge of a flipped face, as the tracker counts it. The terms: a pass over all
// edges, and writing and comparing the silhouette's edges.
std::uint64_t cost_of_extraction(std::uint64_t edge_count, std::size_t silhouette_size) {
    return edge_count / 4 + 3 * silhouette_size;
}

}  // namespace

BruteForceTracker::BruteForceTracker(const Mesh& mesh, const HomogeneousPoint& point)
    : mesh_(&mesh), brute_force_(mesh), record_(make_record(point)) {
    links_.reserve(mesh.face_count());
    faces_.assign(brute_force_.bits().size() * k_block_size, k_no_face);
    for (std::uint32_t place = 0; place < mesh.face_count(); ++place) {
        faces_[place] = brute_force_.face_at(place);
        links_.emplace_back(mesh, faces_[place], brute_force_.places());
    }
    bits_.assign(brute_force_.bits().begin(), brute_force_.bits().end());
    states_.assign(bits_.begin(), bits_.end());
    flipped_blocks_.resize(bits_.size());
    positions_.resize(faces_.size() + k_block_size);
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
    const std::span<const FlippedBlock> blocks = find_flips();
    record_.begin_move();
    const std::size_t count = kernels::flip_blocks(blocks, faces_, states_.data(),
                                                   positions_.data(), record_.flip_space());
    record_.flip_faces(count);

    const std::uint64_t edge_count = mesh_->edges_of_class(EdgeClass::border).first;
    const std::uint64_t cost_of_update = 3 * std::uint64_t{count};
    was_extracted_ = cost_of_update > cost_of_extraction(edge_count, record_.slots().size());
    if (was_extracted_) {
        counters.edge_checks = edge_count;
        brute_force_.silhouette(extracted_);
        record_.replace_edges(extracted_);
    } else {
        counters.edge_checks = cost_of_update;
        record_.toggle_edges(find_toggled_edges(std::span(positions_).first(count), links_, states_,
                                                record_.toggle_space()));
    }
    for (const FlippedBlock& flipped : blocks) states_[flipped.block] &= 0xffffu;
    return record_.end_move(point, counters);
}

std::span<const FlippedBlock> BruteForceTracker::find_flips() noexcept {
    FlippedBlock* end = flipped_blocks_.data();
    const std::span<const std::uint16_t> bits = brute_force_.bits();
    // Most windows have no face that flipped.
    for (std::size_t first = 0; first < bits.size(); first += k_window_blocks) {
        std::uint16_t any = 0;
        for (std::size_t b = first; b < first + k_window_blocks; ++b)
            any = static_cast<std::uint16_t>(any | (bits[b] ^ bits_[b]));
        if (any == 0) continue;
        for (std::size_t b = first; b < first + k_window_blocks; ++b) {
            const auto flips = static_cast<std::uint32_t>(bits[b] ^ bits_[b]);
            bits_[b] = bits[b];
            *end = {static_cast<std::uint32_t>(b), flips};
            end += flips != 0;
        }
    }
    return {flipped_blocks_.data(), end};
}

}  // namespace rimline
