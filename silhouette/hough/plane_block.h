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
//   T in float     at most ten roundings of S*|c||Q|/u <= 1.5*32000/u           10 * 2^-24 * 48000/u
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
// float.
//
// A block that no box decides may be decided by T alone: |k·W| <= |k| * 32002, so where
// |T| >= max |k| * 32002 + margin all its planes have the sign of T. This does not need the origin, and
// decides planes that contain it.
//
// Negated planes can be stored too: -X changes sign where X does.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "silhouette/hough/block_scratch.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/plane.h"

namespace rimline {

constexpr float k_block_margin = 65536.0f;
constexpr float k_block_weight_length = 32002.0f;  ///< Upper bound of |W|.
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

/// The center of some planes, and their step.
struct BlockFrame {
    std::array<float, 4> center;
    float step_inverse;  ///< 1/u, a power of two.

    /// The smallest frame that contains all `planes`. There may be none.
    static BlockFrame around(std::span<const PlaneVector> planes) noexcept;
    /// Writes a plane that the frame contains. Returns the square of the length of its k.
    std::int32_t encode(const PlaneVector& plane, std::uint32_t lane,
                        PlaneBlock& block) const noexcept;
};

/// A silhouette point, prepared for blocks relative to one origin.
struct BlockPoint {
    /// `length` is D.
    BlockPoint(const HomogeneousPoint& point, const glm::dvec3& origin, double length) noexcept;

    std::array<float, 4> scaled;          ///< S*Q.
    std::array<std::int16_t, 4> weights;  ///< W.
    float spread;                         ///< See above.
};

}  // namespace rimline
