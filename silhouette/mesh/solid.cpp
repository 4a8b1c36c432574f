#include "silhouette/mesh/solid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <vector>

#include "silhouette/mesh/face_pairs.h"
#include "silhouette/mesh/face_tree.h"
#include "silhouette/mesh/line_hit.h"

namespace rimline {

namespace {

// A projection has about twenty rounding errors of 2^-53, relative to the projected length.
constexpr double k_rounding = 0x1p-40;
// Beyond this many pairs of overlapping boxes the test gives up: the boxes of many long and thin faces overlap.
constexpr std::uint64_t k_pairs_a_face = 256;
constexpr std::uint64_t k_min_pairs = 1u << 22;
constexpr std::uint32_t k_solid_faces_a_checkpoint = 1u << 18;

using Points = std::span<const glm::dvec3>;
using Segment = std::array<glm::dvec3, 2>;
using Corners = std::array<glm::dvec3, 3>;

// Whether an axis separates the convex hulls of two sets of points, by more than rounding error.
bool are_apart(Points a, Points b, const glm::dvec3& axis) {
    const glm::dvec3 origin = a[0];
    double low[2], high[2], reach = 0.0;
    int side = 0;
    for (const Points points : {a, b}) {
        low[side] = std::numeric_limits<double>::infinity();
        high[side] = -low[side];
        for (const glm::dvec3& p : points) {
            const double along = glm::dot(p - origin, axis);
            low[side] = std::min(low[side], along);
            high[side] = std::max(high[side], along);
            reach = std::max(reach, glm::dot(p - origin, p - origin));
        }
        ++side;
    }
    const double margin = k_rounding * std::sqrt(reach) * std::sqrt(glm::dot(axis, axis));
    return low[1] - high[0] > margin || low[0] - high[1] > margin;
}

glm::dvec3 normal_of(const Corners& t) { return glm::cross(t[1] - t[0], t[2] - t[0]); }

// Tests all axes that can separate two triangles, in space or in a common plane.
bool are_apart(const Corners& a, const Corners& b) {
    const glm::dvec3 normals[]{normal_of(a), normal_of(b)};
    if (are_apart(a, b, normals[0]) || are_apart(a, b, normals[1])) return true;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 ea = a[(i + 1) % 3] - a[i];
        for (std::size_t j = 0; j < 3; ++j)
            if (are_apart(a, b, glm::cross(ea, b[(j + 1) % 3] - b[j]))) return true;
        const glm::dvec3 eb = b[(i + 1) % 3] - b[i];
        if (are_apart(a, b, glm::cross(normals[0], ea)) ||
            are_apart(a, b, glm::cross(normals[1], eb)))
            return true;
    }
    return false;
}

bool are_apart(const Segment& segment, const Corners& t) {
    const glm::dvec3 normal = normal_of(t);
    const glm::dvec3 direction = segment[1] - segment[0];
    if (are_apart(segment, t, normal) || are_apart(segment, t, glm::cross(normal, direction)))
        return true;
    for (std::size_t j = 0; j < 3; ++j) {
        const glm::dvec3 edge = t[(j + 1) % 3] - t[j];
        if (are_apart(segment, t, glm::cross(direction, edge)) ||
            are_apart(segment, t, glm::cross(normal, edge)))
            return true;
    }
    return false;
}

// Whether two faces may meet outside the corners and edges that they share.
bool meet_elsewhere(const Mesh& mesh, const FacePair& pair) {
    const Triangle& a = mesh.triangles()[pair.a];
    const Triangle& b = mesh.triangles()[pair.b];
    const Corners p = corners_of(mesh, pair.a), q = corners_of(mesh, pair.b);
    std::array<std::array<std::size_t, 2>, 3> shared{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (a[i] == b[j]) shared[count++] = {i, j};
    if (count == 0) return !are_apart(p, q);
    if (count == 1) {
        // If they meet in more than the corner, the far side of one of them intersects the other.
        const auto [i, j] = shared[0];
        return !are_apart(Segment{p[(i + 1) % 3], p[(i + 2) % 3]}, q) ||
               !are_apart(Segment{q[(j + 1) % 3], q[(j + 2) % 3]}, p);
    }
    if (count == 3) return true;
    // They meet in more than the edge only if they are folded flat onto each other.
    const std::size_t i = 3 - shared[0][0] - shared[1][0];
    const std::size_t j = 3 - shared[0][1] - shared[1][1];
    const glm::dvec3 start = p[(i + 1) % 3];
    const glm::dvec3 edge = p[(i + 2) % 3] - start;
    const auto off_edge = [&](const glm::dvec3& corner) {
        const glm::dvec3 d = corner - start;
        return d - edge * (glm::dot(d, edge) / glm::dot(edge, edge));
    };
    const glm::dvec3 u = off_edge(p[i]), v = off_edge(q[j]);
    return glm::dot(u, v) > 0.0 && glm::length(glm::cross(u, v)) <=
                                       k_rounding *
                                           (glm::length(p[i] - start) + glm::length(q[j] - start)) *
                                           std::max(glm::length(u), glm::length(v));
}

// Of faces, around one point.
class SumOfVolumes {
public:
    explicit SumOfVolumes(const glm::dvec3& origin) : origin_(origin) {}

    void add(Corners corners) {
        for (glm::dvec3& corner : corners) corner -= origin_;
        const double term = glm::dot(corners[0], glm::cross(corners[1], corners[2]));
        volume_ += term;
        terms_ += std::abs(term);
        products_ += glm::length(corners[0]) * glm::length(corners[1]) * glm::length(corners[2]);
        ++faces_;
    }
    void add(const SumOfVolumes& other) {
        volume_ += other.volume_;
        terms_ += other.terms_;
        products_ += other.products_;
        faces_ += other.faces_;
    }
    // By more than the rounding error. A term has at most five errors of 2^-53 times its product. The sum has one per
    // face.
    bool is_positive() const { return volume_ > 0x1p-49 * products_ + 0x1p-52 * faces_ * terms_; }

private:
    glm::dvec3 origin_;
    // Six times the volume, and two sums that bound its rounding error.
    double volume_ = 0.0, terms_ = 0.0, products_ = 0.0;
    std::uint32_t faces_ = 0;
};

glm::dvec3 first_corner(const Mesh& mesh, std::uint32_t face) { return corners_of(mesh, face)[0]; }

bool one_shell_turns_outwards(const Mesh& mesh) {
    using Range = tbb::blocked_range<std::uint32_t>;
    constexpr std::uint32_t k_faces_a_task = 1u << 14;
    const SumOfVolumes none(first_corner(mesh, 0));
    const SumOfVolumes all = tbb::parallel_deterministic_reduce(
        Range(0, mesh.face_count(), k_faces_a_task), none,
        [&](const Range& faces, SumOfVolumes sum) {
            for (std::uint32_t face = faces.begin(); face < faces.end(); ++face)
                sum.add(corners_of(mesh, face));
            return sum;
        },
        [](SumOfVolumes sum, const SumOfVolumes& other) {
            sum.add(other);
            return sum;
        });
    return all.is_positive();
}

// Whether every set of faces connected by edges encloses a positive volume.
bool shells_turn_outwards(const Mesh& mesh, const LongCall& stop) {
    if (mesh.component_count() == 1) return one_shell_turns_outwards(mesh);
    std::vector<std::uint8_t> seen(mesh.face_count(), 0);
    std::vector<std::uint32_t> open;
    std::uint32_t faces = 0;
    for (std::uint32_t first = 0; first < mesh.face_count(); ++first) {
        if (seen[first]) continue;
        SumOfVolumes sum(first_corner(mesh, first));
        seen[first] = 1;
        open.assign(1, first);
        while (!open.empty()) {
            const std::uint32_t face = open.back();
            open.pop_back();
            sum.add(corners_of(mesh, face));
            if (++faces % k_solid_faces_a_checkpoint == 0) stop.checkpoint(0.0);
            for (const EdgeId edge : mesh.edges_of(FaceId{face}))
                for (const FaceId next : mesh.edge(edge).faces)
                    if (!seen[index(next)]) {
                        seen[index(next)] = 1;
                        open.push_back(index(next));
                    }
        }
        if (!sum.is_positive()) return false;
    }
    return true;
}

std::uint64_t max_pairs(const Mesh& mesh) {
    return std::max(k_pairs_a_face * mesh.face_count(), k_min_pairs);
}

bool may_be_solid(const Mesh& mesh, const LongCall& call) {
    const LongCall stop{call.stop, {}};
    return mesh.face_count() > 0 &&
           mesh.edges_of_class(EdgeClass::regular).size() == mesh.edge_count() &&
           std::ranges::all_of(mesh.planes(), &Plane::has_normal) &&
           shells_turn_outwards(mesh, stop);
}

bool meets_itself_nowhere(const Mesh& mesh, const FaceTree& tree, const LongCall& call) {
    return each_near_face_pair(
        mesh, tree,
        [&](std::span<const FacePair> pairs) {
            return std::ranges::none_of(
                pairs, [&](const FacePair& pair) { return meet_elsewhere(mesh, pair); });
        },
        call, max_pairs(mesh));
}

}  // namespace

bool is_solid(const Mesh& mesh, const LongCall& call) {
    return may_be_solid(mesh, call) &&
           meets_itself_nowhere(mesh, FaceTree(mesh, {call.stop, {}}), call);
}

bool is_solid(const Mesh& mesh, const FaceTree& tree, const LongCall& call) {
    return may_be_solid(mesh, call) && meets_itself_nowhere(mesh, tree, call);
}

}  // namespace rimline
