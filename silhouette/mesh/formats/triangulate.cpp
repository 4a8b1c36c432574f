#include "silhouette/mesh/formats/triangulate.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <tuple>
#include <utility>

#include "silhouette/error.h"

namespace rimline {

namespace {

using Corner = std::uint32_t;  // An index into the polygon, not into the mesh.
constexpr Corner k_no_corner = 0xffffffffu;
constexpr std::uint32_t k_no_waiting = 0xffffffffu;
// Limits for polygons that cross themselves. A test takes tens of nanoseconds if the corners are
// scattered in memory, so the second limit is some seconds.
constexpr std::uint64_t k_tests_a_corner = 2048;
constexpr std::uint64_t k_max_tests = std::uint64_t{1} << 27;
// Corners or tests between two checks of the stop token.
constexpr std::uint32_t k_stop_interval = 1 << 13;

// Twice the signed area of triangle abc.
double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) noexcept {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// 1 for an equilateral triangle, 0 for a degenerate one.
double shape(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) noexcept {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 bc = c - b;
    const double squares = glm::dot(ab, ab) + glm::dot(ac, ac) + glm::dot(bc, bc);
    return squares > 0.0 ? 3.4641016151377544 * glm::length(glm::cross(ab, ac)) / squares : 0.0;
}

glm::dvec3 twice_area_vector(std::span<const glm::vec3> positions,
                             std::span<const std::uint32_t> polygon) noexcept {
    // Relative to a corner, so that a small polygon far from the origin keeps its precision.
    const glm::dvec3 base = positions[polygon[0]];
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += glm::cross(glm::dvec3(positions[polygon[i]]) - base,
                          glm::dvec3(positions[polygon[i + 1]]) - base);
    return sum;
}

bool is_before(const glm::vec3& a, const glm::vec3& b) noexcept {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// Whether the first corner of a quad, by is_before(), is 0 or 2.
bool has_first_of_all(std::span<const glm::vec3> positions,
                      std::span<const std::uint32_t> quad) noexcept {
    const auto first = [&](int i, int j) {
        const glm::vec3 &a = positions[quad[i]], &b = positions[quad[j]];
        return is_before(b, a) ? b : a;
    };
    return is_before(first(0, 2), first(1, 3));
}

// A point's position in the plane: its coordinates without the normal's largest axis, in the order
// that makes the polygon counter-clockwise.
struct Projection {
    int u = 0;
    int v = 1;

    explicit Projection(glm::dvec3 normal) noexcept {
        const glm::dvec3 size = glm::abs(normal);
        const int w = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
        u = (w + 1) % 3;
        v = (w + 2) % 3;
        if (normal[w] < 0.0) std::swap(u, v);
    }
    glm::dvec2 operator()(glm::vec3 p) const noexcept { return {p[u], p[v]}; }
};

}  // namespace

// Ear clipping over a ring of corners. A corner is an ear if it turns left and no reflex corner lies
// in its triangle. Reflex corners only become convex or are removed, so an ear stays an ear. A blocked
// corner waits in the list of the reflex corner that blocks it, until that corner is no longer reflex.
class Triangulator::EarClipper {
public:
    explicit EarClipper(std::stop_token stop) : stop_(std::move(stop)) {}

    /// Keeps the polygon from its first corner on (is_before), towards the one of its neighbors that comes first. Returns
    /// whether that reverses it.
    bool take(std::span<const glm::vec3> positions, std::span<const std::uint32_t> polygon);
    std::span<const std::uint32_t> polygon() const noexcept { return polygon_; }
    /// Of the polygon that is kept.
    void clip(std::span<const glm::vec3> positions, const Projection& project,
              std::vector<std::array<std::uint32_t, 3>>& triangles);

private:
    struct Node {
        glm::dvec2 at;
        Corner before, after;
        std::uint32_t version;  // Counts changes of the triangle. Older candidates are invalid.
        std::uint32_t waiting;  // Head of a list in `waiting_` of the corners it blocks.
        bool alive, reflex;
    };
    struct Waiting {
        Corner corner;
        std::uint32_t version;
        std::uint32_t next;
    };
    struct Candidate {
        double quality;
        Corner corner;
        std::uint32_t version;
        bool operator<(const Candidate& other) const noexcept {
            return quality != other.quality ? quality < other.quality : corner > other.corner;
        }
    };

    void consider(Corner corner);
    void stop_blocking(Corner corner);
    Corner blocker_of(Corner corner);
    Corner next_ear();
    bool is_current(const Candidate& c) const noexcept {
        return nodes_[c.corner].alive && nodes_[c.corner].version == c.version;
    }
    static void push(std::vector<Candidate>& heap, Candidate candidate) {
        heap.push_back(candidate);
        std::push_heap(heap.begin(), heap.end());
    }
    static Candidate pop(std::vector<Candidate>& heap) {
        std::pop_heap(heap.begin(), heap.end());
        const Candidate top = heap.back();
        heap.pop_back();
        return top;
    }
    void check_stop() const {
        if (stop_.stop_requested()) throw Error(ErrorCode::cancelled, "cancelled");
    }
    void count_test() {
        if (tests_left_ > 0 && --tests_left_ % k_stop_interval == 0) check_stop();
    }
    void build_grid();
    std::uint32_t column_of(double x) const noexcept { return cell_of(x - low_.x, columns_); }
    std::uint32_t row_of(double y) const noexcept { return cell_of(y - low_.y, rows_); }
    std::uint32_t cell_of(double distance, std::uint32_t count) const noexcept {
        if (count == 1) return 0;
        const double i = std::floor(distance / cell_size_);
        return static_cast<std::uint32_t>(std::clamp(i, 0.0, static_cast<double>(count - 1)));
    }

    std::stop_token stop_;
    std::span<const glm::vec3> positions_;
    std::vector<std::uint32_t> polygon_;
    std::vector<Node> nodes_;
    std::vector<Candidate> open_;     // Not known to be blocked.
    std::vector<Candidate> blocked_;  // Used if `open_` is empty: the polygon crosses itself.
    std::vector<Waiting> waiting_;
    Corner some_corner_ = 0;
    // Reflex corners in a grid over all of them, with about as many cells as corners. Cells are
    // square: a row of a comb's tips then spans many cells. The grid is rebuilt when the number of
    // reflex corners has halved.
    std::vector<std::uint32_t> cell_begin_;
    std::vector<Corner> cell_corners_;
    glm::dvec2 low_{};
    double cell_size_ = 1.0;
    std::uint32_t columns_ = 1, rows_ = 1;
    std::size_t reflex_count_ = 0;
    std::size_t gridded_count_ = 0;
    std::uint64_t tests_left_ = 0;
};

void Triangulator::EarClipper::build_grid() {
    gridded_count_ = reflex_count_;
    bool first = true;
    low_ = {};  // Reset for polygons without reflex corners.
    glm::dvec2 high{};
    for (const Node& n : nodes_) {
        if (!n.alive || !n.reflex) continue;
        low_ = first ? n.at : glm::min(low_, n.at);
        high = first ? n.at : glm::max(high, n.at);
        first = false;
    }
    const glm::dvec2 extent = high - low_;
    const double cells = static_cast<double>(std::max<std::size_t>(reflex_count_, 1));
    // At least extent / cells, for corners that lie nearly on a line.
    cell_size_ =
        std::max(std::sqrt(extent.x * extent.y / cells), std::max(extent.x, extent.y) / cells);
    const auto count = [&](double size) {
        return static_cast<std::uint32_t>(cell_size_ > 0.0 ? size / cell_size_ : 0.0) + 1;
    };
    columns_ = count(extent.x);
    rows_ = count(extent.y);
    cell_begin_.assign(std::size_t{columns_} * rows_ + 1, 0);
    const auto cell = [&](const Node& n) {
        return std::size_t{row_of(n.at.y)} * columns_ + column_of(n.at.x);
    };
    for (const Node& n : nodes_)
        if (n.alive && n.reflex) ++cell_begin_[cell(n) + 1];
    for (std::size_t i = 1; i < cell_begin_.size(); ++i) cell_begin_[i] += cell_begin_[i - 1];
    cell_corners_.resize(reflex_count_);
    // Filling advances cell_begin_ to the end of each cell. The shift restores it.
    for (Corner i = 0; i < nodes_.size(); ++i)
        if (nodes_[i].alive && nodes_[i].reflex) cell_corners_[cell_begin_[cell(nodes_[i])]++] = i;
    std::copy_backward(cell_begin_.begin(), cell_begin_.end() - 1, cell_begin_.end());
    cell_begin_[0] = 0;
}

// A reflex corner inside or on the border of the corner's triangle. A reflex corner at the position of
// one of the triangle's corners does not block, because keyholes and touching rings would otherwise
// block forever.
Corner Triangulator::EarClipper::blocker_of(Corner corner) {
    if (reflex_count_ == 0 || tests_left_ == 0) return k_no_corner;
    const Node& node = nodes_[corner];
    const glm::dvec2 a = nodes_[node.before].at;
    const glm::dvec2 b = node.at;
    const glm::dvec2 c = nodes_[node.after].at;
    const glm::dvec2 low = glm::min(a, glm::min(b, c));
    const glm::dvec2 high = glm::max(a, glm::max(b, c));
    const std::uint32_t last_row = row_of(high.y);
    const std::uint32_t first_column = column_of(low.x);
    const std::uint32_t last_column = column_of(high.x);
    for (std::uint32_t row = row_of(low.y); row <= last_row; ++row) {
        const std::size_t first = std::size_t{row} * columns_ + first_column;
        const std::uint32_t begin = cell_begin_[first];
        const std::uint32_t end = cell_begin_[first + (last_column - first_column) + 1];
        count_test();
        for (std::uint32_t i = begin; i < end; ++i) {
            // Counts actual tests only: the first corner of a long row often blocks.
            count_test();
            const Node& other = nodes_[cell_corners_[i]];
            if (!other.alive || !other.reflex) continue;
            const glm::dvec2 p = other.at;
            if (p == a || p == b || p == c) continue;
            if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0)
                return cell_corners_[i];
        }
    }
    return k_no_corner;
}

// Updates a corner whose triangle has changed.
void Triangulator::EarClipper::consider(Corner corner) {
    Node& node = nodes_[corner];
    ++node.version;
    const double area = turn(nodes_[node.before].at, node.at, nodes_[node.after].at);
    if (area <= 0.0) {
        // A corner on a straight line can be removed, but only as the last choice.
        if (area == 0.0) push(open_, {-1.0, corner, node.version});
        return;
    }
    if (node.reflex) stop_blocking(corner);
    push(open_, {shape(positions_[polygon_[node.before]], positions_[polygon_[corner]],
                       positions_[polygon_[node.after]]),
                 corner, node.version});
}

void Triangulator::EarClipper::stop_blocking(Corner corner) {
    Node& node = nodes_[corner];
    node.reflex = false;
    --reflex_count_;
    for (std::uint32_t i = node.waiting; i != k_no_waiting; i = waiting_[i].next) {
        const Waiting& w = waiting_[i];
        if (nodes_[w.corner].alive && nodes_[w.corner].version == w.version) consider(w.corner);
    }
    node.waiting = k_no_waiting;
}

Corner Triangulator::EarClipper::next_ear() {
    while (!open_.empty()) {
        const Candidate best = pop(open_);
        if (!is_current(best)) continue;
        if (best.quality < 0.0) return best.corner;
        const Corner blocker = blocker_of(best.corner);
        if (blocker == k_no_corner) return best.corner;
        push(blocked_, best);
        waiting_.push_back({best.corner, best.version, nodes_[blocker].waiting});
        nodes_[blocker].waiting = static_cast<std::uint32_t>(waiting_.size() - 1);
    }
    while (!blocked_.empty()) {
        const Candidate best = pop(blocked_);
        if (is_current(best)) return best.corner;
    }
    return some_corner_;
}

bool Triangulator::EarClipper::take(std::span<const glm::vec3> positions,
                                    std::span<const std::uint32_t> polygon) {
    const auto by_position = [&](std::uint32_t a, std::uint32_t b) {
        return is_before(positions[a], positions[b]);
    };
    polygon_.assign(polygon.begin(), polygon.end());
    std::ranges::rotate(polygon_, std::ranges::min_element(polygon_, by_position));
    const bool is_reversed = by_position(polygon_.back(), polygon_[1]);
    if (is_reversed) std::reverse(polygon_.begin() + 1, polygon_.end());
    return is_reversed;
}

void Triangulator::EarClipper::clip(std::span<const glm::vec3> positions, const Projection& project,
                                    std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const auto count = static_cast<Corner>(polygon_.size());
    positions_ = positions;
    nodes_.resize(count);
    open_.clear();
    blocked_.clear();
    waiting_.clear();
    for (Corner i = 0; i < count; ++i)
        nodes_[i] = {project(positions[polygon_[i]]),
                     i == 0 ? count - 1 : i - 1,
                     i + 1 == count ? 0 : i + 1,
                     0,
                     k_no_waiting,
                     true,
                     false};
    reflex_count_ = 0;
    for (Node& n : nodes_) {
        n.reflex = turn(nodes_[n.before].at, n.at, nodes_[n.after].at) <= 0.0;
        reflex_count_ += n.reflex;
    }
    build_grid();
    tests_left_ = std::min(k_tests_a_corner * count, k_max_tests);
    for (Corner i = 0; i < count; ++i) {
        if (i % k_stop_interval == 0) check_stop();
        consider(i);
    }

    some_corner_ = 0;
    for (Corner left = count; left > 3; --left) {
        if (left % k_stop_interval == 0) check_stop();
        const Corner ear = next_ear();
        Node& node = nodes_[ear];
        const Corner before = node.before;
        const Corner after = node.after;
        triangles.push_back({polygon_[before], polygon_[ear], polygon_[after]});
        node.alive = false;
        nodes_[before].after = after;
        nodes_[after].before = before;
        some_corner_ = after;
        if (node.reflex) stop_blocking(ear);
        consider(before);
        consider(after);
        if (gridded_count_ > 64 && reflex_count_ < gridded_count_ / 2) build_grid();
    }
    const Node& last = nodes_[some_corner_];
    triangles.push_back({polygon_[last.before], polygon_[some_corner_], polygon_[last.after]});
}

Triangulator::Triangulator(std::stop_token stop)
    : clipper_(std::make_unique<EarClipper>(std::move(stop))) {}
Triangulator::~Triangulator() = default;
Triangulator::Triangulator(Triangulator&&) noexcept = default;
Triangulator& Triangulator::operator=(Triangulator&&) noexcept = default;

void Triangulator::triangulate(std::span<const glm::vec3> positions,
                               std::span<const std::uint32_t> polygon,
                               std::vector<std::array<std::uint32_t, 3>>& triangles) {
    RIMLINE_CHECK(polygon.size() >= 3 && polygon.size() < k_no_corner);
    if (polygon.size() == 3) {
        triangles.push_back({polygon[0], polygon[1], polygon[2]});
        return;
    }
    if (polygon.size() == 4) {
        const glm::dvec3 normal = twice_area_vector(positions, polygon);
        // The two diagonals, each with the smaller of its two triangle areas along the normal. In a
        // concave quad the diagonal outside has a negative area.
        const auto corner = [&](int i) { return glm::dvec3(positions[polygon[i]]); };
        const auto area = [&](int i, int j, int k) {
            return glm::dot(normal, glm::cross(corner(j) - corner(i), corner(k) - corner(i)));
        };
        const double cut_02 = std::min(area(0, 1, 2), area(0, 2, 3));
        const double cut_13 = std::min(area(0, 1, 3), area(1, 2, 3));
        const bool both_inside = cut_02 > 0.0 && cut_13 > 0.0;
        const double more_02 =
            both_inside ? glm::distance(corner(1), corner(3)) - glm::distance(corner(0), corner(2))
                        : cut_02 - cut_13;
        if (more_02 > 0.0 || (more_02 == 0.0 && has_first_of_all(positions, polygon))) {
            triangles.push_back({polygon[0], polygon[1], polygon[2]});
            triangles.push_back({polygon[0], polygon[2], polygon[3]});
        } else {
            triangles.push_back({polygon[0], polygon[1], polygon[3]});
            triangles.push_back({polygon[1], polygon[2], polygon[3]});
        }
        return;
    }
    const bool is_reversed = clipper_->take(positions, polygon);
    polygon = clipper_->polygon();
    const glm::dvec3 normal = twice_area_vector(positions, polygon);
    const std::size_t first = triangles.size();
    if (normal == glm::dvec3(0.0)) {
        // Inside and outside are not defined.
        for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
            triangles.push_back({polygon[0], polygon[i], polygon[i + 1]});
    } else {
        clipper_->clip(positions, Projection(normal), triangles);
    }
    if (is_reversed)
        for (std::size_t i = first; i < triangles.size(); ++i)
            std::swap(triangles[i][1], triangles[i][2]);
}

}  // namespace rimline
