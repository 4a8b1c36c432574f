#pragma once

// What a draw of all edges of a mesh needs: for line paths that draw no slots (line_path.h).

#include <vulkan/vulkan.h>

#include <cstdint>

namespace rimline {

struct EveryEdgeDraw {
    std::uint32_t regular_edge_count = 0;
    std::uint32_t irregular_pair_count = 0;
    std::uint32_t adjacency_index_count = 0;
    VkBuffer adjacency = VK_NULL_HANDLE;  ///< 32-bit indices, six a face.
};

}  // namespace rimline
