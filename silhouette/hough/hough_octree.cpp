#include "silhouette/hough/hough_octree.h"

#include <algorithm>
#include <bit>
#include <glm/geometric.hpp>

#include "silhouette/hough/block_kernels.h"
#include "silhouette/hough/face_links.h"
#include "silhouette/mesh/face_bits.h"

namespace rimline {

std::vector<std::uint32_t> HoughOctree::face_groups() const {
    std::vector<std::uint32_t> groups(mesh_->face_count(), k_no_group);
    for (std::uint32_t g = 0; g < face_blocks_.size(); ++g) {
        const FaceBlocks& blocks = face_blocks_[g];
        const std::size_t first = std::size_t{blocks.first_block} * k_block_size;
        for (const FaceId face :
             std::span(faces_).subspan(first, blocks.planes.size() * k_block_size))
            if (face != k_no_face) groups[index(face)] = g;
    }
    return groups;
}

std::span<const FaceLinks> HoughOctree::links() const noexcept { return links_; }

std::string_view HoughOctree::instruction_set() { return kernels::instruction_set(); }

// Decides the edges that integers cannot: in about one of two hundred blocks. Their edges and planes lie anywhere, so
// they are fetched together. Returns how many are on the silhouette.
std::size_t HoughOctree::decide_edges(std::span<const EdgeId> edges, const HomogeneousPoint& point,
                                      std::uint32_t count, BlockScratch& scratch) const noexcept {
    struct Doubt {
        std::uint32_t found, lane;
        EdgeId edge;
    };
    std::array<Doubt, 64> doubts;
    std::size_t pending = 0, on = 0;
    const std::uint32_t inconsistent = mesh_->edges_of_class(EdgeClass::inconsistent).first;
    const auto decide = [&] {
        for (const Doubt& doubt : std::span(doubts).first(pending))
            for (const FaceId face : mesh_->edge(doubt.edge).faces)
                __builtin_prefetch(&mesh_->plane(face));
        for (const Doubt& doubt : std::span(doubts).first(pending)) {
            const std::array<FaceId, 2>& faces = mesh_->edge(doubt.edge).faces;
            const bool differ =
                is_front(mesh_->plane(faces[0]), point) != is_front(mesh_->plane(faces[1]), point);
            const bool is_on = differ != (index(doubt.edge) >= inconsistent);
            scratch.found_lanes[doubt.found] |= std::uint32_t{is_on} << doubt.lane;
            on += is_on;
        }
        pending = 0;
    };
    for (const std::uint32_t j : std::span(scratch.doubtful).first(count)) {
        if (pending + k_block_size > doubts.size()) decide();
        for (std::uint32_t lanes = scratch.found_doubts[j]; lanes != 0; lanes &= lanes - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
            const EdgeId edge = edges[std::size_t{scratch.found_block[j]} * k_block_size + lane];
            __builtin_prefetch(&mesh_->edge(edge));
            doubts[pending++] = {j, lane, edge};
        }
    }
    decide();
    return on;
}

std::uint32_t HoughOctree::front_doubts(const FaceBlocks& blocks, const HomogeneousPoint& point,
                                        std::uint32_t found,
                                        const BlockScratch& scratch) const noexcept {
    const FaceId* const faces =
        faces_.data() + std::size_t{blocks.first_block + scratch.found_block[found]} * k_block_size;
    std::uint32_t fronts = 0;
    for (std::uint32_t doubts = scratch.found_doubts[found]; doubts != 0; doubts &= doubts - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(doubts));
        fronts |= std::uint32_t{is_front(mesh_->plane(faces[lane]), point)} << lane;
    }
    return fronts;
}

void HoughOctree::extract_blocks(const EdgeBlocks& blocks, const HomogeneousPoint& point,
                                 std::vector<EdgeId>& edges, TraversalCounters& work,
                                 BlockScratch& scratch) const {
    if (blocks.planes.empty()) return;
    const BlockPoint seen_from = blocks.space.seen_from(point);
    std::uint64_t nodes = 0;
    const std::uint32_t count = kernels::find_mixed(blocks.tree, seen_from, scratch, nodes);
    const kernels::TestedEdges tested = kernels::test_edges(blocks, seen_from, count, scratch);
    const std::size_t on =
        tested.certain + decide_edges(blocks.edges, point, tested.doubtful, scratch);
    // Whole vectors are stored, so one more block must fit.
    const std::size_t old_size = edges.size();
    edges.resize(old_size + on + k_block_size);
    kernels::write_edges(blocks.edges, tested.found, scratch, edges.data() + old_size);
    edges.resize(old_size + on);
    work.box_checks += nodes * k_node_width;
    work.face_checks += 2 * std::uint64_t{count} * k_block_size;
    work.edge_checks += std::uint64_t{count} * k_block_size;
}

void HoughOctree::extract_nonmanifold(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                                      TraversalCounters& work) const {
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
}

void HoughOctree::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                          TraversalCounters& counters, BlockScratch& scratch) const {
    RIMLINE_CHECK(point.is_valid());
    RIMLINE_CHECK(scratch.max_blocks >= max_blocks_);
    edges.clear();
    for (const EdgeBlocks& blocks : edge_blocks_)
        extract_blocks(blocks, point, edges, counters, scratch);
    extract_nonmanifold(point, edges, counters);
}

void HoughOctree::evaluate_faces(const HomogeneousPoint& point, std::span<std::uint16_t> bits,
                                 BlockScratch& scratch) const noexcept {
    RIMLINE_CHECK(point.is_valid());
    RIMLINE_CHECK(bits.size() == block_count());
    RIMLINE_CHECK(scratch.max_blocks >= max_blocks_);
    for (const FaceBlocks& blocks : face_blocks_) {
        if (blocks.planes.empty()) continue;
        const std::span own_bits = bits.subspan(blocks.first_block, blocks.planes.size());
        const std::uint32_t found =
            kernels::front_bits(blocks, blocks.space.seen_from(point), own_bits, scratch);
        for (std::uint32_t j = 0; j < found; ++j)
            own_bits[scratch.found_block[j]] |=
                static_cast<std::uint16_t>(front_doubts(blocks, point, j, scratch));
    }
}

std::vector<std::uint32_t> HoughOctree::face_words(std::span<const std::uint16_t> bits) const {
    RIMLINE_CHECK(bits.size() == block_count());
    std::vector<std::uint32_t> words(face_word_count(mesh_->face_count()), 0);
    for (std::uint32_t b = 0; b < bits.size(); ++b)
        for (std::uint32_t lanes = bits[b]; lanes != 0; lanes &= lanes - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
            const FaceId face = face_at(b * k_block_size + lane);
            words[index(face) / 32] |= 1u << (index(face) % 32);
        }
    return words;
}

std::size_t HoughOctree::find_flips(const HomogeneousPoint& from, const HomogeneousPoint& to,
                                    std::span<const std::uint32_t> states,
                                    std::span<FlippedBlock> flipped, TraversalCounters& counters,
                                    BlockScratch& scratch) const noexcept {
    RIMLINE_CHECK(from.is_valid() && to.is_valid());
    RIMLINE_CHECK(states.size() >= block_count());
    RIMLINE_CHECK(scratch.max_blocks >= max_blocks_);
    RIMLINE_CHECK(flipped.size() >= block_count());
    if (from == to) return 0;
    FlippedBlock* out = flipped.data();
    for (const FaceBlocks& blocks : face_blocks_) {
        if (blocks.planes.empty()) continue;
        const BlockPoint seen_from = blocks.space.seen_from(to);
        const std::span own = states.subspan(blocks.first_block, blocks.planes.size());
        std::uint64_t nodes = 0;
        std::uint32_t certain_count = 0;
        const std::uint32_t count = kernels::find_changing(
            blocks.tree, blocks.space.seen_from(from), seen_from, scratch, certain_count, nodes);
        const kernels::TestedFaces tested =
            kernels::test_faces(blocks, seen_from, count, own, scratch);
        for (const std::uint32_t j : std::span(scratch.doubtful).first(tested.doubtful))
            scratch.found_lanes[j] |=
                (front_doubts(blocks, to, j, scratch) ^ own[scratch.found_block[j]]) &
                scratch.found_doubts[j];
        for (std::uint32_t j = 0; j < tested.found; ++j) {
            *out = {blocks.first_block + scratch.found_block[j], scratch.found_lanes[j]};
            out += scratch.found_lanes[j] != 0;
        }
        for (std::uint32_t i = 0; i < certain_count; ++i)
            for (std::uint32_t b = scratch.certain[i].first; b < scratch.certain[i].last; ++b)
                *out++ = {blocks.first_block + b,
                          b + 1 == blocks.planes.size() ? blocks.last_lanes : 0xffffu};
        counters.box_checks += nodes * k_node_width;
        counters.face_checks += std::uint64_t{count} * k_block_size;
    }
    return static_cast<std::size_t>(out - flipped.data());
}

}  // namespace rimline
