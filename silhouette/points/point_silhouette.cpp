#include "silhouette/points/point_silhouette.h"

#include <algorithm>

namespace rimline {

namespace {

constexpr std::uint8_t k_untouched = 0xff;

}  // namespace

PointSilhouette::PointSilhouette(const UmbrellaIndex& umbrellas, const HomogeneousPoint& point)
    : umbrellas_(&umbrellas),
      tracker_(umbrellas.octree(), point),
      spoke_counts_(umbrellas.point_count(), 0),
      is_on_(umbrellas.mesh().vertex_count(), 0),
      consensus_slots_(umbrellas.mesh().vertex_count()),
      was_on_(umbrellas.point_count(), k_untouched) {
    count_spokes(tracker_.silhouette(), 1);
    for (const PointId p : touched_) was_on_[index(p)] = k_untouched;
    touched_.clear();
    size_ = static_cast<std::uint32_t>(
        std::ranges::count_if(spoke_counts_, [](std::uint8_t count) { return count > 0; }));
}

// A point's rings hold at most 64 different points: counts fit a byte.
void PointSilhouette::count_spokes(std::span<const EdgeId> edges, int step) {
    for (const EdgeId edge : edges) {
        if (!umbrellas_->is_spoke(edge)) continue;
        const std::uint32_t spoke = umbrellas_->spoke_of(edge);
        const PointId owner = umbrellas_->owner(spoke);
        std::uint8_t& count = spoke_counts_[index(owner)];
        if (was_on_[index(owner)] == k_untouched) {
            was_on_[index(owner)] = count > 0;
            touched_.push_back(owner);
        }
        count = static_cast<std::uint8_t>(count + step);
        is_on_[spoke] = step > 0;
        const std::uint32_t twin = umbrellas_->twin(spoke);
        if (twin == UmbrellaIndex::k_no_spoke || is_on_[twin] == 0) continue;
        if (step > 0)
            join_consensus(spoke, twin);
        else
            leave_consensus(spoke, twin);
    }
}

void PointSilhouette::join_consensus(std::uint32_t spoke, std::uint32_t twin) {
    const std::uint32_t lesser = std::min(spoke, twin);
    const PointId a = umbrellas_->owner(spoke);
    const PointId b = umbrellas_->target(spoke);
    consensus_slots_[lesser] = static_cast<std::uint32_t>(consensus_.size());
    consensus_.push_back({std::min(a, b), std::max(a, b)});
    consensus_spokes_.push_back(lesser);
}

void PointSilhouette::leave_consensus(std::uint32_t spoke, std::uint32_t twin) {
    // The last takes its place.
    const std::uint32_t slot = consensus_slots_[std::min(spoke, twin)];
    consensus_[slot] = consensus_.back();
    consensus_spokes_[slot] = consensus_spokes_.back();
    consensus_slots_[consensus_spokes_[slot]] = slot;
    consensus_.pop_back();
    consensus_spokes_.pop_back();
}

PointSilhouette::Change PointSilhouette::move_to(const HomogeneousPoint& point) {
    const ChangeSet& changes = tracker_.move_to(point);
    touched_.clear();
    added_.clear();
    removed_.clear();
    count_spokes(changes.added, 1);
    count_spokes(changes.removed, -1);
    for (const PointId p : touched_) {
        const bool was_on = was_on_[index(p)] != 0;
        was_on_[index(p)] = k_untouched;
        if (was_on == contains(p)) continue;
        (was_on ? removed_ : added_).push_back(p);
    }
    size_ += static_cast<std::uint32_t>(added_.size());
    size_ -= static_cast<std::uint32_t>(removed_.size());
    return {added_, removed_, changes.counters};
}

std::vector<PointId> PointSilhouette::points() const {
    std::vector<PointId> points;
    points.reserve(size_);
    for (std::uint32_t p = 0; p < spoke_counts_.size(); ++p)
        if (spoke_counts_[p] > 0) points.push_back(PointId{p});
    return points;
}

std::vector<PointEdge> PointSilhouette::consensus_edges() const {
    std::vector<PointEdge> edges = consensus_;
    std::ranges::sort(edges);
    return edges;
}

std::vector<std::vector<PointId>> chain(std::span<const PointEdge> edges) {
    // Each edge from both its ends, by the point it leaves.
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
