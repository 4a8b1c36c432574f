#include "tools/bench/edge_normals.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "silhouette/hough/spread_viewpoints.h"
#include "silhouette/mesh/face_bits.h"
#include "silhouette/mesh/formats/glb_writer.h"

namespace rimline::tools {

namespace {

using ReadNormals = std::array<std::array<glm::vec3, 2>, k_stored_normals>;

// An edge of the class silhouette, as a viewer has it.
struct JudgedEdge {
    EdgeId edge;
    glm::vec3 middle;
    ReadNormals normals;
};

std::vector<JudgedEdge> judged_edges(const Mesh& mesh, const std::vector<EdgeVisibility>& edges) {
    std::vector<JudgedEdge> judged;
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
        if (edges[e] != EdgeVisibility::silhouette) continue;
        const auto [a, b] = mesh.edge(EdgeId{e}).vertices;
        JudgedEdge& added = judged.emplace_back(JudgedEdge{
            EdgeId{e}, 0.5f * (mesh.positions()[index(a)] + mesh.positions()[index(b)]), {}});
        const auto normals = silhouette_normals(mesh, EdgeId{e}, mesh.faces_of(EdgeId{e})[0]);
        for (std::size_t s = 0; s < k_stored_normals; ++s)
            for (std::size_t i = 0; i < 2; ++i)
                added.normals[s][i] = stored_and_read(normals[i], StoredNormals(s));
    }
    return judged;
}

EdgeNormalsResult sum_of(EdgeNormalsResult a, const EdgeNormalsResult& b) {
    a.silhouette += b.silhouette;
    a.hidden += b.hidden;
    for (std::size_t s = 0; s < k_stored_normals; ++s) {
        a.misjudged[s].missed += b.misjudged[s].missed;
        a.misjudged[s].extra += b.misjudged[s].extra;
    }
    return a;
}

// From one point.
EdgeNormalsResult judge(const Mesh& mesh, const std::vector<EdgeVisibility>& edges,
                        const std::vector<JudgedEdge>& judged, const HomogeneousPoint& eye) {
    std::vector<std::uint32_t> bits(face_word_count(mesh.face_count()), 0);
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f)
        bits[f / 32] |= std::uint32_t{is_front(mesh.plane(FaceId{f}), eye)} << f % 32;
    EdgeNormalsResult result;
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e)
        result.hidden +=
            edges[e] == EdgeVisibility::hidden && is_on_silhouette(mesh, EdgeId{e}, bits);
    for (const auto& [edge, middle, normals] : judged) {
        const bool is_silhouette = is_on_silhouette(mesh, edge, bits);
        result.silhouette += is_silhouette;
        const glm::vec3 to_eye = eye.xyz() - middle;
        for (std::size_t s = 0; s < k_stored_normals; ++s) {
            const bool is_drawn = (glm::dot(normals[s][0], to_eye) > 0.0f) !=
                                  (glm::dot(normals[s][1], to_eye) > 0.0f);
            result.misjudged[s].missed += is_silhouette && !is_drawn;
            result.misjudged[s].extra += is_drawn && !is_silhouette;
        }
    }
    return result;
}

// In two bytes and back.
glm::vec3 octahedral(glm::vec3 n) noexcept {
    const auto folded = [](float x, float y, int axis) {
        const float c = axis == 0 ? x : y;
        return (1.0f - std::abs(axis == 0 ? y : x)) * (c < 0.0f ? -1.0f : 1.0f);
    };
    const auto stored = [](float c) {
        return std::round((c * 0.5f + 0.5f) * 255.0f) / 127.5f - 1.0f;
    };
    n /= std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (n.z < 0.0f) n = {folded(n.x, n.y, 0), folded(n.x, n.y, 1), n.z};
    const float x = stored(n.x), y = stored(n.y);
    const float z = 1.0f - std::abs(x) - std::abs(y);
    return z < 0.0f ? glm::vec3(folded(x, y, 0), folded(x, y, 1), z) : glm::vec3(x, y, z);
}

}  // namespace

glm::vec3 stored_and_read(glm::vec3 normal, StoredNormals stored) noexcept {
    const auto [x, y, z] = normal_bytes(normal);
    const glm::vec3 bytes(x, y, z);
    switch (stored) {
        case StoredNormals::bytes: return bytes / 127.0f;
        case StoredNormals::cesium_bytes: return (2.0f * bytes + 1.0f) / 255.0f;
        case StoredNormals::oct16: return octahedral(normal);
        case StoredNormals::floats: break;
    }
    return normal;
}

EdgeNormalsResult judge_edges(const Mesh& mesh, const std::vector<EdgeVisibility>& edges,
                              std::uint32_t views, const LongCall& call) {
    RIMLINE_CHECK(edges.size() == mesh.edge_count());
    const std::vector<JudgedEdge> judged = judged_edges(mesh, edges);
    const std::vector<HomogeneousPoint> eyes = spread_viewpoints(mesh, views);
    constexpr std::size_t k_views_a_checkpoint = 20;
    EdgeNormalsResult result;
    for (std::size_t begin = 0; begin < eyes.size(); begin += k_views_a_checkpoint) {
        call.checkpoint(double(begin) / double(eyes.size()));
        const std::size_t end = std::min(begin + k_views_a_checkpoint, eyes.size());
        result =
            sum_of(result, tbb::parallel_reduce(
                               tbb::blocked_range<std::size_t>(begin, end, 1), EdgeNormalsResult{},
                               [&](const auto& run, EdgeNormalsResult sum) {
                                   for (std::size_t i = run.begin(); i < run.end(); ++i)
                                       sum = sum_of(sum, judge(mesh, edges, judged, eyes[i]));
                                   return sum;
                               },
                               sum_of));
    }
    return result;
}

}  // namespace rimline::tools
