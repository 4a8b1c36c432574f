#include "tools/bindings/bound_mesh.h"

#include <algorithm>
#include <cmath>

#include "tools/options/model_argument.h"

namespace rimline::tools {

namespace {

constexpr double k_min_radius = 0x1p-50;

}  // namespace

BoundMesh::BoundMesh(std::string name, MeshSource source, Welding welding, const LongCall& call)
    : name_(std::move(name)), mesh_(source, welding, call) {
    if (mesh_.radius() > 0.0 && mesh_.radius() < k_min_radius)
        throw Error(ErrorCode::bad_input, "too small, less than 2^-50 in size: scale it up");
    positions_ = std::move(source.positions);
}

const std::vector<std::array<std::uint32_t, 3>>& BoundMesh::faces() {
    return faces_.get({}, [&] {
        std::vector<std::array<std::uint32_t, 3>> faces;
        faces.reserve(mesh_.face_count());
        for (const auto& [a, b, c] : mesh_.triangles())
            faces.push_back({mesh_.file_vertex(a), mesh_.file_vertex(b), mesh_.file_vertex(c)});
        return faces;
    });
}

const std::vector<BoundMesh::Pair>& BoundMesh::edges() {
    return edges_.get({}, [&] {
        std::vector<Pair> edges;
        edges.reserve(mesh_.edge_count());
        for (std::uint32_t edge = 0; edge < mesh_.edge_count(); ++edge) {
            const auto& [v, w] = mesh_.edge(EdgeId{edge}).vertices;
            edges.push_back({mesh_.file_vertex(v), mesh_.file_vertex(w)});
        }
        return edges;
    });
}

const std::vector<std::array<std::int64_t, 2>>& BoundMesh::edge_faces() {
    return edge_faces_.get({}, [&] {
        std::vector<std::array<std::int64_t, 2>> pairs;
        pairs.reserve(mesh_.edge_count());
        for (std::uint32_t edge = 0; edge < mesh_.edge_count(); ++edge) {
            const std::span<const FaceId> faces = mesh_.faces_of(EdgeId{edge});
            pairs.push_back(
                {index(faces[0]), faces.size() > 1 ? std::int64_t{index(faces[1])} : -1});
        }
        return pairs;
    });
}

glm::dvec3 long_direction(const glm::dvec3& direction) {
    const double largest =
        std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    if (!(largest > 0.0 && largest < 0x1p-20)) return direction;
    const int exponent = -std::ilogb(largest);
    return {std::scalbn(direction.x, exponent), std::scalbn(direction.y, exponent),
            std::scalbn(direction.z, exponent)};
}

SharedMesh load_bound_mesh(const std::string& model, std::uint32_t subdivide, bool reads_textures,
                           const char* advice_for_clouds, std::vector<std::string>& warnings,
                           const LongCall& call) {
    // Reading, textures and subdividing, each of which may take nearly all of the time.
    int steps = 0;
    const auto begin = [&](const std::string&) {
        const double from = 0.2 * std::min(steps++, 2);
        return call.part(from, from + 0.2);
    };
    MeshSource source = load_model(model, subdivide, FaceRequirement::faces_or_points, begin,
                                   reads_textures ? TexturePictures::read : TexturePictures::skip);
    if (source.triangles.empty())
        throw Error(ErrorCode::bad_input, model + ": no faces: it is a cloud of " +
                                              std::to_string(source.positions.size()) + " points" +
                                              advice_for_clouds);
    warnings.insert(warnings.end(), source.warnings.begin(), source.warnings.end());
    return about_model(model, [&] {
        return std::make_shared<BoundMesh>(model, std::move(source), Welding::equal_positions,
                                           call.part(0.6, 1.0));
    });
}

}  // namespace rimline::tools
