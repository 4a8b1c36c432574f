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
// Of tests of a block's planes: at most sixteen lanes.
using Wides = hn::CappedTag<std::int32_t, k_block_size>;

// Distances of prefetches in steps. Measured on 70,000 to 4.3 million faces: half of them are up to a fifth slower
// where the index does not fit into the caches, twice of them nowhere faster.
constexpr std::uint32_t k_nodes_ahead = 12;
constexpr std::uint32_t k_blocks_ahead = 32;

HWY_INLINE void prefetch(const void* data, std::size_t size) {
    for (std::size_t offset = 0; offset < size; offset += 64)
        hwy::Prefetch(static_cast<const std::uint8_t*>(data) + offset);
}

// Sums of products with four weights, of numbers that lie in pairs.
#if HWY_TARGET == HWY_SCALAR
template <class D>
class PairWeights {
public:
    explicit PairWeights(const std::array<std::int16_t, 4>& weights) : w_(weights) {}
    HWY_INLINE hn::Vec<D> times(const std::int16_t* xy, const std::int16_t* zd,
                                std::size_t lane) const {
        xy += 2 * lane;
        zd += 2 * lane;
        return hn::Set(D(), xy[0] * w_[0] + xy[1] * w_[1] + zd[0] * w_[2] + zd[1] * w_[3]);
    }

private:
    std::array<std::int16_t, 4> w_;
};
#else
template <class D>
class PairWeights {
public:
    explicit PairWeights(const std::array<std::int16_t, 4>& weights) {
        HWY_ALIGN std::int16_t xy[2 * k_block_size];
        HWY_ALIGN std::int16_t zd[2 * k_block_size];
        for (std::size_t i = 0; i < 2 * k_block_size; ++i) {
            xy[i] = weights[i % 2];
            zd[i] = weights[2 + i % 2];
        }
        xy_ = hn::Load(Shorts(), xy);
        zd_ = hn::Load(Shorts(), zd);
    }
    HWY_INLINE hn::Vec<D> times(const std::int16_t* xy, const std::int16_t* zd,
                                std::size_t lane) const {
        const D di;
        const Shorts ds;
        auto odd = hn::Zero(di);
        auto even =
            hn::ReorderWidenMulAccumulate(di, hn::Load(ds, xy + 2 * lane), xy_, hn::Zero(di), odd);
        even = hn::ReorderWidenMulAccumulate(di, hn::Load(ds, zd + 2 * lane), zd_, even, odd);
        return hn::RearrangeToOddPlusEven(even, odd);
    }

private:
    using Shorts = hn::Repartition<std::int16_t, D>;
    hn::Vec<Shorts> xy_, zd_;
};
#endif

// k·W of the planes from `lane` on.
HWY_INLINE hn::Vec<Wides> product(const PairWeights<Wides>& weights, const PlaneBlock& block,
                                  std::size_t lane) {
    return weights.times(block.normal_xy.data(), block.normal_z_distance.data(), lane);
}

// The center of a block times S*Q, in steps of k_center_step (plane_block.h).
class CenterProduct {
public:
    explicit CenterProduct(const BlockPoint& point)
        : weights_(point.weights), residues_(point.residues) {}

    // c·W of the blocks from `lane` on.
    HWY_INLINE hn::Vec<Ints> times(const BlockNode& node, std::size_t lane) const {
        return weights_.times(node.center_xy.data(), node.center_zd.data(), lane);
    }
    // The same and what the weights' rounding left, for which `value` is the product above.
    HWY_INLINE hn::Vec<Floats> exact(const BlockNode& node, std::size_t lane,
                                     hn::Vec<Ints> value) const {
        const Floats d;
        const auto rest = residues_.times(node.center_xy.data(), node.center_zd.data(), lane);
        return hn::Add(hn::ConvertTo(d, value),
                       hn::Mul(hn::ConvertTo(d, rest), hn::Set(d, k_residue_step)));
    }

private:
    PairWeights<Ints> weights_, residues_;
};

struct Thresholds {
    hn::Vec<Ints> threshold;
    hn::Vec<Ints> margin;
};

// `value` is that of CenterProduct::exact().
HWY_INLINE Thresholds make_thresholds(const NodeSteps& steps, std::size_t lane,
                                      hn::Vec<Floats> value, const BlockPoint& point) {
    const Floats d;
    const Ints di;
    const auto inverse = hn::Load(d, steps.inverse + lane);
    const auto limit = hn::Set(d, k_block_threshold_limit);
    const auto scaled =
        hn::Mul(hn::Mul(value, hn::Set(d, static_cast<float>(k_center_step))), inverse);
    const auto threshold = hn::Min(hn::Max(scaled, hn::Neg(limit)), limit);
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

// Visits the nodes of the tree, level by level: visit(node, number, lane, in_use, next, level, end) appends those
// children from `lane` on that are to be entered, of the lanes in use, and returns the new end. Above the blocks `next`
// is null. Returns the number of blocks.
template <typename Visit>
HWY_INLINE std::uint32_t walk(const BlockTree& tree, BlockScratch& scratch, std::uint64_t& nodes,
                              const Visit& visit) {
    if (tree.block_count() == 0) return 0;
    const std::uint32_t levels = tree.level_count();
    std::uint32_t count = 1;
    scratch.frontier[0][0] = 0;
    for (std::uint32_t l = 0; l < levels; ++l) {
        const std::span<const BlockNode> level = tree.level(l);
        const std::uint32_t* const from = scratch.frontier[l % 2].data();
        const bool is_last = l + 1 == levels;
        std::uint32_t* const next = is_last ? nullptr : scratch.frontier[(l + 1) % 2].data();
        const std::uint32_t children = tree.child_count(l);
        std::uint32_t end = 0;
        nodes += count;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (i + k_nodes_ahead < count) {
                const std::uint32_t ahead = from[i + k_nodes_ahead];
                prefetch(&level[ahead], sizeof(BlockNode));
                if (is_last) prefetch(&tree.steps()[ahead], sizeof(NodeSteps));
            }
            const std::uint32_t n = from[i];
            const std::uint32_t in_use =
                (1u << HWY_MIN(children - n * k_node_width, k_node_width)) - 1;
            for (std::size_t lane = 0; lane < k_node_width; lane += hn::Lanes(Floats()))
                end = visit(level[n], n, lane, in_use >> lane & ((1u << hn::Lanes(Floats())) - 1),
                            next, l, end);
        }
        count = end;
    }
    return count;
}

std::array<std::int16_t, 4> absolute(const std::array<std::int16_t, 4>& weights) {
    std::array<std::int16_t, 4> all;
    for (std::size_t i = 0; i < 4; ++i)
        all[i] = static_cast<std::int16_t>(weights[i] < 0 ? -weights[i] : weights[i]);
    return all;
}

std::uint32_t FindMixed(const BlockTree& tree, const BlockPoint& point, BlockScratch& scratch,
                        std::uint64_t& nodes) {
    const Ints di;
    const CenterProduct centers(point);
    const PairWeights<Ints> reach(absolute(point.weights));
    const auto margin = hn::Set(di, point.box_margin);
    const NodeSteps* const steps = tree.steps().data();
    return walk(tree, scratch, nodes,
                [&](const BlockNode& node, std::uint32_t n, std::size_t lane, std::uint32_t in_use,
                    std::uint32_t* next, std::uint32_t, std::uint32_t end) HWY_ATTR {
                    const auto value = centers.times(node, lane);
                    const auto range =
                        reach.times(node.extent_xy.data(), node.extent_zd.data(), lane);
                    const std::uint32_t mixed =
                        in_use & ~lanes_of(di, hn::Gt(hn::Sub(hn::Abs(value), margin), range));
                    if (next != nullptr) return append_children(n, lane, mixed, next, end);
                    const Thresholds t =
                        make_thresholds(steps[n], lane, centers.exact(node, lane, value), point);
                    return append_blocks(n, lane, mixed, t, end, scratch);
                });
}

std::uint32_t FindChanging(const BlockTree& tree, const BlockPoint& from_point,
                           const BlockPoint& to_point, BlockScratch& scratch,
                           std::uint32_t& certain_count, std::uint64_t& nodes) {
    const Ints di;
    const PairWeights<Ints> from(from_point.weights);
    const CenterProduct to(to_point);
    std::array<std::int16_t, 4> farther = absolute(to_point.weights);
    const std::array<std::int16_t, 4> of_from = absolute(from_point.weights);
    for (std::size_t i = 0; i < 4; ++i) farther[i] = HWY_MAX(farther[i], of_from[i]);
    const PairWeights<Ints> reach(farther);
    const auto margin = hn::Set(di, HWY_MAX(from_point.box_margin, to_point.box_margin));
    const NodeSteps* const steps = tree.steps().data();
    const std::uint32_t levels = tree.level_count();
    certain_count = 0;
    return walk(
        tree, scratch, nodes,
        [&](const BlockNode& node, std::uint32_t n, std::size_t lane, std::uint32_t in_use,
            std::uint32_t* next, std::uint32_t level, std::uint32_t end) HWY_ATTR {
            const auto a = from.times(node.center_xy.data(), node.center_zd.data(), lane);
            const auto b = to.times(node, lane);
            const auto nearest = hn::Sub(hn::Min(hn::Abs(a), hn::Abs(b)), margin);
            const auto range = reach.times(node.extent_xy.data(), node.extent_zd.data(), lane);
            const std::uint32_t sure = in_use & lanes_of(di, hn::Gt(nearest, range));
            const std::uint32_t mixed = in_use & ~sure;
            std::uint32_t certain = sure & lanes_of(di, hn::Lt(hn::Xor(a, b), hn::Zero(di)));
            if (HWY_UNLIKELY(certain != 0)) {
                std::uint32_t span = 1;  // Blocks below a child.
                for (std::uint32_t l = level + 1; l < levels; ++l) span *= k_node_width;
                for (; certain != 0; certain &= certain - 1) {
                    const auto child = static_cast<std::uint32_t>(
                        n * k_node_width + lane + hwy::Num0BitsBelowLS1Bit_Nonzero32(certain));
                    scratch.certain[certain_count++] = {
                        child * span, HWY_MIN((child + 1) * span, tree.block_count())};
                }
            }
            if (next != nullptr) return append_children(n, lane, mixed, next, end);
            const Thresholds t = make_thresholds(steps[n], lane, to.exact(node, lane, b), to_point);
            return append_blocks(n, lane, mixed, t, end, scratch);
        });
}

TestedEdges TestEdges(const EdgeBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                      BlockScratch& scratch) {
    const Wides di;
    const PairWeights<Wides> weights(point.weights);
    const auto last = static_cast<std::uint32_t>(blocks.planes.size()) - 1;
    TestedEdges tested{};
    for (std::uint32_t j = 0; j < count; ++j) {
        if (j + k_blocks_ahead < count)
            prefetch(&blocks.planes[scratch.block[j + k_blocks_ahead]], sizeof(EdgePlanes));
        const std::uint32_t b = scratch.block[j];
        const EdgePlanes& planes = blocks.planes[b];
        const auto threshold = hn::Set(di, scratch.threshold[j]);
        const auto margin = hn::Set(di, scratch.margin[j]);
        std::uint32_t on = 0;
        std::uint32_t doubts = 0;
        for (std::size_t lane = 0; lane < k_block_size; lane += hn::Lanes(di)) {
            const auto x = hn::Add(product(weights, planes[0], lane), threshold);
            const auto y = hn::Add(product(weights, planes[1], lane), threshold);
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
        if (j + k_blocks_ahead < count)
            hwy::Prefetch(&edges_of_blocks[std::size_t{scratch.found_block[j + k_blocks_ahead]} *
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

TestedFaces TestFaces(const FaceBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                      std::span<const std::uint32_t> states, BlockScratch& scratch) {
    const Wides di;
    const PairWeights<Wides> weights(point.weights);
    const auto last = static_cast<std::uint32_t>(blocks.planes.size()) - 1;
    TestedFaces tested{};
    for (std::uint32_t j = 0; j < count; ++j) {
        if (j + k_blocks_ahead < count)
            prefetch(&blocks.planes[scratch.block[j + k_blocks_ahead]], sizeof(PlaneBlock));
        const std::uint32_t b = scratch.block[j];
        const PlaneBlock& planes = blocks.planes[b];
        const auto threshold = hn::Set(di, scratch.threshold[j]);
        const auto margin = hn::Set(di, scratch.margin[j]);
        std::uint32_t front = 0;
        std::uint32_t doubts = 0;
        for (std::size_t lane = 0; lane < k_block_size; lane += hn::Lanes(di)) {
            const auto x = hn::Add(product(weights, planes, lane), threshold);
            front |= lanes_of(di, hn::Gt(x, hn::Zero(di))) << lane;
            doubts |= lanes_of(di, hn::Lt(hn::Abs(x), margin)) << lane;
        }
        const std::uint32_t in_use = b == last ? blocks.last_lanes : 0xffffu;
        doubts &= in_use;
        const std::uint32_t flips = (front ^ states[b]) & in_use & ~doubts;
        scratch.found_block[tested.found] = b;
        scratch.found_lanes[tested.found] = flips;
        scratch.found_doubts[tested.found] = doubts;
        scratch.doubtful[tested.doubtful] = tested.found;
        tested.doubtful += doubts != 0;
        tested.found += (flips | doubts) != 0;
    }
    return tested;
}

std::size_t FlipBlocks(std::span<const FlippedBlock> blocks, std::span<const FaceId> face_at,
                       std::uint32_t* states, std::uint32_t* positions, FaceId* faces) {
    const Unsigneds du;
    const std::uint32_t* const begin = positions;
    auto* out = reinterpret_cast<std::uint32_t*>(faces);
    for (std::size_t j = 0; j < blocks.size(); ++j) {
        if (j + k_blocks_ahead < blocks.size())
            hwy::Prefetch(&face_at[std::size_t{blocks[j + k_blocks_ahead].block} * k_block_size]);
        const auto [block, flips] = blocks[j];
        const std::uint32_t state = ((states[block] ^ flips) & 0xffffu) | flips << 16;
        states[block] = state;
        for (std::uint32_t lane = 0; lane < k_block_size;
             lane += static_cast<std::uint32_t>(hn::Lanes(du))) {
            const std::uint32_t lanes = flips >> lane & ((1u << hn::Lanes(du)) - 1);
            const auto order = squeezed_lanes(du, lanes);
            const std::uint32_t position = block * k_block_size + lane;
            const auto ids =
                hn::LoadU(du, reinterpret_cast<const std::uint32_t*>(&face_at[position]));
            hn::StoreU(squeezed(du, ids, order), du, out);
            const auto front = hn::ShiftLeft<31>(hn::Shr(hn::Set(du, state >> lane), order));
            hn::StoreU(hn::Or(hn::Add(order, hn::Set(du, position)), front), du, positions);
            const auto count = hwy::PopCount(std::uint64_t{lanes});
            out += count;
            positions += count;
        }
    }
    return static_cast<std::size_t>(positions - begin);
}

std::uint32_t FrontBits(const FaceBlocks& blocks, const BlockPoint& point,
                        std::span<std::uint16_t> bits, BlockScratch& scratch) {
    const Wides di;
    const PairWeights<Wides> weights(point.weights);
    const auto block_count = static_cast<std::uint32_t>(blocks.planes.size());
    HWY_ALIGN std::int32_t thresholds[k_node_width], margins[k_node_width];
    std::uint32_t found = 0;
    const std::span<const BlockNode> nodes = blocks.tree.last_level();
    const CenterProduct centers(point);
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
        for (std::size_t lane = 0; lane < k_node_width; lane += hn::Lanes(Ints())) {
            const Thresholds t = make_thresholds(
                blocks.tree.steps()[n], lane,
                centers.exact(nodes[n], lane, centers.times(nodes[n], lane)), point);
            hn::Store(t.threshold, Ints(), thresholds + lane);
            hn::Store(t.margin, Ints(), margins + lane);
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
                const auto x = hn::Add(product(weights, blocks.planes[b], lane), threshold);
                front |= lanes_of(di, hn::Gt(x, hn::Zero(di))) << lane;
                nearest = hn::Min(nearest, hn::Abs(x));
            }
            bits[b] = static_cast<std::uint16_t>(front);
            if (HWY_LIKELY(b + 1 < block_count && hn::AllFalse(di, hn::Lt(nearest, margin))))
                continue;
            std::uint32_t doubts = 0;
            for (std::size_t lane = 0; lane < k_block_size; lane += hn::Lanes(di)) {
                const auto x = hn::Add(product(weights, blocks.planes[b], lane), threshold);
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
HWY_EXPORT(TestEdges);
HWY_EXPORT(WriteEdges);
HWY_EXPORT(TestFaces);
HWY_EXPORT(FlipBlocks);
HWY_EXPORT(FrontBits);
HWY_EXPORT(TargetName);

std::uint32_t find_mixed(const BlockTree& tree, const BlockPoint& point, BlockScratch& scratch,
                         std::uint64_t& nodes) {
    return HWY_DYNAMIC_DISPATCH(FindMixed)(tree, point, scratch, nodes);
}

std::uint32_t find_changing(const BlockTree& tree, const BlockPoint& from, const BlockPoint& to,
                            BlockScratch& scratch, std::uint32_t& certain_count,
                            std::uint64_t& nodes) {
    return HWY_DYNAMIC_DISPATCH(FindChanging)(tree, from, to, scratch, certain_count, nodes);
}

TestedEdges test_edges(const EdgeBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                       BlockScratch& scratch) {
    return HWY_DYNAMIC_DISPATCH(TestEdges)(blocks, point, count, scratch);
}

EdgeId* write_edges(std::span<const EdgeId> edges_of_blocks, std::uint32_t count,
                    const BlockScratch& scratch, EdgeId* edges) {
    return HWY_DYNAMIC_DISPATCH(WriteEdges)(edges_of_blocks, count, scratch, edges);
}

TestedFaces test_faces(const FaceBlocks& blocks, const BlockPoint& point, std::uint32_t count,
                       std::span<const std::uint32_t> states, BlockScratch& scratch) {
    return HWY_DYNAMIC_DISPATCH(TestFaces)(blocks, point, count, states, scratch);
}

std::size_t flip_blocks(std::span<const FlippedBlock> blocks, std::span<const FaceId> face_at,
                        std::uint32_t* states, std::uint32_t* positions, FaceId* faces) {
    return HWY_DYNAMIC_DISPATCH(FlipBlocks)(blocks, face_at, states, positions, faces);
}

std::uint32_t front_bits(const FaceBlocks& blocks, const BlockPoint& point,
                         std::span<std::uint16_t> bits, BlockScratch& scratch) {
    return HWY_DYNAMIC_DISPATCH(FrontBits)(blocks, point, bits, scratch);
}

std::string_view instruction_set() { return HWY_DYNAMIC_DISPATCH(TargetName)(); }

}  // namespace rimline::kernels
#endif  // HWY_ONCE
