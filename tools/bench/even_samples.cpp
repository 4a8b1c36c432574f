#include "tools/bench/even_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <unordered_map>

namespace rimline::tools {

namespace {

constexpr double k_filled =
    0.7;  // The share of the plane that discs cover which no further disc fits between.
constexpr int k_darts = 40;         // For each point.
constexpr int k_border_steps = 16;  // For each distance between points.

// Accepts points that keep their distance. A cell holds one point at most.
class Darts {
public:
    explicit Darts(double distance) : distance_(distance), cell_(distance / std::sqrt(3.0)) {}

    bool throw_at(const glm::dvec3& p) {
        const Cell at = cell_of(p);
        for (std::int64_t x = -2; x <= 2; ++x)
            for (std::int64_t y = -2; y <= 2; ++y)
                for (std::int64_t z = -2; z <= 2; ++z) {
                    const auto near = cells_.find({at[0] + x, at[1] + y, at[2] + z});
                    if (near != cells_.end() && glm::distance(near->second, p) < distance_)
                        return false;
                }
        cells_.emplace(at, p);
        return true;
    }

private:
    using Cell = std::array<std::int64_t, 3>;
    struct Hash {
        std::size_t operator()(const Cell& cell) const noexcept {
            std::uint64_t hash = 0;
            for (const std::int64_t c : cell)
                hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9e3779b97f4a7c15u;
            return hash ^ hash >> 32;
        }
    };
    Cell cell_of(const glm::dvec3& p) const {
        const auto of = [&](double c) { return static_cast<std::int64_t>(std::floor(c / cell_)); };
        return {of(p.x), of(p.y), of(p.z)};
    }

    double distance_, cell_;
    std::unordered_map<Cell, glm::dvec3, Hash> cells_;
};

}  // namespace

EvenSamples even_samples(const Mesh& mesh, std::uint32_t count) {
    const auto at = [&](VertexId v) { return glm::dvec3(mesh.positions()[index(v)]); };
    std::vector<double> areas;  // Of all faces up to each.
    double area = 0.0;
    for (const auto& [a, b, c] : mesh.triangles()) {
        area += glm::length(glm::cross(at(b) - at(a), at(c) - at(a))) / 2.0;
        areas.push_back(area);
    }
    EvenSamples samples;
    if (count == 0 || area <= 0.0) return samples;
    // A disc of half the distance around each point.
    const double distance = 2.0 * std::sqrt(k_filled * area / (count * std::numbers::pi));
    Darts darts(distance);
    const auto offer = [&](const glm::dvec3& p, bool is_border) {
        if (!darts.throw_at(p)) return;
        samples.positions.push_back(p);
        samples.is_border.push_back(is_border);
    };
    const Mesh::EdgeRange borders = mesh.edges_of_class(EdgeClass::border);
    for (std::uint32_t e = borders.first; e < borders.last; ++e) {
        const auto [a, b] = mesh.edge(EdgeId{e}).vertices;
        const int steps =
            1 + static_cast<int>(k_border_steps * glm::distance(at(a), at(b)) / distance);
        for (int i = 0; i < steps; ++i)
            offer(glm::mix(at(a), at(b), static_cast<double>(i) / steps), true);
    }
    std::mt19937_64 random(1);
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (std::uint64_t dart = 0; dart < std::uint64_t{k_darts} * count; ++dart) {
        const auto face = static_cast<std::size_t>(
            std::upper_bound(areas.begin(), areas.end() - 1, unit() * area) - areas.begin());
        const auto& [a, b, c] = mesh.triangles()[face];
        double u = unit(), v = unit();
        if (u + v > 1.0) {
            u = 1.0 - u;
            v = 1.0 - v;
        }
        offer(at(a) + u * (at(b) - at(a)) + v * (at(c) - at(a)), false);
    }
    return samples;
}

}  // namespace rimline::tools
