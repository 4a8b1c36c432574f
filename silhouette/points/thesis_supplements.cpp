#include "silhouette/points/thesis_supplements.h"

#include "silhouette/points/thesis_fan.h"

namespace rimline {

namespace {

// Of the `k` nearest those that a further umbrella may take.
std::uint64_t free_places(const Neighborhood& around, const PointFans& fans, std::size_t k,
                          double radius, const PointSurfaceOptions& options) {
    std::uint64_t taken = 0, once = 0, twice = 0;
    for (const Fan& fan : fans.all()) {
        const std::uint64_t ends = gap_ends(fan);
        const glm::dvec3 normal = around.normal(fan);
        std::uint64_t admitted = ring_places(fan);
        for (std::uint32_t place = 0; place < k; ++place)
            if (is_admissible(around, place, normal, radius, options))
                admitted |= std::uint64_t{1} << place;
        taken |= admitted & ~ends;
        twice |= once & ends;
        once |= ends;
    }
    return ((std::uint64_t{1} << k) - 1) & ~taken & ~twice;
}

}  // namespace

PointFans supplemented(const Neighborhood& around, const PointFans& first,
                       std::span<const glm::dvec3> normals, double radius,
                       const PointSurfaceOptions& options) {
    PointFans fans = first;
    for (std::size_t place = 0; place < normals.size() && fans.count < PointFans::k_max_fans;
         ++place) {
        if (fans.count > 0 && open_ends(fans) == 0) break;
        if (normals[place] == glm::dvec3(0.0)) continue;
        const std::uint64_t free = free_places(around, fans, normals.size(), radius, options);
        if ((free >> place & 1u) == 0) continue;
        const auto fan = admitted_fan(around, free, normals[place], radius, options);
        if (!fan) continue;
        if (fan->gaps != 0) {
            fans.fans[fans.count++] = *fan;
        } else if (!is_smallest(*fan, fans.all())) {
            fans.set(*fan);
            break;
        }
    }
    return fans;
}

}  // namespace rimline
