#include "tools/bench/box_tests.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace rimline::tools {

namespace {

struct Interval {
    double low = 0.0, high = 0.0;
};

// Of h(h - q) over the box on one axis.
Interval axis_values(double low, double high, double q) {
    const double at = std::clamp(0.5 * q, low, high);
    return {at * (at - q), std::max(low * (low - q), high * (high - q))};
}

VSphereSide side_of(const Interval& g) {
    if (g.high < 0.0) return VSphereSide::inside;
    return g.low > 0.0 ? VSphereSide::outside : VSphereSide::mixed;
}

Interval exact_values(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& q) {
    Interval sum;
    for (int i = 0; i < 3; ++i) {
        const Interval axis = axis_values(low[i], high[i], q[i]);
        sum.low += axis.low;
        sum.high += axis.high;
    }
    return sum;
}

Interval interval_values(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& q) {
    Interval sum;
    for (int i = 0; i < 3; ++i) {
        const bool holds_zero = low[i] < 0.0 && high[i] > 0.0;
        const double low_square = low[i] * low[i];
        const double high_square = high[i] * high[i];
        sum.low += holds_zero ? 0.0 : std::min(low_square, high_square);
        sum.high += std::max(low_square, high_square);
        sum.low -= std::max(low[i] * q[i], high[i] * q[i]);
        sum.high -= std::min(low[i] * q[i], high[i] * q[i]);
    }
    return sum;
}

class BoxCount {
public:
    BoxCount(const LiteralOctree& octree, const HomogeneousPoint& viewpoint, BoxTest test,
             bool is_ebv_first)
        : octree_(octree),
          q_(glm::dvec3(viewpoint.xyz()) - octree.origin()),
          test_(test),
          is_ebv_first_(is_ebv_first) {}

    void visit(std::uint32_t number) {
        const OctreeNode& node = octree_.nodes()[number];
        if (!octree_.is_small_leaf(node)) {
            if (is_ebv_first_ ? is_inside(number) || is_outside(number)
                              : is_outside(number) || is_inside(number))
                return;
        }
        for (const std::uint32_t child : node.children)
            if (child != k_no_node) visit(child);
    }

    const LiteralCounters& work() const noexcept { return work_; }

private:
    bool is_outside(std::uint32_t number) {
        ++work_.pbv_checks;
        return tools::side_of(octree_.point_boxes()[number].box, q_, test_) == VSphereSide::outside;
    }
    bool is_inside(std::uint32_t number) {
        ++work_.ebv_checks;
        return tools::side_of(octree_.edge_boxes()[number].box, q_, test_) == VSphereSide::inside;
    }

    const LiteralOctree& octree_;
    glm::dvec3 q_;
    BoxTest test_;
    bool is_ebv_first_;
    LiteralCounters work_;
};

}  // namespace

std::string_view name_of(BoxTest test) noexcept {
    switch (test) {
        case BoxTest::exact: return "exact";
        case BoxTest::spheres: return "spheres";
        case BoxTest::inside_sphere: return "inside_sphere";
        case BoxTest::sphere_box: return "sphere_box";
        case BoxTest::intervals: return "intervals";
    }
    return "";
}

VSphereSide side_of(const HoughBox& box, const glm::dvec3& q, BoxTest test) noexcept {
    const glm::dvec3 low(box.low[0], box.low[1], box.low[2]);
    const glm::dvec3 high(box.high[0], box.high[1], box.high[2]);
    const VSphereSide exact = side_of(exact_values(low, high, q));
    if (test == BoxTest::exact) return exact;
    if (test == BoxTest::intervals) return side_of(interval_values(low, high, q));

    const double radius = 0.5 * glm::length(q);
    if (test == BoxTest::sphere_box) {
        if (exact == VSphereSide::inside) return exact;
        const bool is_apart = glm::any(glm::lessThan(high, 0.5 * q - radius)) ||
                              glm::any(glm::greaterThan(low, 0.5 * q + radius));
        return is_apart ? VSphereSide::outside : VSphereSide::mixed;
    }
    const double between = glm::distance(0.5 * (low + high), 0.5 * q);
    const double reach = 0.5 * glm::distance(low, high);
    if (between + reach < radius) return VSphereSide::inside;
    const bool is_outside =
        test == BoxTest::inside_sphere ? exact == VSphereSide::outside : between - reach > radius;
    return is_outside ? VSphereSide::outside : VSphereSide::mixed;
}

LiteralCounters count_boxes(const LiteralOctree& octree, const HomogeneousPoint& viewpoint,
                            BoxTest test, bool is_ebv_first) {
    RIMLINE_CHECK(viewpoint.w == 1.0f);
    BoxCount count(octree, viewpoint, test, is_ebv_first);
    if (!octree.nodes().empty()) count.visit(0);
    return count.work();
}

}  // namespace rimline::tools
