// Moves the selected lanes of a vector to its front. For sources that Highway compiles once for each
// instruction set: vector_targets-inl.h includes it after Highway's own header.
//
// Highway's Compress does the same, but gcc 12 copies its table to the stack at every call. That took two
// thirds of the time of the loops that use this.

#ifndef RIMLINE_SQUEEZED_LANES_TABLE
#define RIMLINE_SQUEEZED_LANES_TABLE

#include <array>
#include <cstddef>
#include <cstdint>

namespace rimline::kernels {

constexpr std::size_t k_max_lanes = 8;

// For each byte the numbers of its set bits, ascending, then zeros.
using SetBits = std::array<std::array<std::uint8_t, k_max_lanes>, 1u << k_max_lanes>;
constexpr SetBits make_set_bits() {
    SetBits table{};
    for (std::size_t bits = 0; bits < table.size(); ++bits) {
        std::size_t count = 0;
        for (std::uint8_t i = 0; i < k_max_lanes; ++i)
            if (bits >> i & 1u) table[bits][count++] = i;
    }
    return table;
}
alignas(64) inline constexpr SetBits k_set_bits = make_set_bits();

}  // namespace rimline::kernels
#endif

#if defined(RIMLINE_SQUEEZED_LANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef RIMLINE_SQUEEZED_LANES_INL
#undef RIMLINE_SQUEEZED_LANES_INL
#else
#define RIMLINE_SQUEEZED_LANES_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace rimline::kernels::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The mask as bits: bit i is lane i.
template <class D, class M>
HWY_INLINE std::uint32_t lanes_of(D d, M mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    std::uint32_t lanes = bits[0];
    if constexpr (hn::MaxLanes(D()) > 8) lanes |= std::uint32_t{bits[1]} << 8;
    if constexpr (hn::MaxLanes(D()) > 16)
        lanes |= std::uint32_t{bits[2]} << 16 | std::uint32_t{bits[3]} << 24;
    return lanes;
}

// The numbers of the lanes in `lanes`, ascending: the table for squeezed().
template <class DU>
HWY_INLINE hn::Vec<DU> squeezed_lanes(DU du, std::uint32_t lanes) {
    const hn::Rebind<std::uint8_t, DU> d8;
    return hn::PromoteTo(du, hn::LoadU(d8, k_set_bits[lanes].data()));
}

template <class D, class VU>
HWY_INLINE hn::Vec<D> squeezed(D d, hn::Vec<D> vector, VU lanes) {
    return hn::TableLookupLanes(vector, hn::IndicesFromVec(d, lanes));
}

}  // namespace rimline::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
