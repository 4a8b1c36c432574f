#include "engine/frame/shadow_batches.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "silhouette/mesh/face_bits.h"

namespace rimline {

namespace {

// Limits of the number of bins, a power of two that is at least the number of sides.
constexpr std::uint32_t k_min_bins = 256;
constexpr std::uint32_t k_max_bins = 1u << 14;

// Limit of a direction's distance from the axis, relative to its length. Directions nearer to the axis have
// no certain meridian: a side that begins or ends there spans all bins. With float roundings of 2^-22 of
// their length, the meridian of others is known to less than a quarter of a bin's width.
constexpr double k_near_axis = 0x1p-5;

// A number in [0, 4) that increases with the angle of `v`, by one for each quarter turn.
double turn_of(const glm::dvec2& v) {
    const double along = v.x / (std::abs(v.x) + std::abs(v.y));
    const double turn = v.y >= 0.0 ? 1.0 - along : 3.0 + along;
    return turn >= 4.0 ? 0.0 : turn;
}

}  // namespace

// The meridians of a light in bins, and which bins a side or a face spans.
class ShadowCounter::Meridians {
public:
    struct Span {
        std::uint32_t first, count;  // Bins; after the last one follows the first.
    };

    Meridians(const Mesh& mesh, const HomogeneousPoint& light, std::uint32_t bins)
        : mesh_(mesh), light_(light.xyz()), directional_(light.is_direction()), bins_(bins) {
        const glm::dvec3 low(mesh.bounds().low);
        const glm::dvec3 high(mesh.bounds().high);
        // The coordinate along which the light lies farthest outside the bounds; for a directional light,
        // its greatest component.
        const glm::dvec3 gap =
            directional_ ? glm::abs(light_) : glm::max(low - light_, light_ - high);
        for (int axis = 1; axis < 3; ++axis)
            if (gap[axis] > gap[outer_]) outer_ = axis;
        pole_ = (outer_ + 1) % 3;
        other_ = (outer_ + 2) % 3;
        // Outside only if by more than rounding.
        is_within_ = !directional_ && gap[outer_] <= 0x1p-20 * glm::length(high - low);
        if (!directional_) return;
        // For a directional light, lines perpendicular to the light and the axis replace meridians.
        double least = 0.0, most = 0.0;
        for (const int axis : {outer_, other_}) {
            const double a = line_weight(axis) * low[axis];
            const double b = line_weight(axis) * high[axis];
            least += std::min(a, b);
            most += std::max(a, b);
        }
        line_begin_ = least;
        line_scale_ = most > least ? (bins_ - 1) / (most - least) : 0.0;
    }

    bool is_within() const noexcept { return is_within_; }

    Span span_of(std::span<const VertexId> vertices) const {
        return directional_ ? line_span(vertices) : turn_span(vertices);
    }

    // Whether the line through the light along the axis may meet a face.
    bool may_meet_axis(const Triangle& triangle) const {
        glm::dvec2 low = across(triangle[0]);
        glm::dvec2 high = low;
        for (const VertexId vertex : triangle) {
            low = glm::min(low, across(vertex));
            high = glm::max(high, across(vertex));
        }
        const double slack = 0x1p-20 * (mesh_.radius() + glm::length(light_ - mesh_.center()));
        return glm::all(glm::lessThanEqual(low, glm::dvec2(slack))) &&
               glm::all(glm::greaterThanEqual(high, glm::dvec2(-slack)));
    }

private:
    // Perpendicular to the light, and to the axis.
    double line_weight(int axis) const { return axis == outer_ ? -light_[other_] : light_[outer_]; }
    glm::dvec3 from_light(VertexId vertex) const {
        return glm::dvec3(mesh_.positions()[index(vertex)]) - light_;
    }
    glm::dvec2 across(VertexId vertex) const {
        const glm::dvec3 away = from_light(vertex);
        return {away[outer_], away[other_]};
    }

    Span line_span(std::span<const VertexId> vertices) const {
        double least = 0.0, most = 0.0;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const glm::dvec3 position(mesh_.positions()[index(vertices[i])]);
            const double place =
                line_scale_ * (line_weight(outer_) * position[outer_] +
                               line_weight(other_) * position[other_] - line_begin_);
            least = i == 0 ? place : std::min(least, place);
            most = i == 0 ? place : std::max(most, place);
        }
        return widened(least, most);
    }

    Span turn_span(std::span<const VertexId> vertices) const {
        double first = 0.0, least = 0.0, most = 0.0;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const glm::dvec2 v = across(vertices[i]);
            const glm::dvec3 away = from_light(vertices[i]);
            if (!(std::abs(v.x) + std::abs(v.y) > k_near_axis * glm::length(away))) return all();
            const double turn = turn_of(v);
            if (i == 0) {
                first = turn;
                continue;
            }
            // The step of at most half a turn from the first.
            double step = turn - first;
            if (step > 2.0) step -= 4.0;
            if (step < -2.0) step += 4.0;
            least = std::min(least, step);
            most = std::max(most, step);
        }
        // From half a turn on, the direction is ambiguous.
        if (most - least > 1.9) return all();
        const double scale = bins_ / 4.0;
        return widened(scale * (first + least), scale * (first + most));
    }

    Span all() const { return {0, bins_}; }
    // Widened by one bin on both sides, which is more than all roundings together.
    Span widened(double least, double most) const {
        const double bin = std::floor(least) - 1.0;
        const double count = std::floor(most) + 2.0 - bin;
        if (!(count < bins_)) return all();
        const double wrapped = bin - bins_ * std::floor(bin / bins_);
        return {static_cast<std::uint32_t>(wrapped) % bins_, static_cast<std::uint32_t>(count)};
    }

    const Mesh& mesh_;
    glm::dvec3 light_;
    bool directional_;
    std::uint32_t bins_;
    bool is_within_ = false;
    int outer_ = 0, pole_ = 1, other_ = 2;
    double line_begin_ = 0.0, line_scale_ = 0.0;
};

std::uint32_t ShadowCounter::bound(const CountedVolume& volume) {
    const Mesh& mesh = *volume.mesh;
    const bool single = volume.form == ShadowForm::single;
    const std::uint32_t regular_end = mesh.edges_of_class(EdgeClass::regular).last;
    const auto sides =
        static_cast<std::uint32_t>(volume.silhouette.size()) + (mesh.edge_count() - regular_end);
    const std::uint32_t bins =
        std::clamp(std::bit_ceil(std::max(sides, 1u)), k_min_bins, k_max_bins);
    const Meridians meridians(mesh, volume.light, bins);
    steps_.assign(bins + 1, 0);
    std::int64_t everywhere = 0;
    const auto add = [&](std::span<const VertexId> vertices, std::int32_t count) {
        const Meridians::Span span = meridians.span_of(vertices);
        if (span.count == bins) {
            everywhere += count;
            return;
        }
        const std::uint32_t end = span.first + span.count;
        steps_[span.first] += count;
        if (end <= bins) {
            steps_[end] -= count;
        } else {
            steps_[0] += count;
            steps_[end - bins] -= count;
        }
    };
    for (const EdgeId edge : volume.silhouette)
        if (index(edge) < regular_end) add(mesh.edge(edge).vertices, single ? 1 : 2);
    for (std::uint32_t e = regular_end; e < mesh.edge_count(); ++e) {
        std::int32_t count = 0;
        for (const FaceId face : mesh.faces_of(EdgeId{e}))
            count += !single || face_bit(volume.face_words, face) ? 1 : 0;
        if (count > 0) add(mesh.edge(EdgeId{e}).vertices, count);
    }
    if (meridians.is_within())
        for (const Triangle& triangle : mesh.triangles())
            everywhere += meridians.may_meet_axis(triangle) ? 1 : 0;
    std::int64_t most = 0;
    std::int64_t spanning = 0;
    for (std::uint32_t bin = 0; bin < bins; ++bin) {
        spanning += steps_[bin];
        most = std::max(most, spanning);
    }
    // A ray meets at most all triangles.
    return static_cast<std::uint32_t>(
        std::min<std::int64_t>((most + everywhere) / 2, mesh.face_count()));
}

void ShadowCounter::begin() noexcept {
    added_.clear();
    total_ = 0;
}

std::uint32_t ShadowCounter::add(std::uint32_t instance, const CountedVolume& volume) {
    added_.push_back({instance, volume.mesh->face_count(), volume, bound(volume)});
    total_ += added_.back().bound;
    return added_.back().bound;
}

std::uint32_t ShadowCounter::add_unseen(std::uint32_t instance, std::uint32_t face_count) {
    added_.push_back({instance, face_count, {}, std::min(face_count, k_batch_limit)});
    total_ += added_.back().bound;
    return added_.back().bound;
}

std::vector<ShadowBatch> ShadowCounter::end() {
    std::vector<ShadowBatch> batches(1);
    std::uint64_t counted = 0;
    const std::uint64_t limit =
        total_ <= k_single_batch_limit ? k_single_batch_limit : k_batch_limit;
    for (const Added& added : added_) {
        if (added.bound > limit) {
            add_faces(added, batches);
            counted = limit;
            continue;
        }
        if (counted + added.bound > limit) {
            batches.emplace_back();
            counted = 0;
        }
        counted += added.bound;
        batches.back().draws.push_back(
            {.instance = added.instance, .face_count = added.face_count});
    }
    // The pass folds the stencil only if there is more than one batch.
    if (total_ > k_single_batch_limit && batches.size() == 1) batches.emplace_back();
    return batches;
}

void ShadowCounter::add_faces(const Added& added, std::vector<ShadowBatch>& batches) {
    const Mesh& mesh = *added.volume.mesh;
    const Meridians meridians(mesh, added.volume.light, k_min_bins);
    std::uint32_t first = 0;
    std::uint32_t most = 0;
    steps_.assign(k_min_bins, 0);  // Here: the number of faces that span each bin.
    const auto cut = [&](std::uint32_t end) {
        if (end == first) return;
        if (!batches.back().draws.empty()) batches.emplace_back();
        batches.back().draws.push_back({.instance = added.instance,
                                        .first_face = first,
                                        .face_count = end - first,
                                        .face_by_face = true});
        first = end;
        most = 0;
        std::ranges::fill(steps_, 0);
    };
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        if (most == k_batch_limit) cut(f);
        const Meridians::Span span = meridians.span_of(mesh.triangles()[f]);
        for (std::uint32_t i = 0; i < span.count; ++i) {
            std::int32_t& spanning = steps_[(span.first + i) % k_min_bins];
            most = std::max(most, static_cast<std::uint32_t>(++spanning));
        }
    }
    cut(mesh.face_count());
}

}  // namespace rimline
