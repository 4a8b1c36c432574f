#include "silhouette/points/neighbour_lists.h"

#include <algorithm>
#include <array>
#include <bit>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <nanoflann.hpp>

#include "silhouette/points/each_point.h"

namespace rimline {

namespace {

// Directions spread 1.8 times as far along a line as across it.
constexpr double k_row = 0.18;

// As nanoflann reads points.
struct TreePoints {
    std::span<const glm::dvec3> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return points[i][static_cast<glm::length_t>(axis)];
    }
    template <typename Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, TreePoints, double, std::uint32_t>, TreePoints, 3,
    std::uint32_t>;

struct Near {
    double square;
    std::uint32_t number;
    bool operator<(const Near& other) const {
        return square != other.square ? square < other.square : number < other.number;
    }
};

// The least number above one that is positive or zero.
double next_above(double x) { return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) + 1); }

// The nearest so far, ascending, for nanoflann, whose own set drops ties in the order it meets them.
class NearestSet {
public:
    /// k points are known to lie no farther than the square root of `known`.
    NearestSet(std::uint32_t self, std::uint32_t k, double known)
        : self_(self), k_(k), limit_(known) {
        if (known < std::numeric_limits<double>::infinity()) limit_ = next_above(known);
    }
    std::size_t size() const { return count_; }
    bool full() const { return count_ == k_; }
    // Beyond it nothing is offered; what lies just there must be.
    double worstDist() const { return limit_; }
    bool addPoint(double square, std::uint32_t number) {
        const Near near{square, number};
        if (number == self_ || (full() && !(near < near_[k_ - 1]))) return true;
        std::uint32_t i = full() ? k_ - 1 : count_++;
        for (; i > 0 && near < near_[i - 1]; --i) near_[i] = near_[i - 1];
        near_[i] = near;
        if (full()) limit_ = next_above(near_[k_ - 1].square);
        return true;
    }
    const Near& operator[](std::uint32_t i) const { return near_[i]; }

private:
    std::uint32_t self_, k_;
    std::uint32_t count_ = 0;
    double limit_;
    std::array<Near, k_most_neighbours> near_;
};

// Whether the directions of so many neighbours spread along one line, as they do where a row bends too: by
// the greatest two eigenvalues a, b of their covariance, for ab / (a + b + c)² is their sum of principal
// minors over the square of the trace.
bool is_row(std::span<const glm::dvec3> points, std::uint32_t i,
            std::span<const std::uint32_t> near) {
    glm::dmat3 sum(0.0);
    for (const std::uint32_t j : near) {
        const glm::dvec3 d = glm::normalize(points[j] - points[i]);
        sum += glm::outerProduct(d, d);
    }
    const double trace = sum[0][0] + sum[1][1] + sum[2][2];
    const double minors = sum[0][0] * sum[1][1] - sum[0][1] * sum[0][1] + sum[0][0] * sum[2][2] -
                          sum[0][2] * sum[0][2] + sum[1][1] * sum[2][2] - sum[1][2] * sum[1][2];
    return minors < k_row * trace * trace;
}

}  // namespace

NeighbourLists::NeighbourLists(std::span<const glm::dvec3> points, std::uint32_t k,
                               const LongCall& call) {
    const auto count = static_cast<std::uint32_t>(points.size());
    k_ = count == 0 ? 0 : std::min(k, count - 1);
    RIMLINE_CHECK(k <= k_most_neighbours);
    begin_.assign(std::size_t{count} + 1, 0);
    is_mutual_.assign(count, 0);
    is_row_.assign(count, 0);
    if (k_ == 0) return;
    const std::uint32_t most = std::min(k_most_neighbours, count - 1);

    const TreePoints source{points};
    const Tree tree(3, source, nanoflann::KDTreeSingleIndexAdaptorParams(12));
    std::vector<std::uint32_t> nearest(std::size_t{count} * k_);
    std::vector<Near> farthest(count);
    const auto square = [&](std::uint32_t i, std::uint32_t j) {
        const glm::dvec3 d = points[i] - points[j];
        return glm::dot(d, d);
    };
    each_point(count, {call, 0.0, 0.9}, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i) {
            // The point before, near in memory and mostly in space, and its neighbours are k others.
            double known = std::numeric_limits<double>::infinity();
            if (i > first) {
                known = square(i, i - 1);
                for (std::uint32_t j = 0; j < k_; ++j)
                    known = std::max(known, square(i, nearest[std::size_t{i - 1} * k_ + j]));
            }
            NearestSet set(i, k_, known);
            tree.findNeighbors(set, &points[i].x, nanoflann::SearchParams());
            for (std::uint32_t j = 0; j < k_; ++j) nearest[std::size_t{i} * k_ + j] = set[j].number;
            farthest[i] = set[k_ - 1];
            is_row_[i] = is_row(points, i, std::span(nearest).subspan(std::size_t{i} * k_, k_));
        }
    });

    // i among the k nearest of j is i no farther than the farthest of them.
    const auto counts = [&](std::uint32_t j, std::uint32_t i) {
        return !(farthest[j] < Near{square(i, j), i});
    };
    std::vector<std::uint64_t> end(count, 0);
    std::vector<std::uint64_t> is_counted(count, 0);  // Bit n: by its n-th.
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t n = 0; n < k_; ++n) {
            const std::uint32_t j = nearest[std::size_t{i} * k_ + n];
            if (counts(j, i)) {
                is_mutual_[i] = 1;
                is_counted[i] |= std::uint64_t{1} << n;
            } else {
                ++end[j];
            }
        }
    std::uint64_t total = 0;
    std::vector<std::uint64_t> all_begin(std::size_t{count} + 1, 0);
    for (std::uint32_t i = 0; i < count; ++i) {
        all_begin[i] = total;
        total += end[i];
        end[i] = all_begin[i];
    }
    all_begin[count] = total;
    std::vector<std::uint32_t> others(total);
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t n = 0; n < k_; ++n) {
            const std::uint32_t j = nearest[std::size_t{i} * k_ + n];
            if ((is_counted[i] >> n & 1u) == 0) others[end[j]++] = i;
        }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint64_t more =
            std::min<std::uint64_t>(k_most_neighbours - k_, all_begin[i + 1] - all_begin[i]);
        begin_[i + 1] = begin_[i] + (is_row_[i] != 0 ? most : k_ + more);
    }
    lists_.resize(begin_[count]);
    each_point(count, {call, 0.9, 1.0}, [&](std::uint32_t first, std::uint32_t last) {
        std::vector<Near> more;
        for (std::uint32_t i = first; i < last; ++i) {
            std::uint32_t* out = lists_.data() + begin_[i];
            if (is_row_[i] != 0) {
                NearestSet set(i, most, std::numeric_limits<double>::infinity());
                tree.findNeighbors(set, &points[i].x, nanoflann::SearchParams());
                for (std::uint32_t n = 0; n < most; ++n) *out++ = set[n].number;
                continue;
            }
            for (std::uint32_t n = 0; n < k_; ++n) *out++ = nearest[std::size_t{i} * k_ + n];
            more.clear();
            for (std::uint64_t j = all_begin[i]; j < all_begin[i + 1]; ++j)
                more.push_back({square(i, others[j]), others[j]});
            std::sort(more.begin(), more.end());
            for (std::size_t j = 0; out < lists_.data() + begin_[i + 1]; ++j)
                *out++ = more[j].number;
        }
    });
}

}  // namespace rimline
