#include "tools/bench/fresh_tracker.h"

#include <bit>

namespace rimline::tools {

FreshTracker::FreshTracker(const HoughOctree& octree, const HomogeneousPoint& point)
    : octree_(&octree),
      scratch_(octree.make_scratch()),
      bits_(octree.block_count()),
      new_bits_(octree.block_count()),
      record_(make_record(point)) {}

SilhouetteRecord FreshTracker::make_record(const HomogeneousPoint& point) {
    octree_->evaluate_faces(point, bits_, scratch_);
    const Mesh& mesh = octree_->mesh();
    std::vector<std::uint32_t> words = octree_->face_words(bits_);
    extracted_.reserve(mesh.edge_count() + HoughOctree::k_extraction_slack);
    TraversalCounters counters;
    octree_->extract(point, extracted_, counters, scratch_);
    return SilhouetteRecord(mesh, point, std::move(words), extracted_);
}

const ChangeSet& FreshTracker::move_to(const HomogeneousPoint& point) {
    TraversalCounters counters;
    counters.face_checks = std::uint64_t{octree_->block_count()} * k_block_size;
    octree_->evaluate_faces(point, new_bits_, scratch_);
    record_.begin_move();
    FaceId* const flipped = record_.flip_space();
    std::size_t count = 0;
    for (std::uint32_t b = 0; b < bits_.size(); ++b)
        for (std::uint32_t flips = static_cast<std::uint32_t>(bits_[b] ^ new_bits_[b]); flips != 0;
             flips &= flips - 1)
            flipped[count++] = octree_->face_at(
                b * k_block_size + static_cast<std::uint32_t>(std::countr_zero(flips)));
    bits_.swap(new_bits_);
    record_.flip_faces(count);
    octree_->extract(point, extracted_, counters, scratch_);
    record_.replace_edges(extracted_);
    return record_.end_move(point, counters);
}

}  // namespace rimline::tools
