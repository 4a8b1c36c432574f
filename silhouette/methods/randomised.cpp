#include "silhouette/methods/randomised.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace rimline {

namespace {

// No edge has weight zero: coplanar faces may differ by rounding.
constexpr double k_min_angle_rad = 1e-3;

double angle_of(const Mesh& mesh, EdgeId edge) {
    const auto normal = [&mesh](FaceId face) {
        const Plane& plane = mesh.plane(face);
        return plane.normal();
    };
    const std::span<const FaceId> faces = mesh.faces_of(edge);
    double greatest = k_min_angle_rad;
    for (const FaceId face : faces.subspan(1)) {
        const glm::dvec3 a = normal(faces[0]);
        const glm::dvec3 b = normal(face);
        greatest = std::max(greatest, std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
    }
    return greatest;
}

}  // namespace

Randomised::Randomised(const Mesh& mesh, std::uint64_t seed)
    : mesh_(&mesh), seed_(seed), random_(seed) {
    const std::uint32_t edge_count = mesh.edges_of_class(EdgeClass::border).first;
    seed_count_ =
        static_cast<std::uint64_t>(std::ceil(8.0 * std::sqrt(static_cast<double>(edge_count))));
    std::vector<double> angles(edge_count);
    for (std::uint32_t e = 0; e < edge_count; ++e) angles[e] = angle_of(mesh, EdgeId{e});
    edges_by_angle_ = AliasTable(angles);
    edges_.reserve(edge_count);
    for (std::uint32_t e = 0; e < edge_count; ++e) {
        const std::span<const FaceId> faces = mesh.faces_of(EdgeId{e});
        edges_.push_back(
            {{mesh.plane(faces[0]), mesh.plane(faces[1])}, 0, mesh.edge_class(EdgeId{e})});
    }

    vertex_begin_.assign(std::size_t{mesh.vertex_count()} + 1, 0);
    for (std::uint32_t e = 0; e < edge_count; ++e)
        for (const VertexId vertex : mesh.edge(EdgeId{e}).vertices)
            ++vertex_begin_[index(vertex) + 1];
    std::partial_sum(vertex_begin_.begin(), vertex_begin_.end(), vertex_begin_.begin());
    vertex_edges_.resize(vertex_begin_.back());
    std::vector<std::uint32_t> next(vertex_begin_.begin(), vertex_begin_.end() - 1);
    for (std::uint32_t e = 0; e < edge_count; ++e)
        for (const VertexId vertex : mesh.edge(EdgeId{e}).vertices)
            vertex_edges_[next[index(vertex)]++] = EdgeId{e};
}

bool Randomised::is_on_silhouette_from(EdgeId edge, const HomogeneousPoint& point) {
    const EdgeToTest& tested = edges_[index(edge)];
    const bool first = is_front(tested.planes[0], point);
    const bool differ = is_front(tested.planes[1], point) != first;
    work_.face_checks += 2;
    switch (tested.edge_class) {
        case EdgeClass::regular: return differ;
        case EdgeClass::inconsistent: return !differ;
        default: break;
    }
    if (differ) return true;
    const std::span<const FaceId> others = mesh_->faces_of(edge).subspan(2);
    work_.face_checks += others.size();
    return std::any_of(others.begin(), others.end(),
                       [&](FaceId face) { return is_front(mesh_->plane(face), point) != first; });
}

bool Randomised::test(EdgeId edge, const HomogeneousPoint& point) {
    if (edges_[index(edge)].tested_in == call_) return false;
    edges_[index(edge)].tested_in = call_;
    ++work_.edge_checks;
    if (!is_on_silhouette_from(edge, point)) return false;
    found_.push_back(edge);
    return true;
}

void Randomised::begin_call() {
    if (++call_ == 0) {  // The call number has wrapped: old marks would be valid again.
        for (EdgeToTest& edge : edges_) edge.tested_in = 0;
        call_ = 1;
    }
    previous_.swap(found_);
    found_.clear();
    traced_ = 0;
    tried_ = 0;
    hits_ = 0;
    work_ = {};
}

void Randomised::try_random_edges(std::uint64_t count, const HomogeneousPoint& point) {
    if (edges_by_angle_.is_empty()) return;
    for (std::uint64_t i = 0; i < count; ++i) {
        ++tried_;
        if (!test(EdgeId{edges_by_angle_.draw(random_)}, point)) continue;
        ++hits_;
        // Followed at once, so that later seeds on the same loop cost nothing.
        trace(point);
    }
}

void Randomised::test_around(EdgeId edge, const HomogeneousPoint& point) {
    for (const VertexId vertex : mesh_->edge(edge).vertices)
        for (std::uint32_t i = vertex_begin_[index(vertex)]; i < vertex_begin_[index(vertex) + 1];
             ++i)
            test(vertex_edges_[i], point);
}

void Randomised::trace(const HomogeneousPoint& point) {
    for (; traced_ < found_.size(); ++traced_) test_around(found_[traced_], point);
}

void Randomised::finish(std::vector<EdgeId>& edges, TraversalCounters& counters) {
    edges.assign(found_.begin(), found_.end());
    counters += work_;
}

void Randomised::extract(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                         TraversalCounters& counters) {
    RIMLINE_CHECK(point.is_valid());
    begin_call();
    random_ = RandomBits(seed_);
    try_random_edges(seed_count_, point);
    finish(edges, counters);
}

void Randomised::update(const HomogeneousPoint& point, std::vector<EdgeId>& edges,
                        TraversalCounters& counters) {
    RIMLINE_CHECK(point.is_valid());
    const bool is_first = call_ == 0;
    begin_call();
    for (const EdgeId edge : previous_)
        if (!test(edge, point)) test_around(edge, point);
    trace(point);
    try_random_edges(is_first ? seed_count_ : seed_count_ / 4, point);
    finish(edges, counters);
}

std::vector<NamedCount> Randomised::own_counts() const {
    return {{"random_edges", tried_}, {"random_hits", hits_}};
}

}  // namespace rimline
