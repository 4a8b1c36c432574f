#include "silhouette/mesh/face_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "silhouette/gradual_resize.h"

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
    Builder(FaceTree& tree, const std::stop_token& stop) : tree_(tree) {
        resize_gradually(places_, tree.order_.size(), stop);
        const auto count = static_cast<std::uint32_t>(places_.size());
        tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, k_faces_a_task),
                          [&](const auto& run) {
                              for (std::uint32_t f = run.begin(); f < run.end(); ++f) {
                                  const FaceBox box = tree_.box_of(f);
                                  places_[f] = Place(box.low + box.high, f);
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
                tree_.order_[i] = places_[i].face();
                box.include(tree_.box_of(places_[i].face()));
            }
            return tree_.boxes_[node.number] = box;
        }
        sort_around(node.first, middle_of(node.first, node.last), node.last);
        for (const Node& child : children_of(node)) box.include(build_below(child));
        return tree_.boxes_[node.number] = box;
    }

    // Twice the center of a face, and the face: four words of 32 bits. They are moved in halves of 64, as they are
    // read again: a load of all that follows stores of its parts waits for them.
    class Place {
    public:
        Place() = default;
        Place(const glm::vec3& twice_center, std::uint32_t face)
            : halves_{joined(twice_center.x, twice_center.y),
                      joined(twice_center.z, std::bit_cast<float>(face))} {}
        glm::vec3 twice_center() const {
            return {std::bit_cast<float>(word(0)), std::bit_cast<float>(word(1)),
                    std::bit_cast<float>(word(2))};
        }
        std::uint32_t face() const { return word(3); }
        // Ascends with the center along an axis. The face number breaks ties, so the tree is the same on every
        // machine.
        template <int axis>
        std::int64_t key() const {
            const auto bits = static_cast<std::int32_t>(word(axis));
            const std::int32_t ordered = bits ^ (bits >> 31 & 0x7fffffff);
            return std::int64_t{ordered} * (std::int64_t{1} << 32) + face();
        }
        void swap_with(Place& other) { std::swap(halves_, other.halves_); }

    private:
        static std::uint64_t joined(float low, float high) {
            return std::uint64_t{std::bit_cast<std::uint32_t>(high)} << 32 |
                   std::bit_cast<std::uint32_t>(low);
        }
        std::uint32_t word(int i) const {
            return static_cast<std::uint32_t>(halves_[i / 2] >> 32 * (i % 2));
        }
        std::array<std::uint64_t, 2> halves_;
    };

    // By the axis along which the centers extend farthest.
    void sort_around(std::uint32_t first, std::uint32_t middle, std::uint32_t last) {
        glm::vec3 low = places_[first].twice_center(), high = low;
        for (std::uint32_t i = first; i < last; ++i) {
            low = glm::min(low, places_[i].twice_center());
            high = glm::max(high, places_[i].twice_center());
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
        constexpr std::array k_select{&Builder::select<0>, &Builder::select<1>,
                                      &Builder::select<2>};
        k_select[axis](places_.data() + first, places_.data() + middle, places_.data() + last);
    }

    // As std::nth_element, which takes four times as long, because half of its branches go the other way than
    // predicted. It does the rest where pivots stay bad.
    template <int axis>
    static void select(Place* first, Place* nth, Place* last) {
        const auto less = [](const Place& a, const Place& b) {
            return a.key<axis>() < b.key<axis>();
        };
        std::size_t rounds = 2 * std::bit_width(static_cast<std::size_t>(last - first));
        while (last - first > k_few_places) {
            if (rounds-- == 0) return std::nth_element(first, nth, last, less);
            const std::int64_t pivot = pivot_near<axis>(first, nth, last);
            Place* below = first;
            for (Place* place = first; place != last; ++place) {
                const std::int64_t key = place->key<axis>();
                place->swap_with(*below);
                below += key < pivot;
            }
            (nth < below ? last : first) = below;
        }
        std::sort(first, last, less);
    }

    // A key that is neither the least nor less than all, a little on that side of the nth which has more places: so
    // the nth is among the fewer afterwards, mostly.
    template <int axis>
    static std::int64_t pivot_near(const Place* first, const Place* nth, const Place* last) {
        std::array<std::int64_t, k_max_sample> keys;
        const std::ptrdiff_t count = last - first;
        const std::ptrdiff_t sample = count < 100 ? 3 : (count < 2000 ? 15 : k_max_sample);
        // One anywhere in each part: places with a step would fall on the same column of a grid.
        std::uint64_t random = static_cast<std::uint64_t>(count);
        for (std::ptrdiff_t i = 0; i < sample; ++i) {
            random = random * 6364136223846793005u + 1442695040888963407u;
            const std::ptrdiff_t begin = i * count / sample, end = (i + 1) * count / sample;
            keys[i] = first[begin + std::ptrdiff_t(random >> 33) % (end - begin)].key<axis>();
        }
        std::sort(keys.begin(), keys.begin() + sample);
        const double share = double(nth - first) / double(count);
        const double margin = 0.6 * std::sqrt(share * (1.0 - share) / double(sample));
        const double rank = (share + (share < 0.5 ? margin : -margin)) * double(sample);
        return keys[std::clamp(std::ptrdiff_t(rank), std::ptrdiff_t{1}, sample - 1)];
    }
    static constexpr std::ptrdiff_t k_few_places = 12, k_max_sample = 63;

    FaceTree& tree_;
    std::vector<Place> places_;
};

FaceTree::FaceTree(const Mesh& mesh, const LongCall& call)
    : mesh_(mesh), order_(mesh.face_count()) {
    std::size_t nodes = 1;
    // The deepest path: second children, where all blocks are full, or all leaves of the only one.
    const std::uint32_t unit = mesh.face_count() > k_block_faces ? k_block_faces : k_leaf_faces;
    const std::uint32_t full = (mesh.face_count() + unit - 1) / unit * unit;
    for (std::uint32_t faces = full; faces > k_leaf_faces; faces -= middle_of(0, faces))
        nodes = 2 * nodes + 1;
    resize_gradually(boxes_, nodes, call.stop);
    Builder(*this, call.stop).build(call);
}

FaceBox FaceTree::box_of(std::uint32_t face) const {
    FaceBox box;
    for (const VertexId v : mesh_.triangles()[face]) {
        const glm::vec3& p = mesh_.positions()[index(v)];
        box.include({p, p});
    }
    return box;
}

FaceTree::NodePairs::NodePairs(const FaceTree& tree, std::uint32_t max_faces)
    : tree_(tree), max_faces_(max_faces) {
    RIMLINE_CHECK(max_faces >= k_block_faces);
    const Node root{0, 0, static_cast<std::uint32_t>(tree.order_.size())};
    open_.push_back({{root, root}, 1.0});
}

void FaceTree::NodePairs::next(std::size_t count, std::vector<NodePair>& pairs) {
    pairs.clear();
    while (!open_.empty() && pairs.size() < count) {
        const auto [pair, share] = open_.back();
        const auto& [a, b] = pair;
        open_.pop_back();
        const bool is_same = a.number == b.number;
        const bool meets = is_same || tree_.boxes_[a.number].meets(tree_.boxes_[b.number]);
        const Node& larger = a.size() >= b.size() ? a : b;
        if (!meets || larger.size() <= max_faces_) {
            if (meets) pairs.push_back(pair);
            done_ += share;
            continue;
        }
        const auto [low, high] = children_of(larger);
        const Node& rest = a.size() >= b.size() ? b : a;
        if (is_same) {
            // Most pairs of faces that meet are neighbors.
            open_.push_back({{low, high}, 0.1 * share});
            open_.push_back({{high, high}, 0.45 * share});
            open_.push_back({{low, low}, 0.45 * share});
        } else {
            open_.push_back({{high, rest}, 0.5 * share});
            open_.push_back({{low, rest}, 0.5 * share});
        }
    }
}

// The margin is a few hundred times the rounding errors of the tests and of the ends. Along an axis on which the
// segment has no length, 1e300 tells as well as infinity on which side of it a box lies, and gives no NaN.
FaceTree::Segment::Segment(const glm::dvec3& a, const glm::dvec3& b) {
    const double margin = 0x1p-44 * (reach_of(a) + reach_of(b)) + 0x1p-1000;
    behind = a + margin;
    before = a - margin;
    for (int i = 0; i < 3; ++i) inverse[i] = std::clamp(1.0 / (b[i] - a[i]), -1e300, 1e300);
}

}  // namespace rimline
