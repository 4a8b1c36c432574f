#include "silhouette/methods/cone_tree.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "silhouette/methods/edge_order.h"
#include "silhouette/methods/scaled_direction.h"

namespace rimline {

namespace {

constexpr double k_angle_margin = 0x1p-18;

struct SupportingPlane {
    glm::dvec3 n;       // As rounded to floats.
    glm::dvec3 unit_n;  // Of length 1.
    double d;
};

// The planes of the edges' faces, and the center of their vertices' bounds.
struct Cluster {
    std::vector<SupportingPlane> planes;
    glm::dvec3 middle;
};

Cluster cluster_of(const Mesh& mesh, std::span<const EdgeId> edges) {
    Cluster cluster;
    cluster.planes.reserve(2 * edges.size());
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-low);
    for (const EdgeId edge : edges) {
        for (const FaceId face : mesh.edge(edge).faces) {
            const Plane& plane = mesh.plane(face);
            const glm::dvec3 n = plane.normal();
            cluster.planes.push_back({n, glm::normalize(n), plane.d});
        }
        for (const VertexId vertex : mesh.edge(edge).vertices) {
            const glm::dvec3 position(mesh.positions()[index(vertex)]);
            low = glm::min(low, position);
            high = glm::max(high, position);
        }
    }
    cluster.middle = 0.5 * (low + high);
    return cluster;
}

// The unit normal farthest from an axis.
glm::dvec3 farthest_normal(const Cluster& cluster, const glm::dvec3& axis) {
    glm::dvec3 farthest(axis);
    double least = 1.0;
    for (const SupportingPlane& plane : cluster.planes) {
        const double cosine = glm::dot(plane.unit_n, axis);
        if (cosine >= least) continue;
        farthest = plane.unit_n;
        least = cosine;
    }
    return farthest;
}

// Nearly the axis of the smallest cone around all normals, by steps towards the farthest one (Badoiu,
// Clarkson 2003). Zero where the cone cannot be narrower than a half-space.
glm::dvec3 axis_of(const Cluster& cluster) {
    glm::dvec3 axis(0.0);
    for (const SupportingPlane& plane : cluster.planes) axis += plane.unit_n;
    constexpr double k_smallest = 1e-6;
    constexpr int k_steps = 16;
    for (int step = 1; step <= k_steps; ++step) {
        if (!(glm::length(axis) > k_smallest)) return glm::dvec3(0.0);
        axis = glm::normalize(axis);
        const glm::dvec3 farthest = farthest_normal(cluster, axis);
        if (glm::dot(axis, farthest) < -0.5) return glm::dvec3(0.0);
        axis += (farthest - axis) / (step + 1.0);
    }
    return glm::length(axis) > k_smallest ? glm::normalize(axis) : glm::dvec3(0.0);
}

// The sine of the greatest angle between an axis and a normal; 1 where that is a right angle or more. Uses
// the cross product: cosines of small angles are too inexact.
double sine_around(const Cluster& cluster, const glm::dvec3& axis) {
    double greatest = 0.0;
    for (const SupportingPlane& plane : cluster.planes) {
        if (!(glm::dot(plane.unit_n, axis) > 0.0)) return 1.0;
        greatest = std::max(greatest, glm::length(glm::cross(plane.unit_n, axis)));
    }
    return greatest;
}

// The first point along the axis from the center, forward (sign 1) or backward (-1), that lies certainly on
// the outer or the inner side of all planes. Infinite where none is within reach.
glm::vec3 apex_of(const Cluster& cluster, const glm::dvec3& axis, double sign) {
    const glm::vec3 none(std::numeric_limits<float>::infinity());
    double along = -std::numeric_limits<double>::infinity();
    for (const SupportingPlane& plane : cluster.planes) {
        const double missing = sign * (plane.d - glm::dot(plane.n, cluster.middle));
        along = std::max(along, missing / glm::dot(plane.n, axis));
    }
    // Each step is longer than rounding and the margin require after the last.
    double step = 0x1p-20 * (glm::length(cluster.middle) + std::abs(along));
    for (int attempt = 0; attempt < 12; ++attempt, step *= 2.0) {
        const glm::vec3 apex(cluster.middle + sign * (along + step) * axis);
        const glm::dvec3 a(apex);
        if (!(glm::length(a) < double{k_max_coordinate})) return none;
        bool holds = true;
        for (const SupportingPlane& plane : cluster.planes)
            holds = holds && sign * (glm::dot(plane.n, a) - plane.d) >=
                                 0x1p-20 * glm::length(a) * glm::length(plane.n);
        if (holds) return apex;
    }
    return none;
}

}  // namespace

ConeTree::ConeTree(const Mesh& mesh) : mesh_(&mesh), in_cone_(best_version<InCone>()) {
    const std::vector<EdgeId> edges = edges_by_plane(mesh);
    tree_ = PackedTree(static_cast<std::uint32_t>(edges.size()));
    groups_.resize(tree_.group_count());
    edge_leaves_ = EdgeLeaves(mesh, edges);
    for (std::uint32_t level = 0; level < tree_.level_count(); ++level)
        for (std::uint32_t node = 0; node < tree_.node_count(level); ++node) {
            const PackedTree::Range range = tree_.items_of(level, node);
            build_cones(level, node, std::span(edges).subspan(range.begin, range.size()));
        }
}

void ConeTree::build_cones(std::uint32_t level, std::uint32_t node, std::span<const EdgeId> edges) {
    Group& group = groups_[tree_.group_of(level, node)];
    const std::uint32_t lane = node % k_fan_out;
    const auto set = [lane](std::array<Lanes, 3>& lanes, const glm::vec3& v) {
        for (int k = 0; k < 3; ++k) lanes[static_cast<std::size_t>(k)][lane] = v[k];
    };
    group.sine_squared[lane] = std::numeric_limits<float>::infinity();

    const Cluster cluster = cluster_of(*mesh_, edges);
    const glm::vec3 rounded_axis(axis_of(cluster));
    if (rounded_axis == glm::vec3(0.0f)) return;
    const glm::dvec3 axis = glm::normalize(glm::dvec3(rounded_axis));
    const double sine = sine_around(cluster, axis) + k_angle_margin;
    if (sine >= 1.0) return;
    const glm::vec3 front = apex_of(cluster, axis, 1.0);
    const glm::vec3 back = apex_of(cluster, axis, -1.0);
    set(group.axis, rounded_axis);
    set(group.front_apex, front);
    set(group.back_apex, back);
    group.sine_squared[lane] = static_cast<float>(sine * sine);
}

[[gnu::always_inline]] inline std::uint32_t ConeTree::InCone::run(const Group& group,
                                                                  const HomogeneousPoint& p) {
    std::uint32_t inside = 0;
    const auto in_cone = [&](const std::array<Lanes, 3>& apex, std::uint32_t i, float sign) {
        const float x = p.x - p.w * apex[0][i];
        const float y = p.y - p.w * apex[1][i];
        const float z = p.z - p.w * apex[2][i];
        const float along =
            sign * (x * group.axis[0][i] + y * group.axis[1][i] + z * group.axis[2][i]);
        const float squares = x * x + y * y + z * z;
        return (along > 0.0f) & (along * along > group.sine_squared[i] * squares) &
               (squares > 0x1p-80f);
    };
    for (std::uint32_t i = 0; i < k_fan_out; ++i) {
        const bool in_either =
            in_cone(group.front_apex, i, 1.0f) | in_cone(group.back_apex, i, -1.0f);
        inside |= in_either ? 1u << i : 0u;
    }
    return inside;
}

void ConeTree::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                       TraversalCounters& counters) {
    RIMLINE_CHECK(point.is_valid());
    edges.clear();
    const HomogeneousPoint scaled = scaled_direction(point);
    tree_.walk(
        [&](const PackedTree::Siblings& siblings) {
            counters.box_checks += siblings.count;
            return siblings.lanes() & ~in_cone_(groups_[siblings.group], scaled);
        },
        [&](std::uint32_t leaf) { edge_leaves_.test_leaf(leaf, point, edges, counters); });
    edge_leaves_.test_rest(point, edges, counters);
}

}  // namespace rimline
