#include "silhouette/mesh/face_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace rimline {

namespace {

constexpr std::uint32_t k_faces_a_task = 4096;
constexpr std::size_t k_nodes_a_checkpoint = 64;

double reach_of(const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

}  // namespace

// Places that are moved as a whole, so that nothing is looked up while they are sorted.
class FaceTree::Builder {
public:
    explicit Builder(FaceTree& tree) : tree_(tree), places_(tree.order_.size()) {
        const auto count = static_cast<std::uint32_t>(places_.size());
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, k_faces_a_task),
                          [&](const auto& run) {
                              for (std::uint32_t f = run.begin(); f < run.end(); ++f) {
                                  const FaceBox box = tree_.box_of(f);
                                  places_[f] = {box.low + box.high, f};
                              }
                          });
    }

    // Large nodes are sorted level by level, each level on all threads, and what is below them at once.
    void build(const LongCall& call) {
        const auto count = static_cast<std::uint32_t>(places_.size());
        std::vector<Node> level{{0, 0, count}}, next;
        const double levels = std::max(1.0, std::log2(double(count) / k_leaf_faces));
        std::uint32_t depth = 0;
        for (; count >> depth > k_faces_a_task; ++depth) {
            call.checkpoint(depth / levels);
            next.resize(2 * level.size());
            tbb::parallel_for(std::size_t{0}, level.size(), [&](std::size_t i) {
                sort_around(level[i].first, middle_of(level[i].first, level[i].last),
                            level[i].last);
                std::ranges::copy(children_of(level[i]), next.begin() + std::ptrdiff_t(2 * i));
            });
            level.swap(next);
        }
        for (std::size_t first = 0; first < level.size(); first += k_nodes_a_checkpoint) {
            call.checkpoint(std::lerp(depth / levels, 1.0, double(first) / double(level.size())));
            tbb::parallel_for(first, std::min(level.size(), first + k_nodes_a_checkpoint),
                              [&](std::size_t i) { build_below(level[i]); });
        }
        for (std::size_t node = level.front().number; node-- > 0;) {
            tree_.boxes_[node] = tree_.boxes_[2 * node + 1];
            tree_.boxes_[node].include(tree_.boxes_[2 * node + 2]);
        }
    }

private:
    // Sorts the faces of a node, and sets the boxes of the node and of all below it.
    FaceBox build_below(const Node& node) {
        FaceBox box;
        if (is_leaf(node)) {
            for (std::uint32_t i = node.first; i < node.last; ++i) {
                tree_.order_[i] = places_[i].face;
                box.include(tree_.box_of(places_[i].face));
            }
            return tree_.boxes_[node.number] = box;
        }
        sort_around(node.first, middle_of(node.first, node.last), node.last);
        for (const Node& child : children_of(node)) box.include(build_below(child));
        return tree_.boxes_[node.number] = box;
    }

    struct Place {
        glm::vec3 twice_center;
        std::uint32_t face;
    };

    // By the axis along which the centers extend farthest. The face number breaks ties, so the tree is the same on
    // every machine.
    void sort_around(std::uint32_t first, std::uint32_t middle, std::uint32_t last) {
        glm::vec3 low = places_[first].twice_center, high = low;
        for (std::uint32_t i = first; i < last; ++i) {
            low = glm::min(low, places_[i].twice_center);
            high = glm::max(high, places_[i].twice_center);
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        std::nth_element(places_.begin() + first, places_.begin() + middle, places_.begin() + last,
                         [axis](const Place& a, const Place& b) {
                             const float p = a.twice_center[axis], q = b.twice_center[axis];
                             return p != q ? p < q : a.face < b.face;
                         });
    }

    FaceTree& tree_;
    std::vector<Place> places_;
};

FaceTree::FaceTree(const Mesh& mesh, const LongCall& call)
    : mesh_(mesh), order_(mesh.face_count()) {
    std::size_t nodes = 1;
    for (std::uint32_t faces = mesh.face_count(); faces > k_leaf_faces; faces -= faces / 2)
        nodes = 2 * nodes + 1;
    boxes_.resize(nodes);
    Builder(*this).build(call);
}

FaceBox FaceTree::box_of(std::uint32_t face) const {
    FaceBox box;
    for (const VertexId v : mesh_.triangles()[face]) {
        const glm::vec3& p = mesh_.positions()[index(v)];
        box.include({p, p});
    }
    return box;
}

std::vector<FaceTree::NodePair> FaceTree::node_pairs(std::uint32_t max_faces) const {
    const Node root{0, 0, static_cast<std::uint32_t>(order_.size())};
    std::vector<NodePair> done, open{{root, root}};
    while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        const bool is_same = a.number == b.number;
        if (!is_same && !boxes_[a.number].meets(boxes_[b.number])) continue;
        const Node& larger = a.size() >= b.size() ? a : b;
        if (is_leaf(larger) || larger.size() <= max_faces) {
            done.push_back({a, b});
            continue;
        }
        const auto [low, high] = children_of(larger);
        const Node& rest = a.size() >= b.size() ? b : a;
        if (is_same)
            open.insert(open.end(), {{low, high}, {high, high}, {low, low}});
        else
            open.insert(open.end(), {{high, rest}, {low, rest}});
    }
    return done;
}

// The margin is a few hundred times the rounding errors of the tests and of the ends. Along an axis on which the
// segment has no length, 1e300 tells as well as infinity on which side of it a box lies, and gives no NaN.
FaceTree::Segment::Segment(const glm::dvec3& a, const glm::dvec3& b)
    : from(a), margin(0x1p-44 * (reach_of(a) + reach_of(b)) + 0x1p-1000) {
    for (int i = 0; i < 3; ++i) inverse[i] = std::clamp(1.0 / (b[i] - a[i]), -1e300, 1e300);
}

}  // namespace rimline
