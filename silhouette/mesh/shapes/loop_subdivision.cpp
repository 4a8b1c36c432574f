#include "silhouette/mesh/shapes/loop_subdivision.h"

#include <string>
#include <utility>
#include <vector>

#include "silhouette/gradual_resize.h"
#include "silhouette/mesh/mesh.h"
#include "silhouette/mesh/opposite_corner.h"

namespace rimline {

namespace {

constexpr std::uint64_t k_max_faces = std::uint64_t{1} << 28;
constexpr std::uint32_t k_checkpoint_interval = 1u << 16;

bool is_crease(EdgeClass edge_class) {
    return edge_class == EdgeClass::border || edge_class == EdgeClass::nonmanifold;
}

// The neighbors of a vertex: all of them, and those along creases.
struct Neighborhood {
    glm::dvec3 sum{0.0};
    glm::dvec3 crease_sum{0.0};
    std::uint32_t count = 0;
    std::uint32_t crease_count = 0;
};

// All operations are correctly rounded in double, so scaling the input by a power of two scales the
// result exactly.
glm::dvec3 moved(const glm::dvec3& v, const Neighborhood& around) {
    if (around.crease_count == 2) return 0.75 * v + 0.125 * around.crease_sum;
    if (around.crease_count > 2 || around.count == 0) return v;
    // A single crease that ends here does not fix the vertex.
    const double n = around.count;
    const double n_beta = around.count == 3 ? 0.5625 : 0.375;
    return (1.0 - n_beta) * v + n_beta * (around.sum / n);
}

// Values of corners for the four faces that each face becomes. New corners, which are on edges, get the mean of the
// edge's two corners.
template <typename Value>
std::vector<Value> refined_corners(const std::vector<Value>& corners) {
    std::vector<Value> refined;
    refined.reserve(4 * corners.size());
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const Value a = corners[i], b = corners[i + 1], c = corners[i + 2];
        const Value ab = 0.5f * (a + b);
        const Value bc = 0.5f * (b + c);
        const Value ca = 0.5f * (c + a);
        // In the order of the faces of refine().
        refined.insert(refined.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    return refined;
}

FaceMaterials refined_materials(const FaceMaterials& materials) {
    FaceMaterials refined{.materials = materials.materials,
                          .of_face = {},
                          .corner_colors = refined_corners(materials.corner_colors),
                          .textures = materials.textures,
                          .corner_uvs = refined_corners(materials.corner_uvs)};
    refined.of_face.reserve(4 * materials.of_face.size());
    for (const MaterialId material : materials.of_face)
        refined.of_face.insert(refined.of_face.end(), 4, material);
    return refined;
}

// Each half of an edge has the code of the edge, and edges inside a face are never drawn. Codes are those of
// MeshSource::edge_codes.
std::vector<std::uint8_t> refined_codes(const std::vector<std::uint8_t>& codes) {
    std::vector<std::uint8_t> refined;
    refined.reserve(4 * codes.size());
    for (const std::uint8_t code : codes) {
        const unsigned ab = code & 3u, bc = code >> 2 & 3u, ca = code >> 4 & 3u;
        // In the order of the faces of refine(): a ab ca, ab b bc, ca bc c, ab bc ca.
        for (const unsigned refined_code : {ab | ca << 4, ab | bc << 2, bc << 2 | ca << 4, 0u})
            refined.push_back(static_cast<std::uint8_t>(refined_code));
    }
    return refined;
}

/// One step. Calls `checkpoint` at intervals with the step's finished share.
template <typename Checkpoint>
MeshSource refine(const Mesh& mesh, const std::stop_token& stop, Checkpoint&& checkpoint) {
    const std::uint32_t vertex_count = mesh.vertex_count();
    const auto position = [&](VertexId v) { return glm::dvec3(mesh.positions()[index(v)]); };
    const auto pause = [&](std::uint32_t i, std::uint32_t count, double from, double share) {
        if (i % k_checkpoint_interval == 0) checkpoint(from + share * i / count);
    };

    MeshSource refined;
    refined.up = mesh.up();
    refined.is_up_known = mesh.is_up_known();
    // First the vertices, then one vertex per edge e: vertex_count + e.
    resize_gradually(refined.positions, std::size_t{vertex_count} + mesh.edge_count(), stop);
    std::vector<Neighborhood> around;
    resize_gradually(around, vertex_count, stop);
    for (std::uint32_t e = 0; e < mesh.edge_count(); ++e) {
        pause(e, mesh.edge_count(), 0.0, 0.6);
        const Edge& edge = mesh.edges()[e];
        const bool crease = is_crease(mesh.edge_class(EdgeId{e}));
        const glm::dvec3 a = position(edge.vertices[0]);
        const glm::dvec3 b = position(edge.vertices[1]);
        for (std::uint32_t end = 0; end < 2; ++end) {
            Neighborhood& hood = around[index(edge.vertices[end])];
            const glm::dvec3& neighbor = end == 0 ? b : a;
            hood.sum += neighbor;
            ++hood.count;
            if (!crease) continue;
            hood.crease_sum += neighbor;
            ++hood.crease_count;
        }
        glm::dvec3 edge_point = 0.5 * (a + b);
        if (!crease) {
            const glm::dvec3 c =
                position(opposite_corner(mesh.triangles()[index(edge.faces[0])], edge));
            const glm::dvec3 d =
                position(opposite_corner(mesh.triangles()[index(edge.faces[1])], edge));
            edge_point = 0.375 * (a + b) + 0.125 * (c + d);
        }
        refined.positions[std::size_t{vertex_count} + e] = glm::vec3(edge_point);
    }
    for (std::uint32_t v = 0; v < vertex_count; ++v)
        refined.positions[v] = glm::vec3(moved(position(VertexId{v}), around[v]));

    refined.triangles.reserve(4 * std::size_t{mesh.face_count()});
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
        pause(f, mesh.face_count(), 0.6, 0.4);
        const auto [a, b, c] = mesh.triangles()[f];
        const auto [ab, bc, ca] = mesh.edges_of(FaceId{f});
        if (ab == k_no_edge) {
            // A triangle with equal corners has no edges to split. Four copies keep the face count.
            refined.triangles.insert(refined.triangles.end(), 4, {index(a), index(b), index(c)});
            continue;
        }
        const std::uint32_t on_ab = vertex_count + index(ab);
        const std::uint32_t on_bc = vertex_count + index(bc);
        const std::uint32_t on_ca = vertex_count + index(ca);
        refined.triangles.push_back({index(a), on_ab, on_ca});
        refined.triangles.push_back({on_ab, index(b), on_bc});
        refined.triangles.push_back({on_ca, on_bc, index(c)});
        refined.triangles.push_back({on_ab, on_bc, on_ca});
    }
    refined.materials = refined_materials(mesh.materials());
    return refined;
}

}  // namespace

MeshSource subdivide_loop(const MeshSource& source, std::uint32_t steps, const LongCall& call) {
    if (steps == 0) return source;
    const std::uint64_t faces = source.triangles.size();
    if (faces > 0 && (steps > 14 || (faces << 2 * steps) > k_max_faces))
        throw Error(ErrorCode::too_large, std::to_string(faces) + " faces refined " +
                                              std::to_string(steps) +
                                              " times would be more than 268435456");
    // What the file says besides, which a Mesh does not hold.
    const auto with_rest = [&](MeshSource refined, std::uint32_t times) {
        refined.edge_codes = source.edge_codes;
        for (std::uint32_t step = 0; step < times; ++step)
            refined.edge_codes = refined_codes(refined.edge_codes);
        refined.warnings = source.warnings;
        refined.files = source.files;
        return refined;
    };
    if (faces == 0) return with_rest(refine(Mesh(source), {}, [](double) {}), 0);

    // Each step takes four times the work of the previous one.
    double total = 0.0;
    for (std::uint32_t step = 0; step < steps; ++step)
        total += double(std::uint64_t{1} << 2 * step);
    MeshSource refined;
    double done = 0.0;
    for (std::uint32_t step = 0; step < steps; ++step) {
        const double work = double(std::uint64_t{1} << 2 * step) / total;
        constexpr double k_mesh_share = 0.7;
        const Mesh mesh(step == 0 ? source : refined, Welding::equal_positions,
                        call.part(done, done + work * k_mesh_share));
        refined = refine(mesh, call.stop, [&](double share) {
            call.checkpoint(done + work * (k_mesh_share + (1.0 - k_mesh_share) * share));
        });
        done += work;
    }
    call.checkpoint(1.0);
    return with_rest(std::move(refined), steps);
}

}  // namespace rimline
