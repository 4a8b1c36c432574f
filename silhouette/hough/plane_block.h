#pragma once

// Sixteen planes in 128 bytes, as 16-bit steps from a common center.
//
// With q = p - w*O a face's real value is X = n·p - w*d = n·q - w*dO. Call N = (n, dO/D) and
// Q = (q, -w*D) with a length D no less than any |dO|, so that X = N·Q. A block keeps a center c and a
// step u, and for each plane the integers k = round((N - c)/u), |k_i| <= 16383. Of the point, S*Q is
// rounded to integers W, with S such that |S*Q| <= 32000. Then
//
//     S*X/u  =  T + k·W + E          T = S*(c·Q)/u, once a block,      k·W exact in 32 bits
//
// Two multiplications and three additions give eight values, from half the memory of floats. The speed of the
// index is bounded by what it reads. Bounds of the parts of E:
//   k's rounding   |N_i - (c_i + u*k_i)| <= 0.501u, and |S*Q|_1 <= 2*32000      0.501 * 64000 = 32064
//   W's rounding   |W_i - S*Q_i| <= 0.51, and |k|_1 <= 4*16383                  0.51 * 65532  = 33422
//   T in float     c·W exact, c·(S*Q - W) with S*Q - W in steps of 2^-15:
//                  |c|_1 * 2^-16/u, and four roundings of |c||S*Q|/u <= 64000/u    0.0154/u
//   T to integer   1
// The face bit itself is that of X wherever |X| > 3.1*2^-24*|p| (v_sphere.h). So the sign of T + k·W is
// the face bit wherever
//
//     |T + k·W|  >=  k_block_margin + spread/u,     spread = S*3.25*2^-24*|p| + 0.0305
//
// and elsewhere is_front decides from the mesh's own plane: for about one in two hundred of the blocks that a
// v-sphere intersects. T is clamped to ±1.09e9 and |k·W| <= 2*16383*32002 < 1.05e9, so nothing overflows and
// clamping changes no sign. The margin is clamped above |T + k·W| < 2.14e9, where nothing is certain. A step
// is at least 2^-20. So for planes that coincide, the range without decision is below the resolution of
// float. Centers have steps of 2^-14 (block_tree.h).
//
// Negated planes can be stored too: -X changes sign where X does.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "silhouette/hough/block_scratch.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/plane.h"

namespace rimline {

constexpr float k_block_margin = 65536.0f;
constexpr float k_block_threshold_limit = 1.09e9f;
/// The maximum float below 2^31. It is above any |T + k·W|, so with this margin nothing is certain.
constexpr float k_block_max_margin = 2147483520.0f;

/// Two pairs of components for each plane. One instruction multiplies and adds a pair; pairs of all planes
/// lie together.
struct alignas(64) PlaneBlock {
    std::array<std::int16_t, 2 * k_block_size> normal_xy;
    std::array<std::int16_t, 2 * k_block_size> normal_z_distance;
};
static_assert(sizeof(PlaneBlock) == 128);

/// A plane (n, dO/D).
using PlaneVector = std::array<double, 4>;

/// A box of planes, empty until something is included.
struct BlockBounds {
    PlaneVector low{1e300, 1e300, 1e300, 1e300};
    PlaneVector high{-1e300, -1e300, -1e300, -1e300};

    void include(const PlaneVector& plane) noexcept { include({plane, plane}); }
    void include(const BlockBounds& other) noexcept {
        for (std::size_t i = 0; i < low.size(); ++i) {
            low[i] = std::min(low[i], other.low[i]);
            high[i] = std::max(high[i], other.high[i]);
        }
    }
    bool is_empty() const noexcept { return !(low[0] <= high[0]); }
    /// The box of the negated planes.
    BlockBounds turned() const noexcept {
        BlockBounds turned;
        for (std::size_t i = 0; i < low.size(); ++i) {
            turned.low[i] = -high[i];
            turned.high[i] = -low[i];
        }
        return turned;
    }
};

constexpr double k_center_step = 0x1p-14;
constexpr float k_residue_step = 0x1p-15f;
/// The center of some planes, and their step.
struct BlockFrame {
    /// The smallest frame of the planes in `bounds`, which may be empty.
    explicit BlockFrame(const BlockBounds& bounds) noexcept;
    /// Writes a plane that the frame contains.
    void encode(const PlaneVector& plane, std::uint32_t lane, PlaneBlock& block) const noexcept;

    std::array<float, 4> center{};  ///< In steps of k_center_step.
    /// The maximum distance of a plane from the center along an axis.
    std::array<double, 4> extent{};
    float step_inverse = 0x1p20f;  ///< 1/u, a power of two.
};

/// A silhouette point, prepared for blocks relative to one origin.
struct BlockPoint {
    /// `length` is D.
    BlockPoint(const HomogeneousPoint& point, const glm::dvec3& origin, double length) noexcept;

    std::array<std::int16_t, 4> weights;   ///< W.
    std::array<std::int16_t, 4> residues;  ///< S*Q - W in steps of k_residue_step.
    float spread;                          ///< See above.
    std::int32_t box_margin;               ///< See block_tree.h.
};

}  // namespace rimline
