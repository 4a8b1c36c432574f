#include "tests/silhouette/methods/literal/octants.h"

#include <random>

namespace rimline::tests {

std::vector<glm::dvec3> clustered_points(std::uint32_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_int_distribution<int> anywhere(0, 1024);
    std::uniform_int_distribution<int> near(-12, 12);
    std::vector<glm::dvec3> points{glm::dvec3(0.0), glm::dvec3(1.0)};
    glm::dvec3 center(0.0);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i % 50 == 0)
            center = glm::dvec3(anywhere(random), anywhere(random), anywhere(random)) / 1024.0;
        const glm::dvec3 offset(near(random), near(random), near(random));
        const glm::dvec3 point = center + offset / 1024.0;
        if (holds({glm::dvec3(0.0), glm::dvec3(1.0)}, point)) points.push_back(point);
    }
    return points;
}

std::vector<Octant> octants_of(std::span<const OctreeNode> nodes, const Octant& root) {
    std::vector<Octant> octants(nodes.size());
    if (!nodes.empty()) octants[0] = root;
    for (std::uint32_t i = 0; i < nodes.size(); ++i)
        for (std::uint32_t octant = 0; octant < 8; ++octant)
            if (nodes[i].children[octant] != k_no_node)
                octants[nodes[i].children[octant]] = octants[i].child(octant);
    return octants;
}

}  // namespace rimline::tests
