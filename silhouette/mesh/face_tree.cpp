#include "silhouette/mesh/face_tree.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rimline {

namespace {

constexpr std::uint32_t k_faces_a_task = 4096;

double reach_of(const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

}  // namespace

FaceTree::FaceTree(const Mesh& mesh) : mesh_(mesh), order_(mesh.face_count()) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::size_t nodes = 1;
    for (std::uint32_t faces = mesh.face_count(); faces > k_leaf_faces; faces -= faces / 2)
        nodes = 2 * nodes + 1;
    boxes_.resize(nodes);
    build(0, 0, mesh.face_count());
}

FaceBox FaceTree::box_of(std::uint32_t face) const {
    FaceBox box;
    for (const VertexId v : mesh_.triangles()[face]) {
        const glm::vec3& p = mesh_.positions()[index(v)];
        box.include({p, p});
    }
    return box;
}

void FaceTree::build(std::size_t node, std::uint32_t first, std::uint32_t last) {
    FaceBox box;
    for (std::uint32_t i = first; i < last; ++i) box.include(box_of(order_[i]));
    boxes_[node] = box;
    if (last - first <= k_leaf_faces) return;
    const glm::vec3 size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    // The face number breaks ties, so the tree is the same on every machine.
    const auto place = [&](std::uint32_t face) {
        const FaceBox b = box_of(face);
        return std::pair(b.low[axis] + b.high[axis], face);
    };
    const std::uint32_t middle = middle_of(first, last);
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
    const auto low = [&] { build(2 * node + 1, first, middle); };
    const auto high = [&] { build(2 * node + 2, middle, last); };
    if (last - first > k_faces_a_task) {
        tbb::parallel_invoke(low, high);
    } else {
        low();
        high();
    }
}

// The margin is a few hundred times the rounding errors of the tests and of the ends.
FaceTree::Segment::Segment(const glm::dvec3& a, const glm::dvec3& b)
    : from(a), margin(0x1p-44 * (reach_of(a) + reach_of(b)) + 0x1p-1000) {
    for (int i = 0; i < 3; ++i) inverse[i] = 1.0 / (b[i] - a[i]);
}

bool FaceTree::Segment::may_meet(const FaceBox& box) const noexcept {
    double begin = 0.0, end = 1.0;
    for (int i = 0; i < 3; ++i) {
        const double low = double{box.low[i]} - margin - from[i];
        const double high = double{box.high[i]} + margin - from[i];
        if (std::isinf(inverse[i])) {
            if (low > 0.0 || high < 0.0) return false;
            continue;
        }
        const double p = low * inverse[i], q = high * inverse[i];
        begin = std::max(begin, std::min(p, q));
        end = std::min(end, std::max(p, q));
    }
    return begin <= end + 0x1p-44;
}

}  // namespace rimline
