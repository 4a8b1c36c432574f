#include "silhouette/lines/local_rule.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>
#include <span>

#include "silhouette/lines/exact_signs.h"

namespace rimline {

namespace {

// So far ahead the stars of nodes are asked for, which lie anywhere in memory, and half as far their corners.
constexpr std::uint32_t k_nodes_ahead = 16;
constexpr std::size_t k_links_at_once = 32;

// A vertex, and what its faces do to the lines that end there.
class VertexCorner {
public:
    VertexCorner(const LineFrame& frame, std::uint32_t vertex)
        : frame_(frame),
          point_(frame.view->point()),
          vertex_(vertex),
          from_(frame.position(vertex)),
          towards_(glm::dvec3(point_.xyz()) - (point_.is_direction() ? glm::dvec3(0.0) : from_)) {}

    // The next faces of the vertex.
    void take(std::span<const VertexStars::Link> links) {
        links_ = links;
        follows_ = 0;
        std::uint32_t last = links.back()[1];  // A closed star follows itself.
        for (std::size_t i = 0; i < links.size(); ++i) {
            const auto [a, b] = links[i];
            ways_[i] = glm::dvec3(frame_.position(b)) - from_;
            follows_ |= std::uint32_t{a == last} << i;
            last = b;
        }
    }

    struct Locals {
        // How many of the faces hide the line at the vertex.
        std::int32_t count = 0;
        // Of the line's own faces, those left of it minus those right of it, as seen from the vertex.
        std::int32_t balance = 0;
    };
    // What the faces taken do to the line to vertex w. Without branches on sides and numbers, which are as good as
    // random: bits of links where a or b lies left or right.
    Locals locals_towards(std::uint32_t w) const {
        const Line line(*this, w);
        std::uint32_t left_b = 0, right_b = 0, ends_b = 0;
        for (std::size_t i = 0; i < links_.size(); ++i) {
            const double side = glm::dot(line.normal, ways_[i]),
                         bound = line.bound * length_1(ways_[i]);
            left_b |= std::uint32_t{side > bound} << i;
            right_b |= std::uint32_t{-side > bound} << i;
            ends_b |= std::uint32_t{links_[i][1] == w} << i;
        }
        left_b &= ~ends_b, right_b &= ~ends_b;
        const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << links_.size()) - 1);
        for (std::uint32_t unsure = all & ~(left_b | right_b | ends_b); unsure != 0;
             unsure &= unsure - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(unsure));
            const int side = exact_side(w, links_[i][1]);
            left_b |= std::uint32_t{side > 0} << i;
            right_b |= std::uint32_t{side < 0} << i;
        }
        const auto before = [&](std::uint32_t bits) {
            return follows_ & (bits << 1 | bits >> (links_.size() - 1));
        };
        std::uint32_t left_a = before(left_b), right_a = before(right_b), ends_a = before(ends_b);
        for (std::uint32_t rest = all & ~follows_; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(rest));
            const std::uint32_t a = links_[i][0];
            if (a == w) {
                ends_a |= 1u << i;
                continue;
            }
            const int side = side_of(line, w, a);
            left_a |= std::uint32_t{side > 0} << i;
            right_a |= std::uint32_t{side < 0} << i;
        }
        // Mostly one bit or none, for which no instruction is needed that not every machine has.
        const auto count = [](std::uint32_t bits) {
            return (bits & (bits - 1)) == 0 ? int(bits != 0) : std::popcount(bits);
        };
        Locals locals;
        locals.balance = count(ends_a & left_b) + count(ends_b & left_a) - count(ends_a & right_b) -
                         count(ends_b & right_a);
        for (std::uint32_t rest = (left_a & right_b) | (right_a & left_b); rest != 0;
             rest &= rest - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(rest));
            locals.count += hides(line, w, i, (left_b >> i & 1u) != 0 ? 1 : -1);
        }
        return locals;
    }

private:
    // A line from the vertex: the plane through it and the eye.
    struct Line {
        Line(const VertexCorner& corner, std::uint32_t w)
            : way(glm::dvec3(corner.frame_.position(w)) - corner.from_),
              normal(glm::cross(corner.towards_, way)),
              bound(k_determinant_error * length_1(corner.towards_) * length_1(way)) {}
        glm::dvec3 way, normal;
        double bound;
    };

    int exact_side(std::uint32_t w, std::uint32_t x) const {
        return seen_side(point_, frame_.position(vertex_), frame_.position(w), frame_.position(x));
    }
    int side_of(const Line& line, std::uint32_t w, std::uint32_t x) const {
        const glm::dvec3 q = glm::dvec3(frame_.position(x)) - from_;
        const double side = glm::dot(line.normal, q), bound = line.bound * length_1(q);
        return side > bound ? 1 : (-side > bound ? -1 : exact_side(w, x));
    }

    // Whether the face of link i hides w, where a and b lie on different sides, b on side_b.
    bool hides(const Line& line, std::uint32_t w, std::uint32_t i, int side_b) const {
        const auto [a, b] = links_[i];
        const glm::dvec3 way_a = glm::dvec3(frame_.position(a)) - from_;
        const glm::dvec3 n = glm::cross(way_a, ways_[i]);
        const double size = length_1(way_a) * length_1(ways_[i]);
        const auto sign_along = [&](const glm::dvec3& d, auto&& exact) {
            const double value = glm::dot(n, d);
            const double bound = k_determinant_error * size * length_1(d);
            if (value > bound) return 1;
            if (-value > bound) return -1;
            return exact();
        };
        const auto at = [&](std::uint32_t x) { return frame_.position(x); };
        if (sign_along(towards_, [&] { return seen_side(point_, at(vertex_), at(a), at(b)); }) !=
            side_b)
            return false;
        return sign_along(line.way, [&] { return plane_side(at(vertex_), at(a), at(b), at(w)); }) ==
               -side_b;
    }

    const LineFrame& frame_;
    const HomogeneousPoint& point_;
    std::uint32_t vertex_;
    glm::dvec3 from_, towards_;
    std::span<const VertexStars::Link> links_;
    std::array<glm::dvec3, k_links_at_once> ways_;  // To the second corner of each link.
    std::uint32_t follows_ =
        0;  // Bits of links whose first corner is the second one of the link before.
};

}  // namespace

bool covers(const LineFrame& frame, std::uint32_t face, std::uint32_t side, std::uint32_t from,
            std::uint32_t to) {
    if (side == FaceContacts::Touch::k_inside) return true;
    const Triangle& t = frame.surface->mesh().triangles()[face];
    const auto seen = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return seen_side(frame.view->point(), frame.position(a), frame.position(b),
                         frame.position(c));
    };
    if (side < FaceContacts::Touch::k_inside) {
        const std::uint32_t c = index(t[side]), d = index(t[(side + 1) % 3]);
        return seen(c, d, to) == seen(c, d, index(t[(side + 2) % 3]));
    }
    const std::size_t i = index(t[0]) == from ? 0 : (index(t[1]) == from ? 1 : 2);
    const std::uint32_t a = index(t[(i + 1) % 3]), b = index(t[(i + 2) % 3]);
    const int facing = seen(from, a, b);
    return seen(from, a, to) == facing && seen(from, to, b) == facing;
}

bool lies_before(const LineFrame& frame, std::uint32_t face, std::uint32_t vertex) {
    const Triangle& t = frame.surface->mesh().triangles()[face];
    const glm::vec3 &a = frame.position(index(t[0])), &b = frame.position(index(t[1])),
                    &c = frame.position(index(t[2]));
    const int facing = seen_side(frame.view->point(), a, b, c);
    return facing != 0 && plane_side(a, b, c, frame.position(vertex)) == -facing;
}

void find_locals(LineFrame& frame, bool draws_creases, float crease_angle_rad) {
    const Mesh& mesh = frame.surface->mesh();
    const VertexStars& stars = frame.surface->stars();
    frame.locals.assign(frame.edge_lines, {0, 0});
    for (std::uint32_t node = 0; node < frame.node_vertices.size(); ++node) {
        if (node + k_nodes_ahead < frame.node_vertices.size())
            stars.fetch(frame.node_vertices[node + k_nodes_ahead]);
        if (node + k_nodes_ahead / 2 < frame.node_vertices.size())
            for (const auto& [a, b] : stars.links(frame.node_vertices[node + k_nodes_ahead / 2]))
                __builtin_prefetch(&frame.position(b));
        const std::uint32_t v = frame.node_vertices[node];
        const std::span<const LineEnd> ends = frame.ends_at(node);
        VertexCorner corner(frame, v);
        std::span<const VertexStars::Link> links = stars.links(v);
        for (; !links.empty(); links = links.subspan(std::min(links.size(), k_links_at_once))) {
            corner.take(links.first(std::min(links.size(), k_links_at_once)));
            for (const LineEnd end : ends) {
                ViewLine& line = frame.lines[end / 2];
                const bool is_second = end % 2 != 0;
                const VertexCorner::Locals locals =
                    corner.locals_towards(line.vertices[is_second ? 0 : 1]);
                frame.locals[end / 2][end % 2] += locals.count;
                // The same at both ends, of which one may be cut.
                if (!is_second)
                    line.balance += locals.balance;
                else if (line.is_cut[0])
                    line.balance -= locals.balance;
            }
        }
        if (!frame.surface->has_touches(v)) continue;
        for (const FaceContacts::Touch& touch : frame.surface->contacts().touches_of(v))
            for (const LineEnd end : ends) {
                const std::uint32_t w = frame.lines[end / 2].vertices[1 - end % 2];
                if (covers(frame, touch.face, touch.side, v, w) &&
                    lies_before(frame, touch.face, w))
                    ++frame.locals[end / 2][end % 2];
            }
    }
    for (std::uint32_t i = 0; i < frame.edge_lines; ++i) {
        ViewLine& line = frame.lines[i];
        if (line.kind != LineKind::silhouette || line.balance != 0) continue;
        const EdgeClass kind = mesh.edge_class(EdgeId{line.source});
        if (kind == EdgeClass::regular || kind == EdgeClass::inconsistent) {
            line.kind = LineKind::crease;
            line.is_drawn =
                draws_creases && frame.surface->bends_rad()[line.source] >= crease_angle_rad;
        }
    }
}

}  // namespace rimline
