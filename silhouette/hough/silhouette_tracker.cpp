#include "silhouette/hough/silhouette_tracker.h"

#include "silhouette/hough/block_kernels.h"
#include "silhouette/hough/face_links.h"
#include "silhouette/hough/reserved_bytes.h"
#include "silhouette/hough/silhouette_record.h"

namespace rimline {

namespace {

// Cost in units of the time for one edge of a flipped face, as measured on three meshes of 13,000 to 269,000
// faces. Both ways take equally long when 10 to 20 per cent of the faces flip at once. This estimate finds
// that point within a third.
std::uint64_t cost_of_extraction(const TraversalCounters& work, std::size_t silhouette_size) {
    return work.edge_checks / 2 + work.box_checks / 4 + 6 * silhouette_size;
}

}  // namespace

SilhouetteTracker::SilhouetteTracker(const HoughOctree& octree, const HomogeneousPoint& point)
    : octree_(&octree), scratch_(octree.make_scratch()) {
    RIMLINE_CHECK(point.is_valid());
    const Mesh& m = octree_->mesh();
    std::vector<std::uint16_t> bits(octree_->block_count());
    octree_->evaluate_faces(point, bits, scratch_);
    std::vector<std::uint32_t> face_words = octree_->face_words(bits);
    construction_counters_.face_checks = std::uint64_t{octree_->block_count()} * k_block_size;

    states_.assign(bits.begin(), bits.end());
    states_.push_back(0);
    flipped_blocks_.resize(octree_->block_count());
    positions_.resize(std::size_t{octree_->block_count() + 1} * k_block_size);
    extracted_.reserve(m.edges_of_class(EdgeClass::border).first + HoughOctree::k_extraction_slack);
    octree_->extract(point, extracted_, extraction_counters_, scratch_);
    construction_counters_ += extraction_counters_;
    record_ = std::make_unique<SilhouetteRecord>(m, point, std::move(face_words), extracted_);
}

SilhouetteTracker::SilhouetteTracker(SilhouetteTracker&&) noexcept = default;
SilhouetteTracker& SilhouetteTracker::operator=(SilhouetteTracker&&) noexcept = default;
SilhouetteTracker::~SilhouetteTracker() = default;

const HomogeneousPoint& SilhouetteTracker::point() const noexcept {
    return record_->change_set().point;
}

std::uint64_t SilhouetteTracker::sequence() const noexcept {
    return record_->change_set().sequence;
}

std::span<const EdgeId> SilhouetteTracker::silhouette() const noexcept { return record_->slots(); }

std::span<const std::uint32_t> SilhouetteTracker::face_words() const noexcept {
    return record_->face_words();
}

std::uint64_t SilhouetteTracker::size_bytes() const noexcept {
    return reserved_bytes(states_, flipped_blocks_, positions_, extracted_) +
           scratch_.size_bytes() + record_->size_bytes();
}

const ChangeSet& SilhouetteTracker::move_to(const HomogeneousPoint& point) noexcept {
    RIMLINE_CHECK(point.is_valid());
    TraversalCounters counters;
    const auto blocks = std::span<const FlippedBlock>(flipped_blocks_)
                            .first(octree_->find_flips(this->point(), point, states_,
                                                       flipped_blocks_, counters, scratch_));
    record_->begin_move();
    const std::size_t count = kernels::flip_blocks(blocks, octree_->faces(), states_.data(),
                                                   positions_.data(), record_->flip_space());
    record_->flip_faces(count);

    const std::uint64_t cost_of_update = 3 * std::uint64_t{count};
    was_extracted_ =
        cost_of_update > cost_of_extraction(extraction_counters_, record_->slots().size());
    if (was_extracted_) {
        extraction_counters_ = {};
        octree_->extract(point, extracted_, extraction_counters_, scratch_);
        counters += extraction_counters_;
        record_->replace_edges(extracted_);
    } else {
        counters.edge_checks += cost_of_update;
        record_->toggle_edges(find_toggled_edges(std::span(positions_).first(count),
                                                 octree_->links(), states_,
                                                 record_->toggle_space()));
    }
    for (const FlippedBlock& flipped : blocks) states_[flipped.block] &= 0xffffu;
    return record_->end_move(point, counters);
}

}  // namespace rimline
