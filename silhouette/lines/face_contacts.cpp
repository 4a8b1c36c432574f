#include "silhouette/lines/face_contacts.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/lines/exact_signs.h"
#include "silhouette/mesh/face_pairs.h"
#include "silhouette/mesh/opposite_corner.h"

namespace rimline {

namespace {

// The contacts of one pair of faces after the other.
class ContactSearch {
public:
    ContactSearch(const Mesh& mesh, std::span<const std::uint8_t> is_flat)
        : mesh_(mesh), positions_(mesh.positions()), is_flat_(is_flat) {}

    void add_pair(std::uint32_t f, std::uint32_t g) {
        const Triangle &a = mesh_.triangles()[f], &b = mesh_.triangles()[g];
        if (!has_edges(f) || !has_edges(g)) return;
        // Before the planes: of a corner in the plane of the other they say nothing, and that takes exact sums.
        const int drop_a = widest_axis(a), drop_b = widest_axis(b);
        if (is_beside(a, b, drop_a) || (drop_b != drop_a && is_beside(a, b, drop_b))) return;
        if (is_apart(a, g, b) || is_apart(b, f, a)) return;
        add_corners(f, g);
        add_corners(g, f);
        add_sides(f, g);
        add_sides(g, f);
    }

    FaceContacts found;

private:
    bool has_edges(std::uint32_t f) const { return mesh_.edges_of(FaceId{f})[0] != k_no_edge; }
    const glm::vec3& at(VertexId v) const { return positions_[index(v)]; }
    int side_of(const Triangle& t, VertexId v) const {
        return plane_side(at(t[0]), at(t[1]), at(t[2]), at(v));
    }

    std::array<glm::dvec2, 3> projected(const Triangle& t, int drop) const {
        const int x = (drop + 1) % 3, y = (drop + 2) % 3;
        std::array<glm::dvec2, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = {at(t[k])[x], at(t[k])[y]};
        return corners;
    }

    // Whether two faces, projected along an axis, are certainly on different sides of a line, but for shared corners: then
    // they meet in shared corners and sides only. Of two faces in one plane that meet in no more, most are.
    bool is_beside(const Triangle& a, const Triangle& b, int drop) const {
        const std::array<glm::dvec2, 3> p = projected(a, drop), q = projected(b, drop);
        return has_side_between(a, p, b, q) || has_side_between(b, q, a, p);
    }

    // Whether the line along a side of `t` has `t` on one side and the corners of `other` that are not on this side of `t`
    // on the other.
    static bool has_side_between(const Triangle& t, const std::array<glm::dvec2, 3>& p,
                                 const Triangle& other, const std::array<glm::dvec2, 3>& q) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = k == 2 ? 0 : k + 1;
            const int inside = certain_turn(p[k], p[next], p[3 - k - next]);
            if (inside == 0) continue;
            bool is_between = true;
            for (std::size_t i = 0; i < 3 && is_between; ++i)
                is_between = certain_turn(p[k], p[next], q[i]) == -inside || other[i] == t[k] ||
                             other[i] == t[next];
            if (is_between) return true;
        }
        return false;
    }

    // Whether all corners of `t` that are not corners of face `g` lie on one side of its plane, so that they
    // meet in what they share only. False where all are shared: such faces have no contact either, but it
    // takes the other tests to see that no side is inside.
    bool is_apart(const Triangle& t, std::uint32_t g, const Triangle& corners) const {
        if (is_flat_[g] != 0) return false;
        int side = 0;
        for (const VertexId v : t) {
            if (has_corner(corners, v)) continue;
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
            if (has_corner(t, v) || side_of(t, v) != 0) continue;
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
            const int shared = int(has_corner(t, v)) + int(has_corner(t, w));
            if (shared == 2) continue;
            const int from = has_corner(t, v) ? 0 : side_of(t, v);
            const int to = has_corner(t, w) ? 0 : side_of(t, w);
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

std::vector<std::uint8_t> find_flat_faces(const Mesh& mesh, const std::stop_token& stop) {
    std::vector<std::uint8_t> is_flat(mesh.face_count());
    const std::span<const glm::vec3> p = mesh.positions();
    tbb::parallel_for(
        tbb::blocked_range<std::uint32_t>(0, mesh.face_count(), 4096), [&](const auto& run) {
            LongCall{stop, {}}.checkpoint(0.0);
            for (std::uint32_t f = run.begin(); f < run.end(); ++f) {
                const Triangle& t = mesh.triangles()[f];
                is_flat[f] = first_normal_sign(p[index(t[0])], p[index(t[1])], p[index(t[2])]) == 0;
            }
        });
    return is_flat;
}

FaceContacts find_face_contacts(const Mesh& mesh, const FaceTree& tree,
                                std::span<const std::uint8_t> is_flat, const LongCall& call) {
    tbb::enumerable_thread_specific<ContactSearch> searches(
        [&] { return ContactSearch(mesh, is_flat); });
    each_near_face_pair(
        mesh, tree,
        [&](std::span<const FacePair> pairs) {
            ContactSearch& search = searches.local();
            for (const FacePair& pair : pairs) search.add_pair(pair.a, pair.b);
            return true;
        },
        call);
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
