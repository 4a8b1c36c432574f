#include "silhouette/lines/line_events.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "silhouette/error.h"
#include "silhouette/lines/coincident_lines.h"
#include "silhouette/lines/contact_places.h"
#include "silhouette/lines/cross_2d.h"
#include "silhouette/lines/exact_signs.h"
#include "silhouette/lines/local_rule.h"
#include "silhouette/mesh/opposite_corner.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_no_line = 0xffffffffu;
// A line may meet all others in the picture.
constexpr std::uint32_t k_lines_a_stop_test = 64;
// In radii: of a segment of an intersection and a line so near to each other in depth, either may lie in front.
constexpr double k_depth_slack = 0x1p-40;

double length_1(const glm::dvec2& u) { return std::abs(u.x) + std::abs(u.y); }

// A turn in the picture, cross_2d(u, v), errs by less than this times the sum of length_1 of u and v and times the
// greatest coordinate, of which each coordinate errs by a few 2^-53.
constexpr double k_turn_error = 0x1p-46;

// The turn a -> b -> c in the picture, where doubles decide it.
int turn_in_picture(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, double size) {
    const glm::dvec2 u = b - a, v = c - a;
    const double turn = cross_2d(u, v), bound = k_turn_error * size * (length_1(u) + length_1(v));
    return turn > bound ? 1 : (-turn > bound ? -1 : 0);
}

// On which sides of each other the ends of two segments of the picture lie, left being positive.
struct SegmentTurns {
    // Without branches: most pairs do not cross, but which of the turns says so is as good as random.
    SegmentTurns(const std::array<glm::dvec2, 2>& line, const std::array<glm::dvec2, 2>& other,
                 double size) {
        const glm::dvec2 u = line[1] - line[0], v = other[1] - other[0], w = other[0] - line[0];
        others = {cross_2d(u, w), cross_2d(u, other[1] - line[0])};
        own = {cross_2d(v, line[0] - other[0]), cross_2d(v, line[1] - other[0])};
        const double least = std::min(std::min(std::abs(others[0]), std::abs(others[1])),
                                      std::min(std::abs(own[0]), std::abs(own[1])));
        // No other vector that the turns are made of is longer than w and one of the two.
        is_sure = least > k_turn_error * size * (length_1(u) + length_1(v) + length_1(w));
    }
    bool cross() const {
        return ((others[0] > 0.0) != (others[1] > 0.0)) & ((own[0] > 0.0) != (own[1] > 0.0));
    }
    std::array<double, 2> own, others;
    bool is_sure;  // Doubles decide all four.
};

struct CrossingPlace {
    double share, other_share;
};

// Where the lines through two segments of the picture cross.
CrossingPlace crossing_of(const FlatLine& a, const FlatLine& b) {
    const glm::dvec2 u = a.ends[1] - a.ends[0], v = b.ends[1] - b.ends[0];
    const double turn = cross_2d(u, v);
    if (turn == 0.0) return {0.5, 0.5};
    const glm::dvec2 w = b.ends[0] - a.ends[0];
    return {cross_2d(w, v) / turn, cross_2d(w, u) / turn};
}

}  // namespace

void LineEvents::fill_tree(const LineFrame& frame, double margin) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const FlatLine& flat : frame.flats)
        for (const std::size_t k : {0, 1}) {
            low = glm::min(low, glm::dvec3(flat.ends[k], flat.depths[k]));
            high = glm::max(high, glm::dvec3(flat.ends[k], flat.depths[k]));
        }
    const PictureSteps steps(low, high);
    tree_.clear();
    for (std::size_t i = 0; i < frame.lines.size(); ++i) {
        const auto& [ends, depths, shares] = frame.flats[i];
        const bool may_lie_before = frame.lines[i].is_drawn || frame.lines[i].balance != 0;
        const glm::dvec3 a(ends[0], depths[0]), b(ends[1], depths[1]);
        tree_.add(steps.box(a, b), may_lie_before ? steps.box(a, b, margin) : k_empty_picture_box);
    }
    tree_.finish();
}

void LineEvents::find_crossings(LineFrame& frame, bool finds_parallels,
                                const std::stop_token& stop) {
    // Lines that coincide lie beside each other by up to the tolerance, and so may their boxes.
    const double tolerance = coincidence_tolerance(frame);
    fill_tree(frame, finds_parallels ? tolerance : 0.0);
    // Lines that are near enough to coincide meet as (line, other) and as (other, line), unless one of them lies
    // behind.
    const auto meets_again = [&](std::uint32_t line, std::uint32_t other) {
        const auto& own = frame.flats[line].depths;
        const auto& others = frame.flats[other].depths;
        return line > other && std::min(own[0], own[1]) <= std::max(others[0], others[1]);
    };
    const LongCall call{stop, {}};
    tree_.each_pair([&](std::uint32_t line, std::uint32_t other) {
        if (line == other) {
            if (line % k_lines_a_stop_test == 0) call.checkpoint(0.0);
            return;
        }
        if (finds_parallels && frame.lines[line].is_drawn && frame.lines[other].is_drawn &&
            !meets_again(line, other) &&
            may_coincide(frame.flats[line], frame.flats[other], tolerance))
            frame.parallels.push_back({std::min(line, other), std::max(line, other)});
        if (frame.lines[other].balance == 0) return;
        if (line < frame.edge_lines)
            cross(frame, line, other);
        else
            cross_segment(frame, line, other);
    });
}

void LineEvents::cross(LineFrame& frame, std::uint32_t i, std::uint32_t occluder) {
    const ViewLine &line = frame.lines[i], &other = frame.lines[occluder];
    const auto [v, w] = line.vertices;
    const auto [c, d] = other.vertices;
    if (v == c || v == d || w == c || w == d) return;
    const FlatLine& flat = frame.flats[i];
    // Picture coordinates of an end that was cut are not those of its vertex.
    const bool is_cut = line.is_cut[0] || line.is_cut[1] || other.is_cut[0] || other.is_cut[1];
    const SegmentTurns turns(flat.ends, frame.flats[occluder].ends, frame.picture_size);
    int side_c, side_w;
    if (turns.is_sure && !is_cut) {
        if (!turns.cross()) return;
        side_c = turns.others[0] > 0.0 ? 1 : -1;
        side_w = turns.own[1] > 0.0 ? 1 : -1;
    } else {
        const auto side = [&](std::uint32_t a, std::uint32_t b, std::uint32_t p) {
            return seen_side(frame.view->point(), frame.position(a), frame.position(b),
                             frame.position(p));
        };
        side_c = side(v, w, c);
        if (side_c * side(v, w, d) >= 0) return;
        side_w = side(c, d, w);
        if (side_w * side(c, d, v) >= 0) return;
    }
    const CrossingPlace place = crossing_of(flat, frame.flats[occluder]);
    // Where a line has an end behind the eye, the two may cross behind the eye.
    if (is_cut && !(place.share >= 0.0 && place.share <= 1.0 && place.other_share >= 0.0 &&
                    place.other_share <= 1.0))
        return;
    const int depth =
        plane_side(frame.position(v), frame.position(w), frame.position(c), frame.position(d));
    if (depth != side_c) return;  // It lies behind; or they meet, which is a contact.
    found_.push_back({i, side_w * other.balance, std::clamp(place.share, 0.0, 1.0)});
    ++frame.report.crossings;
}

void LineEvents::add_contact(LineFrame& frame, std::uint32_t line, std::int32_t jump,
                             double share_in_space) {
    ++frame.report.contacts;
    const FlatLine& flat = frame.flats[line];
    if (jump == 0 || share_in_space < flat.shares[0] || share_in_space > flat.shares[1]) return;
    const double share = flat.share_in_picture(share_in_space, frame.view->is_orthographic());
    found_.push_back({line, jump, std::clamp(share, 0.0, 1.0)});
}

void LineEvents::find_contacts(LineFrame& frame) {
    if (frame.surface->contacts().empty()) return;
    line_of_edge_.assign(frame.surface->mesh().edge_count(), k_no_line);
    for (std::uint32_t i = 0; i < frame.edge_lines; ++i) line_of_edge_[frame.lines[i].source] = i;
    add_piercings(frame);
    add_edge_crossings(frame);
    add_footholds(frame);
}

void LineEvents::add_piercings(LineFrame& frame) {
    for (const auto& [edge, face] : frame.surface->contacts().piercings) {
        const std::uint32_t i = line_of_edge_[edge];
        if (i == k_no_line) continue;
        const auto [v, w] = frame.lines[i].vertices;
        const Triangle& t = frame.surface->mesh().triangles()[face];
        const double share =
            share_to_plane(frame.position(v), frame.position(w), frame.position(index(t[0])),
                           frame.position(index(t[1])), frame.position(index(t[2])));
        add_contact(frame, i, lies_before(frame, face, w) ? 1 : -1, share);
    }
}

void LineEvents::add_edge_crossings(LineFrame& frame) {
    const Mesh& mesh = frame.surface->mesh();
    const auto seen = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return seen_side(frame.view->point(), frame.position(a), frame.position(b),
                         frame.position(c));
    };
    for (const auto& [edge, other] : frame.surface->contacts().crossings) {
        const std::uint32_t i = line_of_edge_[edge];
        if (i == k_no_line) continue;
        const auto [v, w] = frame.lines[i].vertices;
        const std::uint32_t c = index(mesh.edges()[other].vertices[0]);
        const std::uint32_t d = index(mesh.edges()[other].vertices[1]);
        const int side_w = seen(c, d, w);
        std::int32_t jump = 0;
        for (const FaceId face : mesh.faces_of(EdgeId{other}))
            for (const VertexId corner : mesh.triangles()[index(face)]) {
                if (index(corner) == c || index(corner) == d) continue;
                const int side = seen(c, d, index(corner));
                if (side == 0) continue;  // A face without an area.
                const bool is_after = side == side_w;
                if (lies_before(frame, index(face), is_after ? w : v)) jump += is_after ? 1 : -1;
            }
        add_contact(frame, i, jump,
                    share_to_crossing(frame.position(v), frame.position(w), frame.position(c),
                                      frame.position(d)));
    }
}

void LineEvents::add_footholds(LineFrame& frame) {
    const Mesh& mesh = frame.surface->mesh();
    for (const auto& [edge, vertex] : frame.surface->contacts().footholds) {
        const std::uint32_t i = line_of_edge_[edge];
        if (i == k_no_line) continue;
        const auto [v, w] = frame.lines[i].vertices;
        std::int32_t jump = 0;
        // Faces that the vertex only touches are met by the edge itself, or its own.
        for (const std::uint32_t face : frame.surface->stars().faces(vertex)) {
            const Triangle& t = mesh.triangles()[face];
            if (has_corner(t, VertexId{v}) && has_corner(t, VertexId{w})) continue;
            if (covers(frame, face, k_corner, vertex, w) && lies_before(frame, face, w)) ++jump;
            if (covers(frame, face, k_corner, vertex, v) && lies_before(frame, face, v)) --jump;
        }
        const glm::dvec3 from(frame.position(v));
        const glm::dvec3 way = glm::dvec3(frame.position(w)) - from;
        add_contact(frame, i, jump,
                    glm::dot(way, glm::dvec3(frame.position(vertex)) - from) / glm::dot(way, way));
    }
}

// The ends of a segment are rounded, and segments that share a node share its position. So a line passes behind
// the chain of segments where it does exactly, but perhaps beside the segment that says so. A segment is doubtful
// where an occluder passes so near to it that doubles do not decide on which side, or which lies in front.
void LineEvents::cross_segment(LineFrame& frame, std::uint32_t i, std::uint32_t occluder) {
    const IntersectionCurves& curves = frame.surface->curves();
    const IntersectionCurves::Segment& segment = curves.segments()[frame.lines[i].source];
    const ViewLine& other = frame.lines[occluder];
    // The edges of its own faces do not pass before it, and those at its ends are up to the local rule.
    for (const FaceId face : frame.surface->mesh().faces_of(EdgeId{other.source}))
        if (index(face) == segment.faces[0] || index(face) == segment.faces[1]) return;
    for (const std::uint32_t node : segment.nodes)
        if (curves.vertex(node) == other.vertices[0] || curves.vertex(node) == other.vertices[1])
            return;
    const FlatLine& flat = frame.flats[i];
    const auto& [a, b] = flat.ends;
    const auto& [p, q] = frame.flats[occluder].ends;
    bool is_sure = true;
    const auto side = [&](const glm::dvec2& u, const glm::dvec2& v, const glm::dvec2& x) {
        const int turn = turn_in_picture(u, v, x, frame.picture_size);
        if (turn != 0) return turn;
        is_sure = false;
        return cross_2d(v - u, x - u) >= 0.0 ? 1 : -1;
    };
    const int side_b = side(p, q, b);
    const bool is_crossed = side(a, b, p) != side(a, b, q) && side(p, q, a) != side_b;
    if (!is_crossed && is_sure) return;
    const auto depth_at = [&](const FlatLine& line, double share) {
        return frame.view->is_orthographic()
                   ? glm::mix(line.depths[0], line.depths[1], share)
                   : 1.0 / glm::mix(1.0 / line.depths[0], 1.0 / line.depths[1], share);
    };
    const CrossingPlace place = crossing_of(flat, frame.flats[occluder]);
    const double share = std::clamp(place.share, 0.0, 1.0);
    const double behind = depth_at(flat, share) -
                          depth_at(frame.flats[occluder], std::clamp(place.other_share, 0.0, 1.0));
    const double slack = k_depth_slack * frame.surface->mesh().radius();
    if (!(behind > -slack)) return;
    if (!is_sure || behind < slack) frame.set_doubtful(i);
    found_.push_back({i, is_crossed && behind > 0.0 ? side_b * other.balance : 0, share});
    ++frame.report.crossings;
}

// Where segments of intersections pass through faces.
void LineEvents::add_passages(LineFrame& frame) {
    const Mesh& mesh = frame.surface->mesh();
    for (std::uint32_t i = frame.edge_lines; i < frame.lines.size(); ++i) {
        for (const auto& [kind, face, share] :
             frame.surface->curves().passages(frame.lines[i].source)) {
            if (kind != IntersectionCurves::Passage::Kind::through) frame.set_doubtful(i);
            const Triangle& t = mesh.triangles()[face];
            const auto corner = [&](std::size_t k) {
                return glm::dvec3(frame.position(index(t[k])));
            };
            const glm::dvec3 n = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
            const int facing = seen_side(frame.view->point(), frame.position(index(t[0])),
                                         frame.position(index(t[1])), frame.position(index(t[2])));
            const double after = glm::dot(n, frame.end_of(frame.lines[i], 1) - corner(0));
            add_contact(frame, i, (after < 0.0) == (facing > 0) ? 1 : -1, share);
        }
    }
}

// By line, then by share.
void LineEvents::sort(LineFrame& frame) {
    frame.event_begin.assign(frame.lines.size() + 1, 0);
    for (const LineEvent& event : found_) ++frame.event_begin[event.line + 1];
    for (std::size_t i = 0; i < frame.lines.size(); ++i)
        frame.event_begin[i + 1] += frame.event_begin[i];
    frame.events.resize(found_.size());
    next_.assign(frame.event_begin.begin(), frame.event_begin.end() - 1);
    for (const LineEvent& event : found_) frame.events[next_[event.line]++] = event;
    for (std::size_t i = 0; i < frame.lines.size(); ++i)
        std::sort(frame.events.begin() + frame.event_begin[i],
                  frame.events.begin() + frame.event_begin[i + 1],
                  [](const LineEvent& a, const LineEvent& b) {
                      return a.share != b.share ? a.share < b.share : a.jump < b.jump;
                  });
}

void LineEvents::find(LineFrame& frame, bool finds_parallels, const std::stop_token& stop) {
    found_.clear();
    frame.parallels.clear();
    if (!frame.lines.empty()) {
        find_crossings(frame, finds_parallels, stop);
        find_contacts(frame);
        add_passages(frame);
    }
    sort(frame);
}

}  // namespace rimline
