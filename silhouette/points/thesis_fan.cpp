#include "silhouette/points/thesis_fan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/mesh/any_perpendicular.h"

namespace rimline {

namespace {

class FanBuilder {
public:
    FanBuilder(const Neighborhood& around, const glm::dvec3& normal, double phi)
        : around_(around), normal_(normal), phi_(phi) {}

    void order(std::span<const std::uint8_t> places) {
        const glm::dvec3 u = any_perpendicular(normal_);
        const glm::dvec3 v = glm::cross(normal_, u);
        for (const std::uint8_t place : places) {
            const glm::dvec3& d = around_.edge(place);
            turns_[place] = std::atan2(glm::dot(d, v), glm::dot(d, u));
            fan_.ring[fan_.size++] = place;
        }
        std::sort(fan_.ring.begin(), fan_.ring.begin() + fan_.size,
                  [&](std::uint8_t a, std::uint8_t b) {
                      return turns_[a] != turns_[b] ? turns_[a] < turns_[b] : a < b;
                  });
        for (std::size_t j = 0; j < fan_.size; ++j)
            if (is_wide(j)) fan_.open(j);
    }

    void take_out_turned(double omega) {
        for (;;) {
            std::size_t worst = fan_.size;
            double max_turned = omega + k_tie;
            for (std::size_t j = 0; j < fan_.size && fan_.size > 3; ++j) {
                if (is_at_gap(j)) continue;
                const double turned = std::min(around_.deviation(fan_, j, normal_),
                                               around_.deviation(fan_, fan_.previous(j), normal_));
                if (turned <= max_turned || turn_without(j) > omega) continue;
                max_turned = turned + k_tie;
                worst = j;
            }
            if (worst == fan_.size) return;
            erase(worst);
        }
    }

    void make_delaunay() {
        for (;;) {
            std::size_t worst = fan_.size;
            double max_sum = std::numbers::pi + k_tie;
            for (std::size_t j = 0; j < fan_.size && fan_.size > 3; ++j) {
                if (is_at_gap(j)) continue;
                const glm::dvec3& a = edge(fan_.previous(j));
                const glm::dvec3& b = edge(fan_.next(j));
                const double sum = angle_between(-a, edge(j) - a) + angle_between(-b, edge(j) - b);
                if (sum <= max_sum) continue;
                max_sum = sum + k_tie;
                worst = j;
            }
            if (worst == fan_.size) return;
            erase(worst);
        }
    }

    void grow_gaps(double max_radius) {
        for (bool is_changed = true; is_changed;) {
            is_changed = false;
            for (std::size_t j = 0; j < fan_.size; ++j) {
                const bool is_beside = fan_.is_gap(fan_.previous(j)) || fan_.is_gap(fan_.next(j));
                if (fan_.is_gap(j) || !is_beside) continue;
                if (around_.circumradius(fan_, j) <= max_radius) continue;
                fan_.open(j);
                is_changed = true;
            }
        }
        merge_gaps(fan_);
    }

    const Fan& fan() const { return fan_; }

private:
    const glm::dvec3& edge(std::size_t j) const { return around_.edge(fan_.ring[j]); }

    // At a concave boundary a sector is wider than phi; at a convex one it spans π or more around the normal.
    bool is_wide(std::size_t j) const {
        const std::size_t next = fan_.next(j);
        if (next == j) return true;
        double turn = turns_[fan_.ring[next]] - turns_[fan_.ring[j]];
        if (next < j) turn += 2.0 * std::numbers::pi;
        return turn >= std::numbers::pi - k_tie || angle_between(edge(j), edge(next)) > phi_;
    }
    bool is_at_gap(std::size_t j) const { return fan_.is_gap(j) || fan_.is_gap(fan_.previous(j)); }
    double turn_without(std::size_t j) const {
        const glm::dvec3 product = glm::cross(edge(fan_.previous(j)), edge(fan_.next(j)));
        return angle_between(product, normal_);
    }
    void erase(std::size_t j) {
        const std::uint64_t below = (std::uint64_t{1} << j) - 1;
        fan_.gaps = (fan_.gaps & below) | (fan_.gaps >> 1 & ~below);
        std::copy(fan_.ring.begin() + static_cast<std::ptrdiff_t>(j) + 1,
                  fan_.ring.begin() + fan_.size,
                  fan_.ring.begin() + static_cast<std::ptrdiff_t>(j));
        --fan_.size;
        const std::size_t before = (j == 0 ? fan_.size : j) - 1u;
        if (is_wide(before)) fan_.open(before);
    }

    const Neighborhood& around_;
    glm::dvec3 normal_;
    double phi_;
    Fan fan_;
    std::array<double, k_max_neighbors> turns_;  // By place.
};

}  // namespace

GabrielTriangle gabriel_triangle(const Neighborhood& around, std::uint32_t k, double omega) {
    GabrielTriangle triangle;
    const glm::dvec3& q = around.edge(0);
    double widest = -1.0;
    glm::dvec3 third(0.0);
    for (std::uint32_t place = 1; place < k; ++place) {
        const glm::dvec3& u = around.edge(place);
        if (glm::length(glm::cross(q, u)) <= k_tie * around.length(0) * around.length(place))
            continue;
        const double angle = angle_between(-u, q - u);
        if (angle <= widest + k_tie) continue;
        widest = angle;
        third = u;
    }
    if (widest < 0.0) return triangle;
    triangle.normal = glm::normalize(glm::cross(q, third));
    triangle.radius = glm::length(q) / (2.0 * std::sin(widest));
    std::uint32_t near = 0;
    for (std::uint32_t place = 0; place < k; ++place)
        near += std::abs(glm::dot(around.edge(place), triangle.normal)) <
                std::sin(omega) * around.length(place);
    triangle.is_trusted = 2 * near >= k;
    return triangle;
}

bool is_admissible(const Neighborhood& around, std::uint32_t place, const glm::dvec3& normal,
                   double radius, const PointSurfaceOptions& options) {
    const double angle = std::asin(
        std::min(1.0, std::abs(glm::dot(around.edge(place), normal)) / around.length(place)));
    if (angle <= options.omega - options.omega_t) return true;
    return angle <= options.omega + options.omega_t &&
           around.length(place) < options.gamma * radius;
}

std::optional<Fan> admitted_fan(const Neighborhood& around, std::uint64_t among,
                                const glm::dvec3& normal, double radius,
                                const PointSurfaceOptions& options) {
    std::array<std::uint8_t, k_max_neighbors> places;
    std::size_t count = 0;
    for (std::uint32_t place = 0; place < around.size(); ++place)
        if ((among >> place & 1u) != 0 && is_admissible(around, place, normal, radius, options))
            places[count++] = static_cast<std::uint8_t>(place);
    if (count < 2) return std::nullopt;
    const Fan fan = thesis_fan(around, std::span(places).first(count), normal, radius, options);
    return fan.is_umbrella() ? std::optional(fan) : std::nullopt;
}

Fan thesis_fan(const Neighborhood& around, std::span<const std::uint8_t> places,
               const glm::dvec3& normal, double radius, const PointSurfaceOptions& options) {
    FanBuilder builder(around, normal, options.phi);
    builder.order(places);
    builder.take_out_turned(options.omega);
    builder.make_delaunay();
    builder.grow_gaps(options.gamma * radius);
    return builder.fan();
}

Fan ordered_fan(const Neighborhood& around, std::span<const std::uint8_t> places,
                const glm::dvec3& normal, double phi) {
    FanBuilder builder(around, normal, phi);
    builder.order(places);
    return builder.fan();
}

}  // namespace rimline
