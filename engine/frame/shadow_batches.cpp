#include "engine/frame/shadow_batches.h"

#include <algorithm>

namespace rimline {

void ShadowBatches::begin() noexcept {
    added_.clear();
    total_ = 0;
}

std::uint32_t ShadowBatches::add(std::uint32_t instance, const CountedVolume& volume,
                                 VolumeCount& count) {
    counter_.update(volume, k_batch_limit, count);
    added_.push_back({instance, count.bound, volume, &count});
    total_ += count.bound;
    return count.bound;
}

std::uint32_t ShadowBatches::add_unseen(std::uint32_t instance, std::uint32_t face_count) {
    added_.push_back({instance, std::min(face_count, k_batch_limit), {}, nullptr});
    total_ += added_.back().bound;
    return added_.back().bound;
}

std::vector<ShadowBatch> ShadowBatches::end() {
    std::vector<ShadowBatch> batches(1);
    const std::uint64_t limit =
        total_ <= k_single_batch_limit ? k_single_batch_limit : k_batch_limit;
    std::uint64_t counted = 0;
    const auto draw = [&](const ShadowDraw& drawn, std::uint32_t bound) {
        if (counted + bound > limit) {
            batches.emplace_back();
            counted = 0;
        }
        counted += bound;
        batches.back().draws.push_back(drawn);
    };
    for (const Added& added : added_) {
        if (added.bound <= limit) {
            draw({.instance = added.instance}, added.bound);
            continue;
        }
        counter_.divide(added.volume, k_batch_limit, *added.count);
        for (const VolumePart& part : added.count->parts)
            draw({.instance = added.instance,
                  .part = ShadowDraw::Part{.first_face = part.first_face,
                                           .face_count = part.face_count,
                                           .first_side = part.first_side,
                                           .side_count = part.side_count}},
                 part.bound);
    }
    // The pass folds the stencil only if there is more than one batch.
    if (total_ > k_single_batch_limit && batches.size() == 1) batches.emplace_back();
    return batches;
}

}  // namespace rimline
