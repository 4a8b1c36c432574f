#include "silhouette/lines/contact_places.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "silhouette/lines/exact_signs.h"
#include "silhouette/lines/exact_sum.h"

namespace rimline {

namespace {

// A component of (b - a) x (d - c), from the two other coordinates. Products of two floats are exact in double.
double minor(double a_0, double a_1, double b_0, double b_1, double c_0, double c_1, double d_0,
             double d_1) {
    ExactSum sum;
    for (const auto& [x, y, sign] : {std::array{b_0, b_1, 1.0}, std::array{a_0, a_1, -1.0}}) {
        sum.add(sign * (x * d_1));
        sum.add(-sign * (x * c_1));
        sum.add(-sign * (y * d_0));
        sum.add(sign * (y * c_0));
    }
    return sum.value();
}

}  // namespace

double share_to_plane(const glm::vec3& a, const glm::vec3& b, const glm::vec3& p,
                      const glm::vec3& q, const glm::vec3& r) noexcept {
    const double before = plane_height(p, q, r, a), after = plane_height(p, q, r, b);
    return before / (before - after);
}

double share_to_crossing(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                         const glm::vec3& d) noexcept {
    // Seen along an axis, the way from `a` to the crossing is to that from `a` to `b` as two areas. All axes give the
    // same; the largest areas do not get lost among numbers that are subnormal.
    double part = 0.0, whole = 0.0;
    for (int x = 0; x < 3; ++x) {
        const int y = (x + 1) % 3;
        const double area = minor(a[x], a[y], b[x], b[y], c[x], c[y], d[x], d[y]);
        if (std::abs(area) <= std::abs(whole)) continue;
        whole = area;
        part = minor(a[x], a[y], c[x], c[y], c[x], c[y], d[x], d[y]);
    }
    return whole == 0.0 ? 0.5 : std::clamp(part / whole, 0.0, 1.0);
}

}  // namespace rimline
