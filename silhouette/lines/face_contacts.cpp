#include "silhouette/lines/face_contacts.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>

#include "silhouette/lines/exact_signs.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_contact_faces_a_task = 1u << 10;
constexpr std::size_t k_contact_tasks_a_checkpoint = 64;

// A face with what most pairs of faces need: a quick and certain test that they are apart. All differences of
// coordinates are taken first, so floats decide it wherever faces are not nearly coplanar.
class TestedFace {
public:
    /// Undefined.
    TestedFace() = default;
    /// `scale`, a power of two, makes the mesh about as large as 1, so that no product leaves the range of floats.
    TestedFace(const Mesh& mesh, std::uint32_t face, float scale)
        : vertices_(mesh.triangles()[face]) {
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 p = mesh.positions()[index(vertices_[k])] * scale;
            x_[k] = p.x, y_[k] = p.y, z_[k] = p.z;
        }
        const glm::vec3 u = corner(1) - corner(0), v = corner(2) - corner(0);
        const glm::vec3 n = glm::cross(u, v);
        x_[3] = n.x, y_[3] = n.y, z_[3] = n.z;
        bound_ = k_error * length_1(u) * length_1(v);
    }

    FaceBox box() const {
        return {glm::min(glm::min(corner(0), corner(1)), corner(2)),
                glm::max(glm::max(corner(0), corner(1)), corner(2))};
    }

    // Whether all corners of `other` but those that this face has lie on one side of its plane, certainly. Then
    // the two meet in what they share only. False where all are shared.
    bool is_beside(const TestedFace& other) const {
        std::array<float, 4> height, bound;
        for (std::size_t k = 0; k < 4; ++k) {  // Four lanes, of which three count.
            const float x = other.x_[k] - x_[0], y = other.y_[k] - y_[0], z = other.z_[k] - z_[0];
            height[k] = x_[3] * x + y_[3] * y + z_[3] * z;
            bound[k] = bound_ * (std::abs(x) + std::abs(y) + std::abs(z)) + k_least;
        }
        int sides = 0;
        for (std::size_t k = 0; k < 3; ++k)
            sides |= has(other.vertices_[k]) ? 0 : side(height[k], bound[k]);
        return sides == k_left || sides == k_right;
    }

    // Whether no side of this face touches `other` outside of shared corners, certainly.
    bool passes_by(const TestedFace& other) const {
        std::array<int, 3> sides;
        for (std::size_t k = 0; k < 3; ++k) {
            sides[k] = other.has(vertices_[k]) ? k_shared : other.side_of(corner(k));
            if (sides[k] == k_unknown) return false;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            if (sides[k] + sides[next] != k_left + k_right) continue;
            const int turns = turn_of(k, next, other.corner(0), other.corner(1)) |
                              turn_of(k, next, other.corner(1), other.corner(2)) |
                              turn_of(k, next, other.corner(2), other.corner(0));
            if ((turns & (k_left | k_right)) != (k_left | k_right)) return false;
        }
        return true;
    }

private:
    // Sides are bits, so that several can be collected.
    static constexpr int k_left = 1, k_right = 2, k_unknown = 4, k_shared = 8;
    // Sixteen roundings, relative; and more than what is lost where numbers are subnormal.
    static constexpr float k_error = 0x1p-20f, k_least = 0x1p-120f;

    glm::vec3 corner(std::size_t k) const { return {x_[k], y_[k], z_[k]}; }
    bool has(VertexId v) const {
        return (int(v == vertices_[0]) | int(v == vertices_[1]) | int(v == vertices_[2])) != 0;
    }
    static float length_1(const glm::vec3& v) {
        return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
    }
    static int side(float height, float bound) {
        return height > bound ? k_left : (-height > bound ? k_right : k_unknown);
    }
    int side_of(const glm::vec3& p) const {
        const glm::vec3 q = p - corner(0);
        return side(x_[3] * q.x + y_[3] * q.y + z_[3] * q.z, bound_ * length_1(q) + k_least);
    }
    // On which side of the line a -> b the line through two corners passes.
    int turn_of(std::size_t from, std::size_t to, const glm::vec3& a, const glm::vec3& b) const {
        const glm::vec3 u = corner(to) - corner(from), v = a - corner(from), w = b - corner(from);
        return side(glm::dot(glm::cross(u, v), w),
                    k_error * length_1(u) * length_1(v) * length_1(w) + k_least);
    }

    // Of the corners, and in the last lane of the normal. 64 bytes in all: a line of the cache.
    std::array<float, 4> x_, y_, z_;
    Triangle vertices_;
    float bound_;
};
static_assert(sizeof(TestedFace) == 64);

// By place in the order of the tree, so that faces that may meet lie near each other.
class TestedFaces {
public:
    TestedFaces(const Mesh& mesh, const FaceTree& tree)
        : faces_(std::make_unique_for_overwrite<TestedFace[]>(mesh.face_count())) {
        const float scale =
            mesh.radius() > 0.0 ? static_cast<float>(std::exp2(-std::ilogb(mesh.radius()))) : 1.0f;
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mesh.face_count(), 4096),
                          [&](const auto& run) {
                              for (std::uint32_t i = run.begin(); i < run.end(); ++i)
                                  faces_[i] = TestedFace(mesh, tree.order()[i], scale);
                          });
    }

    // Calls visit(i, j) for the pairs of faces of two leaves that may meet.
    template <typename Visit>
    void each_pair(const FaceTree::Node& a, const FaceTree::Node& b, Visit&& visit) const {
        const bool is_same = a.number == b.number;
        std::array<FaceBox, FaceTree::k_leaf_faces> boxes;
        FaceBox all;
        for (std::uint32_t j = b.first; j < b.last; ++j)
            all.include(boxes[j - b.first] = faces_[j].box());
        for (std::uint32_t i = a.first; i < a.last; ++i) {
            const FaceBox box = faces_[i].box();
            if (!box.meets(all)) continue;
            for (std::uint32_t j = is_same ? i + 1 : b.first; j < b.last; ++j)
                if (box.meets(boxes[j - b.first]) && !faces_[i].is_beside(faces_[j]) &&
                    !faces_[j].is_beside(faces_[i]) &&
                    !(faces_[i].passes_by(faces_[j]) && faces_[j].passes_by(faces_[i])))
                    visit(i, j);
        }
    }

private:
    std::unique_ptr<TestedFace[]> faces_;
};

// The contacts of one pair of faces after the other.
class ContactSearch {
public:
    ContactSearch(const Mesh& mesh, std::span<const std::uint8_t> is_flat)
        : mesh_(mesh), positions_(mesh.positions()), is_flat_(is_flat) {}

    void add_pair(std::uint32_t f, std::uint32_t g) {
        const Triangle &a = mesh_.triangles()[f], &b = mesh_.triangles()[g];
        if (!has_edges(f) || !has_edges(g)) return;
        if (is_apart(a, g, b) || is_apart(b, f, a)) return;
        add_corners(f, g);
        add_corners(g, f);
        add_sides(f, g);
        add_sides(g, f);
    }

    FaceContacts found;

private:
    static bool is_corner(const Triangle& t, VertexId v) {
        return t[0] == v || t[1] == v || t[2] == v;
    }
    bool has_edges(std::uint32_t f) const { return mesh_.edges_of(FaceId{f})[0] != k_no_edge; }
    const glm::vec3& at(VertexId v) const { return positions_[index(v)]; }
    int side_of(const Triangle& t, VertexId v) const {
        return plane_side(at(t[0]), at(t[1]), at(t[2]), at(v));
    }

    // Whether all corners of `t` that are not corners of face `g` lie on one side of its plane, so that they
    // meet in what they share only. False where all are shared: such faces have no contact either, but it
    // takes the other tests to see that no side is inside.
    bool is_apart(const Triangle& t, std::uint32_t g, const Triangle& corners) const {
        if (is_flat_[g] != 0) return false;
        int side = 0;
        for (const VertexId v : t) {
            if (is_corner(corners, v)) continue;
            const int s = side_of(corners, v);
            if (s == 0 || s == -side) return false;
            side = s;
        }
        return side != 0;
    }

    // The axis along which a face is projected to its largest area.
    int widest_axis(const Triangle& t) const {
        const glm::dvec3 a(at(t[0]));
        const glm::dvec3 n =
            glm::abs(glm::cross(glm::dvec3(at(t[1])) - a, glm::dvec3(at(t[2])) - a));
        return n.x > n.y ? (n.x > n.z ? 0 : 2) : (n.y > n.z ? 1 : 2);
    }

    // Corners of face `f` on face `g`.
    void add_corners(std::uint32_t f, std::uint32_t g) {
        if (is_flat_[g] != 0) return;
        const Triangle& t = mesh_.triangles()[g];
        for (const VertexId v : mesh_.triangles()[f]) {
            if (is_corner(t, v) || side_of(t, v) != 0) continue;
            const int drop = widest_axis(t);
            const int facing = flat_turn(drop, at(t[0]), at(t[1]), at(t[2]));
            if (facing == 0) continue;
            std::uint32_t zeros = 0, side = FaceContacts::Touch::k_inside;
            bool is_inside = true;
            for (std::uint32_t k = 0; k < 3; ++k) {
                const int s = flat_turn(drop, at(t[k]), at(t[(k + 1) % 3]), at(v));
                if (s == -facing) is_inside = false;
                if (s == 0) ++zeros, side = k;
            }
            if (!is_inside || zeros > 1) continue;  // Two zeros: on a corner, but not welded to it.
            found.touches.push_back({index(v), g, side});
            if (side < 3)
                found.footholds.push_back({index(mesh_.edges_of(FaceId{g})[side]), index(v)});
        }
    }

    // Sides of face `f` through face `g`.
    void add_sides(std::uint32_t f, std::uint32_t g) {
        if (is_flat_[g] != 0) return;
        const Triangle &a = mesh_.triangles()[f], &t = mesh_.triangles()[g];
        for (std::size_t i = 0; i < 3; ++i) {
            const VertexId v = a[i], w = a[(i + 1) % 3];
            const int shared = int(is_corner(t, v)) + int(is_corner(t, w));
            if (shared == 2) continue;
            const int from = is_corner(t, v) ? 0 : side_of(t, v);
            const int to = is_corner(t, w) ? 0 : side_of(t, w);
            if (from * to > 0) continue;
            const std::uint32_t edge = index(mesh_.edges_of(FaceId{f})[i]);
            if (from == 0 && to == 0)
                add_in_plane(edge, v, w, g, t);
            else if (shared == 0 && from * to != 0)
                add_through(edge, v, w, g, t);
        }
    }

    // Edge v-w lies in the plane of face `g`.
    void add_in_plane(std::uint32_t edge, VertexId v, VertexId w, std::uint32_t g,
                      const Triangle& t) {
        const int drop = widest_axis(t);
        for (std::size_t k = 0; k < 3; ++k) {
            const VertexId x = t[k], y = t[(k + 1) % 3];
            if (x != v && x != w && first_normal_sign(at(v), at(w), at(x)) == 0 &&
                glm::dot(glm::dvec3(at(x)) - glm::dvec3(at(v)),
                         glm::dvec3(at(w)) - glm::dvec3(at(x))) > 0.0)
                found.footholds.push_back({edge, index(x)});
            if (x == v || x == w || y == v || y == w) continue;
            if (flat_turn(drop, at(v), at(w), at(x)) * flat_turn(drop, at(v), at(w), at(y)) < 0 &&
                flat_turn(drop, at(x), at(y), at(v)) * flat_turn(drop, at(x), at(y), at(w)) < 0)
                add_crossing(edge, g, k);
        }
    }

    // The ends of edge v-w lie on different sides of face `g`.
    void add_through(std::uint32_t edge, VertexId v, VertexId w, std::uint32_t g,
                     const Triangle& t) {
        int sign = 0;
        std::array<bool, 3> is_met{};
        std::size_t met = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const int s = plane_side(at(v), at(w), at(t[k]), at(t[(k + 1) % 3]));
            if (s == 0)
                is_met[k] = true, ++met;
            else if (sign == 0)
                sign = s;
            else if (s != sign)
                return;
        }
        if (met == 0) {
            found.piercings.push_back({edge, g});
        } else if (met == 1) {
            add_crossing(edge, g, is_met[0] ? 0 : (is_met[1] ? 1 : 2));
        } else {
            // Two sides meet in a corner.
            const std::size_t corner = !is_met[0] ? 2 : (!is_met[1] ? 0 : 1);
            found.footholds.push_back({edge, index(t[corner])});
        }
    }

    void add_crossing(std::uint32_t edge, std::uint32_t g, std::size_t side) {
        const std::uint32_t other = index(mesh_.edges_of(FaceId{g})[side]);
        found.crossings.push_back({edge, other});
        found.crossings.push_back({other, edge});
    }

    const Mesh& mesh_;
    std::span<const glm::vec3> positions_;
    std::span<const std::uint8_t> is_flat_;
};

template <typename Contact>
void merge(std::vector<Contact>& all, const std::vector<Contact>& some) {
    all.insert(all.end(), some.begin(), some.end());
}

template <typename Contact>
void keep_each_once(std::vector<Contact>& contacts) {
    std::sort(contacts.begin(), contacts.end());
    contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
}

}  // namespace

std::span<const FaceContacts::Touch> FaceContacts::touches_of(std::uint32_t vertex) const noexcept {
    const auto range =
        std::ranges::equal_range(touches, vertex, {}, [](const Touch& t) { return t.vertex; });
    return {range.begin(), range.end()};
}

std::vector<std::uint8_t> find_flat_faces(const Mesh& mesh) {
    std::vector<std::uint8_t> is_flat(mesh.face_count());
    const std::span<const glm::vec3> p = mesh.positions();
    tbb::parallel_for(
        tbb::blocked_range<std::uint32_t>(0, mesh.face_count(), 4096), [&](const auto& run) {
            for (std::uint32_t f = run.begin(); f < run.end(); ++f) {
                const Triangle& t = mesh.triangles()[f];
                is_flat[f] = first_normal_sign(p[index(t[0])], p[index(t[1])], p[index(t[2])]) == 0;
            }
        });
    return is_flat;
}

FaceContacts find_face_contacts(const Mesh& mesh, const FaceTree& tree, const LongCall& call) {
    const std::vector<std::uint8_t> is_flat = find_flat_faces(mesh);
    tbb::enumerable_thread_specific<ContactSearch> searches(
        [&] { return ContactSearch(mesh, is_flat); });
    const TestedFaces faces(mesh, tree);
    const std::span<const std::uint32_t> order = tree.order();
    const std::vector<FaceTree::NodePair> pairs = tree.node_pairs(k_contact_faces_a_task);
    for (std::size_t first = 0; first < pairs.size(); first += k_contact_tasks_a_checkpoint) {
        call.checkpoint(double(first) / double(pairs.size()));
        const std::size_t last = std::min(pairs.size(), first + k_contact_tasks_a_checkpoint);
        tbb::parallel_for(first, last, [&](std::size_t task) {
            ContactSearch& search = searches.local();
            tree.each_leaf_pair(pairs[task], [&](const FaceTree::Node& a, const FaceTree::Node& b) {
                faces.each_pair(a, b, [&](std::uint32_t i, std::uint32_t j) {
                    search.add_pair(order[i], order[j]);
                });
            });
        });
    }
    FaceContacts all;
    for (const ContactSearch& search : searches) {
        merge(all.piercings, search.found.piercings);
        merge(all.crossings, search.found.crossings);
        merge(all.footholds, search.found.footholds);
        merge(all.touches, search.found.touches);
    }
    keep_each_once(all.piercings);
    keep_each_once(all.crossings);
    keep_each_once(all.footholds);
    keep_each_once(all.touches);
    return all;
}

}  // namespace rimline
