#include "silhouette/mesh/formats/gltf_edges.h"

#include <algorithm>

namespace rimline {

namespace {

using EdgeFault = std::function<void(const std::string&)>;

std::string in_edges(const std::string& what) { return std::string(k_gltf_edges) + "." + what; }

// One edge of one triangle.
struct TriangleEdge {
    std::array<std::uint32_t, 2> vertices;  // The lesser first.
    std::uint32_t triangle;
    std::uint32_t corner;

    bool operator<(const TriangleEdge& other) const noexcept { return vertices < other.vertices; }
};

TriangleEdge triangle_edge(std::uint32_t a, std::uint32_t b, std::uint32_t triangle = 0,
                           std::uint32_t corner = 0) noexcept {
    return {{std::min(a, b), std::max(a, b)}, triangle, corner};
}

void read_visibility(const GltfAccessors& accessors, const GltfEdges& edges,
                     std::vector<std::uint8_t>& codes, const EdgeFault& fail) {
    GltfElements bytes = accessors.bit_field(*edges.visibility);
    const std::size_t needed = (6 * codes.size() + 7) / 8;
    if (bytes.count() != needed)
        fail(in_edges("visibility: ") + std::to_string(bytes.count()) + " bytes for " +
             std::to_string(codes.size()) + " triangles; they need " + std::to_string(needed));
    std::uint32_t bits = 0;
    unsigned count = 0;  // Of `bits`.
    std::uint64_t silhouette_edges = 0;
    for (std::uint8_t& code : codes) {
        if (count < 6) {
            bits |= bytes.index() << count;
            count += 8;
        }
        code = bits & 0x3f;
        bits >>= 6;
        count -= 6;
        for (unsigned corner = 0; corner < 3; ++corner)
            silhouette_edges += (code >> (2 * corner) & 3u) == 1;
    }
    if (bits != 0) fail(in_edges("visibility: bits after those of the last triangle are not 0"));
    if (!edges.silhouette_normals) {
        if (silhouette_edges > 0)
            fail(in_edges("visibility: ") + std::to_string(silhouette_edges) +
                 " silhouette edges, but there are no silhouetteNormals");
        return;
    }
    const std::uint32_t normals = accessors.normals(*edges.silhouette_normals).count();
    if (normals != 2 * silhouette_edges)
        fail(in_edges("silhouetteNormals: ") + std::to_string(normals) + " normals for " +
             std::to_string(silhouette_edges) + " silhouette edges, which have two each");
}

// The edges of line strings, whose accessors are given.
std::vector<TriangleEdge> read_lines(const GltfAccessors& accessors,
                                     std::span<const std::uint32_t> line_strings,
                                     std::uint64_t triangles, std::uint32_t vertices,
                                     const EdgeFault& fail) {
    // Each edge is named once. Strips of one edge take three indices.
    const std::uint64_t max_indices = 9 * triangles;
    std::uint64_t indices = 0;
    std::vector<TriangleEdge> lines;
    for (std::size_t s = 0; s < line_strings.size(); ++s) {
        const auto fail_here = [&](const std::string& what) {
            fail(in_edges("lineStrings[") + std::to_string(s) + "]: " + what);
        };
        GltfElements elements = accessors.indices(line_strings[s]);
        const std::uint32_t restart = accessors.restart_index(line_strings[s]);
        indices += elements.count();
        if (indices > max_indices) fail_here("there are more indices than edges of triangles need");
        std::uint32_t length = 0;  // Of the strip.
        std::uint32_t before = 0;
        for (std::uint32_t i = 0; i <= elements.count(); ++i) {
            const bool is_end = i == elements.count();
            const std::uint32_t vertex = is_end ? restart : elements.index();
            if (is_end || vertex == restart) {
                if (length < 2)
                    fail_here("the strip that ends at index number " + std::to_string(i) + " has " +
                              std::to_string(length) + " vertices; it needs two");
                length = 0;
                continue;
            }
            if (vertex >= vertices)
                fail_here("index " + std::to_string(vertex) + " (number " + std::to_string(i) +
                          ") is out of range; there are " + std::to_string(vertices) + " vertices");
            if (length > 0) lines.push_back(triangle_edge(before, vertex));
            before = vertex;
            ++length;
        }
    }
    return lines;
}

}  // namespace

std::vector<std::uint8_t> read_gltf_edges(const GltfScene& scene, const GltfAccessors& accessors,
                                          std::uint32_t edges_number,
                                          std::span<const std::array<std::uint32_t, 3>> triangles,
                                          std::uint32_t vertices, const EdgeFault& fail) {
    const GltfEdges& edges = scene.edges[edges_number];
    std::vector<std::uint8_t> codes(triangles.size(), 0);
    if (edges.visibility) read_visibility(accessors, edges, codes, fail);
    const auto [begin, end] = edges.line_strings;
    if (begin == end) return codes;

    const std::vector<TriangleEdge> lines =
        read_lines(accessors, std::span(scene.line_strings).subspan(begin, end - begin),
                   triangles.size(), vertices, fail);
    std::vector<TriangleEdge> sides;
    sides.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (std::uint32_t corner = 0; corner < 3; ++corner)
            sides.push_back(
                triangle_edge(triangles[t][corner], triangles[t][(corner + 1) % 3], t, corner));
    std::ranges::stable_sort(sides, std::less<>{});
    for (const TriangleEdge& line : lines) {
        const auto [first, last] = std::equal_range(sides.begin(), sides.end(), line);
        if (first == last)
            fail(in_edges("lineStrings: the line from vertex ") + std::to_string(line.vertices[0]) +
                 " to " + std::to_string(line.vertices[1]) + " is no edge of a triangle");
        for (auto side = first; side != last; ++side)
            codes[side->triangle] |=
                static_cast<std::uint8_t>((side == first ? 2 : 3) << (2 * side->corner));
    }
    return codes;
}

}  // namespace rimline
