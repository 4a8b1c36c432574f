#include "silhouette/points/supplement.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace rimline {

namespace {

constexpr double k_greatest_turn = std::numbers::pi / 3.0;
constexpr double k_explained = 0.2588;       // The sine of 15 degrees.
constexpr double k_cosine_of_flat = 0.9397;  // 20 degrees.
constexpr double k_cosine_of_tried = 0.985;  // 10 degrees: too near to a plane that was tried.
constexpr std::size_t k_most_tried = 16;
// Of candidates with the plane: 50 degrees, and 25 for edges so sharp that the first side is nearer.
constexpr double k_sines[] = {0.766, 0.4226};

std::size_t only_gap(const Fan& fan) {
    return static_cast<std::size_t>(std::countr_zero(fan.gaps));
}

// Places that the umbrella does not explain, and its gap's ends.
std::uint64_t unexplained(const Neighbourhood& around, const Fan& fan, const glm::dvec3& normal) {
    const std::size_t gap = only_gap(fan);
    std::uint64_t places =
        around.size() == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << around.size()) - 1;
    for (std::size_t j = 0; j < fan.size; ++j)
        if (j != gap && j != fan.next(gap)) places &= ~(std::uint64_t{1} << fan.ring[j]);
    for (std::uint32_t place = 0; place < around.size(); ++place) {
        if ((places >> place & 1u) == 0 || place == fan.ring[gap] ||
            place == fan.ring[fan.next(gap)])
            continue;
        const glm::dvec3& d = around.edge(place);
        for (std::size_t j = 0; j < fan.size; ++j) {
            if (fan.is_gap(j)) continue;
            if (glm::dot(normal, glm::cross(around.edge(fan.ring[j]), d)) < 0.0 ||
                glm::dot(normal, glm::cross(d, around.edge(fan.ring[fan.next(j)]))) < 0.0)
                continue;
            const glm::dvec3 product = around.cross(fan, j);
            if (std::abs(glm::dot(product, d)) <
                k_explained * glm::length(product) * around.length(place))
                places &= ~(std::uint64_t{1} << place);
        }
    }
    return places;
}

}  // namespace

Fan find_supplement(const Neighbourhood& around, std::uint32_t point, const Fan& fan,
                    const Stars& stars, double gap_ratio) {
    const glm::dvec3 normal = around.normal(fan);
    const std::size_t gap = only_gap(fan);
    const std::uint8_t first = fan.ring[gap], last = fan.ring[fan.next(gap)];
    const std::uint64_t places = unexplained(around, fan, normal);
    std::array<glm::dvec3, k_most_tried> tried;
    std::size_t count = 0;
    for (std::uint32_t place = 0; place < around.size() && count < k_most_tried; ++place) {
        if ((places >> place & 1u) == 0) continue;
        const glm::dvec3& plane = stars.normals[around.number(place)];
        if (plane == glm::dvec3(0.0)) continue;
        const auto end = tried.begin() + static_cast<std::ptrdiff_t>(count);
        if (std::any_of(tried.begin(), end, [&](const glm::dvec3& other) {
                return std::abs(glm::dot(other, plane)) > k_cosine_of_tried;
            }))
            continue;
        tried[count++] = plane;
        for (const double sine : k_sines) {
            Fan other = around.star(plane, sine, places);
            for (std::size_t j = 0; j < other.size; ++j) {
                if (other.is_gap(j)) continue;
                const double scale =
                    std::max({stars.scales[point], stars.scales[around.number(other.ring[j])],
                              stars.scales[around.number(other.ring[other.next(j)])]});
                if (around.circumradius(other, j) > gap_ratio * scale ||
                    around.deviation(other, j, plane) > k_greatest_turn)
                    other.open(j);
            }
            merge_gaps(other);
            if (!other.is_umbrella() || std::popcount(other.gaps) != 1) continue;
            const std::size_t other_gap = only_gap(other);
            const std::uint8_t a = other.ring[other_gap], b = other.ring[other.next(other_gap)];
            const bool runs_on = a == last && b == first;
            if (!runs_on && !(a == first && b == last)) continue;
            const glm::dvec3 other_normal = around.normal(other);
            if (glm::dot(runs_on ? other_normal : -other_normal, normal) <= -k_cosine_of_flat)
                continue;
            if (!runs_on) reverse(other);
            return other;
        }
    }
    return {};
}

}  // namespace rimline
