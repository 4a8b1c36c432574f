#include "silhouette/methods/quadric_tree.h"

#include <bit>
#include <cmath>

#include "silhouette/methods/edge_order.h"
#include "silhouette/methods/plane_space.h"
#include "silhouette/methods/scaled_direction.h"

namespace rimline {

namespace {

using Vector4 = std::array<double, 4>;
using LowerTriangle = std::array<double, 10>;

constexpr std::size_t at(std::size_t row, std::size_t column) {
    return row * (row + 1) / 2 + column;
}

struct OffsetVector {
    Vector4 x;     // (n, d - n·O)
    double error;  // Of the fourth coordinate.
};

OffsetVector vector_of(const Plane& plane, const glm::dvec3& origin) {
    const auto [distance, error] = offset_plane(plane, origin);
    return {{plane.nx, plane.ny, plane.nz, distance}, error};
}

PlaneBounds bounds_of(const Plane& plane, const glm::dvec3& origin) {
    const auto [x, error] = vector_of(plane, origin);
    return {{x[0], x[1], x[2], x[3] - error}, {x[0], x[1], x[2], x[3] + error}};
}

// M = LL^T. A coordinate that does not vary, or depends on those before it within a millionth, has a column
// that is zero or nearly zero.
LowerTriangle cholesky(const LowerTriangle& m) {
    LowerTriangle l{};
    for (std::size_t j = 0; j < 4; ++j) {
        double pivot = m[at(j, j)];
        for (std::size_t k = 0; k < j; ++k) pivot -= l[at(j, k)] * l[at(j, k)];
        pivot = std::max(pivot, 0x1p-40 * m[at(j, j)]);
        if (!(pivot > 0.0)) continue;
        l[at(j, j)] = std::sqrt(pivot);
        for (std::size_t i = j + 1; i < 4; ++i) {
            double sum = m[at(i, j)];
            for (std::size_t k = 0; k < j; ++k) sum -= l[at(i, k)] * l[at(j, k)];
            l[at(i, j)] = sum / l[at(j, j)];
        }
    }
    return l;
}

// t with Lt = v, as far as v lies in the range of L.
Vector4 solved(const LowerTriangle& l, const Vector4& v) {
    Vector4 t{};
    for (std::size_t i = 0; i < 4; ++i) {
        double rest = v[i];
        for (std::size_t k = 0; k < i; ++k) rest -= l[at(i, k)] * t[k];
        if (l[at(i, i)] > 0.0) t[i] = rest / l[at(i, i)];
    }
    return t;
}

}  // namespace

QuadricTree::QuadricTree(const Mesh& mesh)
    : mesh_(&mesh), origin_(mesh.center()), missed_(best_version<Missed>()) {
    const std::vector<EdgeId> edges = edges_by_plane(mesh);
    edge_leaves_ = EdgeLeaves(mesh, edges);
    std::vector<PlaneBounds> bounds(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const std::array<FaceId, 2>& faces = mesh.edge(edges[i]).faces;
        bounds[i] = bounds_of(mesh.plane(faces[0]), origin_);
        bounds[i].include(bounds_of(mesh.plane(faces[1]), origin_));
    }
    boxes_ = PlaneBoxes(origin_, bounds);
    const PackedTree& tree = boxes_.tree();
    groups_.resize(tree.group_count());
    for (std::uint32_t level = 0; level < tree.level_count(); ++level)
        for (std::uint32_t node = 0; node < tree.node_count(level); ++node) {
            const PackedTree::Range range = tree.items_of(level, node);
            build_quadric(level, node, std::span(edges).subspan(range.begin, range.size()));
        }
}

void QuadricTree::build_quadric(std::uint32_t level, std::uint32_t node,
                                std::span<const EdgeId> edges) {
    const auto for_each_plane = [&](auto&& visit) {
        for (const EdgeId edge : edges)
            for (const FaceId face : mesh_->edge(edge).faces)
                visit(vector_of(mesh_->plane(face), origin_));
    };
    const double count = 2.0 * static_cast<double>(edges.size());
    Vector4 center{};
    for_each_plane([&](const OffsetVector& v) {
        for (std::size_t i = 0; i < 4; ++i) center[i] += v.x[i] / count;
    });
    for (double& c : center) c = static_cast<float>(c);  // Rounded as it is stored.

    const auto from_center = [&center](const Vector4& x) {
        return Vector4{x[0] - center[0], x[1] - center[1], x[2] - center[2], x[3] - center[3]};
    };
    LowerTriangle covariance{};
    for_each_plane([&](const OffsetVector& v) {
        const Vector4 offset = from_center(v.x);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j <= i; ++j)
                covariance[at(i, j)] += offset[i] * offset[j] / count;
    });
    const LowerTriangle root = cholesky(covariance);

    double greatest_t = 0.0;
    Vector4 extent{};
    for_each_plane([&](const OffsetVector& v) {
        const Vector4 offset = from_center(v.x);
        const Vector4 t = solved(root, offset);
        greatest_t =
            std::max(greatest_t, std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2] + t[3] * t[3]));
        for (std::size_t i = 0; i < 4; ++i) {
            double rest = offset[i];
            for (std::size_t k = 0; k <= i; ++k) rest -= root[at(i, k)] * t[k];
            // The subtractions that made `rest` round by less than this.
            double error = 0x1p-48 * (std::abs(v.x[i]) + std::abs(center[i]));
            for (std::size_t k = 0; k <= i; ++k) error += 0x1p-48 * std::abs(root[at(i, k)] * t[k]);
            if (i == 3) error += v.error;
            extent[i] = std::max(extent[i], std::abs(rest) + error);
        }
    });

    Group& group = groups_[boxes_.tree().group_of(level, node)];
    const std::uint32_t lane = node % k_fan_out;
    const std::array<double, 3> origin_size{std::abs(origin_.x), std::abs(origin_.y),
                                            std::abs(origin_.z)};
    double origin_margin = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        double greatest = std::abs(center[i]) + extent[i];
        for (std::size_t k = 0; k <= i; ++k) {
            const double scaled = root[at(i, k)] * greatest_t * (1.0 + 0x1p-40);
            group.root[at(i, k)][lane] = static_cast<float>(scaled);
            greatest += std::abs(scaled);
        }
        double stored = extent[i] + 0x1p-20 * greatest;
        if (i < 3)
            origin_margin += greatest * (0x1p-22 * origin_size[i] + 0x1p-140);
        else
            stored += origin_margin;
        group.center[i][lane] = static_cast<float>(center[i]);
        // Slightly enlarged, so that rounding to the nearest float cannot make it too small.
        group.extent[i][lane] = static_cast<float>(stored * (1.0 + 0x1p-22));
    }
}

[[gnu::always_inline]] inline std::uint32_t QuadricTree::Missed::run(const Group& group,
                                                                     const PointForm& y) {
    std::uint32_t missed = 0;
    const PointForm size{std::abs(y[0]), std::abs(y[1]), std::abs(y[2]), std::abs(y[3])};
    for (std::uint32_t i = 0; i < k_fan_out; ++i) {
        const auto& l = group.root;
        const float value = (group.center[0][i] * y[0] + group.center[1][i] * y[1]) +
                            (group.center[2][i] * y[2] + group.center[3][i] * y[3]);
        const float reach = (group.extent[0][i] * size[0] + group.extent[1][i] * size[1]) +
                            (group.extent[2][i] * size[2] + group.extent[3][i] * size[3]);
        const float z0 = (l[0][i] * y[0] + l[1][i] * y[1]) + (l[3][i] * y[2] + l[6][i] * y[3]);
        const float z1 = l[2][i] * y[1] + (l[4][i] * y[2] + l[7][i] * y[3]);
        const float z2 = l[5][i] * y[2] + l[8][i] * y[3];
        const float z3 = l[9][i] * y[3];
        const float gap = std::abs(value) - reach;
        const float half_width_squared = (z0 * z0 + z1 * z1) + (z2 * z2 + z3 * z3);
        const bool is_missed = (gap > 0.0f) & (gap * gap > half_width_squared + 0x1p-120f);
        missed |= is_missed ? 1u << i : 0u;
    }
    return missed;
}

void QuadricTree::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                          TraversalCounters& counters) {
    RIMLINE_CHECK(point.is_valid());
    edges.clear();
    rejected_by_box_ = 0;
    rejected_by_quadric_ = 0;
    const PointForm y = form_of(scaled_direction(point), origin_);
    boxes_.tree().walk(
        [&](const PackedTree::Siblings& siblings) {
            const CertainSides sides = boxes_.sides(siblings.group, y);
            const std::uint32_t crossed = siblings.lanes() & ~(sides.positive | sides.negative);
            const auto crossed_count = static_cast<std::uint32_t>(std::popcount(crossed));
            counters.box_checks += siblings.count + crossed_count;
            rejected_by_box_ += siblings.count - crossed_count;
            if (crossed == 0) return crossed;
            const std::uint32_t left = crossed & ~missed_(groups_[siblings.group], y);
            rejected_by_quadric_ += crossed_count - static_cast<std::uint32_t>(std::popcount(left));
            return left;
        },
        [&](std::uint32_t leaf) { edge_leaves_.test_leaf(leaf, point, edges, counters); });
    edge_leaves_.test_rest(point, edges, counters);
}

std::vector<NamedCount> QuadricTree::own_counts() const {
    return {{"rejected_by_box", rejected_by_box_}, {"rejected_by_quadric", rejected_by_quadric_}};
}

}  // namespace rimline
