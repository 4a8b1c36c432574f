#include "silhouette/points/neighborhood.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/mesh/any_perpendicular.h"

namespace rimline {

namespace {

// Directions are rounded to multiples of it.
constexpr double k_same_angle = 0x1p-30;

// A monotonic function of the angle, from 0 to 4. Values that round to 4 become nearly 0.
double diamond_angle(double x, double y) {
    const double t = x / (std::abs(x) + std::abs(y));
    const double angle = y >= 0.0 ? 1.0 - t : 3.0 + t;
    return angle < 4.0 - 0.5 * k_same_angle ? angle : angle - 4.0;
}

// The image of a neighbor under the inversion.
struct Image {
    double angle, x, y;
    std::uint8_t place;
};

// Sorts by angle. In one direction the nearer neighbor comes first, for places are ordered by distance.
constexpr int k_place_bits = 6;
std::uint64_t sort_key(double angle, std::size_t place) {
    return static_cast<std::uint64_t>(angle / k_same_angle + 0.5) << k_place_bits | place;
}

// Whether b is no corner of the hull: a, b, c turn right, or too little to the left.
bool is_inside(const Image& a, const Image& b, const Image& c) {
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - b.x, vy = c.y - b.y;
    const double turn = ux * vy - uy * vx;
    return turn <= 0.0 ||
           turn * turn <= (k_tie * k_tie) * ((ux * ux + uy * uy) * (vx * vx + vy * vy));
}

}  // namespace

void Neighborhood::assign(std::span<const glm::dvec3> points, std::uint32_t point,
                          std::span<const std::uint32_t> list) {
    list_ = list;
    size_ = static_cast<std::uint32_t>(list.size());
    for (std::uint32_t i = 0; i < size_; ++i) {
        edges_[i] = points[list[i]] - points[point];
        lengths_[i] = glm::length(edges_[i]);
    }
}

bool Neighborhood::is_collinear() const noexcept {
    for (std::uint32_t i = 1; i < size_; ++i)
        if (glm::length(glm::cross(edges_[0], edges_[i])) > k_tie * lengths_[0] * lengths_[i])
            return false;
    return true;
}

glm::dvec3 Neighborhood::fitted_normal(std::uint32_t count) const noexcept {
    count = std::min(count, size_);
    glm::dvec3 mean(0.0);
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    const double unit = count == 0 ? 1.0 : 1.0 / lengths_[count - 1];
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 d = edges_[i] * unit;
        mean += d;
        xx += d.x * d.x, xy += d.x * d.y, xz += d.x * d.z;
        yy += d.y * d.y, yz += d.y * d.z, zz += d.z * d.z;
    }
    const double weight = 1.0 / (count + 1.0);
    xx -= weight * mean.x * mean.x, xy -= weight * mean.x * mean.y, xz -= weight * mean.x * mean.z;
    yy -= weight * mean.y * mean.y, yz -= weight * mean.y * mean.z, zz -= weight * mean.z * mean.z;
    // The minimum eigenvalue by the trigonometric solution of the cubic (Smith 1961). Its vector is the
    // longest cross product of two rows of the matrix minus the eigenvalue.
    const double q = (xx + yy + zz) / 3.0;
    const double p2 = (xx - q) * (xx - q) + (yy - q) * (yy - q) + (zz - q) * (zz - q) +
                      2.0 * (xy * xy + xz * xz + yz * yz);
    const double p = std::sqrt(p2 / 6.0);
    if (!(p > 0.0)) return glm::dvec3(0.0);
    const double a = (xx - q) / p, b = (yy - q) / p, c = (zz - q) / p;
    const double d = xy / p, e = xz / p, f = yz / p;
    const double half_determinant =
        0.5 * (a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e));
    const double angle = std::acos(std::clamp(half_determinant, -1.0, 1.0)) / 3.0;
    const double min_eigenvalue = q + 2.0 * p * std::cos(angle + 2.0 * std::numbers::pi / 3.0);
    const glm::dvec3 rows[3] = {{xx - min_eigenvalue, xy, xz},
                                {xy, yy - min_eigenvalue, yz},
                                {xz, yz, zz - min_eigenvalue}};
    glm::dvec3 best(0.0);
    double longest = 0.0;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 product = glm::cross(rows[i], rows[(i + 1) % 3]);
        const double square = glm::dot(product, product);
        if (square > longest) longest = square, best = product;
    }
    return longest > 0.0 ? best / std::sqrt(longest) : glm::dvec3(0.0);
}

Fan Neighborhood::star(const glm::dvec3& normal, double sine_of_angle,
                       std::uint64_t among) const noexcept {
    const glm::dvec3 u = any_perpendicular(normal);
    const glm::dvec3 v = glm::cross(normal, u);
    std::array<Image, k_max_neighbors> by_place;
    std::array<std::uint64_t, k_max_neighbors> keys;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < size_; ++i) {
        const glm::dvec3& d = edges_[i];
        if ((among >> i & 1u) == 0) continue;
        if (std::abs(glm::dot(d, normal)) > sine_of_angle * lengths_[i]) continue;
        const double x = glm::dot(d, u), y = glm::dot(d, v);
        const double projected = std::sqrt(x * x + y * y);
        if (!(projected > 0.0)) continue;
        const double factor = 1.0 / (projected * lengths_[i]);
        by_place[i] = {diamond_angle(x, y), x * factor, y * factor, static_cast<std::uint8_t>(i)};
        const std::uint64_t key = sort_key(by_place[i].angle, i);
        std::size_t at = count++;
        for (; at > 0 && key < keys[at - 1]; --at) keys[at] = keys[at - 1];
        keys[at] = key;
    }
    // Of neighbors in one direction only the nearest can be on the hull; rounding could add others.
    const std::size_t all = count;
    count = 0;
    for (std::size_t i = 0; i < all; ++i)
        if (i == 0 || keys[i] >> k_place_bits != keys[count - 1] >> k_place_bits)
            keys[count++] = keys[i];
    Fan fan;
    if (count < 2) return fan;

    // Begins after a sector of π or more, else at the nearest neighbor, which is on the hull.
    const auto image = [&](std::size_t i) -> const Image& {
        return by_place[keys[i] & ((1u << k_place_bits) - 1)];
    };
    std::size_t begin = 0;
    bool is_open = false;
    for (std::size_t i = 0; i < count && !is_open; ++i) {
        const std::size_t next = i + 1 == count ? 0 : i + 1;
        is_open = image(next).angle + (next == 0 ? 4.0 : 0.0) - image(i).angle >= 2.0 - k_tie;
        if (is_open || image(i).place < image(begin).place) begin = is_open ? next : i;
    }
    std::rotate(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(begin),
                keys.begin() + static_cast<std::ptrdiff_t>(count));
    std::array<const Image*, k_max_neighbors + 1> hull;
    std::size_t size = 0;
    for (std::size_t i = 0; i < count + (is_open ? 0 : 1); ++i) {
        const Image& next = image(i == count ? 0 : i);
        while (size >= 2 && is_inside(*hull[size - 2], *hull[size - 1], next)) --size;
        hull[size++] = &next;
    }
    if (!is_open) --size;
    fan.size = static_cast<std::uint8_t>(size);
    for (std::size_t i = 0; i < size; ++i) fan.ring[i] = hull[i]->place;
    for (std::size_t i = 0; i + 1 < size + (is_open ? 0 : 1); ++i) {
        const double turn = hull[i + 1 == size ? 0 : i + 1]->angle - hull[i]->angle;
        if ((turn < 0.0 ? turn + 4.0 : turn) >= 2.0 - k_tie) fan.gaps |= std::uint64_t{1} << i;
    }
    if (is_open) fan.gaps |= std::uint64_t{1} << (size - 1);
    return fan;
}

glm::dvec3 Neighborhood::cross(const Fan& fan, std::size_t j) const noexcept {
    return glm::cross(edges_[fan.ring[j]], edges_[fan.ring[fan.next(j)]]);
}

double Neighborhood::circumradius(const Fan& fan, std::size_t j) const noexcept {
    const std::size_t a = fan.ring[j], b = fan.ring[fan.next(j)];
    const double twice_area = glm::length(cross(fan, j));
    if (!(twice_area > 0.0)) return std::numeric_limits<double>::infinity();
    return lengths_[a] * lengths_[b] * glm::length(edges_[b] - edges_[a]) / (2.0 * twice_area);
}

double Neighborhood::angle(const Fan& fan, std::size_t j) const noexcept {
    return angle_between(edges_[fan.ring[j]], edges_[fan.ring[fan.next(j)]]);
}

double Neighborhood::Triangle::deviation(const glm::dvec3& from) const noexcept {
    return std::acos(std::clamp(glm::dot(normal, from), -1.0, 1.0));
}

double Neighborhood::deviation(const Fan& fan, std::size_t j,
                               const glm::dvec3& normal) const noexcept {
    return triangle(fan, j).deviation(normal);
}

Neighborhood::Triangle Neighborhood::triangle(const Fan& fan, std::size_t j) const noexcept {
    const std::size_t a = fan.ring[j], b = fan.ring[fan.next(j)];
    const glm::dvec3 product = glm::cross(edges_[a], edges_[b]);
    const double twice_area = glm::length(product);
    const double cosine = glm::dot(edges_[a], edges_[b]);
    const double opposite = glm::length(edges_[b] - edges_[a]);
    const double longest = std::max({lengths_[a], lengths_[b], opposite});
    if (!(twice_area > 0.0))
        return {
            glm::dvec3(0.0), std::numeric_limits<double>::infinity(), longest, 0.0, cosine, 0.0};
    const double factor = 1.0 / twice_area;
    const double circumradius = 0.5 * factor * lengths_[a] * lengths_[b] * opposite;
    return {product * factor, circumradius, std::min(circumradius, longest),
            twice_area,       cosine,       0.0};
}

void Neighborhood::triangles(const Fan& fan, Triangles& result) const noexcept {
    for (std::size_t j = 0; j < fan.size; ++j)
        if (!fan.is_gap(j)) result[j] = triangle(fan, j);
}

void Neighborhood::set_angles(const Fan& fan, Triangles& triangles) noexcept {
    for (std::size_t j = 0; j < fan.size; ++j)
        if (!fan.is_gap(j)) triangles[j].angle = std::atan2(triangles[j].sine, triangles[j].cosine);
}

glm::dvec3 Neighborhood::normal(const Fan& fan, const Triangles& triangles) noexcept {
    glm::dvec3 sum(0.0);
    for (std::size_t j = 0; j < fan.size; ++j)
        if (!fan.is_gap(j)) sum += triangles[j].angle * triangles[j].normal;
    const double length = glm::length(sum);
    return length > 0.0 ? sum / length : glm::dvec3(0.0);
}

double Neighborhood::scale(const Fan& fan, const Triangles& triangles) noexcept {
    std::array<double, k_max_neighbors> radii;
    std::size_t count = 0;
    for (std::size_t j = 0; j < fan.size; ++j)
        if (!fan.is_gap(j)) radii[count++] = triangles[j].size;
    if (count == 0) return 0.0;
    const std::size_t median = (count - 1) / 2;
    std::nth_element(radii.begin(), radii.begin() + static_cast<std::ptrdiff_t>(median),
                     radii.begin() + static_cast<std::ptrdiff_t>(count));
    return radii[median];
}

glm::dvec3 Neighborhood::normal(const Fan& fan) const noexcept {
    Triangles all;
    triangles(fan, all);
    set_angles(fan, all);
    return normal(fan, all);
}

double Neighborhood::scale(const Fan& fan) const noexcept {
    Triangles all;
    triangles(fan, all);
    return scale(fan, all);
}

}  // namespace rimline
