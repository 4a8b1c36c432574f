#include "silhouette/lines/line_oracle.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <vector>

#include "silhouette/mesh/opposite_corner.h"

namespace rimline {

namespace {

struct LongVector {
    long double x, y, z;
    friend LongVector operator-(const LongVector& a, const LongVector& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend LongVector operator+(const LongVector& a, const LongVector& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend LongVector operator*(long double s, const LongVector& a) {
        return {s * a.x, s * a.y, s * a.z};
    }
};

LongVector long_vector(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

LongVector cross(const LongVector& a, const LongVector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
long double dot(const LongVector& a, const LongVector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
long double length(const LongVector& a) { return std::sqrt(dot(a, a)); }

// Relative errors within which long double does not decide, far above its own of 2^-64. The shares of a
// drawing's points are floats, so the ends of its pieces are no better known than k_end_share.
constexpr long double k_side_error = 1e-14L, k_height_error = 1e-14L;
constexpr double k_end_share = 1e-6;
// Intersections have rounded ends: faces so near to them, in radii, are their own.
constexpr long double k_own_height = 1e-9L;
// Of a piece of a line: one that passes beside the eye is long in the picture.
constexpr double k_max_samples = 200.0;
constexpr std::uint32_t k_oracle_runs_a_checkpoint = 256;

class LineOracle {
public:
    LineOracle(const Mesh& mesh, const LineView& view)
        : mesh_(mesh),
          view_(view),
          side_(std::clamp(static_cast<std::uint32_t>(std::sqrt(mesh.face_count())), 4u, 512u)) {
        fill_cells();
    }

    struct Count {
        std::int32_t faces;
        bool is_sure;
    };
    // The faces between the view's point and `x`, but those that have the edge as a side.
    Count count_before(const LongVector& x, EdgeId edge) const {
        const LongVector towards = towards_eye(x);
        Count count{0, true};
        const auto test = [&](std::uint32_t face) {
            const Triangle& t = mesh_.triangles()[face];
            if (edge != k_no_edge && has_corner(t, mesh_.edge(edge).vertices[0]) &&
                has_corner(t, mesh_.edge(edge).vertices[1]))
                return;
            add_face(t, x, towards, edge == k_no_edge, count);
        };
        for (const std::uint32_t face : near_faces_) test(face);
        const LineView::Projected seen = view_.project_from_point(
            {static_cast<double>(x.x), static_cast<double>(x.y), static_cast<double>(x.z)});
        const std::uint32_t cell = cell_of(seen.position);
        for (std::uint32_t k = begin_[cell]; k < begin_[cell + 1]; ++k) test(faces_[k]);
        return count;
    }

    // Whether an edge is a border, or a silhouette by the corners of its two faces; false where unsure.
    bool must_be_drawn(EdgeId edge) const {
        const auto& [v, w] = mesh_.edge(edge).vertices;
        for (const VertexId vertex : {v, w})
            if (!view_.is_orthographic() && depth_of(vertex) <= 1e-4 * mesh_.radius()) return false;
        const std::span<const FaceId> faces = mesh_.faces_of(edge);
        if (faces.size() == 1) return true;
        if (faces.size() != 2) return false;
        const LongVector from = position(v);
        const LongVector n = cross(towards_eye(from), position(w) - from);
        int side = 0;
        for (const FaceId face : faces)
            for (const VertexId corner : mesh_.triangles()[index(face)]) {
                if (corner == v || corner == w) continue;
                const LongVector q = position(corner) - from;
                const long double s = dot(n, q);
                if (std::abs(s) <= 1e-12L * length(n) * length(q)) return false;
                if (side != 0) return (s > 0.0L) == (side > 0);
                side = s > 0.0L ? 1 : -1;
            }
        return false;
    }

    LongVector position(VertexId v) const {
        const glm::vec3& p = mesh_.positions()[index(v)];
        return {p.x, p.y, p.z};
    }

private:
    double depth_of(VertexId v) const {
        return view_.project_from_point(glm::dvec3(mesh_.positions()[index(v)])).depth;
    }

    LongVector towards_eye(const LongVector& x) const {
        const HomogeneousPoint& p = view_.point();
        const LongVector eye{p.x, p.y, p.z};
        return p.is_direction() ? eye : eye - x;
    }

    void add_face(const Triangle& t, const LongVector& x, const LongVector& towards,
                  bool leaves_near, Count& count) const {
        const std::array corners{position(t[0]) - x, position(t[1]) - x, position(t[2]) - x};
        bool is_sure = true;
        int sign = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const LongVector &a = corners[k], &b = corners[(k + 1) % 3];
            const long double side = dot(cross(a, b), towards);
            if (std::abs(side) <= k_side_error * length(a) * length(b) * length(towards)) {
                is_sure = false;
                continue;
            }
            const int s = side > 0.0L ? 1 : -1;
            if (sign == -s) return;
            sign = s;
        }
        const LongVector n = cross(corners[1] - corners[0], corners[2] - corners[0]);
        const long double size = length(n);
        if (size == 0.0L) return;
        const long double height = -dot(n, corners[0]) / size, facing = dot(n, towards) / size;
        if (leaves_near && std::abs(height) <= k_own_height * mesh_.radius()) return;
        if (std::abs(height) <= k_height_error * mesh_.radius()) {
            count.is_sure = false;
            return;
        }
        const bool is_between = view_.is_orthographic()
                                    ? (height < 0.0L) == (facing > 0.0L)
                                    : (height < 0.0L) != (height + facing < 0.0L);
        if (!is_between) return;
        if (!is_sure) count.is_sure = false;
        ++count.faces;
    }

    std::uint32_t cell_of(const glm::dvec2& p) const {
        const auto place = [&](double value, double low) {
            return static_cast<std::uint32_t>(
                std::clamp((value - low) / width_, 0.0, double(side_ - 1)));
        };
        return place(p.y, low_.y) * side_ + place(p.x, low_.x);
    }

    // Faces by the cells of the picture that their boxes meet; those that come near the eye by themselves.
    void fill_cells() {
        std::vector<glm::dvec2> seen(mesh_.vertex_count());
        std::vector<std::uint8_t> is_near(mesh_.vertex_count());
        low_ = glm::dvec2(std::numeric_limits<double>::infinity());
        glm::dvec2 high = -low_;
        for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
            const LineView::Projected p =
                view_.project_from_point(glm::dvec3(mesh_.positions()[v]));
            seen[v] = p.position;
            is_near[v] = !view_.is_orthographic() && p.depth <= 1e-2 * mesh_.radius();
            if (is_near[v] != 0) continue;
            low_ = {std::min(low_.x, p.position.x), std::min(low_.y, p.position.y)};
            high = {std::max(high.x, p.position.x), std::max(high.y, p.position.y)};
        }
        width_ = std::max({high.x - low_.x, high.y - low_.y, 1e-300}) / (side_ - 1);
        begin_.assign(std::size_t{side_} * side_ + 1, 0);
        std::vector<std::uint32_t> next;
        const double slack = 1e-6 * width_;
        for (const bool fills : {false, true}) {
            for (std::uint32_t f = 0; f < mesh_.face_count(); ++f) {
                const Triangle& t = mesh_.triangles()[f];
                glm::dvec2 from(std::numeric_limits<double>::infinity()), to = -from;
                bool comes_near = false;
                for (const VertexId v : t) {
                    const glm::dvec2& p = seen[index(v)];
                    comes_near = comes_near || is_near[index(v)] != 0;
                    from = {std::min(from.x, p.x), std::min(from.y, p.y)};
                    to = {std::max(to.x, p.x), std::max(to.y, p.y)};
                }
                if (comes_near) {
                    if (fills) near_faces_.push_back(f);
                    continue;
                }
                const std::uint32_t first = cell_of(from - slack), last = cell_of(to + slack);
                for (std::uint32_t y = first / side_; y <= last / side_; ++y)
                    for (std::uint32_t x = first % side_; x <= last % side_; ++x) {
                        const std::uint32_t cell = y * side_ + x;
                        if (fills)
                            faces_[next[cell]++] = f;
                        else
                            ++begin_[cell + 1];
                    }
            }
            if (fills) break;
            for (std::size_t c = 0; c + 1 < begin_.size(); ++c) begin_[c + 1] += begin_[c];
            faces_.resize(begin_.back());
            next.assign(begin_.begin(), begin_.end() - 1);
        }
    }

    const Mesh& mesh_;
    const LineView& view_;
    const std::uint32_t side_;  // Cells of a side of the picture.
    glm::dvec2 low_{0.0};
    double width_ = 1.0;
    std::vector<std::uint32_t> begin_, faces_;
    std::vector<std::uint32_t> near_faces_;
};

// The places of a piece of a run in space: on its edge, or for an intersection where the picture says.
struct Piece {
    LongVector from, way;
    EdgeId edge;
    double size;  // Of its length: the share of the edge, or for an intersection in radii.
};

Piece piece_of(const Mesh& mesh, const LineView& view, const LineDrawing& drawing,
               std::uint32_t point) {
    const LineSource &from = drawing.sources[point], &to = drawing.sources[point + 1];
    if (from.edge == k_no_edge) {
        const auto place = [&](const LinePoint& p) {
            return long_vector(view.unproject({p.position, p.depth}));
        };
        const LongVector a = place(drawing.points[point]);
        const LongVector way = place(drawing.points[point + 1]) - a;
        return {a, way, k_no_edge, static_cast<double>(length(way)) / mesh.radius()};
    }
    const auto& [v, w] = mesh.edge(from.edge).vertices;
    const auto at = [&](VertexId vertex) {
        return long_vector(glm::dvec3(mesh.positions()[index(vertex)]));
    };
    const LongVector a = at(v), ab = at(w) - a;
    const long double first = from.share, last = to.share;
    return {a + first * ab, (last - first) * ab, from.edge,
            std::abs(double{to.share} - double{from.share})};
}

std::string text_of(long double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.9Lg", value);
    return text.data();
}

// What one thread finds, in runs of any order.
struct CheckOfRuns {
    LineCheck check;
    std::uint32_t first_wrong_run = ~std::uint32_t{0};  // Of check.first_difference.
};

void check_run(const LineOracle& oracle, const Mesh& mesh, const LineView& view,
               const LineDrawing& drawing, std::uint32_t run, double spacing, CheckOfRuns& found) {
    LineCheck& check = found.check;
    const LineRun& r = drawing.runs[run];
    for (std::uint32_t i = r.first_point; i + 1 < r.last_point; ++i) {
        if (drawing.sources[i].edge != drawing.sources[i + 1].edge) continue;
        const double picture_length = drawing.points[i + 1].arc - drawing.points[i].arc;
        if (!(picture_length > 0.0)) continue;
        const Piece piece = piece_of(mesh, view, drawing, i);
        const double samples = std::clamp(std::ceil(picture_length / spacing), 1.0, k_max_samples);
        for (double k = 0.5; k < samples; k += 1.0) {
            const double share = k / samples;
            const double margin = std::min(share, 1.0 - share) * piece.size;
            ++check.samples;
            const LongVector place = piece.from + static_cast<long double>(share) * piece.way;
            const LineOracle::Count count = oracle.count_before(place, piece.edge);
            if (!count.is_sure || margin < k_end_share) {
                ++check.undecided;
                continue;
            }
            if (count.faces == static_cast<std::int32_t>(r.hidden_by)) continue;
            ++check.wrong;
            if ((count.faces == 0) != r.is_visible()) ++check.wrong_visibility;
            if (run < found.first_wrong_run) {
                found.first_wrong_run = run;
                check.first_difference =
                    (piece.edge == k_no_edge ? "an intersection"
                                             : "edge " + std::to_string(index(piece.edge))) +
                    " at (" + text_of(place.x) + ", " + text_of(place.y) + ", " + text_of(place.z) +
                    ") is hidden by " + std::to_string(count.faces) +
                    " faces, and drawn as hidden by " + std::to_string(r.hidden_by);
            }
        }
    }
}

}  // namespace

LineOptions checkable(LineOptions options) {
    options.gap = options.min_length = options.stubble = options.smooth = options.simplify = 0.0;
    options.splits_counts = options.keeps_coincident = true;
    return options;
}

LineCheck check_lines(const Mesh& mesh, const LineView& view, const LineDrawing& drawing,
                      double spacing, const LongCall& call) {
    RIMLINE_CHECK(spacing > 0.0);
    const LineOracle oracle(mesh, view);
    tbb::enumerable_thread_specific<CheckOfRuns> checks;
    const auto runs = static_cast<std::uint32_t>(drawing.runs.size());
    for (std::uint32_t first = 0; first < runs; first += k_oracle_runs_a_checkpoint) {
        call.checkpoint(double(first) / runs);
        const std::uint32_t last = std::min(runs, first + k_oracle_runs_a_checkpoint);
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(first, last), [&](const auto& part) {
            for (std::uint32_t run = part.begin(); run < part.end(); ++run)
                check_run(oracle, mesh, view, drawing, run, spacing, checks.local());
        });
    }
    LineCheck all;
    std::uint32_t first_wrong_run = ~std::uint32_t{0};
    for (const auto& [check, wrong_run] : checks) {
        all.samples += check.samples;
        all.undecided += check.undecided;
        all.wrong += check.wrong;
        all.wrong_visibility += check.wrong_visibility;
        if (wrong_run >= first_wrong_run) continue;
        first_wrong_run = wrong_run;
        all.first_difference = check.first_difference;
    }
    std::vector<double> drawn(mesh.edge_count(), 0.0);
    for (const LineRun& run : drawing.runs)
        for (std::uint32_t i = run.first_point; i + 1 < run.last_point; ++i)
            if (drawing.sources[i].edge == drawing.sources[i + 1].edge &&
                drawing.sources[i].edge != k_no_edge)
                drawn[index(drawing.sources[i].edge)] += std::abs(
                    double{drawing.sources[i + 1].share} - double{drawing.sources[i].share});
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
        if (std::abs(drawn[e] - 1.0) < 1e-5) continue;
        const bool is_twice = drawn[e] > 1.0;
        if (!is_twice && !oracle.must_be_drawn(EdgeId{e})) continue;
        ++(is_twice ? all.repeated_edges : all.missing_edges);
        if (all.first_difference.empty())
            all.first_difference = "edge " + std::to_string(e) + " is drawn over " +
                                   std::to_string(drawn[e]) + " of its length";
    }
    return all;
}

}  // namespace rimline
