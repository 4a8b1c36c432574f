#include "silhouette/field/tangential_function.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "silhouette/error.h"

namespace rimline {

namespace {

using Knot = TangentialFunction::Knot;
using Piece = TangentialFunction::Piece;

constexpr double k_infinity = std::numeric_limits<double>::infinity();

Piece hermite(const Knot& a, const Knot& b) {
    const double h = b.distance - a.distance;
    const double rise = (b.value - a.value) / h;
    return {a.distance,
            b.distance,
            a.distance,
            a.value,
            a.slope,
            (3.0 * rise - 2.0 * a.slope - b.slope) / h,
            (a.slope + b.slope - 2.0 * rise) / (h * h)};
}

}  // namespace

TangentialFunction::TangentialFunction(std::vector<Knot> knots) : knots_(std::move(knots)) {
    RIMLINE_CHECK(!knots_.empty());
    RIMLINE_CHECK(knots_.front().slope == 0.0 && knots_.back().slope == 0.0);
    for (const Knot& k : knots_)
        RIMLINE_CHECK(std::isfinite(k.distance) && std::isfinite(k.value) &&
                      std::isfinite(k.slope));
    for (std::size_t i = 1; i < knots_.size(); ++i)
        RIMLINE_CHECK(knots_[i - 1].distance < knots_[i].distance);

    const Knot& first = knots_.front();
    const Knot& last = knots_.back();
    pieces_.push_back({-k_infinity, first.distance, first.distance, first.value, 0.0, 0.0, 0.0});
    for (std::size_t i = 1; i < knots_.size(); ++i)
        pieces_.push_back(hermite(knots_[i - 1], knots_[i]));
    pieces_.push_back({last.distance, k_infinity, last.distance, last.value, 0.0, 0.0, 0.0});

    min_ = max_ = first.value;
    for (const Knot& k : knots_) {
        min_ = std::min(min_, k.value);
        max_ = std::max(max_, k.value);
        max_slope_ = std::max(max_slope_, std::abs(k.slope));
    }
    const auto visit = [&](const Piece& piece, double t) {
        const double distance = piece.start + t;
        if (!(distance >= piece.from && distance <= piece.to)) return;
        min_ = std::min(min_, piece.value(distance));
        max_ = std::max(max_, piece.value(distance));
        max_slope_ = std::max(max_slope_, std::abs(piece.slope(distance)));
    };
    for (const Piece& piece : pieces_) {
        if (!std::isfinite(piece.from) || !std::isfinite(piece.to)) continue;
        if (piece.c3 != 0.0) visit(piece, -piece.c2 / (3.0 * piece.c3));  // Maximum slope.
        // Extrema: 3*c3*t^2 + 2*c2*t + c1 = 0.
        const double root = piece.c2 * piece.c2 - 3.0 * piece.c3 * piece.c1;
        if (root < 0.0) continue;
        const double q = -(piece.c2 + std::copysign(std::sqrt(root), piece.c2));
        if (piece.c3 != 0.0) visit(piece, q / (3.0 * piece.c3));
        if (q != 0.0) visit(piece, piece.c1 / q);
    }
}

const Piece& TangentialFunction::piece_at(double distance) const noexcept {
    std::size_t i = 0;
    while (i < knots_.size() && distance >= knots_[i].distance) ++i;
    return pieces_[i];
}

double TangentialFunction::max_magnitude() const noexcept {
    return std::max(std::abs(min_), std::abs(max_));
}

TangentialFunction TangentialFunction::followed_by(const TangentialFunction& front,
                                                   double distance) const {
    const double scale = 1e-9 * std::max(max_magnitude(), front.max_magnitude());
    RIMLINE_CHECK(std::isfinite(distance));
    RIMLINE_CHECK(std::abs(value(distance) - front.value(distance)) <= scale);
    RIMLINE_CHECK(std::abs(slope(distance)) <= 1e-9 * max_slope_ &&
                  std::abs(front.slope(distance)) <= 1e-9 * front.max_slope_);
    std::vector<Knot> knots;
    for (const Knot& k : knots_)
        if (k.distance < distance) knots.push_back(k);
    knots.push_back({distance, value(distance), 0.0});
    for (const Knot& k : front.knots_)
        if (k.distance > distance) knots.push_back(k);
    return TangentialFunction(std::move(knots));
}

TangentialFunction TangentialFunction::reflected() const {
    std::vector<Knot> knots;
    for (auto k = knots_.rbegin(); k != knots_.rend(); ++k)
        knots.push_back({-k->distance, k->value, -k->slope});
    return TangentialFunction(std::move(knots));
}

TangentialFunction TangentialFunction::operator*(double factor) const {
    std::vector<Knot> knots = knots_;
    for (Knot& k : knots) {
        k.value *= factor;
        k.slope *= factor;
    }
    return TangentialFunction(std::move(knots));
}

TangentialFunction TangentialFunction::operator+(const TangentialFunction& other) const {
    // With the knots of both functions, each piece of the sum is the Hermite cubic of its values
    // and slopes.
    std::vector<double> distances;
    for (const Knot& k : knots_) distances.push_back(k.distance);
    for (const Knot& k : other.knots_) distances.push_back(k.distance);
    std::ranges::sort(distances);
    distances.erase(std::unique(distances.begin(), distances.end()), distances.end());
    std::vector<Knot> knots;
    for (const double d : distances)
        knots.push_back({d, value(d) + other.value(d), slope(d) + other.slope(d)});
    return TangentialFunction(std::move(knots));
}

}  // namespace rimline
