#include "engine/frame/shadow_batches.h"

#include <algorithm>

namespace rimline {

void ShadowBatches::begin() noexcept { added_.clear(); }

std::uint32_t ShadowBatches::add(std::uint32_t instance, const CountedVolume& volume,
                                 VolumeCount& count) {
    counter_.update(volume, k_batch_limit, count);
    added_.push_back(
        {.instance = instance, .bound = count.bound, .volume = volume, .count = &count});
    return count.bound;
}

std::uint32_t ShadowBatches::add_unseen(std::uint32_t instance, std::uint32_t face_count) {
    added_.push_back({.instance = instance,
                      .bound = std::min(face_count, k_batch_limit),
                      .volume = {},
                      .count = nullptr});
    return added_.back().bound;
}

std::uint32_t ShadowBatches::add_darkness(std::uint32_t instance) {
    added_.push_back(
        {.instance = instance, .bound = 1, .volume = {}, .count = nullptr, .is_darkness = true});
    return 1;
}

std::vector<ShadowBatch> ShadowBatches::end() {
    std::vector<ShadowBatch> batches(1);
    std::uint32_t room = k_batch_limit;
    const auto draw = [&](const ShadowDraw& drawn, std::uint32_t bound) {
        if (bound > room) {
            batches.emplace_back();
            room = k_batch_limit;
        }
        room -= bound;
        batches.back().draws.push_back(drawn);
    };
    for (const Added& added : added_) {
        if (added.bound <= k_batch_limit) {
            draw({.instance = added.instance,
                  .part = {},
                  .near_count = added.is_darkness ? 1u : 0u,
                  .has_volume = !added.is_darkness},
                 added.bound);
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
    return batches;
}

}  // namespace rimline
