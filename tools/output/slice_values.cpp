#include "tools/output/slice_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace rimline::tools {

namespace {

constexpr int k_stride = 4;

// Of a cubic through values at -1, 0, 1 and 2, at 0, 1/4, 2/4 and 3/4 (Lagrange).
std::array<double, 4> weights_at(int quarter) {
    const double t = double(quarter) / k_stride;
    return {-t * (t - 1.0) * (t - 2.0) / 6.0, (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
            -(t + 1.0) * t * (t - 2.0) / 2.0, (t + 1.0) * t * (t - 1.0) / 6.0};
}

class Interpolation {
public:
    Interpolation(const SliceGrid& grid, double tolerance, const FieldValues& field,
                  const LongCall& call)
        : grid_(grid),
          field_(field),
          call_(call),
          blocks_((grid.side() + k_stride - 1) / k_stride) {
        for (int quarter = 0; quarter < k_stride; ++quarter)
            weights_[std::size_t(quarter)] = weights_at(quarter);
        result_.values.resize(grid.points().size());
        note_blocks();
        ask_at_knots();
        ask_in_middles(0.5 * tolerance);
        fill();
    }
    SliceValues take() { return std::move(result_); }

private:
    enum class Block : std::uint8_t { unused, interpolated, asked };

    // Numbers of blocks, and of knots, one more on the left and above and two more on the right and below.
    std::size_t block_at(int row, int column) const {
        return std::size_t(row) * std::size_t(blocks_) + std::size_t(column);
    }
    std::size_t knot_at(int row, int column) const {
        return std::size_t(row + 1) * std::size_t(blocks_ + 3) + std::size_t(column + 1);
    }
    int row_of(std::size_t i) const { return int(grid_.squares()[i]) / grid_.side(); }
    int column_of(std::size_t i) const { return int(grid_.squares()[i]) % grid_.side(); }
    std::size_t block_of(std::size_t i) const {
        return block_at(row_of(i) / k_stride, column_of(i) / k_stride);
    }

    std::vector<double> ask(const std::vector<glm::dvec3>& points, double begin, double end) {
        std::vector<double> values(points.size());
        field_(points, values, call_.part(begin, end));
        result_.sums += points.size();
        return values;
    }

    void note_blocks() {
        block_.assign(std::size_t(blocks_) * std::size_t(blocks_), Block::unused);
        for (std::size_t i = 0; i < grid_.squares().size(); ++i)
            block_[block_of(i)] = Block::interpolated;
    }

    void ask_at_knots() {
        knot_.assign(std::size_t(blocks_ + 3) * std::size_t(blocks_ + 3), 0.0);
        std::vector<bool> is_needed(knot_.size());
        each_block([&](int row, int column) {
            for (int r = row - 1; r <= row + 2; ++r)
                for (int c = column - 1; c <= column + 2; ++c) is_needed[knot_at(r, c)] = true;
        });
        std::vector<glm::dvec3> points;
        for (int r = -1; r < blocks_ + 2; ++r)
            for (int c = -1; c < blocks_ + 2; ++c)
                if (is_needed[knot_at(r, c)])
                    points.push_back(grid_.center(k_stride * r, k_stride * c));
        const std::vector<double> values = ask(points, 0.0, 0.4);
        std::size_t next = 0;
        for (std::size_t k = 0; k < knot_.size(); ++k)
            if (is_needed[k]) knot_[k] = values[next++];
    }

    void ask_in_middles(double tolerance) {
        constexpr int k_middle = k_stride / 2;
        std::vector<glm::dvec3> points;
        each_block([&](int row, int column) {
            points.push_back(grid_.center(k_stride * row + k_middle, k_stride * column + k_middle));
        });
        const std::vector<double> values = ask(points, 0.4, 0.8);
        std::size_t next = 0;
        each_block([&](int row, int column) {
            const double error =
                std::abs(values[next++] -
                         interpolated(k_stride * row + k_middle, k_stride * column + k_middle));
            if (error <= tolerance)
                result_.greatest_error = std::max(result_.greatest_error, error);
            else
                ask_around(row, column);
        });
    }

    // In a block and its neighbors: a bend may pass their middles by.
    void ask_around(int row, int column) {
        for (int r = std::max(row - 1, 0); r <= std::min(row + 1, blocks_ - 1); ++r)
            for (int c = std::max(column - 1, 0); c <= std::min(column + 1, blocks_ - 1); ++c)
                if (Block& block = block_[block_at(r, c)]; block != Block::unused)
                    block = Block::asked;
    }

    void fill() {
        std::vector<std::size_t> asked;
        std::vector<glm::dvec3> points;
        for (std::size_t i = 0; i < grid_.squares().size(); ++i) {
            if (block_[block_of(i)] == Block::asked) {
                asked.push_back(i);
                points.push_back(grid_.points()[i]);
            } else {
                result_.values[i] = interpolated(row_of(i), column_of(i));
            }
        }
        const std::vector<double> values = ask(points, 0.8, 1.0);
        for (std::size_t k = 0; k < asked.size(); ++k) result_.values[asked[k]] = values[k];
    }

    template <typename Use>
    void each_block(Use&& use) const {
        for (int row = 0; row < blocks_; ++row)
            for (int column = 0; column < blocks_; ++column)
                if (block_[block_at(row, column)] != Block::unused) use(row, column);
    }

    double interpolated(int row, int column) const {
        const std::array<double, 4>& down = weights_[std::size_t(row % k_stride)];
        const std::array<double, 4>& right = weights_[std::size_t(column % k_stride)];
        double value = 0.0;
        for (int r = 0; r < 4; ++r)
            for (int c = 0; c < 4; ++c)
                value += down[std::size_t(r)] * right[std::size_t(c)] *
                         knot_[knot_at(row / k_stride + r - 1, column / k_stride + c - 1)];
        return value;
    }

    const SliceGrid& grid_;
    const FieldValues& field_;
    const LongCall& call_;
    int blocks_;  // Along a side.
    std::array<std::array<double, 4>, k_stride> weights_{};
    std::vector<Block> block_;
    std::vector<double> knot_;
    SliceValues result_;
};

}  // namespace

SliceValues slice_values(const SliceGrid& grid, double tolerance, const FieldValues& field,
                         const LongCall& call) {
    if (grid.points().empty()) return {};
    if (tolerance > 0.0) return Interpolation(grid, tolerance, field, call).take();
    SliceValues exact{.values = std::vector<double>(grid.points().size()),
                      .sums = grid.points().size()};
    field(grid.points(), exact.values, call);
    return exact;
}

}  // namespace rimline::tools
