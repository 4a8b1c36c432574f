#include "silhouette/hough/block_set.h"

#include "silhouette/gradual_resize.h"

namespace rimline {

namespace {

BlockBounds bounds_of(std::span<const PlaneVector> planes) noexcept {
    BlockBounds bounds;
    for (const PlaneVector& plane : planes) bounds.include(plane);
    return bounds;
}

}  // namespace

void FaceBlocks::resize(std::size_t faces, const std::stop_token& stop) {
    resize_gradually(planes, block_count_of(faces), stop);
    last_lanes = lanes_of_last_block(faces);
}

BlockBounds FaceBlocks::set(std::size_t block, std::span<const PlaneVector> of_block) noexcept {
    const BlockBounds bounds = bounds_of(of_block);
    const BlockFrame frame(bounds);
    planes[block] = {};
    for (std::uint32_t i = 0; i < of_block.size(); ++i) frame.encode(of_block[i], i, planes[block]);
    return bounds;
}

void EdgeBlocks::resize(std::size_t edge_count, const std::stop_token& stop) {
    const std::uint32_t block_count = block_count_of(edge_count);
    resize_gradually(planes, block_count, stop);
    resize_gradually(edges, std::size_t{block_count} * k_block_size, stop, k_no_edge);
    last_lanes = lanes_of_last_block(edge_count);
}

BlockBounds EdgeBlocks::set(std::size_t block, std::span<const PlaneVector> of_block) noexcept {
    const BlockBounds bounds = bounds_of(of_block);
    const BlockFrame frame(bounds);
    planes[block] = {};
    for (std::uint32_t i = 0; i < of_block.size(); ++i)
        frame.encode(of_block[i], i / 2, planes[block][i % 2]);
    return bounds;
}

}  // namespace rimline
