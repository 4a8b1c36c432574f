#include "silhouette/methods/window_kernels.h"

#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "silhouette/methods/window_kernels.cpp"
#include "silhouette/vector_targets-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rimline::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t k_window_bytes = k_window_faces / 8;
static_assert(std::endian::native == std::endian::little);  // Words of bits are read as bytes.

void FindSides(std::span<const std::uint16_t> bits, std::span<WindowSides> sides) {
    using Words = hn::CappedTag<std::uint16_t, k_window_blocks>;
    const Words d;
    for (std::size_t w = 0; w < sides.size(); ++w) {
        const std::uint16_t* const window = bits.data() + w * k_window_blocks;
        auto any = hn::Zero(d);
        auto all = hn::Set(d, 0xffff);
        for (std::size_t i = 0; i < k_window_blocks; i += hn::Lanes(d)) {
            const auto word = hn::LoadU(d, window + i);
            any = hn::Or(any, word);
            all = hn::And(all, word);
        }
        const bool is_back = hn::AllTrue(d, hn::Eq(any, hn::Zero(d)));
        const bool is_front = hn::AllTrue(d, hn::Eq(all, hn::Set(d, 0xffff)));
        sides[w] = is_back    ? WindowSides::backs
                   : is_front ? WindowSides::fronts
                              : WindowSides::both;
    }
}

#if HWY_TARGET == HWY_SCALAR
// The edges whose bits differ.
class Lookup {
public:
    Lookup(const std::uint8_t* a, const std::uint8_t* b) : a_(a), b_(b) {}
    std::uint32_t differ(const EdgeGroup& edges) const {
        std::uint32_t lanes = 0;
        for (std::uint32_t i = 0; i < k_window_edges; ++i) {
            const bool a = (a_[place(edges.byte_a[i])] & edges.bit_a[i]) != 0;
            const bool b = (b_[place(edges.byte_b[i])] & edges.bit_b[i]) != 0;
            lanes |= std::uint32_t{a != b} << i;
        }
        return lanes;
    }

private:
    static std::size_t place(std::uint8_t byte) { return (byte & 15u) + (byte >> 7) * 16u; }
    const std::uint8_t *a_, *b_;
};
#else
class Lookup {
public:
    Lookup(const std::uint8_t* a, const std::uint8_t* b)
        : a_low_(hn::LoadDup128(Bytes(), a)),
          a_high_(hn::LoadDup128(Bytes(), a + 16)),
          b_low_(hn::LoadDup128(Bytes(), b)),
          b_high_(hn::LoadDup128(Bytes(), b + 16)) {}

    HWY_INLINE std::uint32_t differ(const EdgeGroup& edges) const {
        const Bytes d;
        std::uint32_t lanes = 0;
        for (std::size_t i = 0; i < k_window_edges; i += hn::Lanes(d)) {
            const auto a = is_set(a_low_, a_high_, hn::Load(d, edges.byte_a.data() + i),
                                  hn::Load(d, edges.bit_a.data() + i));
            const auto b = is_set(b_low_, b_high_, hn::Load(d, edges.byte_b.data() + i),
                                  hn::Load(d, edges.bit_b.data() + i));
            std::uint8_t differ[8] = {};
            hn::StoreMaskBits(d, hn::Ne(a, b), differ);
            std::uint32_t bits = 0;
            std::memcpy(&bits, differ, sizeof(bits));
            lanes |= bits << i;
        }
        return lanes;
    }

private:
    using Bytes = hn::CappedTag<std::uint8_t, k_window_edges>;
    using Vector = hn::Vec<Bytes>;

    // Looking up a byte from 128 on gives 0.
    static HWY_INLINE Vector is_set(Vector low, Vector high, Vector byte, Vector bit) {
        const Bytes d;
        const auto found = hn::Or(hn::TableLookupBytesOr0(low, byte),
                                  hn::TableLookupBytesOr0(high, hn::Xor(byte, hn::Set(d, 0x80))));
        return hn::VecFromMask(d, hn::Eq(hn::And(found, bit), bit));
    }

    Vector a_low_, a_high_, b_low_, b_high_;
};
#endif

// In two steps, without branches on bits, which nothing predicts.
EdgeId* FindWindowEdges(const WindowedEdges& windowed, std::span<const std::uint16_t> bits,
                        std::span<const WindowSides> sides, std::span<FoundEdges> found,
                        EdgeId* out) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(bits.data());
    std::size_t count = 0;
    for (const WindowPair& pair : windowed.pairs) {
        const WindowSides side = sides[pair.window_a];
        if (side == sides[pair.window_b] && side != WindowSides::both) continue;
        const Lookup lookup(bytes + pair.window_a * k_window_bytes,
                            bytes + pair.window_b * k_window_bytes);
        for (std::uint32_t g = pair.first; g < pair.last; ++g) {
            found[count] = {g, lookup.differ(windowed.groups[g])};
            count += found[count].lanes != 0;
        }
    }
    using Numbers = hn::CappedTag<std::uint32_t, k_max_lanes>;
    const Numbers d;
    for (std::size_t i = 0; i < count; ++i) {
        const auto* const ids = reinterpret_cast<const std::uint32_t*>(
            windowed.ids.data() + std::size_t{found[i].group} * k_window_edges);
        for (std::size_t lane = 0; lane < k_window_edges; lane += hn::Lanes(d)) {
            const std::uint32_t lanes = found[i].lanes >> lane & ((1u << hn::Lanes(d)) - 1);
            const auto kept = squeezed(d, hn::LoadU(d, ids + lane), squeezed_lanes(d, lanes));
            hn::StoreU(kept, d, reinterpret_cast<std::uint32_t*>(out));
            out += hwy::PopCount(std::uint64_t{lanes});
        }
    }
    return out;
}

}  // namespace rimline::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rimline::kernels {

HWY_EXPORT(FindSides);
HWY_EXPORT(FindWindowEdges);

void find_sides(std::span<const std::uint16_t> bits, std::span<WindowSides> sides) {
    HWY_DYNAMIC_DISPATCH(FindSides)(bits, sides);
}

EdgeId* find_window_edges(const WindowedEdges& windowed, std::span<const std::uint16_t> bits,
                          std::span<const WindowSides> sides, std::span<FoundEdges> found,
                          EdgeId* out) {
    return HWY_DYNAMIC_DISPATCH(FindWindowEdges)(windowed, bits, sides, found, out);
}

}  // namespace rimline::kernels
#endif  // HWY_ONCE
