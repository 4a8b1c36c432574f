#include "tests/silhouette/exact/exact_numbers.h"

#include <cmath>
#include <cstddef>

namespace rimline::tests {

namespace {

mpq_class power_of_two(int exponent) {
    mpz_class power = 1;
    power <<= static_cast<unsigned>(std::abs(exponent));
    return exponent >= 0 ? mpq_class(power) : mpq_class(1, power);
}

mpz_class floor_of(const mpq_class& value) {
    mpz_class quotient;
    mpz_fdiv_q(quotient.get_mpz_t(), value.get_num_mpz_t(), value.get_den_mpz_t());
    return quotient;
}

// The greatest e with 2^e <= value, which is positive.
int exponent_of(const mpq_class& value) {
    int e = static_cast<int>(mpz_sizeinbase(value.get_num_mpz_t(), 2)) -
            static_cast<int>(mpz_sizeinbase(value.get_den_mpz_t(), 2));
    if (power_of_two(e) > value) --e;
    return e;
}

using RationalVector = std::array<mpq_class, 3>;

RationalVector rational(const glm::vec3& p) {
    return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
}

RationalVector minus(const RationalVector& a, const RationalVector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

RationalVector cross(const RationalVector& a, const RationalVector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpq_class dot(const RationalVector& a, const RationalVector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

WholePoint cross(const WholePoint& a, const WholePoint& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

mpz_class dot(const WholePoint& a, const WholePoint& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

mpq_class dot_of_sizes(const RationalVector& a, const RationalVector& b) {
    return abs(a[0] * b[0]) + abs(a[1] * b[1]) + abs(a[2] * b[2]);
}

mpq_class size_of(const RationalVector& a) { return abs(a[0]) + abs(a[1]) + abs(a[2]); }

mpq_class in_double(const mpq_class& value) { return rounded_to_double(value); }

RationalVector difference_in_double(const RationalVector& a, const RationalVector& b) {
    return {in_double(a[0] - b[0]), in_double(a[1] - b[1]), in_double(a[2] - b[2])};
}

mpq_class dot_in_double(const RationalVector& a, const RationalVector& b) {
    return in_double(in_double(in_double(a[0] * b[0]) + in_double(a[1] * b[1])) +
                     in_double(a[2] * b[2]));
}

mpq_class snapped_to_float(const mpq_class& value, const mpq_class& smallest) {
    return abs(value) < smallest ? mpq_class(0) : rounded_to_float(value);
}

}  // namespace

mpq_class rounded(const mpq_class& value, int bits, int least_exponent) {
    if (value == 0) return 0;
    const mpq_class size = abs(value);
    const mpq_class unit = power_of_two(std::max(exponent_of(size) - bits + 1, least_exponent));
    const mpq_class units = size / unit;
    mpz_class whole_units = floor_of(units);
    const mpq_class rest = units - whole_units;
    const mpq_class half(1, 2);
    if (rest > half || (rest == half && mpz_odd_p(whole_units.get_mpz_t()))) ++whole_units;
    const mpq_class result = whole_units * unit;
    return value < 0 ? mpq_class(-result) : result;
}

mpq_class rounded_root(const mpq_class& value) {
    if (value == 0) return 0;
    // So many digits that a half more than the whole root rounds as everything between it and the next one does.
    int shift = 80 - exponent_of(value) / 2;
    const mpq_class scaled = value * power_of_two(2 * shift);
    const mpz_class whole_part = floor_of(scaled);
    const mpz_class root = sqrt(whole_part);
    const bool is_exact = scaled == whole_part && root * root == whole_part;
    const mpq_class result = is_exact ? mpq_class(root) : mpq_class(root) + mpq_class(1, 2);
    return rounded_to_double(result * power_of_two(-shift));
}

RoundedPlane rounded_plane(const FloatCorners& corners) {
    const RationalVector v0 = rational(corners[0]);
    const RationalVector a = difference_in_double(rational(corners[1]), v0);
    const RationalVector b = difference_in_double(rational(corners[2]), v0);
    const auto product = [](const mpq_class& x, const mpq_class& y) { return in_double(x * y); };
    const RationalVector n{in_double(product(a[1], b[2]) - product(b[1], a[2])),
                           in_double(product(a[2], b[0]) - product(b[2], a[0])),
                           in_double(product(a[0], b[1]) - product(b[0], a[1]))};
    const mpq_class length = rounded_root(dot_in_double(n, n));
    RoundedPlane plane;
    if (length == 0) return plane;
    RationalVector unit;
    for (std::size_t i = 0; i < 3; ++i) {
        unit[i] = in_double(n[i] / length);
        plane.normal[i] = snapped_to_float(unit[i], power_of_two(-40));
    }
    plane.distance = snapped_to_float(dot_in_double(unit, v0), power_of_two(-126));
    return plane;
}

bool rounded_bit(const RoundedPlane& plane, const HomogeneousPoint& point) {
    const RationalVector p = rational(point.xyz());
    const auto product = [&](std::size_t i) { return rounded_to_float(plane.normal[i] * p[i]); };
    const mpq_class sum = rounded_to_float(rounded_to_float(product(0) + product(1)) + product(2));
    return sum > rounded_to_float(mpq_class(point.w) * plane.distance);
}

int exact_side(const FloatCorners& corners, const HomogeneousPoint& point) {
    const RationalVector v0 = rational(corners[0]);
    const RationalVector n =
        cross(minus(rational(corners[1]), v0), minus(rational(corners[2]), v0));
    const RationalVector p = rational(point.xyz());
    return sgn(mpq_class(dot(n, p) - (point.is_direction() ? mpq_class(0) : dot(n, v0))));
}

bool is_within_rounding(const FloatCorners& corners, const HomogeneousPoint& point) {
    const RationalVector v0 = rational(corners[0]);
    const RationalVector a = minus(rational(corners[1]), v0), b = minus(rational(corners[2]), v0);
    const RationalVector n = cross(a, b), p = rational(point.xyz());
    const mpq_class w(point.w);
    const mpq_class distance = abs(dot(n, p) - w * dot(n, v0));
    const mpq_class reach = size_of(p) + w * size_of(v0);
    // The normal's and the distance's roundings to float, the products' and the sums'; components that are too small
    // for a normal; and the cross product, whose error is relative to its factors, not to itself.
    const mpq_class bound = power_of_two(-21) * (dot_of_sizes(n, p) + w * abs(dot(n, v0))) +
                            power_of_two(-39) * size_of(n) * size_of(p) +
                            power_of_two(-49) * size_of(a) * size_of(b) * reach +
                            power_of_two(-50) * w * dot_of_sizes(n, v0) +
                            power_of_two(-125) * size_of(n);
    return distance <= bound;
}

WholePoint whole(const glm::dvec3& p) {
    const auto whole_of = [](double value) {
        int exponent = 0;
        mpz_class result(std::ldexp(std::frexp(value, &exponent), 53));
        const int shift = exponent - 53 - k_unit;
        if (shift >= 0)
            result <<= static_cast<unsigned>(shift);
        else
            result >>= static_cast<unsigned>(-shift);  // Zeros: p is a multiple of the unit.
        return result;
    };
    return {whole_of(p.x), whole_of(p.y), whole_of(p.z)};
}

WholePoint point_between(const WholePoint& a, const WholePoint& b, double share) {
    const mpz_class parts(std::nearbyint(std::ldexp(share, 40)));
    const auto between = [&](const mpz_class& from, const mpz_class& to) {
        // Exact: the coordinates are multiples of 2^-149.
        return mpz_class(from + (((to - from) * parts) >> 40));
    };
    return {between(a.x, b.x), between(a.y, b.y), between(a.z, b.z)};
}

WholeSpacePoint space_point(const HomogeneousPoint& p) {
    return {whole(p.xyz()), p.is_direction()};
}

int orientation(const WholeSpacePoint& a, const WholeSpacePoint& b, const WholeSpacePoint& c,
                const WholeSpacePoint& d) {
    // Developed by the column of ones and zeros.
    mpz_class sum = 0;
    const auto volume = [](const WholeSpacePoint& p, const WholeSpacePoint& q,
                           const WholeSpacePoint& r) {
        return mpz_class(dot(p.place, cross(q.place, r.place)));
    };
    if (!a.is_direction) sum += volume(b, c, d);
    if (!b.is_direction) sum -= volume(a, c, d);
    if (!c.is_direction) sum += volume(a, b, d);
    if (!d.is_direction) sum -= volume(a, b, c);
    return sgn(sum);
}

std::optional<int> crossing(const WholeSpacePoint& x, const WholeSpacePoint& y,
                            const SpaceTriangle& t) {
    const int at_x = orientation(t[0], t[1], t[2], x), at_y = orientation(t[0], t[1], t[2], y);
    if (at_x * at_y > 0) return 0;
    int sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        const int side = orientation(x, y, t[c], t[(c + 1) % 3]);
        if (side == 0) return std::nullopt;
        sum += side;
    }
    if (sum != 3 && sum != -3) return 0;
    if (at_x == 0 || at_y == 0) return std::nullopt;
    return at_x;
}

int WholeEye::side(const WholePoint& a, const WholePoint& b, const WholePoint& c) const {
    const WholePoint u = b - a, v = c - a;
    const WholePoint normal = cross(u, v);
    const int at_place = sgn(mpz_class(dot(normal, is_direction ? place : place - a)));
    if (at_place != 0) return at_place;
    // The determinant's polynomial in e: its coefficients are those of the normal.
    for (const mpz_class* coefficient : {&normal.x, &normal.y, &normal.z})
        if (*coefficient != 0) return sgn(*coefficient);
    return 0;
}

void WholeFaces::add(const std::array<WholePoint, 3>& corners) {
    const auto& [a, b, c] = corners;
    const int side_of_eye = eye_.side(a, b, c);
    if (side_of_eye == 0) return;  // It has no area.
    const WholePoint normal = cross(b - a, c - a);
    faces_.push_back({corners, normal, dot(normal, a), side_of_eye});
}

std::uint32_t WholeFaces::count_before(const WholePoint& x) const {
    std::uint32_t count = 0;
    for (const Face& face : faces_) {
        if (sgn(mpz_class(dot(face.normal, x) - face.distance)) != -face.side_of_eye) continue;
        // No side is 0: x would lie on the plane.
        bool is_inside = true;
        for (std::size_t c = 0; c < 3 && is_inside; ++c)
            is_inside =
                eye_.side(x, face.corners[c], face.corners[(c + 1) % 3]) == face.side_of_eye;
        count += is_inside ? 1 : 0;
    }
    return count;
}

}  // namespace rimline::tests
