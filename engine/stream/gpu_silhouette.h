#pragma once

// Silhouettes that the GPU finds by itself, from scratch, every frame: for meshes whose positions change,
// which no index made beforehand can serve, and as the brute force that streamed silhouettes are
// compared with.
//
//     faces: bits, what flipped --> edges: bits, what joined or left --> scan: sums over groups
//                                                                  --> lists: slots and change set
//
// Four dispatches, each for all silhouettes of a frame, with a barrier after each. Bits are words of 32;
// lists are compacted by prefix sums, not by atomics, so they have one order, ascending, on every run.
// Consumers find what a ChangeStream gives them: slots, face words, draw arguments.
//
// Bits come from planes, and then equal silhouette/mesh/plane.h's, or from the corners where they are
// now, and then equal silhouette/mesh/moving_face.h's: all bit for bit. Edges follow the rules of
// silhouette/mesh/face_bits.h.

#include <cstdint>
#include <span>
#include <string>

#include "engine/vulkan/memory.h"
#include "engine/vulkan/memory_budget.h"
#include "engine/vulkan/pipeline.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/mesh/mesh.h"

namespace rimline {

/// The faces of a mesh's edges, for any number of silhouettes of it. 8 bytes an edge.
class SilhouetteTopology {
public:
    /// Uploads and waits. `mesh` is not needed afterwards. Memory is of `budget`, which must outlive it;
    /// null for none. Messages name `model`. Throws Error{too_large} naming the budget or the device's
    /// limit.
    SilhouetteTopology(const DeviceContext& context, const Mesh& mesh,
                       MemoryBudget* budget = nullptr, const std::string& model = "the model");

    std::uint32_t face_count() const noexcept { return face_count_; }
    /// Edges that may be on a silhouette: all but borders.
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

/// Where face bits come from: one plane a face, or three corners. Addresses of what GpuMesh and others
/// hold; `positions` and `triangles` are not read where `planes` is given.
struct FaceSource {
    VkDeviceAddress planes = 0;
    VkDeviceAddress positions = 0;
    VkDeviceAddress triangles = 0;
};

/// What a run found, as the device writes it (gpu::SilhouetteCounts).
struct GpuSilhouetteCounts {
    std::uint32_t silhouette = 0;  ///< Slots in use.
    std::uint32_t regular = 0;     ///< Of them, those of regular edges, which come first.
    std::uint32_t added = 0;       ///< Edges that joined since the run before.
    std::uint32_t removed = 0;     ///< Edges that left.
    std::uint32_t words = 0;       ///< Words of face bits that changed.
    std::uint32_t flips = 0;       ///< Faces that turned.
};

/// One silhouette of one mesh: its state on the GPU. Before the first run no face is front and no edge
/// is on the silhouette; the first change set is against that.
class GpuSilhouette {
public:
    enum class Changes {
        counted,  ///< Only how many: counts().
        listed,   ///< Also which: added(), removed(), word_writes().
    };

    /// Makes room for any silhouette, uploads and waits. `topology`, and what `faces` names, must outlive
    /// it. About 1/4 byte a face and 4 1/4 an edge, and 8 an edge more where changes are listed. Budget,
    /// messages and errors are as SilhouetteTopology's.
    GpuSilhouette(const DeviceContext& context, const SilhouetteTopology& topology,
                  const FaceSource& faces, Changes changes = Changes::counted,
                  MemoryBudget* budget = nullptr, const std::string& model = "the model");

    /// For consumers, as a ChangeStream's: slots hold edge numbers, words hold face bits, and the
    /// arguments (gpu::SlotArguments) draw the slots in use.
    const Buffer& slots() const noexcept { return slots_; }
    const Buffer& face_words() const noexcept { return face_words_; }
    const Buffer& arguments() const noexcept { return arguments_; }
    /// GpuSilhouetteCounts.
    const Buffer& counts() const noexcept { return counts_; }
    /// The change set, in ascending order: edge numbers, and WordWrite (silhouette/hough/change_set.h).
    /// Empty buffers where changes are only counted.
    const Buffer& added() const noexcept { return added_; }
    const Buffer& removed() const noexcept { return removed_; }
    const Buffer& word_writes() const noexcept { return word_writes_; }

    /// Bytes of buffers, also before there are any.
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

/// A silhouette to find, and where from.
struct SilhouetteRun {
    const GpuSilhouette* silhouette;
    HomogeneousPoint point;
};

/// The four compute pipelines; one set serves every silhouette of a device.
class GpuSilhouettePass {
public:
    /// Dispatches are cut into rows of at most `groups_a_row` workgroups, and never more than the device
    /// takes; tests make them short.
    explicit GpuSilhouettePass(const DeviceContext& context, std::uint32_t groups_a_row = 65535);

    /// Records all runs, each silhouette at most once. What drew from the silhouettes before is waited
    /// for, and what draws from them or copies them afterwards sees them; positions must have been made
    /// visible to compute shaders. O(faces + edges) a silhouette, whatever changed.
    void record(VkCommandBuffer commands, std::span<const SilhouetteRun> runs) const;

private:
    void dispatch(VkCommandBuffer commands, std::uint32_t group_count) const;

    std::uint32_t groups_a_row_;
    OwnedPipelineLayout layout_;
    OwnedPipeline faces_;
    OwnedPipeline edges_;
    OwnedPipeline scan_;
    OwnedPipeline lists_;
};

}  // namespace rimline
