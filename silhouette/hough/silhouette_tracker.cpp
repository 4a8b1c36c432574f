#include "silhouette/hough/silhouette_tracker.h"

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
    bits_.resize(octree_->block_count());
    octree_->evaluate_faces(point, bits_, scratch_);
    std::vector<std::uint32_t> face_words = octree_->face_words(bits_);
    construction_counters_.face_checks = std::uint64_t{octree_->block_count()} * k_block_size;

    flips_.assign(octree_->block_count() + 1, 0);
    positions_.resize(std::size_t{octree_->block_count()} * k_block_size);
    flipped_.reserve(m.face_count());
    const std::uint32_t edge_count = m.edges_of_class(EdgeClass::border).first;
    toggled_.resize(edge_count + 1);
    extracted_.reserve(edge_count + HoughOctree::k_extraction_slack);
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
    return reserved_bytes(bits_, flips_, positions_, flipped_, extracted_, toggled_) +
           scratch_.size_bytes() + record_->size_bytes();
}

const ChangeSet& SilhouetteTracker::move_to(const HomogeneousPoint& point) noexcept {
    RIMLINE_CHECK(point.is_valid());
    TraversalCounters counters;
    const auto positions = std::span<const std::uint32_t>(positions_)
                               .first(octree_->find_flips(this->point(), point, bits_, positions_,
                                                          counters, scratch_));
    record_->begin_move();
    flipped_.clear();
    for (const std::uint32_t position : positions)
        flipped_.push_back(octree_->face_at(position).face);
    record_->flip_faces(flipped_);
    record_->end_faces();

    const std::uint64_t cost_of_update = 3 * positions.size();
    was_extracted_ =
        cost_of_update > cost_of_extraction(extraction_counters_, record_->slots().size());
    if (was_extracted_) {
        extraction_counters_ = {};
        octree_->extract(point, extracted_, extraction_counters_, scratch_);
        counters += extraction_counters_;
        record_->replace_edges(extracted_);
    } else {
        toggle_edges(positions, counters);
    }
    return record_->end_move(point, counters);
}

// An edge changes when one of its faces flips and the other does not. Results are stored before it is known
// whether they count: a branch would be unpredictable.
void SilhouetteTracker::toggle_edges(std::span<const std::uint32_t> positions,
                                     TraversalCounters& counters) noexcept {
    for (const std::uint32_t position : positions) {
        std::uint16_t& flips = flips_[position / k_block_size];
        flips = static_cast<std::uint16_t>(flips | 1u << (position % k_block_size));
    }
    std::size_t count = 0;
    for (const std::uint32_t position : positions) {
        const HoughOctree::PlacedFace& placed = octree_->face_at(position);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t other = placed.neighbors[k];
            toggled_[count] = placed.edges[k];
            count += (flips_[other / k_block_size] >> (other % k_block_size) & 1u) == 0;
        }
    }
    for (const std::uint32_t position : positions) flips_[position / k_block_size] = 0;
    counters.edge_checks += 3 * positions.size();
    record_->toggle_edges(std::span(toggled_).first(count));
}

}  // namespace rimline
