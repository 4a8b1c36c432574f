#include "silhouette/hough/hough_octree.h"

#include <algorithm>
#include <array>
#include <bit>

#include "silhouette/hough/octree_order.h"

namespace rimline {

namespace {

// Up to 32 bits of a packed array from any position, which it must be one word longer for.
std::uint32_t bits_from(std::span<const std::uint32_t> words, std::uint32_t position) {
    const std::uint64_t pair = std::uint64_t{words[position / 32 + 1]} << 32 | words[position / 32];
    return static_cast<std::uint32_t>(pair >> (position % 32));
}

void flip_bits_from(std::span<std::uint32_t> words, std::uint32_t position, std::uint32_t mask) {
    const std::uint64_t pair = std::uint64_t{mask} << (position % 32);
    words[position / 32] ^= static_cast<std::uint32_t>(pair);
    words[position / 32 + 1] ^= static_cast<std::uint32_t>(pair >> 32);
}

std::uint32_t front_bits(std::span<const Plane> planes, const HomogeneousPoint& point) {
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < planes.size(); ++i)
        bits |= std::uint32_t{is_front(planes[i], point)} << i;
    return bits;
}

std::uint32_t low_bits(std::uint32_t count) { return count == 32 ? ~0u : (1u << count) - 1; }

// A depth-first walk's pending work. Its depth is bounded (octree_order.h), so it never allocates.
template <typename Visit>
class Stack {
public:
    bool is_empty() const noexcept { return size_ == 0; }
    void push(const Visit& visit) noexcept { items_[size_++] = visit; }
    Visit pop() noexcept { return items_[--size_]; }

private:
    std::uint32_t size_ = 0;
    std::array<Visit, k_octree_max_stack> items_;
};

}  // namespace

// Results are stored before it is known whether they count: a branch would be taken at random.
void HoughOctree::test_edges(std::span<const EdgeRecord> records, const HomogeneousPoint& point,
                             std::vector<EdgeId>& edges) const {
    const std::uint32_t inconsistent = mesh_->edges_of_class(EdgeClass::inconsistent).first;
    std::array<EdgeId, 64> found;
    while (!records.empty()) {
        std::size_t count = 0;
        const auto block = records.first(std::min(records.size(), found.size()));
        for (const EdgeRecord& record : block) {
            const bool differ =
                is_front(planes_[record.owner], point) != is_front(record.other, point);
            found[count] = record.edge;
            count += differ != (index(record.edge) >= inconsistent);
        }
        edges.insert(edges.end(), found.data(), found.data() + count);
        records = records.subspan(block.size());
    }
}

void HoughOctree::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                          TraversalCounters& counters) const {
    RIMLINE_CHECK(point.is_valid());
    edges.clear();
    TraversalCounters work;
    const VSphere sphere(point, origin_, greatest_reach());
    Stack<std::uint32_t> stack;
    if (!edge_nodes_.empty()) stack.push(0);
    while (!stack.is_empty()) {
        const Node& node = edge_nodes_[stack.pop()];
        if (node.begin == node.end) continue;
        ++work.box_checks;
        if (sphere.side_of(node.box, node.reach) != VSphereSide::mixed) continue;
        for (std::uint32_t k = node.child_count; k-- > 0;) stack.push(node.first_child + k);
        if (node.child_count > 0) continue;
        test_edges(std::span(edges_).subspan(node.begin, node.end - node.begin), point, edges);
        work.edge_checks += node.end - node.begin;
    }
    test_edges(explicit_edges_, point, edges);
    work.edge_checks += explicit_edges_.size();
    work.face_checks = 2 * work.edge_checks;

    const Mesh::EdgeRange nonmanifold = mesh_->edges_of_class(EdgeClass::nonmanifold);
    for (std::uint32_t e = nonmanifold.first; e < nonmanifold.last; ++e) {
        const std::span<const FaceId> faces = mesh_->faces_of(EdgeId{e});
        const bool first = is_front(mesh_->plane(faces[0]), point);
        const bool differ = std::any_of(faces.begin() + 1, faces.end(), [&](FaceId face) {
            return is_front(mesh_->plane(face), point) != first;
        });
        if (differ) edges.push_back(EdgeId{e});
        work.face_checks += faces.size();
    }
    work.edge_checks += nonmanifold.size();
    counters += work;
}

void HoughOctree::evaluate_faces(const HomogeneousPoint& point,
                                 std::span<std::uint32_t> tree_words) const noexcept {
    RIMLINE_CHECK(tree_words.size() == tree_word_count());
    std::fill(tree_words.begin(), tree_words.end(), 0u);
    for (std::uint32_t begin = 0; begin < faces_.size(); begin += 32) {
        const std::uint32_t count = std::min(32u, statistics_.faces - begin);
        tree_words[begin / 32] = front_bits(std::span(planes_).subspan(begin, count), point);
    }
}

void HoughOctree::flip(std::uint32_t begin, std::uint32_t mask, std::span<std::uint32_t> tree_words,
                       std::vector<FaceId>& flipped) const noexcept {
    flip_bits_from(tree_words, begin, mask);
    for (; mask != 0; mask &= mask - 1)
        flipped.push_back(faces_[begin + static_cast<std::uint32_t>(std::countr_zero(mask))]);
}

void HoughOctree::find_flips(const HomogeneousPoint& from, const HomogeneousPoint& to,
                             std::span<std::uint32_t> tree_words, std::vector<FaceId>& flipped,
                             TraversalCounters& counters) const noexcept {
    RIMLINE_CHECK(tree_words.size() == tree_word_count());
    RIMLINE_CHECK(flipped.capacity() - flipped.size() >= statistics_.faces);
    if (from == to || face_nodes_.empty()) return;
    TraversalCounters work;
    const VSphere old_sphere(from, origin_, greatest_reach());
    const VSphere new_sphere(to, origin_, greatest_reach());
    // What is certain of a node is certain of its children, whose boxes lie in its own.
    struct Visit {
        std::uint32_t node;
        VSphereSide old_side, new_side;
    };
    Stack<Visit> stack;
    stack.push({0, VSphereSide::mixed, VSphereSide::mixed});
    while (!stack.is_empty()) {
        auto [n, old_side, new_side] = stack.pop();
        const Node& node = face_nodes_[n];
        if (old_side == VSphereSide::mixed) {
            old_side = old_sphere.side_of(node.box, node.reach);
            ++work.box_checks;
        }
        if (new_side == VSphereSide::mixed) {
            new_side = new_sphere.side_of(node.box, node.reach);
            ++work.box_checks;
        }
        const bool certain = old_side != VSphereSide::mixed && new_side != VSphereSide::mixed;
        if (certain && old_side == new_side) continue;
        if (!certain && node.child_count > 0) {
            for (std::uint32_t k = node.child_count; k-- > 0;)
                stack.push({node.first_child + k, old_side, new_side});
            continue;
        }
        for (std::uint32_t begin = node.begin; begin < node.end; begin += 32) {
            const std::uint32_t count = std::min(32u, node.end - begin);
            std::uint32_t mask = low_bits(count);
            if (!certain) {
                mask &= bits_from(tree_words, begin) ^
                        front_bits(std::span(planes_).subspan(begin, count), to);
                work.face_checks += count;
            }
            flip(begin, mask, tree_words, flipped);
        }
    }
    counters += work;
}

}  // namespace rimline
