#pragma once

// Silhouettes that the GPU computes from scratch in every frame: for meshes whose positions change, where no
// index built beforehand is valid, and as the brute force that streamed silhouettes are compared with.
//
//     faces: bits, what flipped --> edges: bits, what joined or left --> scan: sums over groups
//                                                                  --> lists: slots and change set
//
// Four dispatches, each for all silhouettes of a frame, with a barrier after each. Bits are packed in words
// of 32. Lists are compacted by prefix sums, not by atomics, so they are in ascending order on every run. The
// results have the form of a ChangeStream: slots, face words, draw arguments.
//
// Bits computed from planes equal those of silhouette/mesh/plane.h; bits computed from the current corners
// equal those of silhouette/mesh/moving_face.h, all bit for bit. Edges follow the rules of
// silhouette/mesh/face_bits.h.

#include <cstdint>
#include <span>
#include <string>

#include "engine/vulkan/functions.h"
#include "engine/vulkan/memory.h"
#include "engine/vulkan/memory_budget.h"
#include "engine/vulkan/pipeline.h"
#include "engine/vulkan/uploads.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The faces of a mesh's edges, for any number of silhouettes of it. 8 bytes an edge.
class SilhouetteTopology {
public:
    /// Adds its buffers to `batch`. `mesh` is not needed afterwards. Memory counts in `budget`, which must outlive it;
    /// null for none. Messages name `model`. Throws Error{too_large} naming the budget or the device's
    /// limit.
    SilhouetteTopology(UploadBatch& batch, const Mesh& mesh, MemoryBudget* budget = nullptr,
                       const std::string& model = "the model");

    std::uint32_t face_count() const noexcept { return face_count_; }
    /// The number of edges that may be on a silhouette: all but borders.
    std::uint32_t edge_count() const noexcept { return edge_count_; }
    std::uint64_t size_bytes() const noexcept;

private:
    friend class GpuSilhouette;
    std::uint32_t face_count_;
    std::uint32_t regular_end_;
    std::uint32_t two_face_end_;
    std::uint32_t edge_count_;
    MemoryBudget::Share share_;
    Buffer edge_faces_;
    Buffer fan_begin_;
    Buffer fan_faces_;
};

/// What face bits are computed from: one plane a face, or three corners. Addresses of buffers that the caller
/// keeps. `positions` and `triangles` are not read if `planes` is given.
struct FaceSource {
    VkDeviceAddress planes = 0;
    VkDeviceAddress positions = 0;
    VkDeviceAddress triangles = 0;
};

/// The counts of a run, as the device writes them (gpu::SilhouetteCounts).
struct GpuSilhouetteCounts {
    std::uint32_t silhouette = 0;  ///< Slots in use.
    std::uint32_t regular = 0;     ///< Of these, slots of regular edges, which come first.
    std::uint32_t added = 0;       ///< Edges that joined since the run before.
    std::uint32_t removed = 0;     ///< Edges that left.
    std::uint32_t words = 0;       ///< Words of face bits that changed.
    std::uint32_t flips = 0;       ///< Faces that turned.
};

/// The state of one silhouette of one mesh on the GPU. Before the first run no face is front and no edge is
/// on the silhouette; the first change set is relative to that.
class GpuSilhouette {
public:
    enum class Changes {
        counted,  ///< Their numbers alone: counts().
        listed,   ///< Also the lists: added(), removed(), word_writes().
    };

    /// Allocates memory for any silhouette, and adds its copies to the batch. `topology` and the buffers of `faces` must
    /// outlive it. About 1/4 byte a face and 4 1/4 bytes an edge, and 8 more an edge if changes are listed.
    /// Budget, messages and errors are as in SilhouetteTopology.
    GpuSilhouette(UploadBatch& batch, const SilhouetteTopology& topology, const FaceSource& faces,
                  Changes changes = Changes::counted, MemoryBudget* budget = nullptr,
                  const std::string& model = "the model");

    /// As those of a ChangeStream: slots hold edge numbers, words hold face bits, and the arguments
    /// (gpu::SlotArguments) draw the slots in use.
    const Buffer& slots() const noexcept { return slots_; }
    const Buffer& face_words() const noexcept { return face_words_; }
    const Buffer& arguments() const noexcept { return arguments_; }
    /// GpuSilhouetteCounts.
    const Buffer& counts() const noexcept { return counts_; }
    /// The change set, in ascending order: edge numbers, and WordWrite (silhouette/hough/change_set.h).
    /// Empty buffers if changes are only counted.
    const Buffer& added() const noexcept { return added_; }
    const Buffer& removed() const noexcept { return removed_; }
    const Buffer& word_writes() const noexcept { return word_writes_; }

    /// Bytes of buffers; the static function computes them beforehand.
    std::uint64_t size_bytes() const noexcept;
    static std::uint64_t size_bytes(const SilhouetteTopology& topology,
                                    Changes changes = Changes::counted) noexcept;

private:
    friend class GpuSilhouettePass;
    std::uint32_t face_group_count_;
    std::uint32_t edge_group_count_;
    MemoryBudget::Share share_;
    Buffer face_words_;
    Buffer face_changes_;
    Buffer edge_words_;
    Buffer edge_changes_;
    Buffer face_tallies_;
    Buffer edge_tallies_;
    Buffer slots_;
    Buffer added_;
    Buffer removed_;
    Buffer word_writes_;
    Buffer counts_;
    Buffer arguments_;
    Buffer job_;
};

/// A silhouette to compute, and its silhouette point.
struct SilhouetteRun {
    const GpuSilhouette* silhouette;
    HomogeneousPoint point;
};

/// The four compute pipelines. All silhouettes of a device share one set.
class GpuSilhouettePass {
public:
    /// Dispatches are divided into rows of at most `groups_a_row` workgroups, and of at most the device's
    /// limit. Tests use short rows. Throws Error{no_device} if the device lacks RoundingModeRTE for 32-bit floats:
    /// without it face bits of moving faces would not be the CPU's.
    explicit GpuSilhouettePass(const DeviceContext& context, std::uint32_t groups_a_row = 65535);

    /// Records all runs, each silhouette at most once. Waits for earlier reads of the silhouettes, but those of
    /// fragment shaders, and makes the results visible to later draws and copies. Positions must be visible to compute
    /// shaders. O(faces + edges) a silhouette, independent of the changes.
    void record(Commands commands, std::span<const SilhouetteRun> runs) const;

private:
    std::uint32_t groups_a_row_;
    OwnedPipelineLayout layout_;
    OwnedPipeline faces_;
    OwnedPipeline edges_;
    OwnedPipeline scan_;
    OwnedPipeline lists_;
};

}  // namespace rimline
