#include "silhouette/lines/local_rule.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/lines/exact_signs.h"

namespace rimline {

namespace {

// The relative error of a determinant of three differences in double: sixteen roundings.
constexpr double k_determinant_error = 0x1p-49;

double length_1(const glm::dvec3& v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

// How far ahead the faces of what comes next are asked for. Half of the time would be cache misses.
constexpr std::size_t k_ahead_of_lines = 24, k_ahead_of_stars = 16, k_ahead_of_positions = 8;

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
        if (side > bound) return 1;
        if (-side > bound) return -1;
        return seen_side(point_, frame_.position(v_), frame_.position(w_), frame_.position(x));
    }
    int side_of(std::uint32_t x) const {
        return side_of(x, glm::dvec3(frame_.position(x)) - from_);
    }

    // How many of the faces at the first vertex (turn 1) or the second (turn -1) hide the line there.
    std::int32_t count_at_end(int turn) const {
        const std::uint32_t v = turn > 0 ? v_ : w_, w = turn > 0 ? w_ : v_;
        const glm::dvec3 from(frame_.position(v));
        const glm::dvec3 way = double(turn) * way_;
        const glm::dvec3 towards = towards_eye(from);
        std::int32_t count = 0;
        std::uint32_t last = k_no_vertex;
        int last_side = 0;
        glm::dvec3 last_way(0.0);
        for (const auto& [a, b] : frame_.surface->stars().links(v)) {
            const auto way_to = [&](std::uint32_t x) {
                return glm::dvec3(frame_.position(x)) - from;
            };
            const auto side_at = [&](std::uint32_t x, const glm::dvec3& q) {
                return x == w ? 0 : turn * side_of(x, q);
            };
            const glm::dvec3 qa = a == last ? last_way : way_to(a);
            const int sa = a == last ? last_side : side_at(a, qa);
            const glm::dvec3 qb = way_to(b);
            const int sb = side_at(b, qb);
            last = b, last_side = sb, last_way = qb;
            if (sa * sb >= 0) continue;
            if (hides(v, w, a, b, sb, qa, qb, towards, way)) ++count;
        }
        if (frame_.surface->has_touches(v))
            for (const FaceContacts::Touch& touch : frame_.surface->contacts().touches_of(v))
                if (covers(frame_, touch.face, touch.side, v, w) &&
                    lies_before(frame_, touch.face, w))
                    ++count;
        return count;
    }

private:
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

void fetch_ahead(const LineFrame& frame, std::size_t place) {
    const Mesh& mesh = frame.surface->mesh();
    const VertexStars& stars = frame.surface->stars();
    const auto line_at = [&](std::size_t ahead) -> const ViewLine* {
        return place + ahead < frame.walk.size() ? &frame.lines[frame.walk[place + ahead]]
                                                 : nullptr;
    };
    if (const ViewLine* line = line_at(k_ahead_of_lines)) {
        for (const std::uint32_t v : line->vertices) stars.fetch_place(v);
        __builtin_prefetch(&mesh.edges()[line->source]);
    }
    if (const ViewLine* line = line_at(k_ahead_of_stars)) {
        for (const std::uint32_t v : line->vertices) stars.fetch_links(v);
        for (const FaceId face : mesh.edges()[line->source].faces)
            if (face != k_no_face) __builtin_prefetch(&mesh.triangles()[index(face)]);
    }
    if (const ViewLine* line = line_at(k_ahead_of_positions))
        for (const std::uint32_t v : line->vertices)
            for (const auto& [a, b] : stars.links(v)) __builtin_prefetch(&frame.position(a));
}

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
    for (std::size_t place = 0; place < frame.walk.size(); ++place) {
        fetch_ahead(frame, place);
        const std::uint32_t i = frame.walk[place];
        ViewLine& line = frame.lines[i];
        const auto [v, w] = line.vertices;
        const LineSides sides(frame, v, w);
        line.balance = 0;
        for (const FaceId face : mesh.faces_of(EdgeId{line.source}))
            for (const VertexId corner : mesh.triangles()[index(face)])
                if (index(corner) != v && index(corner) != w)
                    line.balance += sides.side_of(index(corner));
        const EdgeClass kind = mesh.edge_class(EdgeId{line.source});
        if (line.kind == LineKind::silhouette && line.balance == 0 &&
            (kind == EdgeClass::regular || kind == EdgeClass::inconsistent)) {
            line.kind = LineKind::crease;
            line.is_drawn =
                draws_creases && frame.surface->bends_rad()[line.source] >= crease_angle_rad;
        }
        frame.locals[i] = {line.is_cut[0] ? 0 : sides.count_at_end(1),
                           line.is_cut[1] ? 0 : sides.count_at_end(-1)};
    }
}

}  // namespace rimline
