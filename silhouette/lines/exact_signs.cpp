#include "silhouette/lines/exact_signs.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/lines/exact_sum.h"

namespace rimline {

namespace {

// Adds s * det(a, b, c): products of two floats are exact.
void add_determinant(ExactSum& sum, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                     double s) {
    sum.add_product(s * (b.y * c.z), a.x);
    sum.add_product(-s * (b.z * c.y), a.x);
    sum.add_product(s * (b.z * c.x), a.y);
    sum.add_product(-s * (b.x * c.z), a.y);
    sum.add_product(s * (b.x * c.y), a.z);
    sum.add_product(-s * (b.y * c.x), a.z);
}

// ((b - a) x (c - a)) · (p - a) = det(a, b, p) + det(b, c, p) + det(c, a, p) - det(a, b, c).
ExactSum exact_plane_height(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                            const glm::dvec3& p) {
    ExactSum sum;
    add_determinant(sum, a, b, p, 1.0);
    add_determinant(sum, b, c, p, 1.0);
    add_determinant(sum, c, a, p, 1.0);
    add_determinant(sum, a, b, c, -1.0);
    return sum;
}

int exact_direction_side(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                         const glm::dvec3& direction) {
    ExactSum sum;
    add_determinant(sum, a, b, direction, 1.0);
    add_determinant(sum, b, c, direction, 1.0);
    add_determinant(sum, c, a, direction, 1.0);
    return sum.sign();
}

// (by - ay)(cz - az) - (bz - az)(cy - ay), for two of three coordinates.
int minor_sign(double ay, double az, double by, double bz, double cy, double cz) {
    if (const int sign = certain_turn({ay, az}, {by, bz}, {cy, cz})) return sign;
    ExactSum sum;
    sum.add(by * cz);
    sum.add(-by * az);
    sum.add(-ay * cz);
    sum.add(-bz * cy);
    sum.add(bz * ay);
    sum.add(az * cy);
    return sum.sign();
}

// (u x v) · w, and a bound of its error: Shewchuk's of orient3d, rounded up. It holds for vectors that are differences of
// two floats, each rounded once.
struct Volume {
    Volume(const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& w) {
        const double yz = u.y * v.z, zy = u.z * v.y;
        const double zx = u.z * v.x, xz = u.x * v.z;
        const double xy = u.x * v.y, yx = u.y * v.x;
        value = w.x * (yz - zy) + w.y * (zx - xz) + w.z * (xy - yx);
        error = 8e-16 * ((std::abs(yz) + std::abs(zy)) * std::abs(w.x) +
                         (std::abs(zx) + std::abs(xz)) * std::abs(w.y) +
                         (std::abs(xy) + std::abs(yx)) * std::abs(w.z));
    }
    // 0 where double does not decide it.
    int sign() const { return value > error ? 1 : (-value > error ? -1 : 0); }

    double value, error;
};

}  // namespace

int plane_side(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
               const glm::vec3& p) noexcept {
    const glm::dvec3 from(a);
    const int sign =
        Volume(glm::dvec3(b) - from, glm::dvec3(c) - from, glm::dvec3(p) - from).sign();
    return sign != 0 ? sign : exact_plane_height(a, b, c, p).sign();
}

double plane_height(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                    const glm::vec3& p) noexcept {
    const glm::dvec3 from(a);
    const Volume volume(glm::dvec3(b) - from, glm::dvec3(c) - from, glm::dvec3(p) - from);
    constexpr double k_least_errors = 0x1p20;
    return std::abs(volume.value) > k_least_errors * volume.error
               ? volume.value
               : exact_plane_height(a, b, c, p).value();
}

int first_normal_sign(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) noexcept {
    if (const int x = minor_sign(a.y, a.z, b.y, b.z, c.y, c.z)) return x;
    if (const int y = minor_sign(a.z, a.x, b.z, b.x, c.z, c.x)) return y;
    return minor_sign(a.x, a.y, b.x, b.y, c.x, c.y);
}

int seen_side(const HomogeneousPoint& eye, const glm::vec3& a, const glm::vec3& b,
              const glm::vec3& c) noexcept {
    const glm::dvec3 from(a);
    const glm::dvec3 towards =
        eye.is_direction() ? glm::dvec3(eye.xyz()) : glm::dvec3(eye.xyz()) - from;
    int sign = Volume(glm::dvec3(b) - from, glm::dvec3(c) - from, towards).sign();
    if (sign == 0)
        sign = eye.is_direction() ? exact_direction_side(a, b, c, eye.xyz())
                                  : exact_plane_height(a, b, c, eye.xyz()).sign();
    return sign != 0 ? sign : first_normal_sign(a, b, c);
}

int flat_turn(int drop, const glm::vec3& p, const glm::vec3& q, const glm::vec3& r) noexcept {
    const int x = (drop + 1) % 3, y = (drop + 2) % 3;
    return minor_sign(p[x], p[y], q[x], q[y], r[x], r[y]);
}

}  // namespace rimline
