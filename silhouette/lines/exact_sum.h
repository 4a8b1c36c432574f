#pragma once

// A sum of doubles without rounding (Shewchuk, Adaptive Precision Floating-Point Arithmetic, 1997).
//
// The sum is held as an expansion: doubles that do not overlap, from the least to the greatest, which add up to
// it exactly. The sign of the sum is the sign of the last one.

#include <array>
#include <cmath>
#include <cstddef>

namespace rimline {

class ExactSum {
public:
    /// At most k_max_terms calls of add(); add_product() makes two of them.
    static constexpr std::size_t k_max_terms = 64;

    void add(double term) noexcept {
        if (term == 0.0) return;
        double sum = term;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const double high = sum + parts_[i];
            const double added = high - sum;
            const double low = (sum - (high - added)) + (parts_[i] - added);
            if (low != 0.0) parts_[kept++] = low;
            sum = high;
        }
        if (sum != 0.0) parts_[kept++] = sum;
        count_ = kept;
    }
    /// Adds a * b.
    void add_product(double a, double b) noexcept {
        const double high = a * b;
        add(std::fma(a, b, -high));
        add(high);
    }
    /// The sum, rounded once or twice.
    double value() const noexcept {
        double sum = 0.0;
        for (std::size_t i = 0; i < count_; ++i) sum += parts_[i];
        return sum;
    }
    /// -1, 0 or 1.
    int sign() const noexcept { return count_ == 0 ? 0 : (parts_[count_ - 1] > 0.0 ? 1 : -1); }

private:
    std::array<double, k_max_terms> parts_;
    std::size_t count_ = 0;
};

}  // namespace rimline
