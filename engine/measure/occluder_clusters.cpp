#include "engine/measure/occluder_clusters.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/hough/octree_order.h"

namespace rimline {

namespace {

// Faces in a cluster. Chosen from 16, 32 and 64: smaller clusters omit more faces and cost more tests.
constexpr std::uint32_t k_cluster_faces = 16;

// Side of a tile. It is larger in pictures that would have more than k_max_tiles along a side.
constexpr float k_tile_px = 8.0f;
constexpr float k_max_tiles = 128.0f;

// Margins for the rounding of positions on the screen, of distances (relative) and of sines, here and on the
// GPU.
constexpr float k_margin_px = 0.03f;
constexpr float k_distance_margin = 1e-4f;
constexpr float k_sine_margin = 1e-3f;

glm::dvec3 centroid(const Mesh& mesh, const Triangle& triangle) {
    glm::dvec3 sum(0.0);
    for (const VertexId vertex : triangle) sum += glm::dvec3(mesh.positions()[index(vertex)]);
    return sum / 3.0;
}

}  // namespace

void LineReach::Grid::begin(float cell, float side_px) {
    cell_px = cell;
    side = static_cast<int>(std::ceil(side_px / cell));
    farthest.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0.0f);
}

LineReach::Box LineReach::Grid::cells_of(glm::vec2 low, glm::vec2 high,
                                         float margin_px) const noexcept {
    // Clamped before the conversion to integers: near the viewer's plane positions are unbounded. The
    // conversion truncates, which is right for nonnegative values; without SSE4, std::floor and std::ceil are
    // calls.
    const float end = static_cast<float>(side);
    const float scale = 1.0f / cell_px;
    const auto first = [&](float place) {
        const float cell = std::min(std::max((place - margin_px) * scale - 0.5f, 0.0f), end);
        const int cut = static_cast<int>(cell);
        return cut + static_cast<int>(static_cast<float>(cut) < cell);
    };
    const auto last = [&](float place) {
        const float beyond = std::min(std::max((place + margin_px) * scale + 0.5f, 0.0f), end);
        return static_cast<int>(beyond) - 1;
    };
    return {first(low.x), first(low.y), last(high.x), last(high.y)};
}

void LineReach::Grid::mark(const Box& box, float distance) noexcept {
    for (int y = box.top; y <= box.bottom; ++y)
        for (int x = box.left; x <= box.right; ++x) {
            float& cell = farthest[static_cast<std::size_t>(y * side + x)];
            cell = std::max(cell, distance);
        }
}

bool LineReach::Grid::has_line_beyond(const Box& box, float distance) const noexcept {
    for (int y = box.top; y <= box.bottom; ++y)
        for (int x = box.left; x <= box.right; ++x)
            if (farthest[static_cast<std::size_t>(y * side + x)] > distance) return true;
    return false;
}

void LineReach::begin(const SquareView& view) {
    view_ = view;
    half_px_ = 0.5f * view.side_px;
    pixels_.begin(1.0f, view.side_px);
    tiles_.begin(std::max(k_tile_px, view.side_px / k_max_tiles), view.side_px);
}

void LineReach::add(const glm::vec3& from, const glm::vec3& to) {
    const glm::vec3 a = on_screen(from);
    const glm::vec3 b = on_screen(to);
    const float farthest = std::max(a.z, b.z) * (1.0f + k_distance_margin);
    if (farthest <= 0.0f) return;
    if (a.z <= 0.0f || b.z <= 0.0f) {
        pixels_.mark({0, 0, pixels_.side - 1, pixels_.side - 1}, farthest);
        tiles_.mark({0, 0, tiles_.side - 1, tiles_.side - 1}, farthest);
        return;
    }
    const glm::vec2 p(a);
    const glm::vec2 q(b);
    // In pieces no longer than a cell, because an oblique line would mark a whole rectangle. A line covers
    // the pixels whose centers are within half a pixel of it along each axis.
    const auto mark = [&](Grid& grid) {
        const float length = std::max(std::abs(q.x - p.x), std::abs(q.y - p.y));
        const int pieces = static_cast<int>(std::clamp(length / grid.cell_px, 0.0f, 65536.0f)) + 1;
        for (int i = 0; i < pieces; ++i) {
            const float step = 1.0f / static_cast<float>(pieces);
            const glm::vec2 begin = p + (q - p) * (step * static_cast<float>(i));
            const glm::vec2 end = p + (q - p) * (step * static_cast<float>(i + 1));
            // All cells that contain the center of such a pixel, not only cells whose own center is near.
            const float margin =
                0.5f * grid.cell_px + k_margin_px + (grid.cell_px > 1.0f ? 0.5f : 0.0f);
            grid.mark(grid.cells_of(glm::min(begin, end), glm::max(begin, end), margin), farthest);
        }
    };
    mark(pixels_);
    mark(tiles_);
}

bool LineReach::may_hide_line(const glm::vec3& center, float radius) const noexcept {
    const glm::vec3 eye = eye_from_object(center);
    const float farthest = -eye.z + radius;
    if (farthest < view_.near_distance) return false;
    const float nearest = (-eye.z - radius) * (1.0f - k_distance_margin);
    Box box{0, 0, tiles_.side - 1, tiles_.side - 1};
    if (nearest > view_.near_distance) {
        // The projection of a box around the sphere: each side is farthest out at its near or its far end.
        const float half = half_px_;
        const float scale = half * view_.focal;
        const auto most = [&](float c) { return scale * (c > 0.0f ? c / nearest : c / farthest); };
        box = tiles_.cells_of({half - most(radius - eye.x), half - most(radius + eye.y)},
                              {half + most(radius + eye.x), half + most(radius - eye.y)},
                              0.5f * tiles_.cell_px + k_margin_px);
    }
    return tiles_.has_line_beyond(box, std::max(nearest, 0.0f));
}

bool LineReach::may_hide_line(const glm::vec3& a, const glm::vec3& b,
                              const glm::vec3& c) const noexcept {
    const float nearest = std::min({a.z, b.z, c.z});
    if (nearest <= 0.0f) return std::max({a.z, b.z, c.z}) > 0.0f;
    const glm::vec2 low = glm::min(glm::vec2(a), glm::min(glm::vec2(b), glm::vec2(c)));
    const glm::vec2 high = glm::max(glm::vec2(a), glm::max(glm::vec2(b), glm::vec2(c)));
    return pixels_.has_line_beyond(pixels_.cells_of(low, high, k_margin_px),
                                   nearest * (1.0f - k_distance_margin));
}

void join_runs(std::vector<IndexRun>& runs, std::size_t max_runs) {
    if (runs.size() <= max_runs) return;
    const auto gap_before = [&](std::size_t i) {
        return runs[i].first - (runs[i - 1].first + runs[i - 1].count);
    };
    std::vector<std::uint32_t> gaps;
    for (std::size_t i = 1; i < runs.size(); ++i) gaps.push_back(gap_before(i));
    // All but the max_runs - 1 largest.
    const auto largest = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() - max_runs);
    std::ranges::nth_element(gaps, largest);
    const std::uint32_t largest_joined = *largest;
    std::vector<IndexRun> joined{runs[0]};
    for (std::size_t i = 1; i < runs.size(); ++i) {
        if (gap_before(i) > largest_joined)
            joined.push_back(runs[i]);
        else
            joined.back().count = runs[i].first + runs[i].count - joined.back().first;
    }
    runs.swap(joined);
}

OccluderClusters::OccluderClusters(const Mesh& mesh) {
    std::vector<FaceId> faces;
    std::vector<glm::dvec3> centroids;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (!mesh.plane(FaceId{f}).has_normal()) continue;
        faces.push_back(FaceId{f});
        centroids.push_back(centroid(mesh, mesh.triangles()[f]));
    }
    std::vector<FaceId> ordered;
    for (const std::uint32_t place : octree_order(centroids)) {
        ordered.push_back(faces[place]);
        triangles_.push_back(mesh.triangles()[index(faces[place])]);
    }
    for (std::size_t first = 0; first < ordered.size(); first += k_cluster_faces) {
        const std::size_t count = std::min<std::size_t>(k_cluster_faces, ordered.size() - first);
        glm::vec3 low(mesh.positions()[index(triangles_[first][0])]);
        glm::vec3 high = low;
        glm::vec3 sum(0.0f);
        for (std::size_t i = first; i < first + count; ++i) {
            for (const VertexId vertex : triangles_[i]) {
                low = glm::min(low, mesh.positions()[index(vertex)]);
                high = glm::max(high, mesh.positions()[index(vertex)]);
            }
            const Plane& plane = mesh.plane(ordered[i]);
            sum += glm::vec3(plane.nx, plane.ny, plane.nz);
        }
        Cluster cluster{0.5f * low + 0.5f * high, 0.0f, {}, 2.0f};
        for (std::size_t i = first; i < first + count; ++i)
            for (const VertexId vertex : triangles_[i])
                cluster.radius = std::max(
                    cluster.radius, glm::distance(cluster.center, mesh.positions()[index(vertex)]));
        cluster.radius *= 1.0f + k_distance_margin;
        if (glm::length(sum) > 0.0f) {
            cluster.axis = glm::normalize(sum);
            float cosine = 1.0f;
            for (std::size_t i = first; i < first + count; ++i) {
                const Plane& plane = mesh.plane(ordered[i]);
                cosine = std::min(cosine,
                                  glm::dot(cluster.axis, glm::vec3(plane.nx, plane.ny, plane.nz)));
            }
            if (cosine > 0.0f)
                cluster.sine_of_spread = std::sqrt(std::max(1.0f - cosine * cosine, 0.0f));
        }
        clusters_.push_back(cluster);
    }
}

void OccluderClusters::select(const LineReach& lines, bool culls_backs,
                              std::vector<IndexRun>& runs) const {
    runs.clear();
    const auto face_count = static_cast<std::uint32_t>(triangles_.size());
    for (std::uint32_t c = 0; c < clusters_.size(); ++c) {
        const Cluster& cluster = clusters_[c];
        if (culls_backs) {
            // n·(p - eye) > 0 for all normals n and corners p if the angle between axis and center, the
            // half angle of the cone and that of the sphere sum up to less than a right angle.
            // sin(a + b) <= sin a + sin b.
            const glm::vec3 towards = cluster.center - lines.view().eye;
            if (glm::dot(cluster.axis, towards) >
                glm::length(towards) * (cluster.sine_of_spread + k_sine_margin) + cluster.radius)
                continue;
        }
        if (!lines.may_hide_line(cluster.center, cluster.radius)) continue;
        const std::uint32_t first = 3 * k_cluster_faces * c;
        const std::uint32_t end = 3 * std::min(k_cluster_faces * (c + 1), face_count);
        if (!runs.empty() && runs.back().first + runs.back().count == first)
            runs.back().count = end - runs.back().first;
        else
            runs.push_back({first, end - first});
    }
}

void OccluderClusters::select_faces(const LineReach& lines, std::span<const IndexRun> runs,
                                    std::span<const glm::vec3> corners,
                                    std::vector<Triangle>& faces) const {
    faces.clear();
    for (const IndexRun& run : runs)
        for (const Triangle& face : std::span(triangles_).subspan(run.first / 3, run.count / 3))
            if (lines.may_hide_line(corners[index(face[0])], corners[index(face[1])],
                                    corners[index(face[2])]))
                faces.push_back(face);
}

}  // namespace rimline
