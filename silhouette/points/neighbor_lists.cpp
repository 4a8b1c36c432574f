#include "silhouette/points/neighbor_lists.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numeric>

#include "silhouette/points/each_point.h"
#include "silhouette/points/point_tree.h"

namespace rimline {

namespace {

// Limit of minors / trace² (is_row). At it, directions spread 1.8 times as far along a line as across it.
constexpr double k_row = 0.18;

struct Near {
    double square;
    std::uint32_t number;
    bool operator<(const Near& other) const {
        return square != other.square ? square < other.square : number < other.number;
    }
};

// The nearest so far, ascending. Nanoflann has a set of its own, but that resolves ties by the order of the
// search.
class NearestSet {
public:
    using DistanceType = double;
    void sort() {}  // Nanoflann calls it from version 1.5 on.
    // It is known that k others lie no farther than the square root of `known`.
    NearestSet(std::uint32_t self, std::uint32_t k, double known)
        : self_(self), k_(k), reach_(search_radius(known)) {}
    bool full() const { return count_ == k_; }
    // Nanoflann offers no points beyond it.
    double worstDist() const { return reach_; }
    bool addPoint(double square, std::uint32_t number) {
        const Near near{square, number};
        if (number == self_ || (full() && !(near < near_[k_ - 1]))) return true;
        std::uint32_t i = full() ? k_ - 1 : count_++;
        for (; i > 0 && near < near_[i - 1]; --i) near_[i] = near_[i - 1];
        near_[i] = near;
        if (full()) reach_ = search_radius(near_[k_ - 1].square);
        return true;
    }
    // All k. The set must be full.
    std::span<const Near> found() const {
        RIMLINE_CHECK(full());
        return std::span(near_).first(k_);
    }

private:
    std::uint32_t self_, k_;
    std::uint32_t count_ = 0;
    double reach_;
    std::array<Near, k_max_neighbors> near_;
};

// Whether the directions to these neighbors spread along one line (also where a row bends). With eigenvalues
// a, b, c of the sum of the directions' outer products, (ab + bc + ca) / (a + b + c)² is its sum of principal
// minors divided by the square of its trace.
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

class Search {
public:
    Search(std::span<const glm::dvec3> points, std::uint32_t k, const std::stop_token& stop)
        : points_(points),
          k_(k),
          source_(points, stop),
          tree_(3, source_, point_tree_leaves()),
          nearest_(points.size() * k),
          farthest_(points.size()) {}

    // Finds the k nearest of all points. Calls body(point) after each.
    template <typename Body>
    void find(const CallPart& part, Body&& body) {
        each_point(static_cast<std::uint32_t>(points_.size()), part,
                   [&](std::uint32_t first, std::uint32_t last) {
                       for (std::uint32_t i = first; i < last; ++i) {
                           NearestSet set(i, k_, i > first ? known_of(i) : k_unknown);
                           farthest_[i] = search(set, i, nearest_.data() + std::size_t{i} * k_);
                           body(i);
                       }
                   });
    }

    // The k nearest of a point.
    std::span<const std::uint32_t> of(std::uint32_t point) const {
        return std::span(nearest_).subspan(std::size_t{point} * k_, k_);
    }
    Near from(std::uint32_t point, std::uint32_t other) const {
        const glm::dvec3 d = points_[point] - points_[other];
        return {glm::dot(d, d), other};
    }
    // Whether `other` is among the k nearest: no farther than the farthest of them.
    bool has(std::uint32_t point, std::uint32_t other) const {
        return !(farthest_[point] < from(point, other));
    }
    // Writes the `max_count` nearest of a point.
    void find_more(std::uint32_t point, std::uint32_t max_count, std::uint32_t* out) const {
        NearestSet set(point, max_count, k_unknown);
        search(set, point, out);
    }

private:
    static constexpr double k_unknown = std::numeric_limits<double>::infinity();

    // The point before, which is mostly near in space, and its neighbors: k others whose distances bound the
    // search.
    double known_of(std::uint32_t point) const {
        double known = from(point, point - 1).square;
        for (const std::uint32_t other : of(point - 1))
            known = std::max(known, from(point, other).square);
        return known;
    }
    Near search(NearestSet& set, std::uint32_t point, std::uint32_t* out) const {
        tree_.findNeighbors(set, &points_[point].x, {});
        const std::span<const Near> found = set.found();
        for (const Near& near : found) *out++ = near.number;
        return found.back();
    }

    std::span<const glm::dvec3> points_;
    std::uint32_t k_;
    TreeBuildPoints source_;
    PointTree tree_;
    UnsetVector<std::uint32_t> nearest_;
    UnsetVector<Near> farthest_;
};

// For each point the points that have it among their k nearest, without those among its own k nearest.
class Followers {
public:
    // is_returned[i], bit n: the n-th nearest of i has i among its own.
    Followers(const Search& search, std::span<const std::uint64_t> is_returned,
              const std::stop_token& stop)
        : begin_(is_returned.size() + 1, 0) {
        const auto each = [&](auto&& body) {
            for (std::uint32_t i = 0; i < is_returned.size(); ++i) {
                if (i % k_checkpoint_points == 0) LongCall{stop, {}}.checkpoint(0.0);
                for (std::size_t n = 0; n < search.of(i).size(); ++n)
                    if ((is_returned[i] >> n & 1u) == 0) body(search.of(i)[n], i);
            }
        };
        each([&](std::uint32_t point, std::uint32_t) { ++begin_[point]; });
        std::exclusive_scan(begin_.begin(), begin_.end(), begin_.begin(), std::uint64_t{0});
        numbers_.resize(begin_.back());
        std::vector<std::uint64_t> end(begin_.begin(), begin_.end() - 1);
        each([&](std::uint32_t point, std::uint32_t follower) {
            numbers_[end[point]++] = follower;
        });
    }
    std::span<const std::uint32_t> of(std::uint32_t point) const {
        return std::span(numbers_).subspan(begin_[point], begin_[point + 1] - begin_[point]);
    }

private:
    std::vector<std::uint64_t> begin_;
    UnsetVector<std::uint32_t> numbers_;
};

}  // namespace

NeighborLists::NeighborLists(std::span<const glm::dvec3> points, std::uint32_t k,
                             const LongCall& call) {
    const auto count = static_cast<std::uint32_t>(points.size());
    k_ = count == 0 ? 0 : std::min(k, count - 1);
    RIMLINE_CHECK(k <= k_max_neighbors);
    begin_.assign(std::size_t{count} + 1, 0);
    is_mutual_.assign(count, 0);
    is_row_.assign(count, 0);
    if (k_ == 0) return;

    Search search(points, k_, call.stop);
    search.find({call, 0.0, 0.85},
                [&](std::uint32_t i) { is_row_[i] = is_row(points, i, search.of(i)); });
    std::vector<std::uint64_t> is_returned(count, 0);
    each_point(count, {call, 0.85, 0.9}, [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t i = first; i < last; ++i) {
            for (std::size_t n = 0; n < k_; ++n)
                if (search.has(search.of(i)[n], i)) is_returned[i] |= std::uint64_t{1} << n;
            is_mutual_[i] = is_returned[i] != 0;
        }
    });
    const Followers followers(search, is_returned, call.stop);

    const std::uint32_t max_count = std::min(k_max_neighbors, count - 1);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::size_t all = is_row_[i] != 0 ? max_count : k_ + followers.of(i).size();
        begin_[i + 1] = begin_[i] + std::min<std::size_t>(all, k_max_neighbors);
    }
    lists_.resize(begin_[count]);
    each_point(count, {call, 0.9, 1.0}, [&](std::uint32_t first, std::uint32_t last) {
        std::vector<Near> more;
        for (std::uint32_t i = first; i < last; ++i) {
            std::uint32_t* out = lists_.data() + begin_[i];
            if (is_row_[i] != 0) {
                search.find_more(i, max_count, out);
                continue;
            }
            out = std::ranges::copy(search.of(i), out).out;
            more.clear();
            for (const std::uint32_t follower : followers.of(i))
                more.push_back(search.from(i, follower));
            std::sort(more.begin(), more.end());
            for (std::size_t j = 0; out < lists_.data() + begin_[i + 1]; ++j)
                *out++ = more[j].number;
        }
    });
}

}  // namespace rimline
