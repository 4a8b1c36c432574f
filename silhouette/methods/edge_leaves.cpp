#include "silhouette/methods/edge_leaves.h"

#include <algorithm>
#include <bit>

namespace rimline {

namespace {

std::size_t block_count(std::uint32_t edges) {
    return (std::size_t{edges} + k_leaf_items - 1) / k_leaf_items;
}

}  // namespace

EdgeLeaves::EdgeLeaves(const Mesh& mesh, std::span<const EdgeId> treed)
    : mesh_(&mesh), treed_count_(static_cast<std::uint32_t>(treed.size())) {
    const Mesh::EdgeRange regular = mesh.edges_of_class(EdgeClass::regular);
    const Mesh::EdgeRange inconsistent = mesh.edges_of_class(EdgeClass::inconsistent);
    std::vector<bool> is_treed(regular.last, false);
    for (const EdgeId edge : treed) {
        RIMLINE_CHECK(index(edge) < regular.last && !is_treed[index(edge)]);
        is_treed[index(edge)] = true;
    }
    std::vector<EdgeId> untreed;
    for (std::uint32_t e = regular.first; e < regular.last; ++e)
        if (!is_treed[e]) untreed.push_back(EdgeId{e});
    std::vector<EdgeId> equal_faced;
    for (std::uint32_t e = inconsistent.first; e < inconsistent.last; ++e)
        equal_faced.push_back(EdgeId{e});

    untreed_count_ = static_cast<std::uint32_t>(untreed.size());
    rest_count_ = mesh.edges_of_class(EdgeClass::border).first - treed_count_;
    blocks_.reserve(block_count(treed_count_) + block_count(untreed_count_) +
                    block_count(inconsistent.size()));
    append(treed);
    append(untreed);
    append(equal_faced);
}

void EdgeLeaves::append(std::span<const EdgeId> edges) {
    for (std::size_t begin = 0; begin < edges.size(); begin += k_leaf_items) {
        Block& block = blocks_.emplace_back();
        block.edges.fill(k_no_edge);
        const std::size_t count = std::min<std::size_t>(k_leaf_items, edges.size() - begin);
        for (std::uint32_t i = 0; i < count; ++i) {
            block.edges[i] = edges[begin + i];
            for (std::size_t side = 0; side < 2; ++side)
                block.faces[side].set(i, mesh_->plane(mesh_->edge(block.edges[i]).faces[side]));
        }
    }
}

void EdgeLeaves::test(const Block& block, std::uint32_t count, std::uint32_t inverted,
                      const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                      TraversalCounters& counters) const {
    counters.edge_checks += count;
    counters.face_checks += 2 * std::uint64_t{count};
    std::uint32_t on = (difference_(block.faces, point) ^ inverted) & ((1u << count) - 1);
    for (; on != 0; on &= on - 1)
        edges.push_back(block.edges[static_cast<std::uint32_t>(std::countr_zero(on))]);
}

void EdgeLeaves::test_leaf(std::uint32_t leaf, const HomogeneousPoint& point,
                           std::vector<EdgeId>& edges, TraversalCounters& counters) const {
    test(blocks_[leaf], std::min(k_leaf_items, treed_count_ - leaf * k_leaf_items), 0, point, edges,
         counters);
}

void EdgeLeaves::test_run(std::size_t first_block, std::uint32_t count, std::uint32_t inverted,
                          const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                          TraversalCounters& counters) const {
    for (std::uint32_t begin = 0; begin < count; begin += k_leaf_items)
        test(blocks_[first_block + begin / k_leaf_items], std::min(k_leaf_items, count - begin),
             inverted, point, edges, counters);
}

void EdgeLeaves::test_rest(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                           TraversalCounters& counters) const {
    const std::size_t untreed = block_count(treed_count_);
    const std::size_t equal_faced = untreed + block_count(untreed_count_);
    test_run(untreed, untreed_count_, 0, point, edges, counters);
    // On the silhouette where the bits are equal.
    test_run(equal_faced, mesh_->edges_of_class(EdgeClass::inconsistent).size(), ~0u, point, edges,
             counters);

    const Mesh::EdgeRange nonmanifold = mesh_->edges_of_class(EdgeClass::nonmanifold);
    for (std::uint32_t e = nonmanifold.first; e < nonmanifold.last; ++e) {
        const std::span<const FaceId> faces = mesh_->faces_of(EdgeId{e});
        const bool first = is_front(mesh_->plane(faces[0]), point);
        counters.face_checks += faces.size();
        if (std::any_of(faces.begin() + 1, faces.end(),
                        [&](FaceId face) { return is_front(mesh_->plane(face), point) != first; }))
            edges.push_back(EdgeId{e});
    }
    counters.edge_checks += nonmanifold.size();
}

}  // namespace rimline
