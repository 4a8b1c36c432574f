#include "silhouette/lines/curve_rule.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "silhouette/error.h"
#include "silhouette/lines/exact_signs.h"
#include "silhouette/lines/local_rule.h"

namespace rimline {

namespace {

// Relative to the lengths in a product: the ends of a segment are rounded.
constexpr double k_way_error = 0x1p-40;
constexpr std::uint32_t k_curve_lines_a_checkpoint = 1u << 12;

enum class Hides : std::uint8_t { no, yes, unknown };

// One end of one segment.
class CurveEnd {
public:
    CurveEnd(const LineFrame& frame, const IntersectionCurves::Segment& segment, std::size_t end)
        : frame_(frame),
          mesh_(frame.surface->mesh()),
          curves_(frame.surface->curves()),
          segment_(segment),
          node_(segment.nodes[end]),
          from_(curves_.position(node_)),
          way_(curves_.position(segment.nodes[1 - end]) - from_) {}

    struct Count {
        std::int32_t faces;
        bool is_sure;
    };
    Count count() const {
        Count count{0, true};
        for (const IntersectionCurves::NodeFace& face : curves_.faces_at(node_)) {
            if (curves_.is_own(segment_, face.face)) continue;
            switch (hides(face)) {
                case Hides::no: break;
                case Hides::yes: ++count.faces; break;
                case Hides::unknown: count.is_sure = false; break;
            }
        }
        return count;
    }

private:
    Hides hides(const IntersectionCurves::NodeFace& face) const {
        if (face.place < FaceContacts::Touch::k_inside) {
            const EdgeId side = mesh_.edges_of(FaceId{face.face})[face.place];
            if (const std::uint32_t apex = apex_of_own(side); apex != k_no_vertex)
                return covers(frame_, face.face, face.place, k_no_vertex, apex) &&
                               lies_before(frame_, face.face, apex)
                           ? Hides::yes
                           : Hides::no;
        }
        const Triangle& t = mesh_.triangles()[face.face];
        const auto corner = [&](std::size_t k) {
            return glm::dvec3(frame_.position(index(t[k % 3]))) - from_;
        };
        const glm::dvec3 eye(frame_.view->point().xyz());
        const glm::dvec3 towards = frame_.view->is_orthographic() ? eye : eye - from_;
        const glm::dvec3 n = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
        const int facing = sign_of(n, towards);
        // The sides that bound the face at the node: one, none, or the two of a corner.
        for (std::size_t k = 0; k < 3; ++k) {
            const bool bounds = face.place == IntersectionCurves::NodeFace::k_corner
                                    ? index(t[k]) == curves_.vertex(node_) ||
                                          index(t[(k + 1) % 3]) == curves_.vertex(node_)
                                    : face.place == k;
            if (!bounds) continue;
            const int inside = sign_of(glm::cross(towards, corner(k + 1) - corner(k)), way_);
            if (inside == 0 || facing == 0) return Hides::unknown;
            if (inside != facing) return Hides::no;
        }
        const int behind = -sign_of(n, way_);
        if (behind == 0 || facing == 0) return Hides::unknown;
        return behind == facing ? Hides::yes : Hides::no;
    }

    // The corner beside an edge of a face that has the edge and contains the segment.
    std::uint32_t apex_of_own(EdgeId edge) const {
        for (const FaceId face : mesh_.faces_of(edge)) {
            if (!curves_.is_own(segment_, index(face))) continue;
            for (const VertexId v : mesh_.triangles()[index(face)])
                if (v != mesh_.edge(edge).vertices[0] && v != mesh_.edge(edge).vertices[1])
                    return index(v);
        }
        return k_no_vertex;
    }

    static int sign_of(const glm::dvec3& u, const glm::dvec3& v) {
        const double value = glm::dot(u, v);
        const double bound = k_way_error * glm::length(u) * glm::length(v);
        return value > bound ? 1 : (-value > bound ? -1 : 0);
    }

    const LineFrame& frame_;
    const Mesh& mesh_;
    const IntersectionCurves& curves_;
    const IntersectionCurves::Segment& segment_;
    std::uint32_t node_;
    glm::dvec3 from_, way_;
};

}  // namespace

void find_curve_locals(LineFrame& frame, const std::stop_token& stop) {
    const std::span<const IntersectionCurves::Segment> segments =
        frame.surface->curves().segments();
    frame.is_doubtful.assign(frame.lines.size() - frame.edge_lines, 0);
    frame.locals.resize(frame.lines.size());
    const LongCall call{stop, {}};
    for (std::uint32_t i = frame.edge_lines; i < frame.lines.size(); ++i) {
        if (i % k_curve_lines_a_checkpoint == 0) call.checkpoint(0.0);
        for (std::size_t end = 0; end < 2; ++end) {
            frame.locals[i][end] = 0;
            if (frame.lines[i].is_cut[end]) continue;
            const auto [faces, is_sure] =
                CurveEnd(frame, segments[frame.lines[i].source], end).count();
            frame.locals[i][end] = faces;
            if (!is_sure) frame.set_doubtful(i);
        }
    }
}

}  // namespace rimline
