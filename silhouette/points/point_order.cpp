#include "silhouette/points/point_order.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "silhouette/error.h"
#include "silhouette/hough/interleaved_bits.h"
#include "silhouette/is_finite.h"
#include "silhouette/points/each_point.h"
#include "silhouette/points/stoppable_sort.h"
#include "silhouette/unset_vector.h"

namespace rimline {

namespace {

// Multiplies by a power of two, in two steps: the factor alone could overflow or underflow.
class Scaling {
public:
    explicit Scaling(int exponent)
        : first_(std::ldexp(1.0, exponent / 2)),
          second_(std::ldexp(1.0, exponent - exponent / 2)) {}
    glm::dvec3 operator()(const glm::dvec3& p) const { return p * first_ * second_; }

private:
    double first_, second_;
};

double largest(const glm::dvec3& p) { return std::max({p.x, p.y, p.z}); }

bool is_less(const glm::dvec3& a, const glm::dvec3& b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z < b.z;
}

std::uint64_t morton_code(const glm::dvec3& p) {
    const auto cell = [](double x) { return static_cast<std::uint64_t>((x + 1.0) * 0x1p20); };
    return interleaved_bits(cell(p.x), cell(p.y), cell(p.z));
}

}  // namespace

OrderedPoints order_points(std::span<const glm::dvec3> positions, const std::stop_token& stop) {
    const LongCall call{stop, {}};
    OrderedPoints ordered;
    if (positions.empty()) return ordered;
    // Scales twice, so that no sum overflows: by the maximum coordinate, then by the longest side.
    double max_coordinate = 0.0;
    for (const glm::dvec3& p : positions) {
        RIMLINE_CHECK(is_finite(p));
        max_coordinate = std::max(max_coordinate, largest(glm::abs(p)));
    }
    const int first_exponent = max_coordinate > 0.0 ? -std::ilogb(max_coordinate) - 1 : 0;
    const Scaling first_scaling(first_exponent);
    glm::dvec3 low(1.0);
    glm::dvec3 high(-1.0);
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, first_scaling(p));
        high = glm::max(high, first_scaling(p));
    }
    const glm::dvec3 center = 0.5 * (low + high);
    const double side = largest(high - low);
    const int second_exponent = side > 0.0 ? -std::ilogb(side) : 0;
    const Scaling second_scaling(second_exponent);
    ordered.unit = std::ldexp(1.0, -first_exponent - second_exponent);

    struct Entry {
        std::uint64_t code;
        std::uint32_t number;
    };
    UnsetVector<glm::dvec3> units(positions.size());
    UnsetVector<Entry> entries(positions.size());
    const auto count = static_cast<std::uint32_t>(positions.size());
    each_point(count, {call}, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i) {
            const glm::dvec3 p = second_scaling(first_scaling(positions[i]) - center);
            units[i] = glm::round(p * 0x1p50) * 0x1p-50;
            entries[i] = {morton_code(units[i]), i};
        }
    });
    stoppable_sort(entries.begin(), entries.end(), stop, [&](const Entry& a, const Entry& b) {
        if (a.code != b.code) return a.code < b.code;
        const glm::dvec3& p = units[a.number];
        const glm::dvec3& q = units[b.number];
        if (p != q) return is_less(p, q);
        if (positions[a.number] != positions[b.number])
            return is_less(positions[a.number], positions[b.number]);
        return a.number < b.number;
    });
    ordered.positions.reserve(entries.size());
    ordered.numbers.reserve(entries.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i % k_checkpoint_points == 0) call.checkpoint(0.0);
        const Entry& entry = entries[i];
        if (!ordered.positions.empty() && ordered.positions.back() == units[entry.number]) continue;
        ordered.positions.push_back(units[entry.number]);
        ordered.numbers.push_back(entry.number);
    }
    return ordered;
}

}  // namespace rimline
