#include "tools/bench/perturbed_points.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

namespace rimline::tools {

namespace {

constexpr double k_margin = 0.1;

std::vector<glm::dvec3> with_noise(const PointTruth& truth, double noise) {
    std::vector<glm::dvec3> moved = truth.positions;
    std::mt19937 random(1);
    std::normal_distribution<double> gauss;
    for (std::size_t i = 0; i < moved.size(); ++i) {
        if (truth.neighbors[i].empty()) continue;
        double lengths = 0.0;
        for (const std::uint32_t n : truth.neighbors[i])
            lengths += glm::distance(truth.positions[i], truth.positions[n]);
        const double spacing = lengths / static_cast<double>(truth.neighbors[i].size());
        for (int axis = 0; axis < 3; ++axis) moved[i][axis] += noise * spacing * gauss(random);
    }
    return moved;
}

}  // namespace

PerturbedPoints perturb(const PointTruth& truth, const Perturbation& perturbation) {
    const std::vector<glm::dvec3> moved =
        perturbation.noise > 0.0 ? with_noise(truth, perturbation.noise) : truth.positions;
    PerturbedPoints points;
    if (moved.empty()) return points;
    glm::dvec3 low = truth.positions[0], high = low;
    for (const glm::dvec3& p : truth.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 size = high - low;
    const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (std::uint32_t i = 0; i < moved.size(); ++i) {
        if (perturbation.uneven > 0.0) {
            const double along = (truth.positions[i][longest] - low[longest]) / size[longest];
            if (share(random) < perturbation.uneven * along) continue;
        }
        points.positions.push_back(moved[i]);
        points.vertices.push_back(i);
    }
    const auto added = static_cast<std::uint32_t>(perturbation.outliers * double(moved.size()));
    for (std::uint32_t n = 0; n < added; ++n) {
        glm::dvec3 p;
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = low[axis] + size[axis] * ((1.0 + 2.0 * k_margin) * share(random) - k_margin);
        points.positions.push_back(p);
        points.vertices.push_back(PerturbedPoints::k_none);
    }
    return points;
}

}  // namespace rimline::tools
