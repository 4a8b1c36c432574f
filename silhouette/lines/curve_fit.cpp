#include "silhouette/lines/curve_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/lines/line_simplify.h"

namespace rimline {

namespace {

// A line has a corner where its course turns by more than 60 degrees, or where two segments that are longer than
// some tolerances turn by more than 40.
constexpr double k_course_corner_cos = 0.5, k_corner_cos = 0.766, k_long_tolerances = 8.0;
// Below 1, where a straight curve of this length first stands still.
constexpr double k_max_handles = 0.8;
constexpr int k_max_rounds = 4;  // Of fitting with better parameters.
constexpr std::size_t k_samples_a_point = 8;

glm::dvec2 direction(const glm::dvec2& way) {
    const double length = glm::length(way);
    return length > 0.0 ? way / length : glm::dvec2(0.0);
}

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 way = b - a;
    const double square = glm::dot(way, way);
    const double share = square > 0.0 ? std::clamp(glm::dot(p - a, way) / square, 0.0, 1.0) : 0.0;
    return glm::length(p - a - share * way);
}

// By point. The first point of a closed line is its last one too.
std::vector<std::uint8_t> find_corners(std::span<const glm::dvec2> line, bool is_closed,
                                       double tolerance) {
    const std::size_t count = line.size();
    std::vector<std::uint8_t> is_corner(count, 0);
    const auto mark = [&](std::size_t a, std::size_t b, std::size_t c, double cos, double least) {
        const glm::dvec2 in = line[b] - line[a], out = line[c] - line[b];
        if (glm::length(in) >= least && glm::length(out) >= least &&
            glm::dot(direction(in), direction(out)) < cos)
            is_corner[b] = 1;
    };
    std::vector<LinePoint> course;
    for (const glm::dvec2& p : line) course.push_back({p, 0.0, 0.0});
    std::vector<std::uint32_t> kept;
    simplify(course, tolerance, kept);
    for (std::size_t i = 1; i + 1 < kept.size(); ++i)
        mark(kept[i - 1], kept[i], kept[i + 1], k_course_corner_cos, 2.0 * tolerance);
    for (std::size_t i = 1; i + 1 < count; ++i)
        mark(i - 1, i, i + 1, k_corner_cos, k_long_tolerances * tolerance);
    if (is_closed && kept.size() > 2) {
        mark(kept[kept.size() - 2], 0, kept[1], k_course_corner_cos, 2.0 * tolerance);
        mark(count - 2, 0, 1, k_corner_cos, k_long_tolerances * tolerance);
    }
    return is_corner;
}

// Fits one part of a line, which has no corners.
class PartFitter {
public:
    PartFitter(std::span<const glm::dvec2> points, double tolerance,
               std::vector<CurvePiece>& pieces)
        : points_(points), tolerance_(tolerance), pieces_(pieces) {
        arcs_.push_back(0.0);
        for (std::size_t i = 1; i < points.size(); ++i)
            arcs_.push_back(arcs_.back() + glm::length(points[i] - points[i - 1]));
    }

    // From point `first` to `last`, with these directions at its ends, both into the part.
    void fit(std::size_t first, std::size_t last, const glm::dvec2& from, const glm::dvec2& to) {
        if (is_straight(first, last)) return add_straight(last);
        set_parameters(first, last);
        std::size_t worst = (first + last) / 2;
        for (int round = 0; round < k_max_rounds; ++round) {
            const CurvePiece curve = solve(first, last, from, to);
            const double error = improve(first, last, curve, worst);
            if (error <= tolerance_ && stays_near(first, last, curve)) {
                pieces_.push_back(curve);
                return;
            }
            if (error > 16.0 * tolerance_) break;  // Better parameters do not help.
        }
        worst = std::clamp(worst, first + 1, last - 1);
        const glm::dvec2 tangent = direction(points_[worst + 1] - points_[worst - 1]);
        fit(first, worst, from, -tangent);
        fit(worst, last, tangent, to);
    }

private:
    bool is_straight(std::size_t first, std::size_t last) const {
        for (std::size_t i = first + 1; i < last; ++i)
            if (distance_to_segment(points_[i], points_[first], points_[last]) > 0.1 * tolerance_)
                return false;
        return true;
    }
    void add_straight(std::size_t last) {
        pieces_.push_back({true, points_[last], points_[last], points_[last]});
    }

    void set_parameters(std::size_t first, std::size_t last) {
        parameters_.clear();
        const double length = arcs_[last] - arcs_[first];
        for (std::size_t i = first; i <= last; ++i)
            parameters_.push_back((arcs_[i] - arcs_[first]) / length);
    }

    // The least squares of the distances at the parameters, over the lengths of both handles.
    CurvePiece solve(std::size_t first, std::size_t last, const glm::dvec2& from,
                     const glm::dvec2& to) const {
        const glm::dvec2 begin = points_[first], end = points_[last];
        double c00 = 0.0, c01 = 0.0, c11 = 0.0, x0 = 0.0, x1 = 0.0;
        for (std::size_t i = first; i <= last; ++i) {
            const double t = parameters_[i - first], s = 1.0 - t;
            const double b1 = 3.0 * t * s * s, b2 = 3.0 * t * t * s;
            const glm::dvec2 a0 = b1 * from, a1 = b2 * to;
            const glm::dvec2 rest = points_[i] - (s * s * s + b1) * begin - (t * t * t + b2) * end;
            c00 += glm::dot(a0, a0);
            c01 += glm::dot(a0, a1);
            c11 += glm::dot(a1, a1);
            x0 += glm::dot(a0, rest);
            x1 += glm::dot(a1, rest);
        }
        const double chord = glm::length(end - begin);
        const double determinant = c00 * c11 - c01 * c01;
        double handle_0 = chord / 3.0, handle_1 = chord / 3.0;
        if (std::abs(determinant) > 1e-12 * c00 * c11) {
            const double h0 = (x0 * c11 - x1 * c01) / determinant;
            const double h1 = (c00 * x1 - c01 * x0) / determinant;
            // Handles that point backwards, or that reach past each other so far that a straight curve would go
            // back over itself, make loops and cusps, which some programs draw as gaps.
            const double length = arcs_[last] - arcs_[first];
            if (h0 > 1e-6 * chord && h1 > 1e-6 * chord &&
                h0 + h1 - std::sqrt(h0 * h1) < k_max_handles * length)
                handle_0 = h0, handle_1 = h1;
        }
        return {false, begin + handle_0 * from, end + handle_1 * to, end};
    }

    // Moves the parameters to the nearest places of the curve (Newton), and returns the greatest distance.
    double improve(std::size_t first, std::size_t last, const CurvePiece& curve,
                   std::size_t& worst) {
        const glm::dvec2 begin = points_[first];
        double greatest = 0.0;
        for (std::size_t i = first + 1; i < last; ++i) {
            double& t = parameters_[i - first];
            const double distance = glm::length(point_on(curve, begin, t) - points_[i]);
            if (distance > greatest) greatest = distance, worst = i;
            const glm::dvec2 d0 = curve.control_1 - begin, d1 = curve.control_2 - curve.control_1,
                             d2 = curve.end - curve.control_2;
            const double s = 1.0 - t;
            const glm::dvec2 velocity = 3.0 * (s * s * d0 + 2.0 * s * t * d1 + t * t * d2);
            const glm::dvec2 acceleration = 6.0 * (s * (d1 - d0) + t * (d2 - d1));
            const glm::dvec2 off = point_on(curve, begin, t) - points_[i];
            const double slope = glm::dot(velocity, velocity) + glm::dot(off, acceleration);
            if (slope > 0.0) t = std::clamp(t - glm::dot(off, velocity) / slope, 0.0, 1.0);
        }
        return greatest;
    }

    // Whether curve and line lie near each other everywhere.
    bool stays_near(std::size_t first, std::size_t last, const CurvePiece& curve) {
        const std::size_t samples = k_samples_a_point * (last - first);
        curve_places_.assign(1, points_[first]);
        line_places_.assign(1, points_[first]);
        for (std::size_t k = 1; k <= samples; ++k) {
            curve_places_.push_back(point_on(curve, points_[first], double(k) / double(samples)));
            const std::size_t i = first + (k - 1) / k_samples_a_point;
            const double share =
                double((k - 1) % k_samples_a_point + 1) / double{k_samples_a_point};
            line_places_.push_back(glm::mix(points_[i], points_[i + 1], share));
        }
        return lie_near(curve_places_, points_.subspan(first, last - first + 1)) &&
               lie_near(line_places_, curve_places_);
    }

    // Whether all places lie near a line, in the order in which it passes them.
    bool lie_near(std::span<const glm::dvec2> places, std::span<const glm::dvec2> line) const {
        std::size_t near = 0;
        for (const glm::dvec2& p : places) {
            // The nearest segment lies at or after that of the place before; a few more beyond it.
            double least = distance_to_segment(p, line[near], line[near + 1]);
            for (std::size_t i = near + 1; i + 1 < line.size() && i < near + 8; ++i) {
                const double distance = distance_to_segment(p, line[i], line[i + 1]);
                if (distance < least) least = distance, near = i;
            }
            if (least > tolerance_) return false;
        }
        return true;
    }

    std::span<const glm::dvec2> points_;
    double tolerance_;
    std::vector<CurvePiece>& pieces_;
    std::vector<double> arcs_, parameters_;
    std::vector<glm::dvec2> curve_places_, line_places_;
};

}  // namespace

glm::dvec2 point_on(const CurvePiece& piece, const glm::dvec2& begin, double parameter) {
    const double t = parameter, s = 1.0 - t;
    if (piece.is_straight) return s * begin + t * piece.end;
    return s * s * s * begin + 3.0 * s * s * t * piece.control_1 +
           3.0 * s * t * t * piece.control_2 + t * t * t * piece.end;
}

std::vector<CurvePiece> fit_curves(std::span<const glm::dvec2> points, bool is_closed,
                                   double tolerance) {
    std::vector<CurvePiece> pieces;
    if (points.size() < 2) return pieces;
    std::vector<glm::dvec2> line(points.begin(), points.end());
    if (is_closed) line.push_back(points[0]);
    if (!(tolerance > 0.0) || line.size() < 3) {
        for (std::size_t i = 1; i < line.size(); ++i)
            pieces.push_back({true, line[i], line[i], line[i]});
        return pieces;
    }
    const std::size_t last = line.size() - 1;
    const std::vector<std::uint8_t> is_corner = find_corners(line, is_closed, tolerance);
    // A closed line without a corner at its seam has one tangent there.
    const bool is_smooth_seam = is_closed && is_corner[0] == 0;
    const glm::dvec2 seam = direction(line[1] - line[last - 1]);
    PartFitter fitter(line, tolerance, pieces);
    for (std::size_t first = 0; first < last;) {
        std::size_t end = first + 1;
        while (end < last && is_corner[end] == 0) ++end;
        const glm::dvec2 from =
            first == 0 && is_smooth_seam ? seam : direction(line[first + 1] - line[first]);
        const glm::dvec2 to =
            end == last && is_smooth_seam ? -seam : direction(line[end - 1] - line[end]);
        fitter.fit(first, end, from, to);
        first = end;
    }
    return pieces;
}

}  // namespace rimline
