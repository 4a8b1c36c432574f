#include "engine/stream/tracked_silhouette.h"

#include <algorithm>
#include <chrono>

namespace rimline {

TrackedSilhouette::TrackedSilhouette(const DeviceContext& context, SilhouetteService& service,
                                     const HoughOctree& octree, const HomogeneousPoint& point,
                                     std::uint32_t ring_slots, MemoryBudget& stream_budget,
                                     MemoryBudget& tracker_budget, const std::string& model)
    : mesh_(&octree.mesh()),
      regular_end_(octree.mesh().edges_of_class(EdgeClass::regular).last),
      stream_(context, StreamSize::of(octree.mesh()), ring_slots, &stream_budget, model),
      tracker_share_(&tracker_budget),
      follower_(service, octree, point) {
    tracker_share_.resize(follower_.tracker_bytes(), "the tracker of " + model);
}

std::uint32_t TrackedSilhouette::count_regular(std::span<const EdgeId> edges) const noexcept {
    return static_cast<std::uint32_t>(
        std::ranges::count_if(edges, [this](EdgeId edge) { return index(edge) < regular_end_; }));
}

bool TrackedSilhouette::Consumer::apply(const ChangeSet& changes) {
    SilhouetteChanges& counted = silhouette.changes_;
    counted.flips += changes.flipped.size();
    counted.added += changes.added.size();
    counted.removed += changes.removed.size();
    counted.counters += changes.counters;
    if (!silhouette.stream_.apply(changes)) return false;
    silhouette.slots_.resize(changes.silhouette_size);
    for (const SlotWrite& write : changes.slots) silhouette.slots_[write.slot] = write.edge;
    for (const WordWrite& write : changes.words) silhouette.words_[write.word] = write.bits;
    silhouette.regular_count_ +=
        silhouette.count_regular(changes.added) - silhouette.count_regular(changes.removed);
    return true;
}

void TrackedSilhouette::Consumer::resend(const SilhouetteSnapshot& snapshot) {
    silhouette.stream_.resend(snapshot.sequence, snapshot.slots, snapshot.words);
    silhouette.slots_ = snapshot.slots;
    silhouette.words_ = snapshot.words;
    silhouette.regular_count_ = silhouette.count_regular(snapshot.slots);
}

void TrackedSilhouette::follow(const HomogeneousPoint& point, std::uint32_t ring_slot) {
    stream_.begin_frame(ring_slot);
    const auto started = std::chrono::steady_clock::now();
    changes_ = {};
    Consumer consumer{*this};
    follower_.follow(point, consumer);
    changes_.edges = slots_.size();
    changes_.update_us =
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - started)
            .count();
}

}  // namespace rimline
