#include "silhouette/lines/picture_kernels.h"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "silhouette/lines/picture_kernels.cpp"
#include "silhouette/vector_targets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rimline::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Steps = hn::CappedTag<std::int16_t, PictureBoxes::k_boxes>;

HWY_INLINE std::size_t boxes_before(std::span<const PictureBoxes> level,
                                    std::span<const std::uint32_t> blocks, const PictureBox& box,
                                    std::uint32_t* found) {
    const Steps d;
    const auto low_x = hn::Set(d, box.low_x), low_y = hn::Set(d, box.low_y),
               high_x = hn::Set(d, box.high_x), high_y = hn::Set(d, box.high_y),
               far = hn::Set(d, box.far);
    std::uint32_t* const begin = found;
    for (const std::uint32_t block : blocks) {
        const PictureBoxes& boxes = level[block];
        std::uint32_t lanes = 0;
        for (std::size_t i = 0; i < PictureBoxes::k_boxes; i += hn::Lanes(d)) {
            const auto load = [&](const auto& steps) HWY_ATTR { return hn::Load(d, &steps[i]); };
            auto misses =
                hn::Or(hn::Gt(load(boxes.low_x), high_x), hn::Gt(load(boxes.low_y), high_y));
            misses = hn::Or(misses, hn::Or(hn::Gt(low_x, load(boxes.high_x)),
                                           hn::Gt(low_y, load(boxes.high_y))));
            misses = hn::Or(misses, hn::Gt(load(boxes.near), far));
            lanes |= lanes_of(d, hn::Not(misses)) << i;
        }
        for (; lanes != 0; lanes &= lanes - 1)
            *found++ = static_cast<std::uint32_t>(block * PictureBoxes::k_boxes) +
                       static_cast<std::uint32_t>(std::countr_zero(lanes));
    }
    return static_cast<std::size_t>(found - begin);
}

std::size_t FindBefore(std::span<const PictureBoxes> level, std::span<const std::uint32_t> blocks,
                       const PictureBox& box, std::uint32_t* found) {
    return boxes_before(level, blocks, box, found);
}

std::size_t FindBelow(std::span<const PictureBoxes> level, std::span<const std::uint32_t> blocks,
                      std::span<const PictureBoxes> below, const PictureBox& box,
                      std::uint32_t* found_blocks, std::uint32_t* found) {
    const std::size_t count = boxes_before(level, blocks, box, found_blocks);
    return boxes_before(below, {found_blocks, count}, box, found);
}

}  // namespace rimline::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rimline::kernels {

HWY_EXPORT(FindBefore);
HWY_EXPORT(FindBelow);

std::size_t find_before(std::span<const PictureBoxes> level, std::span<const std::uint32_t> blocks,
                        const PictureBox& box, std::uint32_t* found) noexcept {
    return HWY_DYNAMIC_DISPATCH(FindBefore)(level, blocks, box, found);
}

std::size_t find_below(std::span<const PictureBoxes> level, std::span<const std::uint32_t> blocks,
                       std::span<const PictureBoxes> below, const PictureBox& box,
                       std::uint32_t* found_blocks, std::uint32_t* found) noexcept {
    return HWY_DYNAMIC_DISPATCH(FindBelow)(level, blocks, below, box, found_blocks, found);
}

}  // namespace rimline::kernels
#endif  // HWY_ONCE
