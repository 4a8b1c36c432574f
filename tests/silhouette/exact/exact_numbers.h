#pragma once

// The definitions of silhouettes, in exact arithmetic (GMP). The oracle of these tests: it shares nothing with the
// library but positions, triangles and points.
//
// Two kinds of numbers. Rationals, which are rounded where plane.h says that floats and doubles are. And whole numbers
// in units of k_unit, of which every float is a multiple: enough for signs, and ten times faster.

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "silhouette/mesh/homogeneous_point.h"

namespace rimline::tests {

using FloatCorners = std::array<glm::vec3, 3>;

/// The nearest number of `bits` binary digits that is a multiple of 2^least_exponent; of two, the even one.
mpq_class rounded(const mpq_class& value, int bits, int least_exponent);
inline mpq_class rounded_to_float(const mpq_class& value) { return rounded(value, 24, -149); }
inline mpq_class rounded_to_double(const mpq_class& value) { return rounded(value, 53, -1074); }
/// `value` must not be negative.
mpq_class rounded_root(const mpq_class& value);

/// The supporting plane as plane.h defines it: every operation rounded to double, its results to float.
struct RoundedPlane {
    std::array<mpq_class, 3> normal;
    mpq_class distance;
};
RoundedPlane rounded_plane(const FloatCorners& corners);
/// The face bit of a plane, every operation rounded to float.
bool rounded_bit(const RoundedPlane& plane, const HomogeneousPoint& point);

/// 1 where `point` lies on the outer side of the plane through the corners, -1 inside, 0 on it: not rounded.
int exact_side(const FloatCorners& corners, const HomogeneousPoint& point);
/// Whether the point lies so near to the plane that the roundings of plane.h may give the other side.
bool is_within_rounding(const FloatCorners& corners, const HomogeneousPoint& point);

struct WholePoint {
    mpz_class x, y, z;
    friend WholePoint operator-(const WholePoint& a, const WholePoint& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
};

/// In units of 2^-190: every float, every double of at least 2^-137, and every point between two floats at a share that
/// is a multiple of 2^-40.
constexpr int k_unit = -190;
WholePoint whole(const glm::dvec3& p);
/// The point at this share of the way from a to b. `share` is rounded to a multiple of 2^-40.
WholePoint point_between(const WholePoint& a, const WholePoint& b, double share);

/// A point of space (x, y, z, 1), or one at infinity, in a direction (x, y, z, 0).
struct WholeSpacePoint {
    WholePoint place;
    bool is_direction;
};
WholeSpacePoint space_point(const HomogeneousPoint& p);
/// Of points of space, the sign of ((b - a) x (c - a)) · (d - a); of others, its limit.
int orientation(const WholeSpacePoint& a, const WholeSpacePoint& b, const WholeSpacePoint& c,
                const WholeSpacePoint& d);

using SpaceTriangle = std::array<WholeSpacePoint, 3>;
/// 1 where the way from x to y leaves a triangle's outer side, -1 where it comes to it, 0 where it passes beside it.
/// Empty where it touches a side or ends on the triangle.
std::optional<int> crossing(const WholeSpacePoint& x, const WholeSpacePoint& y,
                            const SpaceTriangle& triangle);

/// A viewpoint or a direction that is moved by (e, e^2, e^3), with an e smaller than any number (exact_signs.h).
struct WholeEye {
    WholePoint place;
    bool is_direction;

    explicit WholeEye(const HomogeneousPoint& p)
        : place(whole(p.xyz())), is_direction(p.is_direction()) {}
    /// 1 where it sees a, b, c counter-clockwise. 0 only where the three lie on one line.
    int side(const WholePoint& a, const WholePoint& b, const WholePoint& c) const;
};

/// The triangles of a mesh as an eye sees them. The eye must outlive it.
class WholeFaces {
public:
    explicit WholeFaces(const WholeEye& eye) : eye_(eye) {}
    void add(const std::array<WholePoint, 3>& corners);
    /// How many lie strictly between `x` and the eye.
    std::uint32_t count_before(const WholePoint& x) const;

private:
    struct Face {
        std::array<WholePoint, 3> corners;
        WholePoint normal;
        mpz_class distance;
        int side_of_eye;
    };
    const WholeEye& eye_;
    std::vector<Face> faces_;
};

}  // namespace rimline::tests
