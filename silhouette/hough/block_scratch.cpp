#include "silhouette/hough/block_scratch.h"

#include "silhouette/hough/reserved_bytes.h"

namespace rimline {

// The slack: whole vectors are stored, from any block on.
BlockScratch::BlockScratch(std::uint32_t max_blocks_of_a_set) : max_blocks(max_blocks_of_a_set) {
    constexpr std::size_t k_slack = 64;
    const std::size_t max_nodes = max_blocks / k_node_width + 1 + k_slack;
    for (std::vector<std::uint32_t>& nodes : frontier) nodes.resize(max_nodes);
    block.resize(max_blocks + k_slack);
    threshold.resize(max_blocks + k_slack);
    margin.resize(max_blocks + k_slack);
    found_block.resize(max_blocks + k_slack);
    found_lanes.resize(max_blocks + k_slack);
    found_doubts.resize(max_blocks + k_slack);
    doubtful.resize(max_blocks + k_slack);
    certain.resize(max_blocks + k_slack);
}

std::uint64_t BlockScratch::size_bytes() const noexcept {
    return reserved_bytes(frontier[0], frontier[1], block, threshold, margin, found_block,
                          found_lanes, found_doubts, doubtful, certain);
}

}  // namespace rimline
