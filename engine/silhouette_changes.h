#pragma once

// What a frame tells of its silhouettes: how they changed since the one before, as numbers for reports, and where they
// are in device memory.

#include <vulkan/vulkan.h>

#include <cstdint>

#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/homogeneous_point.h"

namespace rimline {

/// Changes since the previous frame. Flips and edges added or removed are 0 in a silhouette's first frame.
struct SilhouetteChanges {
    std::uint64_t edges = 0;     ///< Edges on the silhouettes now, without borders.
    std::uint64_t flips = 0;     ///< Faces that turned.
    std::uint64_t added = 0;     ///< Edges that joined.
    std::uint64_t removed = 0;   ///< Edges that left.
    TraversalCounters counters;  ///< Work on the CPU. Zero for silhouettes found on the GPU.
    /// CPU time of the frame for these silhouettes. Small where the service was ahead.
    double update_us = 0.0;

    SilhouetteChanges& operator+=(const SilhouetteChanges& other) noexcept {
        edges += other.edges;
        flips += other.flips;
        added += other.added;
        removed += other.removed;
        counters += other.counters;
        update_us += other.update_us;
        return *this;
    }
};

/// A buffer from its first byte: for commands, and for shaders.
struct BufferHandle {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceAddress address = 0;
};

/// The silhouette of one instance in device memory, as the frame recorded last leaves it: for a caller's own commands
/// after that frame. The frame makes it visible to draws that read it as indirect arguments, and to compute, vertex,
/// geometry and fragment shaders as storage; for other uses, as a copy or an index buffer, add a barrier after compute
/// shaders and copies. The next frame that changes them waits for reads as indirect arguments, by copies, and by
/// compute, vertex and geometry shaders. For reads in other stages, as in fragment shaders, add a barrier before its
/// compute shaders and copies. The buffers stay the same while Renderer keeps the silhouette (Renderer::render()).
struct SilhouetteBuffers {
    HomogeneousPoint point;   ///< The silhouette point, in the instance's coordinates.
    BufferHandle slots;       ///< Edge numbers, 32 bits each; as many as the arguments draw.
    BufferHandle face_words;  ///< One bit a face, 32 to a word (silhouette/mesh/face_bits.h).
    /// Four VkDrawIndirectCommand, to draw the slots as points, as strips of four vertices, or as sides of
    /// shadow volumes (SlotArguments in shaders/layout.h). The first one's vertex count is the silhouette's
    /// size.
    BufferHandle arguments;
};

}  // namespace rimline
