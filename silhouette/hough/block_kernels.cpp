#include "silhouette/hough/block_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "silhouette/hough/block_kernels.cpp"
#include "silhouette/vector_targets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rimline::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// At most eight lanes. Where registers have fewer, loops process eight in several steps.
using Floats = hn::CappedTag<float, k_node_width>;
using Ints = hn::RebindToSigned<Floats>;
using Unsigneds = hn::RebindToUnsigned<Floats>;

constexpr std::uint32_t k_prefetch_ahead = 5;
constexpr std::uint32_t k_prefetch_far = 8;  // Where a step is short.

HWY_INLINE void prefetch(const void* data, std::size_t size) {
    for (std::size_t offset = 0; offset < size; offset += 64)
        hwy::Prefetch(static_cast<const std::uint8_t*>(data) + offset);
}

// V and R of eight boxes, from `lane` on (box_tree.h).
struct Interval {
    hn::Vec<Floats> value;
    hn::Vec<Floats> reach;
};
HWY_INLINE Interval test_boxes(const BoxNode& node, std::size_t lane, const BoxQuery& query) {
    const Floats d;
    const auto w = hn::Set(d, query.w);
    auto value = hn::Zero(d);
    auto spread = hn::Add(hn::Mul(hn::Load(d, node.reach + lane), hn::Set(d, query.margin)),
                          hn::Set(d, query.min_margin));
    for (int i = 0; i < 3; ++i) {
        const auto center = hn::Load(d, node.center[i] + lane);
        const auto extent = hn::Load(d, node.extent[i] + lane);
        const auto scaled = hn::Mul(w, center);
        const auto offset = hn::Sub(scaled, hn::Set(d, query.q[i]));
        const auto slope = hn::Abs(hn::Add(offset, scaled));
        value = hn::Add(value, hn::Mul(center, offset));
        spread = hn::Add(spread, hn::Mul(extent, hn::Add(slope, hn::Mul(w, extent))));
    }
    return {value, spread};
}

struct Thresholds {
    hn::Vec<Ints> threshold;
    hn::Vec<Ints> margin;
};

// Of eight blocks from `lane` on, those that their thresholds do not decide. |T| - limit lies between -1.05e9
// and 1.09e9, so nothing overflows.
HWY_INLINE std::uint32_t near_lanes(const NodeFrames& frames, std::size_t lane,
                                    const Thresholds& t) {
    const Floats d;
    const Ints di;
    const auto limit = hn::ConvertTo(
        di, hn::Mul(hn::Load(d, frames.longest + lane), hn::Set(d, k_block_weight_length)));
    return lanes_of(di, hn::Lt(hn::Sub(hn::Abs(t.threshold), limit), t.margin));
}

HWY_INLINE Thresholds make_thresholds(const NodeFrames& frames, std::size_t lane,
                                      const BlockPoint& point) {
    const Floats d;
    const Ints di;
    const auto inverse = hn::Load(d, frames.step_inverse + lane);
    auto value = hn::Zero(d);
    for (int i = 0; i < 4; ++i)
        value = hn::Add(value, hn::Mul(hn::Load(d, frames.center[i] + lane),
                                       hn::Set(d, point.scaled[static_cast<std::size_t>(i)])));
    const auto limit = hn::Set(d, k_block_threshold_limit);
    const auto threshold = hn::Min(hn::Max(hn::Mul(value, inverse), hn::Neg(limit)), limit);
    const auto margin =
        hn::Min(hn::Add(hn::Mul(inverse, hn::Set(d, point.spread)), hn::Set(d, k_block_margin)),
                hn::Set(d, k_block_max_margin));
    return {hn::ConvertTo(di, threshold), hn::ConvertTo(di, margin)};
}

// Appends the children of node `n` in `lanes`, whose bit 0 is child `lane`.
HWY_INLINE std::uint32_t append_children(std::uint32_t n, std::size_t lane, std::uint32_t lanes,
                                         std::uint32_t* out, std::uint32_t end) {
    const Unsigneds du;
    const auto base = static_cast<std::uint32_t>(n * k_node_width + lane);
    hn::StoreU(hn::Add(squeezed_lanes(du, lanes), hn::Set(du, base)), du, out + end);
    return end + static_cast<std::uint32_t>(hwy::PopCount(std::uint64_t{lanes}));
}

// The same for blocks, with their thresholds.
HWY_INLINE std::uint32_t append_blocks(std::uint32_t n, std::size_t lane, std::uint32_t lanes,
                                       const Thresholds& t, std::uint32_t end,
                                       BlockScratch& scratch) {
    const Ints di;
    const auto kept = squeezed_lanes(Unsigneds(), lanes);
    hn::StoreU(squeezed(di, t.threshold, kept), di, scratch.threshold.data() + end);
    hn::StoreU(squeezed(di, t.margin, kept), di, scratch.margin.data() + end);
    return append_children(n, lane, lanes, scratch.block.data(), end);
}

std::uint32_t FindMixed(const BoxTree& tree, std::span<const NodeFrames> frames,
                        const BoxQuery& query, const BlockPoint& point, SettledBy settled_by,
                        BlockScratch& scratch, std::uint64_t& nodes) {
    if (tree.block_count() == 0) return 0;
    const Floats d;
    const std::uint32_t levels = tree.level_count();
    std::uint32_t count = 1;
    scratch.frontier[0][0] = 0;
    for (std::uint32_t l = 0; l < levels; ++l) {
        const std::span<const BoxNode> level = tree.level(l);
        const std::uint32_t* const from = scratch.frontier[l % 2].data();
        const bool is_last = l + 1 == levels;
        std::uint32_t* const to =
            is_last ? scratch.block.data() : scratch.frontier[(l + 1) % 2].data();
        std::uint32_t end = 0;
        nodes += count;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (i + k_prefetch_ahead < count) {
                const std::uint32_t ahead = from[i + k_prefetch_ahead];
                prefetch(&level[ahead], sizeof(BoxNode));
                if (is_last) prefetch(&frames[ahead], sizeof(NodeFrames));
            }
            const std::uint32_t n = from[i];
            for (std::size_t lane = 0; lane < k_node_width; lane += hn::Lanes(d)) {
                const Interval g = test_boxes(level[n], lane, query);
                std::uint32_t mixed = lanes_of(d, hn::Le(hn::Abs(g.value), g.reach));
                if (!is_last) {
                    end = append_children(n, lane, mixed, to, end);
                    continue;
                }
                const Thresholds t = make_thresholds(frames[n], lane, point);
                if (settled_by == SettledBy::box_and_threshold)
                    mixed &= near_lanes(frames[n], lane, t);
                end = append_blocks(n, lane, mixed, t, end, scratch);
            }
        }
        count = end;
    }
    return count;
}

std::uint32_t FindChanging(const BoxTree& tree, std::span<const NodeFrames> frames,
                           const BoxQuery& from_query, const BoxQuery& to_query,
                           const BlockPoint& point, BlockScratch& scratch,
                           std::uint32_t& certain_count, std::uint64_t& nodes) {
    certain_count = 0;
    if (tree.block_count() == 0) return 0;
    const Floats d;
    const std::uint32_t levels = tree.level_count();
    std::uint32_t span = 1;  // Blocks below a child of the level.
    for (std::uint32_t l = 1; l < levels; ++l) span *= k_node_width;
    std::uint32_t count = 1;
    scratch.frontier[0][0] = 0;
    for (std::uint32_t l = 0; l < levels; ++l, span /= k_node_width) {
        const std::span<const BoxNode> level = tree.level(l);
        const std::uint32_t* const from = scratch.frontier[l % 2].data();
        const bool is_last = l + 1 == levels;
        std::uint32_t* const to =
            is_last ? scratch.block.data() : scratch.frontier[(l + 1) % 2].data();
        std::uint32_t end = 0;
        nodes += 2 * std::uint64_t{count};
        for (std::uint32_t i = 0; i < count; ++i) {
            if (i + k_prefetch_ahead < count) {
                const std::uint32_t ahead = from[i + k_prefetch_ahead];
                prefetch(&level[ahead], sizeof(BoxNode));
                if (is_last) prefetch(&frames[ahead], sizeof(NodeFrames));
            }
            const std::uint32_t n = from[i];
            for (std::size_t lane = 0; lane < k_node_width; lane += hn::Lanes(d)) {
                const Interval g = test_boxes(level[n], lane, from_query);
                const Interval h = test_boxes(level[n], lane, to_query);
                // NaN lanes are neither mixed nor different.
                const auto mixed =
                    hn::Or(hn::Le(hn::Abs(g.value), g.reach), hn::Le(hn::Abs(h.value), h.reach));
                const auto differ = hn::AndNot(
                    mixed,
                    hn::Or(hn::And(hn::Gt(g.value, hn::Zero(d)), hn::Lt(h.value, hn::Zero(d))),
                           hn::And(hn::Lt(g.value, hn::Zero(d)), hn::Gt(h.value, hn::Zero(d)))));
                end = is_last ? append_blocks(n, lane, lanes_of(d, mixed),
                                              make_thresholds(frames[n], lane, point), end, scratch)
                              : append_children(n, lane, lanes_of(d, mixed), to, end);
                const auto base = static_cast<std::uint32_t>(n * k_node_width + lane);
                for (std::uint32_t lanes = lanes_of(d, differ); lanes != 0; lanes &= lanes - 1) {
                    const std::uint32_t child =
                        base +
                        static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
                    scratch.certain[certain_count++] = {
                        child * span, HWY_MIN((child + 1) * span, tree.block_count())};
                }
            }
        }
        count = end;
    }
    return count;
}

std::uint32_t FindNear(std::span<const NodeFrames> frames, std::uint32_t block_count,
                       const BlockPoint& point, BlockScratch& scratch) {
    const Ints di;
    std::uint32_t end = 0;
    for (std::uint32_t n = 0; n < frames.size(); ++n) {
        const std::uint32_t left = block_count - n * k_node_width;
        const std::uint32_t in_use = left < k_node_width ? (1u << left) - 1 : 0xffu;
        for (std::size_t lane = 0; lane < k_node_width; lane += hn::Lanes(di)) {
            const Thresholds t = make_thresholds(frames[n], lane, point);
            const std::uint32_t lanes = near_lanes(frames[n], lane, t) & in_use >> lane;
            end = append_blocks(n, lane, lanes, t, end, scratch);
        }
    }
    return end;
}

// k·W of the planes from `lane` on.
#if HWY_TARGET == HWY_SCALAR
class Weights {
public:
    explicit Weights(const BlockPoint& point) : w_(point.weights) {}
    HWY_INLINE hn::Vec<Ints> times(const PlaneBlock& block, std::size_t lane) const {
        const std::int16_t* const xy = block.normal_xy.data() + 2 * lane;
        const std::int16_t* const zd = block.normal_z_distance.data() + 2 * lane;
        return hn::Set(Ints(), xy[0] * w_[0] + xy[1] * w_[1] + zd[0] * w_[2] + zd[1] * w_[3]);
    }

private:
    std::array<std::int16_t, 4> w_;
};
#else
class Weights {
public:
    explicit Weights(const BlockPoint& point) {
        HWY_ALIGN std::int16_t xy[2 * k_node_width];
        HWY_ALIGN std::int16_t zd[2 * k_node_width];
        for (std::size_t i = 0; i < 2 * k_node_width; ++i) {
            xy[i] = point.weights[i % 2];
            zd[i] = point.weights[2 + i % 2];
        }
        xy_ = hn::Load(Shorts(), xy);
        zd_ = hn::Load(Shorts(), zd);
    }
    HWY_INLINE hn::Vec<Ints> times(const PlaneBlock& block, std::size_t lane) const {
        const Ints di;
        const Shorts ds;
        auto odd = hn::Zero(di);
        auto even = hn::ReorderWidenMulAccumulate(
            di, hn::Load(ds, block.normal_xy.data() + 2 * lane), xy_, hn::Zero(di), odd);
        even = hn::ReorderWidenMulAccumulate(
            di, hn::Load(ds, block.normal_z_distance.data() + 2 * lane), zd_, even, odd);
        return hn::RearrangeToOddPlusEven(even, odd);
    }

private:
    using Shorts = hn::Repartition<std::int16_t, Ints>;
    hn::Vec<Shorts> xy_, zd_;
};
#endif

TestedEdges TestEdges(const EdgeBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                      BlockScratch& scratch) {
    const Ints di;
    const Weights weights(point);
    const auto last = static_cast<std::uint32_t>(blocks.planes.size()) - 1;
    TestedEdges tested{};
    for (std::uint32_t j = 0; j < count; ++j) {
        if (j + k_prefetch_far < count)
            prefetch(&blocks.planes[scratch.block[j + k_prefetch_far]], sizeof(EdgePlanes));
        const std::uint32_t b = scratch.block[j];
        const EdgePlanes& planes = blocks.planes[b];
        const auto threshold = hn::Set(di, scratch.threshold[j]);
        const auto margin = hn::Set(di, scratch.margin[j]);
        std::uint32_t on = 0;
        std::uint32_t doubts = 0;
        for (std::size_t lane = 0; lane < k_block_size; lane += hn::Lanes(di)) {
            const auto x = hn::Add(weights.times(planes[0], lane), threshold);
            const auto y = hn::Add(weights.times(planes[1], lane), threshold);
            on |= lanes_of(di, hn::Lt(hn::Xor(x, y), hn::Zero(di))) << lane;
            doubts |= lanes_of(di, hn::Lt(hn::Min(hn::Abs(x), hn::Abs(y)), margin)) << lane;
        }
        const std::uint32_t in_use = b == last ? blocks.last_lanes : 0xffffu;
        doubts &= in_use;
        on &= in_use & ~doubts;
        scratch.found_block[tested.found] = b;
        scratch.found_lanes[tested.found] = on;
        scratch.found_doubts[tested.found] = doubts;
        scratch.doubtful[tested.doubtful] = tested.found;
        tested.certain += static_cast<std::uint32_t>(hwy::PopCount(std::uint64_t{on}));
        tested.doubtful += doubts != 0;
        tested.found += (on | doubts) != 0;
    }
    return tested;
}

EdgeId* WriteEdges(std::span<const EdgeId> edges_of_blocks, std::uint32_t count,
                   const BlockScratch& scratch, EdgeId* edges) {
    const Unsigneds du;
    for (std::uint32_t j = 0; j < count; ++j) {
        if (j + k_prefetch_ahead < count)
            hwy::Prefetch(&edges_of_blocks[std::size_t{scratch.found_block[j + k_prefetch_ahead]} *
                                           k_block_size]);
        const EdgeId* const from =
            edges_of_blocks.data() + std::size_t{scratch.found_block[j]} * k_block_size;
        for (std::size_t lane = 0; lane < k_block_size; lane += hn::Lanes(du)) {
            const std::uint32_t lanes =
                scratch.found_lanes[j] >> lane & ((1u << hn::Lanes(du)) - 1);
            const auto ids = hn::LoadU(du, reinterpret_cast<const std::uint32_t*>(from + lane));
            hn::StoreU(squeezed(du, ids, squeezed_lanes(du, lanes)), du,
                       reinterpret_cast<std::uint32_t*>(edges));
            edges += hwy::PopCount(std::uint64_t{lanes});
        }
    }
    return edges;
}

std::uint32_t TestFaces(const FaceBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                        std::span<const std::uint16_t> bits, BlockScratch& scratch) {
    const Ints di;
    const Weights weights(point);
    const auto last = static_cast<std::uint32_t>(blocks.planes.size()) - 1;
    std::uint32_t found = 0;
    for (std::uint32_t j = 0; j < count; ++j) {
        if (j + k_prefetch_ahead < count)
            prefetch(&blocks.planes[scratch.block[j + k_prefetch_ahead]], sizeof(PlaneBlock));
        const std::uint32_t b = scratch.block[j];
        const PlaneBlock& planes = blocks.planes[b];
        const auto threshold = hn::Set(di, scratch.threshold[j]);
        const auto margin = hn::Set(di, scratch.margin[j]);
        std::uint32_t front = 0;
        std::uint32_t doubts = 0;
        for (std::size_t lane = 0; lane < k_block_size; lane += hn::Lanes(di)) {
            const auto x = hn::Add(weights.times(planes, lane), threshold);
            front |= lanes_of(di, hn::Gt(x, hn::Zero(di))) << lane;
            doubts |= lanes_of(di, hn::Lt(hn::Abs(x), margin)) << lane;
        }
        const std::uint32_t in_use = b == last ? blocks.last_lanes : 0xffffu;
        doubts &= in_use;
        const std::uint32_t flips = (front ^ bits[b]) & in_use & ~doubts;
        scratch.found_block[found] = b;
        scratch.found_lanes[found] = flips;
        scratch.found_doubts[found] = doubts;
        found += (flips | doubts) != 0;
    }
    return found;
}

std::uint32_t FrontBits(const FaceBlocks& blocks, const BlockPoint& point,
                        std::span<std::uint16_t> bits, BlockScratch& scratch) {
    const Ints di;
    const Weights weights(point);
    const auto block_count = static_cast<std::uint32_t>(blocks.planes.size());
    HWY_ALIGN std::int32_t thresholds[k_node_width], margins[k_node_width];
    std::uint32_t found = 0;
    for (std::uint32_t n = 0; n < blocks.frames.size(); ++n) {
        for (std::size_t lane = 0; lane < k_node_width; lane += hn::Lanes(di)) {
            const Thresholds t = make_thresholds(blocks.frames[n], lane, point);
            hn::Store(t.threshold, di, thresholds + lane);
            hn::Store(t.margin, di, margins + lane);
        }
        const std::uint32_t first = n * k_node_width;
        const std::uint32_t count = std::min<std::uint32_t>(k_node_width, block_count - first);
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t b = first + k;
            const auto threshold = hn::Set(di, thresholds[k]);
            const auto margin = hn::Set(di, margins[k]);
            std::uint32_t front = 0;
            auto nearest = hn::Set(di, 0x7fffffff);
            for (std::size_t lane = 0; lane < k_block_size; lane += hn::Lanes(di)) {
                const auto x = hn::Add(weights.times(blocks.planes[b], lane), threshold);
                front |= lanes_of(di, hn::Gt(x, hn::Zero(di))) << lane;
                nearest = hn::Min(nearest, hn::Abs(x));
            }
            bits[b] = static_cast<std::uint16_t>(front);
            if (HWY_LIKELY(b + 1 < block_count && hn::AllFalse(di, hn::Lt(nearest, margin))))
                continue;
            std::uint32_t doubts = 0;
            for (std::size_t lane = 0; lane < k_block_size; lane += hn::Lanes(di)) {
                const auto x = hn::Add(weights.times(blocks.planes[b], lane), threshold);
                doubts |= lanes_of(di, hn::Lt(hn::Abs(x), margin)) << lane;
            }
            const std::uint32_t in_use = b + 1 == block_count ? blocks.last_lanes : 0xffffu;
            doubts &= in_use;
            bits[b] = static_cast<std::uint16_t>(front & in_use & ~doubts);
            if (doubts == 0) continue;
            scratch.found_block[found] = b;
            scratch.found_lanes[found] = 0;
            scratch.found_doubts[found++] = doubts;
        }
    }
    return found;
}

const char* TargetName() { return hwy::TargetName(HWY_TARGET); }

}  // namespace rimline::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rimline::kernels {

HWY_EXPORT(FindMixed);
HWY_EXPORT(FindChanging);
HWY_EXPORT(FindNear);
HWY_EXPORT(TestEdges);
HWY_EXPORT(WriteEdges);
HWY_EXPORT(TestFaces);
HWY_EXPORT(FrontBits);
HWY_EXPORT(TargetName);

std::uint32_t find_mixed(const BoxTree& tree, std::span<const NodeFrames> frames,
                         const BoxQuery& query, const BlockPoint& point, SettledBy settled_by,
                         BlockScratch& scratch, std::uint64_t& nodes) {
    return HWY_DYNAMIC_DISPATCH(FindMixed)(tree, frames, query, point, settled_by, scratch, nodes);
}

std::uint32_t find_changing(const BoxTree& tree, std::span<const NodeFrames> frames,
                            const BoxQuery& from, const BoxQuery& to, const BlockPoint& point,
                            BlockScratch& scratch, std::uint32_t& certain_count,
                            std::uint64_t& nodes) {
    return HWY_DYNAMIC_DISPATCH(FindChanging)(tree, frames, from, to, point, scratch, certain_count,
                                              nodes);
}

std::uint32_t find_near(std::span<const NodeFrames> frames, std::uint32_t block_count,
                        const BlockPoint& point, BlockScratch& scratch) {
    return HWY_DYNAMIC_DISPATCH(FindNear)(frames, block_count, point, scratch);
}

TestedEdges test_edges(const EdgeBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                       BlockScratch& scratch) {
    return HWY_DYNAMIC_DISPATCH(TestEdges)(blocks, point, count, scratch);
}

EdgeId* write_edges(std::span<const EdgeId> edges_of_blocks, std::uint32_t count,
                    const BlockScratch& scratch, EdgeId* edges) {
    return HWY_DYNAMIC_DISPATCH(WriteEdges)(edges_of_blocks, count, scratch, edges);
}

std::uint32_t test_faces(const FaceBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                         std::span<const std::uint16_t> bits, BlockScratch& scratch) {
    return HWY_DYNAMIC_DISPATCH(TestFaces)(blocks, point, count, bits, scratch);
}

std::uint32_t front_bits(const FaceBlocks& blocks, const BlockPoint& point,
                         std::span<std::uint16_t> bits, BlockScratch& scratch) {
    return HWY_DYNAMIC_DISPATCH(FrontBits)(blocks, point, bits, scratch);
}

std::string_view instruction_set() { return HWY_DYNAMIC_DISPATCH(TargetName)(); }

}  // namespace rimline::kernels
#endif  // HWY_ONCE
