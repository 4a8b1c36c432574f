#include "silhouette/lines/local_rule.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>
#include <span>

#include "silhouette/lines/exact_signs.h"

namespace rimline {

namespace {

// So far ahead the stars of lines are asked for, which lie anywhere in memory.
constexpr std::uint32_t k_lines_ahead = 8;

// The sides of one line: the plane through the eye and the line.
class LineSides {
public:
    LineSides(const LineFrame& frame, std::uint32_t v, std::uint32_t w)
        : frame_(frame),
          point_(frame.view->point()),
          v_(v),
          w_(w),
          from_(frame.position(v)),
          way_(glm::dvec3(frame.position(w)) - from_),
          towards_(towards_eye(from_)),
          normal_(glm::cross(towards_, way_)),
          bound_(k_determinant_error * length_1(towards_) * length_1(way_)) {}

    // The side of vertex x, of which q is the difference to a point of the line.
    int side_of(std::uint32_t x, const glm::dvec3& q) const {
        const double side = glm::dot(normal_, q);
        const double bound = bound_ * length_1(q);
        // Without a branch on the sign, which is either one at random.
        const int sign = int(side > bound) - int(-side > bound);
        return sign != 0 ? sign : exact_side_of(x);
    }
    int exact_side_of(std::uint32_t x) const {
        return seen_side(point_, frame_.position(v_), frame_.position(w_), frame_.position(x));
    }
    struct Locals {
        // How many of the faces at the end hide the line there.
        std::int32_t count = 0;
        // Of the line's own faces, those left of it minus those right of it.
        std::int32_t balance = 0;
    };
    // At the first vertex (turn 1) or the second (turn -1). Of both the balance is the same.
    Locals locals_at(int turn) const {
        const std::uint32_t v = turn > 0 ? v_ : w_, w = turn > 0 ? w_ : v_;
        const Corner corner{v, w, turn, glm::dvec3(frame_.position(v)), double(turn) * way_};
        Locals locals;
        std::span<const VertexStars::Link> links = frame_.surface->stars().links(v);
        for (; !links.empty(); links = links.subspan(std::min(links.size(), k_links_at_once)))
            add_links(corner, links.first(std::min(links.size(), k_links_at_once)), locals);
        if (frame_.surface->has_touches(v))
            for (const FaceContacts::Touch& touch : frame_.surface->contacts().touches_of(v))
                if (covers(frame_, touch.face, touch.side, v, w) &&
                    lies_before(frame_, touch.face, w))
                    ++locals.count;
        return locals;
    }

private:
    // An end of the line: vertex v, and from it the way to w.
    struct Corner {
        std::uint32_t v, w;
        int turn;
        glm::dvec3 from, way;
    };
    static constexpr std::size_t k_links_at_once = 32;

    // Without branches on sides and numbers, which are as good as random: bits of links where a or b lies left or right.
    void add_links(const Corner& corner, std::span<const VertexStars::Link> links,
                   Locals& locals) const {
        std::array<glm::dvec3, k_links_at_once> ways;
        std::uint32_t left_b = 0, right_b = 0, ends_b = 0, follows = 0;
        std::uint32_t last = links.back()[1];  // A closed star follows itself.
        for (std::size_t i = 0; i < links.size(); ++i) {
            const auto [a, b] = links[i];
            ways[i] = glm::dvec3(frame_.position(b)) - corner.from;
            const double side = glm::dot(normal_, ways[i]), bound = bound_ * length_1(ways[i]);
            left_b |= std::uint32_t{side > bound} << i;
            right_b |= std::uint32_t{-side > bound} << i;
            ends_b |= std::uint32_t{b == corner.w} << i;
            follows |= std::uint32_t{a == last} << i;
            last = b;
        }
        left_b &= ~ends_b, right_b &= ~ends_b;
        const auto all = static_cast<std::uint32_t>((std::uint64_t{1} << links.size()) - 1);
        for (std::uint32_t unsure = all & ~(left_b | right_b | ends_b); unsure != 0;
             unsure &= unsure - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(unsure));
            const int side = exact_side_of(links[i][1]);
            left_b |= std::uint32_t{side > 0} << i;
            right_b |= std::uint32_t{side < 0} << i;
        }
        const auto before = [&](std::uint32_t bits) {
            return follows & (bits << 1 | bits >> (links.size() - 1));
        };
        std::uint32_t left_a = before(left_b), right_a = before(right_b), ends_a = before(ends_b);
        for (std::uint32_t rest = all & ~follows; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(rest));
            const std::uint32_t a = links[i][0];
            if (a == corner.w) {
                ends_a |= 1u << i;
                continue;
            }
            const int side = side_of(a, glm::dvec3(frame_.position(a)) - corner.from);
            left_a |= std::uint32_t{side > 0} << i;
            right_a |= std::uint32_t{side < 0} << i;
        }
        const auto bits = [](std::uint32_t a, std::uint32_t b) {
            return std::popcount(std::uint64_t{a} << 32 | b);
        };
        locals.balance +=
            bits(ends_a & left_b, ends_b & left_a) - bits(ends_a & right_b, ends_b & right_a);
        for (std::uint32_t rest = (left_a & right_b) | (right_a & left_b); rest != 0;
             rest &= rest - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(rest));
            const auto [a, b] = links[i];
            const int side_b = (left_b >> i & 1u) != 0 ? corner.turn : -corner.turn;
            locals.count += hides(corner.v, corner.w, a, b, side_b,
                                  glm::dvec3(frame_.position(a)) - corner.from, ways[i],
                                  towards_eye(corner.from), corner.way);
        }
    }

    // Whether face (v, a, b) hides w, where a and b lie on different sides, b on side sb.
    bool hides(std::uint32_t v, std::uint32_t w, std::uint32_t a, std::uint32_t b, int sb,
               const glm::dvec3& qa, const glm::dvec3& qb, const glm::dvec3& towards,
               const glm::dvec3& way) const {
        const glm::dvec3 n = glm::cross(qa, qb);
        const double size = length_1(qa) * length_1(qb);
        const auto sign_along = [&](const glm::dvec3& d, auto&& exact) {
            const double value = glm::dot(n, d);
            const double bound = k_determinant_error * size * length_1(d);
            if (value > bound) return 1;
            if (-value > bound) return -1;
            return exact();
        };
        const auto at = [&](std::uint32_t x) { return frame_.position(x); };
        if (sign_along(towards, [&] { return seen_side(point_, at(v), at(a), at(b)); }) != sb)
            return false;
        return sign_along(way, [&] { return plane_side(at(v), at(a), at(b), at(w)); }) == -sb;
    }

    glm::dvec3 towards_eye(const glm::dvec3& from) const {
        const glm::dvec3 p(point_.xyz());
        return point_.is_direction() ? p : p - from;
    }

    const LineFrame& frame_;
    const HomogeneousPoint& point_;
    std::uint32_t v_, w_;
    glm::dvec3 from_, way_, towards_, normal_;
    double bound_;
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
    frame.locals.resize(frame.edge_lines);
    for (std::uint32_t i = 0; i < frame.edge_lines; ++i) {
        if (i + k_lines_ahead < frame.edge_lines)
            for (const std::uint32_t vertex : frame.lines[i + k_lines_ahead].vertices)
                frame.surface->stars().fetch(vertex);
        ViewLine& line = frame.lines[i];
        const auto [v, w] = line.vertices;
        const LineSides sides(frame, v, w);
        const LineSides::Locals first = sides.locals_at(1), second = sides.locals_at(-1);
        line.balance = first.balance;
        const EdgeClass kind = mesh.edge_class(EdgeId{line.source});
        if (line.kind == LineKind::silhouette && line.balance == 0 &&
            (kind == EdgeClass::regular || kind == EdgeClass::inconsistent)) {
            line.kind = LineKind::crease;
            line.is_drawn =
                draws_creases && frame.surface->bends_rad()[line.source] >= crease_angle_rad;
        }
        frame.locals[i] = {line.is_cut[0] ? 0 : first.count, line.is_cut[1] ? 0 : second.count};
    }
}

}  // namespace rimline
