#include "engine/measure/field_pass.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "engine/vulkan/barrier.h"
#include "field_comp.h"
#include "shaders/field_job.h"
#include "silhouette/field/field_kernels.h"

namespace rimline {

namespace {

constexpr std::size_t k_max_sum_bytes = std::size_t{512} << 10;
/// That every device has (maxComputeWorkGroupCount).
constexpr std::uint32_t k_max_groups = 65535;

std::uint32_t tiles_of(std::size_t planes) {
    if (planes > std::numeric_limits<std::uint32_t>::max() - gpu::k_field_tile)
        throw Error(ErrorCode::too_large, "more planes than a compute shader can number");
    return static_cast<std::uint32_t>((planes + gpu::k_field_tile - 1) / gpu::k_field_tile);
}

std::vector<gpu::FieldPlane> records_of(const UnitPlanes& planes, FieldOptions::Weight weight) {
    std::vector<gpu::FieldPlane> records(std::size_t{tiles_of(planes.size())} * gpu::k_field_tile);
    for (std::size_t i = 0; i < planes.size(); ++i)
        records[i] = {.normal = glm::vec3(planes.normal(i)),
                      .offset = static_cast<float>(planes.offset(i)),
                      .weight = weight == FieldOptions::Weight::area
                                    ? static_cast<float>(planes.area(i))
                                    : 1.0f};
    return records;
}

std::vector<gpu::FieldPiece> records_of(const TangentialFunction& function) {
    std::vector<gpu::FieldPiece> records;
    for (const TangentialFunction::Piece& piece : function.pieces())
        records.push_back({.from = static_cast<float>(piece.from),
                           .start = static_cast<float>(piece.start),
                           .c0 = static_cast<float>(piece.c0),
                           .c1 = static_cast<float>(piece.c1),
                           .c2 = static_cast<float>(piece.c2),
                           .c3 = static_cast<float>(piece.c3)});
    return records;
}

double total_weight(const UnitPlanes& planes, FieldOptions::Weight weight) {
    if (weight == FieldOptions::Weight::count) return static_cast<double>(planes.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < planes.size(); ++i) sum += planes.area(i);
    return sum;
}

// A buffer with room for `bytes`.
void make_room(const DeviceContext& context, Buffer& buffer, VkDeviceSize bytes, BufferPlace place,
               const char* what) {
    if (buffer.size() >= bytes) return;
    buffer = {};  // Free before making anew.
    buffer = Buffer(context, bytes, place, what);
}

}  // namespace

FieldPass::FieldPass(const DeviceContext& context, const UnitPlanes& planes,
                     const TangentialFunction& function, FieldOptions::Weight weight)
    : context_(context),
      tile_count_(tiles_of(planes.size())),
      piece_count_(static_cast<std::uint32_t>(function.pieces().size())),
      layout_(make_pipeline_layout(context, sizeof(gpu::FieldJob), VK_SHADER_STAGE_COMPUTE_BIT)),
      pipeline_(make_compute_pipeline(context, field_comp, layout_)) {
    planes_ = upload_buffer(context, std::span<const gpu::FieldPlane>(records_of(planes, weight)),
                            "a field's planes");
    pieces_ = upload_buffer(context, std::span<const gpu::FieldPiece>(records_of(function)),
                            "a field's function");
    // Those of an invocation and of a group (field.comp) beside what the CPU's loops have.
    const double terms = gpu::k_field_chunk_tiles + 8 + 8;
    error_bound_ = total_weight(planes, weight) * (kernels::FunctionTable(function).rounding_share +
                                                   0x1p-24 * terms * function.max_magnitude());
}

void FieldPass::values(std::span<const glm::dvec3> points, std::span<double> out,
                       const LongCall& call) {
    RIMLINE_CHECK(points.size() == out.size());
    for (const glm::dvec3& point : points)
        RIMLINE_CHECK(glm::dot(point, point) <= kernels::k_near_radius * kernels::k_near_radius);
    if (tile_count_ == 0) {
        std::ranges::fill(out, 0.0);
        return;
    }
    const std::size_t chunks =
        (tile_count_ + gpu::k_field_chunk_tiles - 1) / gpu::k_field_chunk_tiles;
    const std::size_t batch = std::clamp<std::size_t>(
        k_max_sum_bytes / (sizeof(float) * chunks), gpu::k_field_group_points,
        std::size_t{k_max_groups} * gpu::k_field_group_points);
    for (std::size_t first = 0; first < points.size(); first += batch) {
        call.checkpoint(static_cast<double>(first) / static_cast<double>(points.size()));
        const std::size_t count = std::min(batch, points.size() - first);
        sum_batch(points.subspan(first, count), out.subspan(first, count));
    }
    call.checkpoint(1.0);
}

void FieldPass::sum_batch(std::span<const glm::dvec3> points, std::span<double> out) {
    const std::uint32_t chunks =
        (tile_count_ + gpu::k_field_chunk_tiles - 1) / gpu::k_field_chunk_tiles;
    make_room(context_, points_, sizeof(glm::vec3) * points.size(), BufferPlace::upload,
              "a field's points");
    make_room(context_, sums_, sizeof(float) * chunks * points.size(), BufferPlace::readback,
              "a field's sums");
    auto* const written = reinterpret_cast<glm::vec3*>(points_.mapped());
    std::ranges::transform(points, written, [](const glm::dvec3& p) { return glm::vec3(p); });

    gpu::FieldJob job{.planes = planes_.address(),
                      .pieces = pieces_.address(),
                      .points = points_.address(),
                      .sums = sums_.address(),
                      .tile_count = tile_count_,
                      .piece_count = piece_count_,
                      .point_count = static_cast<std::uint32_t>(points.size()),
                      .first_chunk = 0};
    const auto columns = static_cast<std::uint32_t>(
        (points.size() + gpu::k_field_group_points - 1) / gpu::k_field_group_points);
    run_commands(context_, [&](VkCommandBuffer commands) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
        for (; job.first_chunk < chunks; job.first_chunk += k_max_groups) {
            vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof job, &job);
            vkCmdDispatch(commands, columns, std::min(chunks - job.first_chunk, k_max_groups), 1);
        }
        record_barrier(
            commands,
            {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
            {VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    });
    const auto* const sums = reinterpret_cast<const float*>(sums_.mapped());
    for (std::size_t i = 0; i < points.size(); ++i) {
        out[i] = 0.0;
        for (std::uint32_t c = 0; c < chunks; ++c) out[i] += double{sums[c * points.size() + i]};
    }
}

}  // namespace rimline
