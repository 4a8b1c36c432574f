#include "engine/frame/counted_volume.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <utility>

#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

constexpr std::uint32_t k_distance_classes = 1u << 16;
// Up to so many times the least number of parts, another order is not tried.
constexpr std::size_t k_few_parts = 2;

FaceBox box_of_face(const CountedVolume& volume, std::uint32_t face) {
    FaceBox box;
    for (const VertexId vertex : volume.caster->mesh().triangles()[face]) {
        const glm::vec3& place = volume.positions()[index(vertex)];
        box.include({place, place});
    }
    return box;
}

Bounds bounds_of(const CountedVolume& volume, const FaceRun& run) {
    FaceBox box;
    for (const std::uint32_t face : run.faces()) box.include(box_of_face(volume, face));
    return {box.low, box.high};
}

// Around the line through a point within `bounds` parallel to an axis, with its roundings.
FaceBox line_through(const glm::vec3& place, int axis, const Bounds& bounds) {
    const double slack = 0x1p-20 * glm::distance(glm::dvec3(bounds.low), glm::dvec3(bounds.high));
    FaceBox line{glm::vec3(glm::dvec3(place) - slack), glm::vec3(glm::dvec3(place) + slack)};
    line.low[axis] = -std::numeric_limits<float>::infinity();
    line.high[axis] = std::numeric_limits<float>::infinity();
    return line;
}

}  // namespace

// Tries the axes with the fewest faces at their poles first, until the bound is enough.
template <typename CountFaces>
std::uint32_t VolumeCounter::bound_from_within(const VolumeSides& sides, const Bounds& bounds,
                                               const HomogeneousPoint& light, std::uint32_t enough,
                                               const CountFaces& faces_on_line) {
    struct Poles {
        std::uint32_t faces;
        int axis;
        auto operator<=>(const Poles&) const = default;
    };
    std::array<Poles, 3> poles;
    for (int axis = 0; axis < 3; ++axis)
        poles[static_cast<std::size_t>(axis)] = {
            faces_on_line(line_through(light.xyz(), axis, bounds)), axis};
    std::ranges::sort(poles);
    std::uint32_t least = ~0u;
    for (const auto& [faces, axis] : poles) {
        least = std::min(least, rays_.from_within(sides, light, axis, faces));
        if (least <= enough) break;
    }
    return least;
}

void VolumeCounter::update(const CountedVolume& volume, std::uint32_t enough, VolumeCount& count) {
    if (count.light == volume.light && count.form == volume.form) return;
    const Mesh& mesh = volume.caster->mesh();
    const std::span<const glm::vec3> positions = volume.positions();
    const Bounds& bounds = volume.bounds();
    const bool single = volume.form == ShadowForm::single;
    const std::uint32_t regular_end = mesh.edges_of_class(EdgeClass::regular).last;
    sides_.clear();
    for (std::uint32_t e = regular_end; e < mesh.edge_count(); ++e) {
        std::int32_t times = 0;
        for (const FaceId face : mesh.faces_of(EdgeId{e}))
            times += !single || face_bit(volume.face_words, face) ? 1 : 0;
        const auto& [a, b] = mesh.edge(EdgeId{e}).vertices;
        if (times > 0) sides_.push_back({positions[index(a)], positions[index(b)], times});
    }
    if (volume.moved) count.places.clear();
    follow_places(volume, count.places);
    const VolumeSides sides(sides_, count.places, regular_end, single ? 1 : 2);
    std::uint32_t bound = 0;
    if (const std::optional<int> outer = outer_axis(bounds, volume.light))
        bound = rays_.from_outside(sides, bounds, volume.light, *outer, enough);
    else
        bound = bound_from_within(sides, bounds, volume.light, enough, [&](const FaceBox& line) {
            std::uint32_t met = 0;
            if (volume.moved) {
                for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
                    met += box_of_face(volume, face).meets(line) ? 1 : 0;
                return met;
            }
            volume.caster->faces().any_meeting(line, [&](std::uint32_t) {
                ++met;
                return false;
            });
            return met;
        });
    count.light = volume.light;
    count.form = volume.form;
    count.bound = std::min(bound, mesh.face_count());  // A ray meets at most all triangles.
    count.parts.clear();
    count.faces.clear();
    count.sides.clear();
    count.part_of.clear();
}

// Reads what changed alone, and of that some edges ahead: else it waits for memory.
void VolumeCounter::follow_places(const CountedVolume& volume, std::vector<EdgePlaces>& places) {
    const std::span<const EdgeId> silhouette = volume.silhouette;
    const std::span<const Edge> edges = volume.caster->mesh().edges();
    const std::span<const glm::vec3> positions = volume.positions();
    places.resize(silhouette.size());
    changed_.clear();
    for (std::uint32_t i = 0; i < places.size(); ++i)
        if (places[i].edge != silhouette[i]) changed_.push_back(i);
    constexpr std::size_t k_ahead = 16;
    const auto edge_at = [&](std::size_t number) -> const Edge& {
        return edges[index(silhouette[changed_[number]])];
    };
    for (std::size_t i = 0; i < changed_.size(); ++i) {
        if (i + 2 * k_ahead < changed_.size()) __builtin_prefetch(&edge_at(i + 2 * k_ahead));
        if (i + k_ahead < changed_.size())
            for (const VertexId vertex : edge_at(i + k_ahead).vertices)
                __builtin_prefetch(&positions[index(vertex)]);
        const auto& [a, b] = edge_at(i).vertices;
        places[changed_[i]] = {silhouette[changed_[i]], positions[index(a)], positions[index(b)]};
    }
}

void VolumeCounter::divide(const CountedVolume& volume, std::uint32_t limit, VolumeCount& count) {
    if (!count.parts.empty()) return;
    const std::uint32_t faces = volume.caster->mesh().face_count();
    order_.resize(faces);
    ranks_.resize(faces);
    std::iota(order_.begin(), order_.end(), 0u);
    std::iota(ranks_.begin(), ranks_.end(), 0u);
    // Divided aside: where memory does not suffice, `count` stays without parts.
    VolumeCount divided{.light = count.light, .form = count.form, .bound = count.bound};
    divide(volume, limit, 0, faces, divided);
    if (divided.parts.size() > k_few_parts * (count.bound / limit + 1)) {
        VolumeCount by_distance{.light = count.light, .form = count.form, .bound = count.bound};
        sort_faces(volume);
        divide(volume, limit, 0, faces, by_distance);
        if (by_distance.parts.size() < divided.parts.size()) divided = std::move(by_distance);
    }
    divided.part_of.assign(faces, 0);
    for (std::uint32_t p = 0; p < divided.parts.size(); ++p) {
        const VolumePart& part = divided.parts[p];
        for (const std::uint32_t f :
             std::span(divided.faces).subspan(part.first_face, part.face_count))
            divided.part_of[f] = p;
    }
    divided.places = std::move(count.places);
    count = std::move(divided);
}

// By classes of distance: within a class the order does not matter.
void VolumeCounter::sort_faces(const CountedVolume& volume) {
    const Mesh& mesh = volume.caster->mesh();
    const glm::dvec3 light(volume.light.xyz());
    const glm::dvec3 towards = light / std::max(glm::length(light), double{k_min_point_component});
    const auto distance = [&](std::uint32_t face) {
        const FaceBox box = box_of_face(volume, face);
        const glm::dvec3 middle = 0.5 * (glm::dvec3(box.low) + glm::dvec3(box.high));
        return volume.light.is_direction() ? -glm::dot(middle, towards)
                                           : glm::distance(middle, light);
    };
    const glm::dvec3 low(volume.bounds().low);
    const glm::dvec3 high(volume.bounds().high);
    const glm::dvec3 middle_of_all = 0.5 * (low + high);
    const double radius = volume.moved ? 0.5 * glm::distance(low, high) : mesh.radius();
    const double center = volume.light.is_direction() ? -glm::dot(middle_of_all, towards)
                                                      : glm::distance(middle_of_all, light);
    const double nearest = center - radius;
    const double classes_per_length = radius > 0.0 ? k_distance_classes / (2.0 * radius) : 0.0;
    std::vector<std::uint32_t> begins(k_distance_classes + 1, 0);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        ranks_[f] = static_cast<std::uint32_t>(std::clamp(
            (distance(f) - nearest) * classes_per_length, 0.0, k_distance_classes - 1.0));
        ++begins[ranks_[f] + 1];
    }
    for (std::size_t c = 0; c < k_distance_classes; ++c) begins[c + 1] += begins[c];
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        ranks_[f] = begins[ranks_[f]]++;
        order_[ranks_[f]] = f;
    }
}

void VolumeCounter::divide(const CountedVolume& volume, std::uint32_t limit, std::uint32_t first,
                           std::uint32_t end, VolumeCount& count) {
    const FaceRun run{order_, ranks_, first, end};
    VolumePart part{.first_face = static_cast<std::uint32_t>(count.faces.size()),
                    .first_side = static_cast<std::uint32_t>(count.sides.size())};
    append_run(volume, run, count);
    part.face_count = static_cast<std::uint32_t>(count.faces.size()) - part.first_face;
    part.side_count = static_cast<std::uint32_t>(count.sides.size()) - part.first_side;
    part.bound =
        std::min(part.face_count,
                 bound_of_run(volume, limit, run, std::span(count.sides).subspan(part.first_side)));
    if (part.bound <= limit) {
        if (part.face_count > 0) count.parts.push_back(part);
        return;
    }
    count.faces.resize(part.first_face);
    count.sides.resize(part.first_side);
    const std::uint32_t middle = first + run.size() / 2;
    divide(volume, limit, first, middle, count);
    divide(volume, limit, middle, end, count);
}

std::uint32_t VolumeCounter::bound_of_run(const CountedVolume& volume, std::uint32_t enough,
                                          const FaceRun& run,
                                          std::span<const gpu::EdgeRecord> records) {
    if (run.size() <= enough) return run.size();
    const std::span<const glm::vec3> positions = volume.positions();
    const Bounds bounds = bounds_of(volume, run);
    sides_.clear();
    for (const gpu::EdgeRecord& record : records)
        sides_.push_back({positions[record.v0], positions[record.v1], 1});
    const VolumeSides sides(sides_);
    if (const std::optional<int> outer = outer_axis(bounds, volume.light))
        return rays_.from_outside(sides, bounds, volume.light, *outer, enough);
    return bound_from_within(sides, bounds, volume.light, enough, [&](const FaceBox& line) {
        return static_cast<std::uint32_t>(std::ranges::count_if(
            run.faces(),
            [&](std::uint32_t face) { return box_of_face(volume, face).meets(line); }));
    });
}

void append_run(const CountedVolume& volume, const FaceRun& run, VolumeCount& count) {
    const Mesh& mesh = volume.caster->mesh();
    const bool single = volume.form == ShadowForm::single;
    const std::uint32_t regular_end = mesh.edges_of_class(EdgeClass::regular).last;
    for (const std::uint32_t f : run.faces()) {
        const bool front = face_bit(volume.face_words, FaceId{f});
        if (single && !front) continue;
        count.faces.push_back(f);
        const Triangle& triangle = mesh.triangles()[f];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const EdgeId edge = mesh.edges_of(FaceId{f})[corner];
            if (edge == k_no_edge) continue;  // The sides of a face with two equal corners cancel.
            if (index(edge) < regular_end) {
                const auto& [f0, f1] = mesh.edge(edge).faces;
                const FaceId other = index(f0) == f ? f1 : f0;
                // Two faces with equal bits traverse the side in opposite directions.
                if (run.has(other) && face_bit(volume.face_words, other) == front) continue;
            }
            count.sides.push_back(
                {index(triangle[corner]), index(triangle[(corner + 1) % 3]), f, index(k_no_face)});
        }
    }
}

}  // namespace rimline
