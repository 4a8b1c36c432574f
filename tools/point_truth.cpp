#include "tools/point_truth.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "silhouette/mesh/angle_between.h"

namespace rimline::tools {

namespace {

constexpr double k_degree = std::numbers::pi / 180.0;
constexpr std::uint32_t k_least_vertices = 250;
constexpr double k_spacings = 3.0;
constexpr double k_least_opening_rad = 100.0 * k_degree;
constexpr double k_clear_of_faces_rad = 30.0 * k_degree;
constexpr double k_greatest_turn_rad = 60.0 * k_degree;

glm::dvec3 direction_of(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

class Truth {
public:
    explicit Truth(const Mesh& mesh) : mesh_(mesh) {
        for (const glm::vec3& p : mesh.positions()) truth_.positions.emplace_back(p);
        truth_.normals.assign(truth_.positions.size(), glm::dvec3(0.0));
        corners_.resize(truth_.positions.size());
        neighbours_.resize(truth_.positions.size());
        for (const Triangle& triangle : mesh.triangles())
            for (int c = 0; c < 3; ++c) {
                const std::uint32_t a = index(triangle[c]), b = index(triangle[(c + 1) % 3]),
                                    d = index(triangle[(c + 2) % 3]);
                corners_[a].push_back({b, d});
                truth_.normals[a] += glm::cross(edge(a, b), edge(a, d));
            }
        for (const Edge& e : mesh.edges()) {
            neighbours_[index(e.vertices[0])].push_back(index(e.vertices[1]));
            neighbours_[index(e.vertices[1])].push_back(index(e.vertices[0]));
        }
        for (glm::dvec3& normal : truth_.normals) normal = direction_of(normal);
    }

    PointTruth find() {
        truth_.is_border.assign(truth_.positions.size(), 0);
        const Mesh::EdgeRange borders = mesh_.edges_of_class(EdgeClass::border);
        for (std::uint32_t e = borders.first; e < borders.last; ++e)
            for (const VertexId v : mesh_.edge(EdgeId{e}).vertices) truth_.is_border[index(v)] = 1;
        truth_.is_fit = truth_.positions.size() >= k_least_vertices && mesh_.is_oriented() &&
                        mesh_.edges_of_class(EdgeClass::nonmanifold).size() == 0 &&
                        std::ranges::all_of(mesh_.planes(), &Plane::has_normal);
        std::uint32_t smooth = 0;
        for (std::uint32_t v = 0; v < truth_.positions.size(); ++v) {
            truth_.border_count += truth_.is_border[v];
            if (truth_.is_border[v] && truth_.is_fit) truth_.wide_count += is_wide(v);
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
                                 truth_.normals[v]) <= k_greatest_turn_rad;
        });
    }

    bool is_wide(std::uint32_t v) const {
        const glm::dvec3& n = truth_.normals[v];
        if (n == glm::dvec3(0.0)) return false;
        const glm::dvec3 u = glm::normalize(
            glm::cross(n, std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        const glm::dvec3 w = glm::cross(n, u);
        const auto direction = [&](const glm::dvec3& d) {
            return std::atan2(glm::dot(d, w), glm::dot(d, u));
        };
        double reach = 0.0;
        for (const std::uint32_t x : neighbours_[v]) reach += glm::length(edge(v, x));
        reach *= k_spacings / static_cast<double>(neighbours_[v].size());
        double covered = 0.0;
        std::vector<std::array<double, 2>> sectors;
        for (const auto& corner : corners_[v]) {
            covered += angle_between(edge(v, corner[0]), edge(v, corner[1]));
            sectors.push_back({direction(edge(v, corner[0])), direction(edge(v, corner[1]))});
        }
        if (2.0 * std::numbers::pi - covered < k_least_opening_rad) return false;
        const auto turn = [](double from, double to) {
            const double angle = std::fmod(to - from, 2.0 * std::numbers::pi);
            return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
        };
        for (std::uint32_t x = 0; x < truth_.positions.size(); ++x) {
            const glm::dvec3 d = edge(v, x);
            const double length = glm::length(d);
            if (x == v || length > reach || !(length > 0.0)) continue;
            if (std::abs(glm::dot(d, n)) > std::sin(std::numbers::pi / 4) * length) continue;
            if (std::ranges::find(neighbours_[v], x) != neighbours_[v].end()) continue;
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
    std::vector<std::vector<std::array<std::uint32_t, 2>>> corners_;
    std::vector<std::vector<std::uint32_t>> neighbours_;
};

}  // namespace

PointTruth point_truth(const Mesh& mesh) { return Truth(mesh).find(); }

}  // namespace rimline::tools
