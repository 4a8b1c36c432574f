#pragma once

// Tangential distance functions (thesis 4.3.2): what a plane votes for a point, by the point's signed
// distance from it, positive in front.
//
// Each is a C1 piecewise cubic: between two knots the Hermite cubic of their values and slopes, constant
// beyond the outer knots, whose slopes are 0. With slopes of 0 everywhere that is the smooth step
// S(x) = 3x^2 - 2x^3 from value to value. Sums, multiples and reflections of such functions are such
// functions; named_functions.h holds the thesis's own.

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
    /// From `from` to `to`: ((c3*t + c2)*t + c1)*t + c0 with t = distance - start.
    struct Piece {
        double from, to;  ///< -infinity and infinity at the ends.
        double start;     ///< The knot at `from`; of the first piece, the one at `to`.
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

    /// One knot or more, ascending and apart, all numbers finite, the slopes of the outer ones 0
    /// (RIMLINE_CHECK).
    explicit TangentialFunction(std::vector<Knot> knots);

    double value(double distance) const noexcept { return piece_at(distance).value(distance); }
    double slope(double distance) const noexcept { return piece_at(distance).slope(distance); }
    /// The second derivative; at a knot, from the right.
    double curvature(double distance) const noexcept {
        return piece_at(distance).curvature(distance);
    }

    std::span<const Knot> knots() const noexcept { return knots_; }
    /// One more than there are knots; the outer ones constant.
    std::span<const Piece> pieces() const noexcept { return pieces_; }
    const Piece& piece_at(double distance) const noexcept;

    /// Over all distances.
    double least() const noexcept { return min_; }
    double greatest() const noexcept { return greatest_; }
    double greatest_magnitude() const noexcept;
    double greatest_slope() const noexcept { return greatest_slope_; }  ///< Its magnitude.

    /// Picks features of two functions: this one below `distance`, `front` from there on. Both must have
    /// the same value and a slope of 0 there, but for rounding (RIMLINE_CHECK).
    TangentialFunction followed_by(const TangentialFunction& front, double distance) const;
    TangentialFunction reflected() const;  ///< f(-s)
    TangentialFunction operator*(double factor) const;
    TangentialFunction operator+(const TangentialFunction& other) const;

private:
    std::vector<Knot> knots_;
    std::vector<Piece> pieces_;
    double min_ = 0.0;
    double greatest_ = 0.0;
    double greatest_slope_ = 0.0;
};

}  // namespace rimline
