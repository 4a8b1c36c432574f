#include "silhouette/points/point_silhouette.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "silhouette/hough/reserved_bytes.h"

namespace rimline {

namespace {

// Eight bytes are read at once, also at the last element.
constexpr std::size_t k_slack = 8;

}  // namespace

PointSilhouette::PointSilhouette(const UmbrellaIndex& umbrellas, const HomogeneousPoint& point)
    : umbrellas_(&umbrellas),
      point_(point),
      scratch_(umbrellas.make_scratch()),
      front_(umbrellas.max_planes() + k_slack),
      spoke_counts_(umbrellas.patch_count(), 0),
      on_bits_(umbrellas.spoke_count() / 8 + k_slack) {
    RIMLINE_CHECK(point.is_valid());
    find_all();
    size_ = static_cast<std::uint32_t>(added_.size());
    added_ = {};
}

// At point_. Sets added_ to all points of the silhouette.
void PointSilhouette::find_all() {
    std::ranges::fill(spoke_counts_, std::uint8_t{0});
    std::ranges::fill(on_bits_, std::uint8_t{0});
    consensus_.clear();
    consensus_spokes_.clear();
    consensus_slots_.clear();
    added_.clear();
    TraversalCounters counters;
    for (std::uint32_t block = 0; block < umbrellas_->block_count(); ++block)
        update_block(block, point_, counters);
    is_torn_ = false;
}

PointSilhouette::Change PointSilhouette::move_to(const HomogeneousPoint& point) {
    TraversalCounters counters;
    if (is_torn_) find_all();
    added_.clear();
    removed_.clear();
    const std::uint32_t count = umbrellas_->find_changing(point_, point, scratch_, counters);
    is_torn_ = true;
    for (std::uint32_t i = 0; i < count; ++i) update_block(scratch_.block[i], point, counters);
    is_torn_ = false;
    point_ = point;
    size_ += static_cast<std::uint32_t>(added_.size());
    size_ -= static_cast<std::uint32_t>(removed_.size());
    return {added_, removed_, counters};
}

void PointSilhouette::update_block(std::uint32_t block, const HomogeneousPoint& point,
                                   TraversalCounters& counters) {
    const UmbrellaIndex& index = *umbrellas_;
    counters.face_checks += index.evaluate(block, point, front_);
    const auto [first_patch, last_patch] = index.patches_of(block);
    const std::uint8_t* front = front_.data();
    std::uint32_t first_spoke = index.spokes_of(first_patch).first;
    std::uint32_t first_plane = index.planes_of(first_patch).first;
    for (std::uint32_t patch = first_patch; patch < last_patch; ++patch) {
        const std::uint32_t last_spoke = index.spokes_of(patch).last;
        const std::uint32_t last_plane = index.planes_of(patch).last;
        const std::uint8_t was_on = spoke_counts_[patch];
        if (index.shape(patch) == UmbrellaIndex::Shape::fan)
            update_fan(patch, first_spoke, last_spoke - first_spoke, front);
        else
            update_spokes(patch, front);
        const std::uint8_t is_now_on = spoke_counts_[patch];
        if ((was_on > 0) != (is_now_on > 0))
            (is_now_on > 0 ? added_ : removed_).push_back(index.point_of(patch));
        counters.edge_checks += last_spoke - first_spoke;
        front += last_plane - first_plane;
        first_spoke = last_spoke;
        first_plane = last_plane;
    }
}

// All spokes at once: one bit for each plane, and the bits of successive planes compared.
void PointSilhouette::update_fan(std::uint32_t patch, std::uint32_t first_spoke, std::uint32_t size,
                                 const std::uint8_t* front) {
    std::uint64_t bytes;
    std::memcpy(&bytes, front, sizeof bytes);
    const std::uint32_t mask = (1u << size) - 1;
    // Moves byte i to bit i. No two partial products share a bit.
    const auto bits = static_cast<std::uint32_t>(bytes * 0x0102040810204080u >> 56) & mask;
    const std::uint32_t on = (bits ^ (bits << 1 | bits >> (size - 1))) & mask;
    std::uint32_t was;
    std::memcpy(&was, on_bits_.data() + first_spoke / 8, sizeof was);
    for (std::uint32_t changed = on ^ (was >> first_spoke % 8 & mask); changed != 0;
         changed &= changed - 1)
        toggle(patch, first_spoke + static_cast<std::uint32_t>(std::countr_zero(changed)));
}

void PointSilhouette::update_spokes(std::uint32_t patch, const std::uint8_t* front) {
    const auto spokes = umbrellas_->spokes_of(patch);
    for (std::uint32_t spoke = spokes.first; spoke < spokes.last; ++spoke)
        if (umbrellas_->is_on(spoke, front) != is_on(spoke)) toggle(patch, spoke);
}

// A patch has at most 64 spokes, so its count fits a byte.
void PointSilhouette::toggle(std::uint32_t patch, std::uint32_t spoke) {
    on_bits_[spoke / 8] = static_cast<std::uint8_t>(on_bits_[spoke / 8] ^ 1u << spoke % 8);
    const bool joins = is_on(spoke);
    std::uint8_t& count = spoke_counts_[patch];
    count = static_cast<std::uint8_t>(joins ? count + 1 : count - 1);
    const std::uint32_t target = umbrellas_->target(spoke);
    if (target == UmbrellaIndex::k_none) return;
    const std::uint32_t twin = umbrellas_->find_spoke(target, patch);
    if (twin == UmbrellaIndex::k_none || !is_on(twin)) return;
    const std::uint32_t lesser = std::min(spoke, twin);
    if (!joins) return leave_consensus(lesser);
    const PointId a = umbrellas_->point_of(patch);
    const PointId b = umbrellas_->point_of(target);
    join_consensus(lesser, {std::min(a, b), std::max(a, b)});
}

void PointSilhouette::join_consensus(std::uint32_t spoke, const PointEdge& edge) {
    consensus_slots_[spoke] = static_cast<std::uint32_t>(consensus_.size());
    consensus_.push_back(edge);
    consensus_spokes_.push_back(spoke);
}

void PointSilhouette::leave_consensus(std::uint32_t spoke) {
    // The last edge takes its slot.
    const auto found = consensus_slots_.find(spoke);
    const std::uint32_t slot = found->second;
    consensus_[slot] = consensus_.back();
    consensus_spokes_[slot] = consensus_spokes_.back();
    consensus_slots_[consensus_spokes_[slot]] = slot;
    consensus_slots_.erase(spoke);
    consensus_.pop_back();
    consensus_spokes_.pop_back();
}

std::uint64_t PointSilhouette::size_bytes() const noexcept {
    // A node of the map holds a pointer besides key and value.
    return scratch_.size_bytes() +
           reserved_bytes(front_, spoke_counts_, on_bits_, consensus_, consensus_spokes_, added_,
                          removed_) +
           consensus_slots_.size() * 16 + consensus_slots_.bucket_count() * sizeof(void*);
}

std::vector<PointId> PointSilhouette::points() const {
    std::vector<PointId> points;
    points.reserve(size_);
    for (std::uint32_t patch = 0; patch < spoke_counts_.size(); ++patch)
        if (spoke_counts_[patch] > 0) points.push_back(umbrellas_->point_of(patch));
    std::ranges::sort(points);
    return points;
}

std::vector<PointEdge> PointSilhouette::consensus_edges() const {
    std::vector<PointEdge> edges = consensus_;
    std::ranges::sort(edges);
    return edges;
}

std::vector<std::vector<PointId>> chain(std::span<const PointEdge> edges) {
    // Each edge twice, once from each end, sorted by that end.
    struct End {
        PointId from, to;
        std::uint32_t edge;
    };
    std::vector<End> ends;
    ends.reserve(2 * edges.size());
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        ends.push_back({edges[e][0], edges[e][1], e});
        ends.push_back({edges[e][1], edges[e][0], e});
    }
    std::ranges::sort(ends, {}, [](const End& end) { return std::array{end.from, end.to}; });
    const auto ends_at = [&](PointId point) {
        return std::ranges::equal_range(ends, point, {}, &End::from);
    };
    std::vector<bool> is_used(edges.size(), false);
    std::vector<std::vector<PointId>> lines;
    const auto follow = [&](const End& first) {
        std::vector<PointId> line{first.from};
        for (const End* end = &first; end != nullptr;) {
            is_used[end->edge] = true;
            line.push_back(end->to);
            const auto here = ends_at(end->to);
            end = nullptr;
            if (here.size() != 2) break;
            for (const End& next : here)
                if (!is_used[next.edge]) end = &next;
        }
        lines.push_back(std::move(line));
    };
    for (const End& end : ends)
        if (!is_used[end.edge] && ends_at(end.from).size() != 2) follow(end);
    for (const End& end : ends)
        if (!is_used[end.edge]) follow(end);
    return lines;
}

}  // namespace rimline
