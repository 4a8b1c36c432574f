#include "engine/frame/counted_volume.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>

#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

constexpr std::size_t k_prefetched = 16;

std::array<glm::vec3, 3> corners_of(const Mesh& mesh, std::uint32_t face) {
    std::array<glm::vec3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c)
        corners[c] = mesh.positions()[index(mesh.triangles()[face][c])];
    return corners;
}

Bounds bounds_of_run(const Mesh& mesh, std::uint32_t first, std::uint32_t end) {
    const glm::vec3 start = mesh.positions()[index(mesh.triangles()[first][0])];
    Bounds bounds{start, start};
    for (std::uint32_t f = first; f < end; ++f)
        for (const glm::vec3& corner : corners_of(mesh, f)) {
            bounds.low = glm::min(bounds.low, corner);
            bounds.high = glm::max(bounds.high, corner);
        }
    return bounds;
}

}  // namespace

void VolumeCounter::update(const CountedVolume& volume, std::uint32_t enough, VolumeCount& count) {
    if (count.light == volume.light && count.form == volume.form) return;
    const Mesh& mesh = *volume.mesh;
    const bool single = volume.form == ShadowForm::single;
    const std::uint32_t regular_end = mesh.edges_of_class(EdgeClass::regular).last;
    sides_.clear();
    const auto add = [&](EdgeId edge, std::int32_t times) {
        const auto& [a, b] = mesh.edge(edge).vertices;
        sides_.push_back({mesh.positions()[index(a)], mesh.positions()[index(b)], times});
    };
    // Edges and their vertices lie anywhere in memory. Prefetched, they take a third of the time at ten million
    // faces.
    const std::span<const EdgeId> silhouette = volume.silhouette;
    for (std::size_t i = 0; i < silhouette.size(); ++i) {
        if (i + 2 * k_prefetched < silhouette.size())
            __builtin_prefetch(&mesh.edge(silhouette[i + 2 * k_prefetched]));
        if (i + k_prefetched < silhouette.size())
            for (const VertexId vertex : mesh.edge(silhouette[i + k_prefetched]).vertices)
                __builtin_prefetch(&mesh.positions()[index(vertex)]);
        if (index(silhouette[i]) < regular_end) add(silhouette[i], single ? 1 : 2);
    }
    for (std::uint32_t e = regular_end; e < mesh.edge_count(); ++e) {
        std::int32_t times = 0;
        for (const FaceId face : mesh.faces_of(EdgeId{e}))
            times += !single || face_bit(volume.face_words, face) ? 1 : 0;
        if (times > 0) add(EdgeId{e}, times);
    }
    std::uint32_t bound = 0;
    if (const std::optional<int> outer = outer_axis(mesh.bounds(), volume.light))
        bound = rays_.from_outside(sides_, mesh.bounds(), volume.light, *outer, enough);
    else
        bound = rays_.from_within(sides_, volume.light, volume.columns->axis(),
                                  volume.columns->faces_on_line(glm::dvec3(volume.light.xyz())));
    count.light = volume.light;
    count.form = volume.form;
    count.bound = std::min(bound, mesh.face_count());  // A ray meets at most all triangles.
    count.parts.clear();
    count.sides.clear();
}

void VolumeCounter::divide(const CountedVolume& volume, std::uint32_t limit, VolumeCount& count) {
    if (count.parts.empty()) divide(volume, limit, 0, volume.mesh->face_count(), count);
}

void VolumeCounter::divide(const CountedVolume& volume, std::uint32_t limit, std::uint32_t first,
                           std::uint32_t end, VolumeCount& count) {
    const auto first_side = static_cast<std::uint32_t>(count.sides.size());
    append_sides_of_run(volume, first, end, count.sides);
    const std::uint32_t bound =
        bound_of_run(volume, limit, first, end, std::span(count.sides).subspan(first_side));
    if (bound <= limit) {
        count.parts.push_back(
            {.first_face = first,
             .face_count = end - first,
             .first_side = first_side,
             .side_count = static_cast<std::uint32_t>(count.sides.size()) - first_side,
             .bound = bound});
        return;
    }
    count.sides.resize(first_side);
    const std::uint32_t middle = first + (end - first) / 2;
    divide(volume, limit, first, middle, count);
    divide(volume, limit, middle, end, count);
}

std::uint32_t VolumeCounter::bound_of_run(const CountedVolume& volume, std::uint32_t enough,
                                          std::uint32_t first, std::uint32_t end,
                                          std::span<const gpu::EdgeRecord> records) {
    if (end - first <= enough) return end - first;
    const Mesh& mesh = *volume.mesh;
    const Bounds bounds = bounds_of_run(mesh, first, end);
    sides_.clear();
    for (const gpu::EdgeRecord& record : records)
        sides_.push_back({mesh.positions()[record.v0], mesh.positions()[record.v1], 1});
    if (const std::optional<int> outer = outer_axis(bounds, volume.light))
        return rays_.from_outside(sides_, bounds, volume.light, *outer, enough);
    const int axis = volume.columns->axis();
    std::uint32_t faces_at_poles = 0;
    for (std::uint32_t f = first; f < end; ++f)
        faces_at_poles += may_meet_line(volume.light, axis, corners_of(mesh, f), bounds) ? 1 : 0;
    return rays_.from_within(sides_, volume.light, axis, faces_at_poles);
}

void append_sides_of_run(const CountedVolume& volume, std::uint32_t first, std::uint32_t end,
                         std::vector<gpu::EdgeRecord>& sides) {
    const Mesh& mesh = *volume.mesh;
    const bool single = volume.form == ShadowForm::single;
    const std::uint32_t regular_end = mesh.edges_of_class(EdgeClass::regular).last;
    for (std::uint32_t f = first; f < end; ++f) {
        const bool front = face_bit(volume.face_words, FaceId{f});
        if (single && !front) continue;
        const Triangle& triangle = mesh.triangles()[f];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const EdgeId edge = mesh.edges_of(FaceId{f})[corner];
            if (edge == k_no_edge) continue;  // The sides of a face with two equal corners cancel.
            if (index(edge) < regular_end) {
                const auto& [f0, f1] = mesh.edge(edge).faces;
                const std::uint32_t other = index(f0) == f ? index(f1) : index(f0);
                // Two faces with equal bits traverse the side in opposite directions.
                if (other >= first && other < end &&
                    face_bit(volume.face_words, FaceId{other}) == front)
                    continue;
            }
            sides.push_back(
                {index(triangle[corner]), index(triangle[(corner + 1) % 3]), f, index(k_no_face)});
        }
    }
}

}  // namespace rimline
