#include "silhouette/points/supplement.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "silhouette/error.h"

namespace rimline {

namespace {

constexpr double k_max_turn = std::numbers::pi / 3.0;
constexpr double k_sine_of_explained = 0.4226;  // 25 degrees.
constexpr double k_sine_of_aside = 0.2588;      // 15 degrees.
constexpr double k_cosine_of_flat = 0.9397;     // 20 degrees.
constexpr double k_cosine_of_tried = 0.985;  // 10 degrees. Planes nearer to one tried are skipped.
constexpr double k_ear_angle = 130.0 * std::numbers::pi / 180.0;
constexpr double k_cosine_of_side = 0.2588;  // 75 degrees.
constexpr std::size_t k_max_tried = 16;
constexpr double k_steep = std::numbers::pi / 4.0;
// Maximum angle of candidates with the plane: 50 degrees, then 25 for edges so sharp that the first side is
// nearer.
constexpr double k_sines[] = {0.766, 0.4226};

std::size_t only_gap(const Fan& fan) {
    RIMLINE_CHECK(fan.gaps != 0);
    return static_cast<std::size_t>(std::countr_zero(fan.gaps));
}

// The places that the umbrella does not explain, and those of its gap's ends.
std::uint64_t unexplained(const Neighborhood& around, const Fan& fan, const glm::dvec3& normal) {
    const std::size_t gap = only_gap(fan);
    std::uint64_t places = (std::uint64_t{1} << around.size()) - 1;
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
                k_sine_of_explained * glm::length(product) * around.length(place))
                places &= ~(std::uint64_t{1} << place);
        }
    }
    return places;
}

// The fan of the places about the plane whose one gap goes from `first` to `last`. It is reversed where the
// gap goes from `last` to `first`. Without triangles where there is none.
Fan partial_between(const Neighborhood& around, std::uint32_t point, std::uint8_t first,
                    std::uint8_t last, const glm::dvec3& plane, double sine, std::uint64_t places,
                    const Stars& stars, double gap_ratio) {
    Fan fan = around.star(plane, sine, places);
    for (std::size_t j = 0; j < fan.size; ++j) {
        if (fan.is_gap(j)) continue;
        if (around.circumradius(fan, j) > gap_ratio * stars.scale_of(around, point, fan, j) ||
            around.deviation(fan, j, plane) > k_max_turn)
            fan.open(j);
    }
    merge_gaps(fan);
    if (!fan.is_umbrella() || std::popcount(fan.gaps) != 1) return {};
    const std::size_t gap = only_gap(fan);
    const std::uint8_t a = fan.ring[gap], b = fan.ring[fan.next(gap)];
    if (a == last && b == first) reverse(fan);
    return (a == first && b == last) || (a == last && b == first) ? fan : Fan{};
}

// Whether two umbrellas lie within 20 degrees of folding onto each other. Neither normal is zero.
bool folds_back(const glm::dvec3& normal, const glm::dvec3& of_what_runs_on) {
    return glm::dot(normal, of_what_runs_on) <= -k_cosine_of_flat;
}

// Whether `fan` is no second side, but lies before a border point that noise has pushed back: it has an
// obtuse triangle and turns from the first side by less than 75 degrees.
bool is_ear(const Neighborhood& around, const Fan& fan, const glm::dvec3& normal) {
    if (glm::dot(normal, around.normal(fan)) < k_cosine_of_side) return false;
    for (std::size_t j = 0; j < fan.size; ++j)
        if (!fan.is_gap(j) && around.angle(fan, j) > k_ear_angle) return true;
    return false;
}

}  // namespace

Fan find_supplement(const Neighborhood& around, std::uint32_t point, const Fan& fan,
                    const Stars& stars, double gap_ratio) {
    const glm::dvec3 normal = around.normal(fan);
    const std::size_t gap = only_gap(fan);
    const std::uint8_t first = fan.ring[gap], last = fan.ring[fan.next(gap)];
    const std::uint64_t places = unexplained(around, fan, normal);
    std::array<glm::dvec3, k_max_tried> tried;
    std::size_t count = 0;
    for (std::uint32_t place = 0; place < around.size() && count < k_max_tried; ++place) {
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
            Fan other =
                partial_between(around, point, last, first, plane, sine, places, stars, gap_ratio);
            if (!other.is_umbrella() || folds_back(normal, around.normal(other)) ||
                is_ear(around, other, normal))
                continue;
            return other;
        }
    }
    return {};
}

std::optional<SplitFan> split_fold(const Neighborhood& around, std::uint32_t point, const Fan& fan,
                                   const Stars& stars, double gap_ratio) {
    const glm::dvec3 normal = around.normal(fan);
    bool is_fold = false;
    for (std::size_t j = 0; j < fan.size; ++j)
        is_fold |= !fan.is_gap(j) && around.deviation(fan, j, normal) > k_steep;
    if (!is_fold) return std::nullopt;

    // The crease goes from one end of the gap to the other. The plane through it along the bisector separates
    // the sides.
    const std::size_t gap = only_gap(fan);
    const std::uint8_t first = fan.ring[gap], last = fan.ring[fan.next(gap)];
    const glm::dvec3 along = around.edge(last) - around.edge(first);
    glm::dvec3 inwards(0.0);
    for (std::size_t j = 0; j < fan.size; ++j)
        if (fan.ring[j] != first && fan.ring[j] != last)
            inwards += around.edge(fan.ring[j]) / around.length(fan.ring[j]);
    const glm::dvec3 up = glm::cross(along, inwards);
    const auto side = [&](bool is_above) -> Fan {
        std::uint64_t places = std::uint64_t{1} << first | std::uint64_t{1} << last;
        glm::dvec3 plane(0.0);  // Of the crease and the nearest point aside of it.
        for (std::uint32_t place = 0; place < around.size(); ++place) {
            const glm::dvec3& d = around.edge(place);
            if (place == first || place == last || (glm::dot(d, up) > 0.0) != is_above) continue;
            places |= std::uint64_t{1} << place;
            const glm::dvec3 product = glm::cross(along, d);
            // Points on the crease itself, behind its ends, are on neither side.
            const bool is_aside =
                glm::length(product) > k_sine_of_aside * glm::length(along) * around.length(place);
            if (is_aside && plane == glm::dvec3(0.0)) plane = product;
        }
        const double length = glm::length(plane);
        if (!(length > 0.0)) return {};
        return partial_between(around, point, first, last, plane / length, k_sines[0], places,
                               stars, gap_ratio);
    };
    SplitFan split{side(true), side(false)};
    if (!split.fan.is_umbrella() || !split.supplement.is_umbrella()) return std::nullopt;
    reverse(split.supplement);
    if (folds_back(around.normal(split.fan), around.normal(split.supplement))) return std::nullopt;
    return split;
}

}  // namespace rimline
