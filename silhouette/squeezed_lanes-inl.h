// Vectors whose unwanted lanes are squeezed out, for what is compiled once for each instruction set: include
// it after hwy/highway.h.
//
// Highway's own Compress would do, but gcc 12 copies its table to the stack at every call, which took two
// thirds of all the time spent in the loops that use this.

#ifndef RIMLINE_SQUEEZED_LANES_TABLE
#define RIMLINE_SQUEEZED_LANES_TABLE

#include <array>
#include <cstddef>
#include <cstdint>

namespace rimline::kernels {

constexpr std::size_t k_max_lanes = 8;

// The numbers of the set bits, in order, then zeros.
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

// Bit i is lane i.
template <class D, class M>
HWY_INLINE std::uint32_t lanes_of(D d, M mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return bits[0];
}

// Which lanes stay when those not in `lanes` are squeezed out.
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
