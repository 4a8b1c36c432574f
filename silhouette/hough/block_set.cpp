#include "silhouette/hough/block_set.h"

#include <algorithm>
#include <cmath>

namespace rimline {

namespace {

// Lanes beyond the last block are read, but not used.
std::vector<NodeFrames> node_frames(std::uint32_t block_count) {
    return std::vector<NodeFrames>((block_count + k_node_width - 1) / k_node_width);
}

// `square` is the greatest square of the lengths of k. The length is rounded up.
void set_frame(NodeFrames& node, std::size_t lane, const BlockFrame& frame,
               std::int32_t square) noexcept {
    for (std::size_t i = 0; i < 4; ++i) node.center[i][lane] = frame.center[i];
    node.step_inverse[lane] = frame.step_inverse;
    node.longest[lane] =
        static_cast<float>(std::sqrt(static_cast<double>(square)) * (1.0 + 0x1p-20));
}

}  // namespace

void FaceBlocks::resize(std::size_t faces) {
    const std::uint32_t block_count = block_count_of(faces);
    planes.resize(block_count);
    frames = node_frames(block_count);
    last_lanes = lanes_of_last_block(faces);
}

void FaceBlocks::set(std::size_t block, std::span<const PlaneVector> of_block) noexcept {
    const BlockFrame frame = BlockFrame::around(of_block);
    std::int32_t square = 0;
    planes[block] = {};
    for (std::uint32_t i = 0; i < of_block.size(); ++i)
        square = std::max(square, frame.encode(of_block[i], i, planes[block]));
    set_frame(frames[block / k_node_width], block % k_node_width, frame, square);
}

void EdgeBlocks::resize(std::size_t edge_count) {
    const std::uint32_t block_count = block_count_of(edge_count);
    planes.resize(block_count);
    frames = node_frames(block_count);
    edges.assign(std::size_t{block_count} * k_block_size, k_no_edge);
    last_lanes = lanes_of_last_block(edge_count);
}

void EdgeBlocks::set(std::size_t block, std::span<const PlaneVector> of_block) noexcept {
    const BlockFrame frame = BlockFrame::around(of_block);
    std::int32_t square = 0;
    planes[block] = {};
    for (std::uint32_t i = 0; i < of_block.size(); ++i)
        square = std::max(square, frame.encode(of_block[i], i / 2, planes[block][i % 2]));
    set_frame(frames[block / k_node_width], block % k_node_width, frame, square);
}

}  // namespace rimline
