#include "silhouette/points/point_cloud.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/error.h"
#include "silhouette/is_finite.h"
#include "silhouette/mesh/equal_positions.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_none = 0xffffffffu;

bool is_usable(const glm::dvec3& p) {
    const double largest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (!is_finite(p)) return false;
    RIMLINE_CHECK(largest <= static_cast<double>(k_max_coordinate));
    return true;
}

glm::vec3 unit_or_zero(const glm::vec3& v) {
    const double length = glm::length(glm::dvec3(v));
    return length > 0.0 && std::isfinite(length) ? glm::vec3(glm::dvec3(v) / length)
                                                 : glm::vec3(0.0f);
}

}  // namespace

PointCloud::PointCloud(PointSource source) : up_(source.up), is_up_known_(source.is_up_known) {
    const std::size_t count = source.positions.size();
    if (count > 0xfffffff0u)
        throw Error(ErrorCode::too_large, "the cloud has 2^32 - 16 points or more");
    RIMLINE_CHECK(source.normals.empty() || source.normals.size() == count);
    RIMLINE_CHECK(source.colors.empty() || source.colors.size() == count);
    RIMLINE_CHECK(source.intensities.empty() || source.intensities.size() == count);
    file_point_count_ = static_cast<std::uint32_t>(count);

    // First only marks positions that are points: 0, or k_none. Later their numbers.
    std::vector<std::uint32_t> point_of(count, source.triangles.empty() ? 0 : k_none);
    for (const auto& triangle : source.triangles)
        for (const std::uint32_t corner : triangle) {
            RIMLINE_CHECK(corner < count);
            point_of[corner] = 0;
        }
    std::vector<glm::dvec3> kept;
    std::vector<std::uint32_t> file_points;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (!is_usable(source.positions[i])) {
            ++dropped_count_;
            point_of[i] = k_none;
        } else if (point_of[i] == k_none) {
            ++unused_count_;
        } else {
            kept.push_back(source.positions[i]);
            file_points.push_back(i);
        }
    }
    source.positions = {};
    const std::vector<std::uint32_t> first = first_equal_positions<double>(kept);
    for (std::uint32_t i = 0; i < kept.size(); ++i) {
        const std::uint32_t file_point = file_points[i];
        if (first[i] != i) {
            ++duplicate_count_;
            point_of[file_point] = point_of[file_points[first[i]]];
            continue;
        }
        point_of[file_point] = size();
        positions_.push_back(kept[i]);
        file_points_.push_back(file_point);
        if (!source.normals.empty()) normals_.push_back(unit_or_zero(source.normals[file_point]));
        if (!source.colors.empty()) colors_.push_back(source.colors[file_point]);
        if (!source.intensities.empty()) intensities_.push_back(source.intensities[file_point]);
    }
    for (const auto& t : source.triangles) {
        const std::array<std::uint32_t, 3> points{point_of[t[0]], point_of[t[1]], point_of[t[2]]};
        if (std::ranges::find(points, k_none) == points.end() && points[0] != points[1] &&
            points[1] != points[2] && points[2] != points[0])
            triangles_.push_back(points);
    }
    measure();
}

void PointCloud::measure() {
    if (positions_.empty()) return;
    glm::dvec3 low = positions_[0];
    glm::dvec3 high = positions_[0];
    for (const glm::dvec3& p : positions_) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    center_ = 0.5 * (low + high);
    for (const glm::dvec3& p : positions_) radius_ = std::max(radius_, glm::distance(p, center_));
}

std::vector<std::uint32_t> PointCloud::mesh_border_points() const {
    std::vector<std::array<std::uint32_t, 2>> edges;
    edges.reserve(3 * triangles_.size());
    for (const auto& t : triangles_)
        for (std::size_t c = 0; c < 3; ++c)
            edges.push_back({std::min(t[c], t[(c + 1) % 3]), std::max(t[c], t[(c + 1) % 3])});
    std::ranges::sort(edges);
    std::vector<std::uint32_t> points;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i + 1;
        while (end < edges.size() && edges[end] == edges[i]) ++end;
        if (end == i + 1) points.insert(points.end(), edges[i].begin(), edges[i].end());
        i = end;
    }
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

}  // namespace rimline
