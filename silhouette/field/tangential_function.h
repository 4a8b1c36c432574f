#pragma once

// Tangential distance functions (thesis 4.3.2): the vote of a plane for a point, as a function of the
// point's signed distance from the plane. The distance is positive in front.
//
// Each is a C1 piecewise cubic. Between two knots it is the Hermite cubic of their values and slopes.
// Beyond the outer knots, whose slopes are 0, it is constant. If all slopes are 0, each piece is the
// smooth step S(x) = 3x^2 - 2x^3 between two values. Sums, multiples and reflections are functions of
// the same kind. named_functions.h holds those of the thesis.

#include <span>
#include <vector>

namespace rimline {

class TangentialFunction {
public:
    struct Knot {
        double distance;
        double value;
        double slope = 0.0;
    };
    /// Between `from` and `to`: ((c3*t + c2)*t + c1)*t + c0 with t = distance - start.
    struct Piece {
        double from, to;  ///< -infinity and infinity at the ends.
        double start;     ///< The knot at `from`. For the first piece, the knot at `to`.
        double c0, c1, c2, c3;

        double value(double distance) const noexcept {
            const double t = distance - start;
            return ((c3 * t + c2) * t + c1) * t + c0;
        }
        double slope(double distance) const noexcept {
            const double t = distance - start;
            return (3.0 * c3 * t + 2.0 * c2) * t + c1;
        }
        double curvature(double distance) const noexcept {
            return 6.0 * c3 * (distance - start) + 2.0 * c2;
        }
    };

    /// One or more knots, with strictly ascending distances, finite numbers, and slope 0 at the outer
    /// knots (RIMLINE_CHECK).
    explicit TangentialFunction(std::vector<Knot> knots);

    double value(double distance) const noexcept { return piece_at(distance).value(distance); }
    double slope(double distance) const noexcept { return piece_at(distance).slope(distance); }
    /// The second derivative. At a knot, its limit from the right.
    double curvature(double distance) const noexcept {
        return piece_at(distance).curvature(distance);
    }

    std::span<const Knot> knots() const noexcept { return knots_; }
    /// One more piece than knots. The outer pieces are constant.
    std::span<const Piece> pieces() const noexcept { return pieces_; }
    const Piece& piece_at(double distance) const noexcept;

    /// Minimum and maximum over all distances.
    double min_value() const noexcept { return min_; }
    double max_value() const noexcept { return max_; }
    double max_magnitude() const noexcept;
    double max_slope() const noexcept { return max_slope_; }  ///< Of its magnitude.

    /// Joins two functions: this one below `distance`, `front` from there on. Up to rounding, both must
    /// have the same value and slope 0 there (RIMLINE_CHECK).
    TangentialFunction followed_by(const TangentialFunction& front, double distance) const;
    TangentialFunction reflected() const;  ///< f(-s)
    TangentialFunction operator*(double factor) const;
    TangentialFunction operator+(const TangentialFunction& other) const;

private:
    std::vector<Knot> knots_;
    std::vector<Piece> pieces_;
    double min_ = 0.0;
    double max_ = 0.0;
    double max_slope_ = 0.0;
};

}  // namespace rimline
