#include "silhouette/mesh/solid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace rimline {

namespace {

// A projection has about twenty rounding errors of 2^-53, relative to the projected length.
constexpr double k_rounding = 0x1p-40;
constexpr std::uint32_t k_leaf_faces = 4;
constexpr std::uint32_t k_faces_a_task = 4096;
constexpr std::uint32_t k_faces_a_checkpoint = 1u << 14;
// Beyond this many pairs of overlapping boxes the test gives up. In a fan all boxes overlap at its center.
constexpr std::uint64_t k_pairs_a_face = 256;
constexpr std::uint64_t k_min_pairs = 1u << 22;

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

struct Box {
    glm::vec3 low{std::numeric_limits<float>::infinity()};
    glm::vec3 high{-std::numeric_limits<float>::infinity()};

    void include(const Box& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    bool meets(const Box& other) const {
        return glm::all(glm::lessThanEqual(low, other.high)) &&
               glm::all(glm::lessThanEqual(other.low, high));
    }
};

// A balanced tree of boxes over the faces. A node holds a range of `order_`. Its children hold one half
// each.
class FaceTree {
public:
    explicit FaceTree(const Mesh& mesh) : mesh_(mesh), order_(mesh.face_count()) {
        std::iota(order_.begin(), order_.end(), 0u);
        std::size_t nodes = 1;
        for (std::uint32_t faces = mesh.face_count(); faces > k_leaf_faces; faces -= faces / 2)
            nodes = 2 * nodes + 1;
        boxes_.resize(nodes);
        build(0, 0, mesh.face_count());
    }

    // Whether the face at `place` in the order intersects a later face outside their shared corners and
    // edges. Adds the number of tested pairs to `pairs`.
    bool meets_another(std::uint32_t place, std::uint64_t& pairs) const {
        const std::uint32_t face = order_[place];
        return meets_another(face, box_of(face), place + 1, 0, 0, mesh_.face_count(), pairs);
    }

private:
    Box box_of(std::uint32_t face) const {
        Box box;
        for (const VertexId v : mesh_.triangles()[face]) {
            const glm::vec3& p = mesh_.positions()[index(v)];
            box.include({p, p});
        }
        return box;
    }

    Corners corners_of(std::uint32_t face) const {
        Corners corners;
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = glm::dvec3(mesh_.positions()[index(mesh_.triangles()[face][i])]);
        return corners;
    }

    void build(std::size_t node, std::uint32_t first, std::uint32_t last) {
        Box box;
        for (std::uint32_t i = first; i < last; ++i) box.include(box_of(order_[i]));
        boxes_[node] = box;
        if (last - first <= k_leaf_faces) return;
        const glm::vec3 size = box.high - box.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        // The face number breaks ties, so the tree is the same on every machine.
        const auto place = [&](std::uint32_t face) {
            const Box b = box_of(face);
            return std::pair(b.low[axis] + b.high[axis], face);
        };
        const std::uint32_t middle = middle_of(first, last);
        std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                         [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
        const auto low = [&] { build(2 * node + 1, first, middle); };
        const auto high = [&] { build(2 * node + 2, middle, last); };
        if (last - first > k_faces_a_task) {
            tbb::parallel_invoke(low, high);
        } else {
            low();
            high();
        }
    }

    static std::uint32_t middle_of(std::uint32_t first, std::uint32_t last) {
        return first + (last - first) / 2;
    }

    bool meets_another(std::uint32_t face, const Box& box, std::uint32_t from, std::size_t node,
                       std::uint32_t first, std::uint32_t last, std::uint64_t& pairs) const {
        if (last <= from || !boxes_[node].meets(box)) return false;
        if (last - first > k_leaf_faces) {
            const std::uint32_t middle = middle_of(first, last);
            return meets_another(face, box, from, 2 * node + 1, first, middle, pairs) ||
                   meets_another(face, box, from, 2 * node + 2, middle, last, pairs);
        }
        for (std::uint32_t i = std::max(first, from); i < last; ++i) {
            if (!box_of(order_[i]).meets(box)) continue;
            ++pairs;
            if (meet_elsewhere(face, order_[i])) return true;
        }
        return false;
    }

    // Whether two faces may meet outside the corners and edges that they share.
    bool meet_elsewhere(std::uint32_t face, std::uint32_t other) const {
        const Triangle& a = mesh_.triangles()[face];
        const Triangle& b = mesh_.triangles()[other];
        const Corners p = corners_of(face), q = corners_of(other);
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
        return glm::dot(u, v) > 0.0 &&
               glm::length(glm::cross(u, v)) <=
                   k_rounding * (glm::length(p[i] - start) + glm::length(q[j] - start)) *
                       std::max(glm::length(u), glm::length(v));
    }

    const Mesh& mesh_;
    std::vector<std::uint32_t> order_;
    std::vector<Box> boxes_;
};

// Whether every set of faces connected by edges encloses a positive volume.
bool shells_turn_outwards(const Mesh& mesh) {
    std::vector<std::uint8_t> seen(mesh.face_count(), 0);
    std::vector<std::uint32_t> open;
    for (std::uint32_t first = 0; first < mesh.face_count(); ++first) {
        if (seen[first]) continue;
        const glm::dvec3 origin(mesh.positions()[index(mesh.triangles()[first][0])]);
        // Six times the volume, and two sums that bound its rounding error.
        double volume = 0.0, terms = 0.0, products = 0.0;
        std::uint32_t faces = 0;
        seen[first] = 1;
        open.assign(1, first);
        while (!open.empty()) {
            const std::uint32_t face = open.back();
            open.pop_back();
            ++faces;
            const auto corner = [&](std::size_t i) {
                return glm::dvec3(mesh.positions()[index(mesh.triangles()[face][i])]) - origin;
            };
            const double term = glm::dot(corner(0), glm::cross(corner(1), corner(2)));
            volume += term;
            terms += std::abs(term);
            products += glm::length(corner(0)) * glm::length(corner(1)) * glm::length(corner(2));
            for (const EdgeId edge : mesh.edges_of(FaceId{face}))
                for (const FaceId next : mesh.edge(edge).faces)
                    if (!seen[index(next)]) {
                        seen[index(next)] = 1;
                        open.push_back(index(next));
                    }
        }
        // A term has at most five rounding errors of 2^-53 times its product. The sum has one per face.
        if (!(volume > 0x1p-49 * products + 0x1p-52 * faces * terms)) return false;
    }
    return true;
}

}  // namespace

bool is_solid(const Mesh& mesh, const LongCall& call) {
    if (mesh.face_count() == 0 ||
        mesh.edges_of_class(EdgeClass::regular).size() != mesh.edge_count() ||
        !std::ranges::all_of(mesh.planes(), &Plane::has_normal) || !shells_turn_outwards(mesh))
        return false;
    const FaceTree tree(mesh);
    const std::uint64_t max_pairs = std::max(k_pairs_a_face * mesh.face_count(), k_min_pairs);
    std::atomic<std::uint64_t> all_pairs = 0;
    std::atomic<bool> is_none = false;
    for (std::uint32_t first = 0; first < mesh.face_count() && !is_none;) {
        call.checkpoint(double(first) / mesh.face_count());
        const std::uint32_t last =
            first + std::min(mesh.face_count() - first, k_faces_a_checkpoint);
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(first, last, 256),
                          [&](const auto& run) {
                              std::uint64_t pairs = 0;
                              for (std::uint32_t i = run.begin(); i < run.end() && !is_none; ++i)
                                  if (tree.meets_another(i, pairs) || all_pairs + pairs > max_pairs)
                                      is_none = true;
                              all_pairs += pairs;
                          });
        first = last;
    }
    return !is_none && all_pairs <= max_pairs;
}

}  // namespace rimline
