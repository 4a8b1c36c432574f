#include "engine/stream/gpu_silhouette.h"

#include <algorithm>
#include <vector>

#include "engine/vulkan/barrier.h"
#include "engine/vulkan/dispatch.h"
#include "shaders/silhouette_job.h"
#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/face_bits.h"
#include "silhouette_edges_comp.h"
#include "silhouette_faces_comp.h"
#include "silhouette_lists_comp.h"
#include "silhouette_scan_comp.h"

namespace rimline {

namespace {

static_assert(sizeof(GpuSilhouetteCounts) == sizeof(gpu::SilhouetteCounts));
static_assert(sizeof(WordWrite) == sizeof(gpu::PlacedWrite));

struct SilhouetteConstants {
    VkDeviceAddress job;
    HomogeneousPoint point;
};
static_assert(sizeof(SilhouetteConstants) == 24);

constexpr StageAccess k_compute{
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
constexpr StageAccess k_consumers{
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT |
        VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
        VK_PIPELINE_STAGE_2_COPY_BIT,
    VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
        VK_ACCESS_2_TRANSFER_READ_BIT};
// Without fragment shaders, as change streams (change_stream.cpp).
constexpr StageAccess k_before{
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT |
        VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};

std::vector<gpu::EdgeFaces> edge_faces(const Mesh& mesh) {
    std::vector<gpu::EdgeFaces> faces;
    const std::uint32_t end = mesh.edges_of_class(EdgeClass::inconsistent).last;
    faces.reserve(end);
    for (const Edge& edge : mesh.edges().first(end))
        faces.push_back({index(edge.faces[0]), index(edge.faces[1])});
    return faces;
}

// The faces of edges with three or more faces, one edge after the other, and where those of each edge begin.
struct Fans {
    std::vector<std::uint32_t> begin{0};
    std::vector<FaceId> faces;
};

Fans fans(const Mesh& mesh) {
    Fans fans;
    const Mesh::EdgeRange range = mesh.edges_of_class(EdgeClass::nonmanifold);
    for (std::uint32_t e = range.first; e < range.last; ++e) {
        const std::span<const FaceId> faces = mesh.faces_of(EdgeId{e});
        fans.faces.insert(fans.faces.end(), faces.begin(), faces.end());
        fans.begin.push_back(static_cast<std::uint32_t>(fans.faces.size()));
    }
    return fans;
}

// The number of workgroups for `count` faces or edges, 32 in a word.
std::uint32_t group_count(std::uint32_t count) {
    return units_of<std::uint32_t>(face_word_count(count), RIMLINE_GROUP_WORDS);
}

template <typename... Buffers>
std::uint64_t total_size(const Buffers&... buffers) {
    return (buffers.size() + ...);
}

// Bytes of the buffers of a silhouette.
struct Sizes {
    Sizes(std::uint32_t face_count, std::uint32_t edge_count, GpuSilhouette::Changes changes)
        : face_words(std::uint64_t{4} * face_word_count(face_count)),
          edge_words(std::uint64_t{4} * face_word_count(edge_count)),
          face_tallies(sizeof(gpu::FaceTally) * std::uint64_t{group_count(face_count)}),
          edge_tallies(sizeof(gpu::EdgeTally) * std::uint64_t{group_count(edge_count)}),
          slots(std::uint64_t{4} * edge_count),
          list(changes == GpuSilhouette::Changes::listed ? slots : 0),
          word_writes(changes == GpuSilhouette::Changes::listed ? 2 * face_words : 0) {}

    std::uint64_t face_words, edge_words;
    std::uint64_t face_tallies, edge_tallies;
    std::uint64_t slots;
    std::uint64_t list, word_writes;  // Of changes; 0 if they are not listed.
};

}  // namespace

SilhouetteTopology::SilhouetteTopology(UploadBatch& batch, const Mesh& mesh, MemoryBudget* budget,
                                       const std::string& model)
    : face_count_(mesh.face_count()),
      regular_end_(mesh.edges_of_class(EdgeClass::regular).last),
      two_face_end_(mesh.edges_of_class(EdgeClass::inconsistent).last),
      edge_count_(mesh.edges_of_class(EdgeClass::nonmanifold).last),
      share_(budget) {
    const std::vector<gpu::EdgeFaces> pairs = edge_faces(mesh);
    const Fans fan = fans(mesh);
    const std::string what = "the faces of edges of " + model;
    share_.resize(buffer_bytes(std::span(pairs).size_bytes()) +
                      buffer_bytes(std::span(fan.begin).size_bytes()) +
                      buffer_bytes(std::span(fan.faces).size_bytes()),
                  what);
    edge_faces_ = batch.add(std::span<const gpu::EdgeFaces>(pairs), what);
    fan_begin_ = batch.add(std::span<const std::uint32_t>(fan.begin), what);
    fan_faces_ = batch.add(std::span<const FaceId>(fan.faces), what);
}

std::uint64_t SilhouetteTopology::size_bytes() const noexcept {
    return total_size(edge_faces_, fan_begin_, fan_faces_);
}

GpuSilhouette::GpuSilhouette(UploadBatch& batch, const SilhouetteTopology& topology,
                             const FaceSource& faces, Changes changes, MemoryBudget* budget,
                             const std::string& model)
    : face_group_count_(group_count(topology.face_count_)),
      edge_group_count_(group_count(topology.edge_count_)),
      share_(budget) {
    share_.resize(size_bytes(topology, changes), "a silhouette of " + model + " found on the GPU");
    const auto make = [&](std::uint64_t size_bytes, const char* what) {
        return Buffer(batch.context(), size_bytes, BufferPlace::device, what + model);
    };
    const Sizes sizes(topology.face_count_, topology.edge_count_, changes);
    const bool listed = changes == Changes::listed;
    face_words_ = batch.add_zeros(sizes.face_words, "the face bits of " + model);
    face_changes_ = make(sizes.face_words, "the changes of face bits of ");
    edge_words_ = batch.add_zeros(sizes.edge_words, "the edge bits of " + model);
    edge_changes_ = make(sizes.edge_words, "the changes of edge bits of ");
    face_tallies_ = make(sizes.face_tallies, "the face tallies of ");
    edge_tallies_ = make(sizes.edge_tallies, "the edge tallies of ");
    slots_ = make(sizes.slots, "the silhouette slots of ");
    if (listed) {
        added_ = make(sizes.list, "the edges that join of ");
        removed_ = make(sizes.list, "the edges that leave of ");
        word_writes_ = make(sizes.word_writes, "the words that change of ");
    }
    counts_ = make(sizeof(gpu::SilhouetteCounts), "the silhouette counts of ");
    arguments_ = make(sizeof(gpu::SlotArguments), "the draw arguments of ");

    const gpu::SilhouetteJob job{.planes = faces.planes,
                                 .positions = faces.positions,
                                 .triangles = faces.triangles,
                                 .edge_faces = topology.edge_faces_.address(),
                                 .fan_begin = topology.fan_begin_.address(),
                                 .fan_faces = topology.fan_faces_.address(),
                                 .face_words = face_words_.address(),
                                 .face_changes = face_changes_.address(),
                                 .edge_words = edge_words_.address(),
                                 .edge_changes = edge_changes_.address(),
                                 .face_tallies = face_tallies_.address(),
                                 .edge_tallies = edge_tallies_.address(),
                                 .slots = slots_.address(),
                                 .added = added_.address(),
                                 .removed = removed_.address(),
                                 .word_writes = word_writes_.address(),
                                 .counts = counts_.address(),
                                 .arguments = arguments_.address(),
                                 .from_planes = faces.planes != 0,
                                 .lists_changes = listed,
                                 .face_count = topology.face_count_,
                                 .regular_end = topology.regular_end_,
                                 .two_face_end = topology.two_face_end_,
                                 .edge_count = topology.edge_count_,
                                 .face_group_count = face_group_count_,
                                 .edge_group_count = edge_group_count_};
    job_ = batch.add(std::span(&job, 1), "a silhouette's addresses");
}

std::uint64_t GpuSilhouette::size_bytes(const SilhouetteTopology& topology,
                                        Changes changes) noexcept {
    const Sizes sizes(topology.face_count_, topology.edge_count_, changes);
    std::uint64_t sum =
        sizeof(gpu::SilhouetteCounts) + sizeof(gpu::SlotArguments) + sizeof(gpu::SilhouetteJob);
    for (const std::uint64_t size :
         {sizes.face_words, sizes.face_words, sizes.edge_words, sizes.edge_words,
          sizes.face_tallies, sizes.edge_tallies, sizes.slots})
        sum += buffer_bytes(size);
    if (changes == Changes::listed)
        sum += 2 * buffer_bytes(sizes.list) + buffer_bytes(sizes.word_writes);
    return sum;
}

std::uint64_t GpuSilhouette::size_bytes() const noexcept {
    return total_size(face_words_, face_changes_, edge_words_, edge_changes_, face_tallies_,
                      edge_tallies_, slots_, added_, removed_, word_writes_, counts_, arguments_,
                      job_);
}

GpuSilhouettePass::GpuSilhouettePass(const DeviceContext& context, std::uint32_t groups_a_row)
    : groups_a_row_(std::min(groups_a_row, context.limits.maxComputeWorkGroupCount[0])),
      layout_(make_pipeline_layout(context, "silhouettes", sizeof(SilhouetteConstants),
                                   VK_SHADER_STAGE_COMPUTE_BIT)),
      faces_(
          (require_round_to_nearest(context, "a mesh that deforms"),
           make_compute_pipeline(context, "silhouettes, faces", silhouette_faces_comp, layout_))),
      edges_(make_compute_pipeline(context, "silhouettes, edges", silhouette_edges_comp, layout_)),
      scan_(make_compute_pipeline(context, "silhouettes, scan", silhouette_scan_comp, layout_)),
      lists_(make_compute_pipeline(context, "silhouettes, lists", silhouette_lists_comp, layout_)) {
}

void GpuSilhouettePass::record(Commands commands, std::span<const SilhouetteRun> runs) const {
    if (runs.empty()) return;
    const auto for_each_run = [&](VkPipeline pipeline, auto&& dispatch_run) {
        commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        for (const SilhouetteRun& run : runs) {
            const SilhouetteConstants constants{run.silhouette->job_.address(), run.point};
            commands->CmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                       sizeof constants, &constants);
            dispatch_run(*run.silhouette);
        }
    };
    const auto dispatch = [&](std::uint32_t group_count) {
        record_dispatch(commands, group_count, groups_a_row_);
    };
    record_barrier(commands, k_before, k_compute);
    for_each_run(faces_, [&](const GpuSilhouette& s) { dispatch(s.face_group_count_); });
    record_barrier(commands, k_compute, k_compute);
    for_each_run(edges_, [&](const GpuSilhouette& s) { dispatch(s.edge_group_count_); });
    record_barrier(commands, k_compute, k_compute);
    for_each_run(scan_, [&](const GpuSilhouette&) { commands->CmdDispatch(commands, 2, 1, 1); });
    record_barrier(commands, k_compute, k_compute);
    for_each_run(lists_, [&](const GpuSilhouette& s) {
        dispatch(s.edge_group_count_ + s.face_group_count_);
    });
    record_barrier(commands, k_compute, k_consumers);
}

}  // namespace rimline
