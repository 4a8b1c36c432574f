#include "tools/bench/point_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <queue>
#include <ranges>
#include <set>
#include <utility>

#include "silhouette/mesh/angle_between.h"
#include "silhouette/mesh/any_perpendicular.h"
#include "silhouette/mesh/creases.h"

namespace rimline::tools {

namespace {

constexpr std::uint32_t k_min_vertices = 250;
constexpr double k_spacings = 3.0;
constexpr double k_min_opening_rad = 100.0 * k_degree;
constexpr double k_clear_of_faces_rad = 30.0 * k_degree;
constexpr double k_max_turn_rad = 60.0 * k_degree;
constexpr double k_own_lengths = 2.0;

glm::dvec3 direction_of(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

class Truth {
public:
    explicit Truth(const Mesh& mesh) : mesh_(mesh) {
        for (const glm::vec3& p : mesh.positions()) truth_.positions.emplace_back(p);
        truth_.normals.assign(truth_.positions.size(), glm::dvec3(0.0));
        truth_.neighbors.resize(truth_.positions.size());
        normals_by_area_ = truth_.normals;
        corners_.resize(truth_.positions.size());
        for (const Triangle& triangle : mesh.triangles())
            for (int c = 0; c < 3; ++c) {
                const std::uint32_t a = index(triangle[c]), b = index(triangle[(c + 1) % 3]),
                                    d = index(triangle[(c + 2) % 3]);
                corners_[a].push_back({b, d});
                const glm::dvec3 product = glm::cross(edge(a, b), edge(a, d));
                normals_by_area_[a] += product;
                truth_.normals[a] += angle_between(edge(a, b), edge(a, d)) * direction_of(product);
            }
        for (const Edge& e : mesh.edges()) {
            truth_.neighbors[index(e.vertices[0])].push_back(index(e.vertices[1]));
            truth_.neighbors[index(e.vertices[1])].push_back(index(e.vertices[0]));
        }
        truth_.turns.assign(truth_.positions.size(), 0.0);
        for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
            for (const VertexId v : mesh.edge(EdgeId{e}).vertices)
                truth_.turns[index(v)] = std::max(truth_.turns[index(v)], bend_of(mesh, EdgeId{e}));
        for (auto* normals : {&truth_.normals, &normals_by_area_})
            for (glm::dvec3& normal : *normals) normal = direction_of(normal);
        by_x_.resize(truth_.positions.size());
        std::iota(by_x_.begin(), by_x_.end(), 0u);
        std::ranges::sort(by_x_, {}, [&](std::uint32_t v) { return truth_.positions[v].x; });
    }

    PointTruth find() {
        truth_.is_border.assign(truth_.positions.size(), 0);
        truth_.is_wide_at = truth_.is_border;
        const Mesh::EdgeRange borders = mesh_.edges_of_class(EdgeClass::border);
        for (std::uint32_t e = borders.first; e < borders.last; ++e)
            for (const VertexId v : mesh_.edge(EdgeId{e}).vertices) truth_.is_border[index(v)] = 1;
        truth_.is_fit = truth_.positions.size() >= k_min_vertices && mesh_.is_oriented() &&
                        mesh_.edges_of_class(EdgeClass::nonmanifold).size() == 0 &&
                        std::ranges::all_of(mesh_.planes(), &Plane::has_normal);
        std::uint32_t smooth = 0;
        for (std::uint32_t v = 0; v < truth_.positions.size(); ++v) {
            truth_.border_count += truth_.is_border[v];
            if (truth_.is_border[v] && truth_.is_fit) truth_.is_wide_at[v] = is_wide(v);
            truth_.wide_count += truth_.is_wide_at[v];
            smooth += is_smooth(v);
        }
        truth_.smooth_share =
            truth_.positions.empty()
                ? 0.0
                : static_cast<double>(smooth) / static_cast<double>(truth_.positions.size());
        return std::move(truth_);
    }

private:
    glm::dvec3 edge(std::uint32_t from, std::uint32_t to) const {
        return truth_.positions[to] - truth_.positions[from];
    }

    bool is_smooth(std::uint32_t v) const {
        return std::ranges::all_of(corners_[v], [&](const auto& corner) {
            return angle_between(glm::cross(edge(v, corner[0]), edge(v, corner[1])),
                                 normals_by_area_[v]) <= k_max_turn_rad;
        });
    }

    bool is_wide(std::uint32_t v) const {
        const glm::dvec3& n = normals_by_area_[v];
        if (n == glm::dvec3(0.0)) return false;
        const glm::dvec3 u = any_perpendicular(n);
        const glm::dvec3 w = glm::cross(n, u);
        const auto direction = [&](const glm::dvec3& d) {
            return std::atan2(glm::dot(d, w), glm::dot(d, u));
        };
        double reach = 0.0;
        const std::vector<std::uint32_t>& neighbors = truth_.neighbors[v];
        for (const std::uint32_t x : neighbors) reach += glm::length(edge(v, x));
        reach *= k_spacings / static_cast<double>(neighbors.size());
        double covered = 0.0;
        std::vector<std::array<double, 2>> sectors;
        for (const auto& corner : corners_[v]) {
            covered += angle_between(edge(v, corner[0]), edge(v, corner[1]));
            sectors.push_back({direction(edge(v, corner[0])), direction(edge(v, corner[1]))});
        }
        if (2.0 * std::numbers::pi - covered < k_min_opening_rad) return false;
        const auto turn = [](double from, double to) {
            const double angle = std::fmod(to - from, 2.0 * std::numbers::pi);
            return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
        };
        const auto x_of = [&](std::uint32_t x) { return truth_.positions[x].x; };
        const auto first = std::ranges::lower_bound(by_x_, x_of(v) - reach, {}, x_of);
        const auto last = std::ranges::upper_bound(by_x_, x_of(v) + reach, {}, x_of);
        for (const std::uint32_t x : std::ranges::subrange(first, last)) {
            const glm::dvec3 d = edge(v, x);
            const double length = glm::length(d);
            if (x == v || length > reach || !(length > 0.0)) continue;
            if (std::abs(glm::dot(d, n)) > std::sin(std::numbers::pi / 4) * length) continue;
            if (std::ranges::find(neighbors, x) != neighbors.end()) continue;
            const double at = direction(d);
            const bool is_near_faces = std::ranges::any_of(sectors, [&](const auto& sector) {
                return turn(sector[0], at) <= turn(sector[0], sector[1]) ||
                       turn(at, sector[0]) < k_clear_of_faces_rad ||
                       turn(sector[1], at) < k_clear_of_faces_rad;
            });
            if (!is_near_faces) return false;
        }
        return true;
    }

    const Mesh& mesh_;
    PointTruth truth_;
    std::vector<glm::dvec3> normals_by_area_;  // Zero if none.
    std::vector<std::vector<std::array<std::uint32_t, 2>>> corners_;
    std::vector<std::uint32_t> by_x_;  // The vertices sorted by x.
};

}  // namespace

bool PointTruth::is_crowded(std::uint32_t vertex) const {
    const auto length = [&](std::uint32_t a, std::uint32_t b) {
        return glm::distance(positions[a], positions[b]);
    };
    double longest = 0.0;
    for (const std::uint32_t next : neighbors[vertex])
        longest = std::max(longest, length(vertex, next));
    // The vertex's own sheet: the vertices near along edges, by shortest paths (Dijkstra 1959).
    using Reached = std::pair<double, std::uint32_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> waiting;
    std::set<std::uint32_t> own;
    for (waiting.push({0.0, vertex}); !waiting.empty();) {
        const auto [far, at] = waiting.top();
        waiting.pop();
        if (!own.insert(at).second) continue;
        for (const std::uint32_t next : neighbors[at])
            if (far + length(at, next) <= k_own_lengths * longest)
                waiting.push({far + length(at, next), next});
    }
    for (std::uint32_t other = 0; other < positions.size(); ++other)
        if (length(vertex, other) < longest && !own.contains(other)) return true;
    return false;
}

PointTruth point_truth(const Mesh& mesh) { return Truth(mesh).find(); }

std::uint32_t count_around_holes(const Mesh& mesh, std::span<const std::uint8_t> found) {
    const auto corners_of = [](const Triangle& t) {
        return std::array<std::uint32_t, 3>{index(t[0]), index(t[1]), index(t[2])};
    };
    const auto is_between_found = [&](const Triangle& t) {
        return std::ranges::all_of(corners_of(t), [&](std::uint32_t v) { return found[v] != 0; });
    };
    // Faces whose vertices are all found, in patches that share vertices. One vertex represents each patch.
    const std::size_t count = mesh.positions().size();
    std::vector<std::uint32_t> up(count);
    std::iota(up.begin(), up.end(), 0u);
    const auto patch = [&](std::uint32_t v) {
        while (up[v] != v) v = up[v] = up[up[v]];
        return v;
    };
    std::vector<std::uint8_t> is_kept(count, 0);  // Vertices with another face.
    for (const Triangle& t : mesh.triangles()) {
        const auto corners = corners_of(t);
        if (is_between_found(t))
            up[patch(corners[0])] = up[patch(corners[1])] = patch(corners[2]);
        else
            for (const std::uint32_t v : corners) is_kept[v] = 1;
    }
    // A patch with a vertex that has no other face is sampled and no hole.
    std::vector<std::uint8_t> is_sampled(count, 0);
    for (std::uint32_t v = 0; v < count; ++v)
        if (!is_kept[v]) is_sampled[patch(v)] = 1;

    MeshSource rest;
    rest.positions.assign(mesh.positions().begin(), mesh.positions().end());
    for (const Triangle& t : mesh.triangles())
        if (!is_between_found(t) || is_sampled[patch(index(t[0]))])
            rest.triangles.push_back(corners_of(t));
    if (rest.triangles.size() == mesh.face_count()) return 0;
    const PointTruth opened = point_truth(Mesh(rest, Welding::none));
    std::vector<std::uint32_t> around(count, 0), wide(count, 0);  // One a patch.
    for (std::uint32_t v = 0; v < count; ++v) {
        around[patch(v)] += opened.is_border[v];
        wide[patch(v)] += opened.is_wide_at[v];
    }
    std::uint32_t total = 0;
    for (std::uint32_t p = 0; p < count; ++p)
        if (2 * wide[p] > around[p]) total += around[p];
    return total;
}

}  // namespace rimline::tools
