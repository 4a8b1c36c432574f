#include "engine/stream/deforming_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "deform_normals_comp.h"
#include "deform_wave_comp.h"
#include "engine/vulkan/barrier.h"
#include "engine/vulkan/dispatch.h"
#include "shaders/deform_job.h"
#include "silhouette/mesh/corner_normals.h"

namespace rimline {

namespace {

struct DeformationConstants {
    VkDeviceAddress job;
    gpu::WaveConstants wave;
};
static_assert(sizeof(DeformationConstants) == 48);

// Fragment shaders read neither positions nor normals by address.
constexpr StageAccess k_shader_readers{
    VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
        VK_PIPELINE_STAGE_2_COPY_BIT,
    VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT};
constexpr StageAccess k_deformers{
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr StageAccess k_normals{
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};

void check_range(const BoundingSphere& sphere) {
    // With a margin for the GPU's rounding.
    const double reach = sphere.radius * (1.0 + 1e-6);
    for (int axis = 0; axis < 3; ++axis)
        if (!(std::abs(sphere.center[axis]) + reach <= double{k_max_coordinate}))
            throw Error(ErrorCode::too_large,
                        "the deformed mesh leaves the range of coordinates, which end at 2^60");
}

gpu::WaveConstants constants_of(const Wave& wave) {
    RIMLINE_CHECK(wave.length > 0.0);
    return {.center = glm::vec3(wave.center),
            .per_length = glm::vec3(wave.travel / wave.length),
            .reach = glm::vec3(wave.amplitude * wave.direction),
            .turns = static_cast<float>(wave.turns - std::floor(wave.turns))};
}

}  // namespace

DeformingMesh::DeformingMesh(UploadBatch& batch, const Mesh& mesh, const GpuMesh& gpu_mesh,
                             float crease_angle_rad, std::uint32_t ring_slots, MemoryBudget* budget,
                             const std::string& model)
    : context_(batch.context()),
      mesh_(&mesh),
      vertex_count_(mesh.vertex_count()),
      ring_slots_(ring_slots),
      triangles_(gpu_mesh.triangles()),
      model_(model),
      topology_(batch, mesh, budget, model),
      share_(budget),
      ring_share_(budget) {
    const CornerGroupList groups = corner_groups(mesh, crease_angle_rad);
    const std::span<const std::uint32_t> begin(groups.begin);
    const std::span<const std::uint32_t> corners(groups.corners);
    group_count_ = static_cast<std::uint32_t>(groups.begin.size() - 1);
    const std::uint64_t normal_bytes = 3 * sizeof(glm::vec3) * std::uint64_t{mesh.face_count()};
    share_.resize(buffer_bytes(mesh.positions().size_bytes()) + buffer_bytes(normal_bytes) +
                      buffer_bytes(begin.size_bytes()) + buffer_bytes(corners.size_bytes()) +
                      sizeof(gpu::DeformJob),
                  "the moved positions and normals of " + model);
    positions_ = Buffer(context_, mesh.positions().size_bytes(), BufferPlace::device,
                        "the moved positions of " + model);
    corner_normals_ =
        Buffer(context_, normal_bytes, BufferPlace::device, "the moved normals of " + model);
    group_begin_ = batch.add(begin, "the groups of corners of " + model);
    group_corners_ = batch.add(corners, "the groups of corners of " + model);
    const gpu::DeformJob job{.rest = gpu_mesh.positions(),
                             .positions = positions_.address(),
                             .triangles = triangles_,
                             .group_begin = group_begin_.address(),
                             .group_corners = group_corners_.address(),
                             .corner_normals = corner_normals_.address(),
                             .vertex_count = vertex_count_,
                             .group_count = group_count_};
    job_ = batch.add(std::span(&job, 1), "a deforming mesh's addresses");
}

void DeformingMesh::move(const Deformation& deformation, std::uint32_t ring_slot) {
    RIMLINE_CHECK(ring_slot < ring_slots_);
    check_range(bounding_sphere(*mesh_, deformation));
    if (const auto* moved = std::get_if<MovedPositions>(&deformation)) {
        RIMLINE_CHECK(moved->positions.size() == vertex_count_);
        const std::uint64_t size_bytes = moved->positions.size_bytes();
        if (ring_.size() < size_bytes * ring_slots_) {
            const std::string what = "the ring of moved positions of " + model_;
            try {
                ring_share_.resize(size_bytes * ring_slots_, what);
                ring_ = Buffer(context_, size_bytes * ring_slots_, BufferPlace::upload, what);
            } catch (...) {
                ring_share_.resize(ring_.size(), what);
                throw;
            }
        }
        if (size_bytes > 0)
            std::memcpy(ring_.mapped() + ring_slot * size_bytes, moved->positions.data(),
                        size_bytes);
    }
    ring_slot_ = ring_slot;
    deformation_ = deformation;
}

std::uint64_t DeformingMesh::size_bytes() const noexcept {
    return topology_.size_bytes() + positions_.size() + corner_normals_.size() +
           group_begin_.size() + group_corners_.size() + job_.size() + ring_.size();
}

DeformPass::DeformPass(const DeviceContext& context)
    : groups_a_row_(std::min(k_min_group_limit, context.limits.maxComputeWorkGroupCount[0])),
      layout_(make_pipeline_layout(context, "deformation", sizeof(DeformationConstants),
                                   VK_SHADER_STAGE_COMPUTE_BIT)),
      wave_(make_compute_pipeline(context, "deformation, positions", deform_wave_comp, layout_)),
      normals_(
          make_compute_pipeline(context, "deformation, normals", deform_normals_comp, layout_)) {}

void DeformPass::record(Commands commands, std::span<const DeformingMesh* const> meshes) const {
    if (meshes.empty()) return;
    const auto dispatch = [&](std::uint32_t count) {
        record_dispatch(commands, units_of<std::uint32_t>(count, RIMLINE_DEFORM_GROUP),
                        groups_a_row_);
    };
    const auto push = [&](const DeformingMesh& mesh, const gpu::WaveConstants& wave) {
        const DeformationConstants constants{mesh.job_.address(), wave};
        commands->CmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                   sizeof constants, &constants);
    };
    record_barrier(commands, k_shader_readers, k_deformers);
    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, wave_);
    for (const DeformingMesh* mesh : meshes) {
        if (mesh->vertex_count_ == 0) continue;
        if (const auto* moved = std::get_if<MovedPositions>(&mesh->deformation_)) {
            const std::uint64_t size_bytes = moved->positions.size_bytes();
            const VkBufferCopy region{.srcOffset = mesh->ring_slot_ * size_bytes,
                                      .size = size_bytes};
            commands->CmdCopyBuffer(commands, mesh->ring_.handle(), mesh->positions_.handle(), 1,
                                    &region);
            continue;
        }
        push(*mesh, constants_of(std::get<Wave>(mesh->deformation_)));
        dispatch(mesh->vertex_count_);
    }
    record_barrier(commands, k_deformers, k_normals);
    commands->CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, normals_);
    for (const DeformingMesh* mesh : meshes) {
        push(*mesh, {});
        dispatch(mesh->group_count_);
    }
    record_barrier(commands, k_deformers, k_shader_readers);
}

}  // namespace rimline
