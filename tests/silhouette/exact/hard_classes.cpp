#include "tests/silhouette/exact/hard_classes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <string>
#include <utility>

#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/shapes/built_in_shape.h"
#include "tests/silhouette/hough/support/generated_meshes.h"
#include "tests/silhouette/lines/difficult_meshes.h"

namespace rimline::tests {

namespace {

constexpr std::size_t k_most_faces = 320;

std::vector<NamedSource> bases(std::uint32_t round) {
    std::vector<NamedSource> all;
    for (std::uint32_t kind = 0; kind < k_generated_kinds; ++kind)
        for (std::uint32_t number = kind + 8 * round * k_generated_kinds;;
             number += k_generated_kinds) {
            NamedSource mesh = generated_mesh(number);
            if (mesh.source.triangles.size() > k_most_faces) continue;
            all.push_back(std::move(mesh));
            break;
        }
    for (NamedSource& mesh : hard_meshes())
        if (!mesh.source.triangles.empty() && mesh.source.triangles.size() <= k_most_faces)
            all.push_back(std::move(mesh));
    for (const std::string_view shape : k_built_in_shapes)
        if (MeshSource source = make_built_in_shape(shape, 120);
            source.triangles.size() <= k_most_faces)
            all.push_back({std::string(shape), std::move(source)});
    return all;
}

// The greatest coordinate's difference from the first vertex, as a power of two.
float size_of(const MeshSource& source) {
    float greatest = 0x1p-100f;
    for (const glm::vec3& p : source.positions) {
        const glm::vec3 way = glm::abs(p - source.positions.front());
        greatest = std::max({greatest, way.x, way.y, way.z});
    }
    return std::exp2(std::ceil(std::log2(greatest)));
}

MeshSource on_lattice(MeshSource source) {
    const float step = 0.125f * size_of(source);
    for (glm::vec3& p : source.positions) p = step * glm::round(p / step);
    return source;
}

MeshSource through_itself(const MeshSource& source) {
    const float size = size_of(source);
    MeshSource moved = source;
    for (glm::vec3& p : moved.positions)
        p = glm::clamp(glm::vec3(p.y, p.z, p.x) + size * glm::vec3(0.173f, -0.119f, 0.071f),
                       -k_max_coordinate, k_max_coordinate);
    return joined(source, moved);
}

}  // namespace

std::vector<NamedSource> hard_classes(std::uint32_t round) {
    std::vector<NamedSource> all;
    for (NamedSource& base : bases(round)) {
        all.push_back({base.name + " on a lattice", on_lattice(base.source)});
        all.push_back(
            {base.name + " broken", broken(base.source, 17 + round, size_of(base.source))});
        all.push_back({base.name + " through itself", through_itself(base.source)});
        all.push_back(std::move(base));
    }
    return all;
}

}  // namespace rimline::tests
