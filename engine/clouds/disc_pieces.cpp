#include "engine/clouds/disc_pieces.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <ranges>
#include <span>

#include "silhouette/points/umbrella_triangles.h"

namespace rimline {

namespace {

// Faces at a point: a corner of a box has three. A piece ends at the two others, or at one and at a border.
constexpr std::size_t k_max_faces = 3;
// Triangles whose normals differ by less than 25 degrees are of one face.
const double k_flat_cosine = std::cos(25.0 * std::numbers::pi / 180.0);
// The cosine between the two cuts of a gap of 135 degrees.
const double k_bent_cosine = std::cos(45.0 * std::numbers::pi / 180.0);

// The triangles of one face: sums weighted by their angles at the point.
struct Face {
    glm::dvec3 normal{0.0};
    glm::dvec3 inward{0.0};  // From the point into them.
};

struct PieceTriangle {
    glm::dvec3 normal;  // Of length 1.
    glm::dvec3 inward;
    double angle;  // At the point.
};

std::vector<PieceTriangle> triangles_of(const PointSurface& surface, PointId point) {
    const std::span<const glm::dvec3> positions = surface.positions();
    std::vector<PieceTriangle> triangles;
    for_each_triangle(surface, point, [&](PointId from, PointId to, UmbrellaId) {
        const auto direction = [&](PointId q) {
            return glm::normalize(positions[index(q)] - positions[index(point)]);
        };
        const glm::dvec3 a = direction(from), b = direction(to), cross = glm::cross(a, b);
        const double sine = glm::length(cross);
        if (sine > 1e-9)
            triangles.push_back({cross / sine, a + b, std::atan2(sine, glm::dot(a, b))});
    });
    return triangles;
}

// Where the surface of a border point ends, on one side of a gap.
struct BorderSide {
    glm::dvec3 normal;  // Of the triangle beside the gap, of length 1.
    glm::dvec3 inward;  // In its plane, away from the gap, of length 1.
};

// A gap's side at which another umbrella of the point goes on is no border.
std::vector<BorderSide> border_sides(const PointSurface& surface, PointId point) {
    if (surface.label(point) != PointLabel::border) return {};
    struct End {
        PointId at,
            inside;     // The ring point at the gap's side, and the next one away from the gap.
        bool is_first;  // Of the triangles between two gaps.
    };
    std::vector<End> ends;
    const PointSurface::UmbrellaRange range = surface.umbrellas_of(point);
    for (std::uint32_t u = range.first; u < range.last; ++u) {
        const Umbrella umbrella = surface.umbrella(UmbrellaId{u});
        const std::size_t size = umbrella.ring.size();
        for (std::size_t j = 0; j < size; ++j) {
            if (!umbrella.is_gap(j)) continue;
            const std::size_t before = (j + size - 1) % size, after = (j + 1) % size;
            if (!umbrella.is_gap(before))
                ends.push_back({umbrella.ring[j], umbrella.ring[before], false});
            if (!umbrella.is_gap(after))
                ends.push_back({umbrella.ring[after], umbrella.ring[(j + 2) % size], true});
        }
    }
    std::vector<BorderSide> sides;
    const std::span<const glm::dvec3> positions = surface.positions();
    for (const End& end : ends) {
        if (std::ranges::count(ends, end.at, &End::at) > 1) continue;
        const glm::dvec3 along = positions[index(end.at)] - positions[index(point)];
        const glm::dvec3 inside = positions[index(end.inside)] - positions[index(point)];
        const glm::dvec3 cross =
            end.is_first ? glm::cross(along, inside) : glm::cross(inside, along);
        const glm::dvec3 inward = inside - glm::dot(inside, along) / glm::dot(along, along) * along;
        if (glm::length(cross) <= 1e-9 * glm::length(along) * glm::length(inside)) continue;
        sides.push_back({glm::normalize(cross), glm::normalize(inward)});
    }
    return sides;
}

// The triangles grouped into faces by their normals. The normals of faces have length 1.
std::vector<Face> faces_of(const PointSurface& surface, PointId point) {
    const std::vector<PieceTriangle> triangles = triangles_of(surface, point);
    if (triangles.empty()) return {};
    // Each further seed is the normal farthest from all seeds before.
    std::vector<glm::dvec3> seeds{triangles[0].normal};
    const auto nearest_seed = [&](const PieceTriangle& triangle) {
        std::size_t nearest = 0;
        for (std::size_t s = 1; s < seeds.size(); ++s)
            if (glm::dot(triangle.normal, seeds[s]) > glm::dot(triangle.normal, seeds[nearest]))
                nearest = s;
        return nearest;
    };
    while (seeds.size() < k_max_faces) {
        const PieceTriangle* farthest = nullptr;
        double least = k_flat_cosine;
        for (const PieceTriangle& triangle : triangles) {
            const double cosine = glm::dot(triangle.normal, seeds[nearest_seed(triangle)]);
            if (cosine >= least) continue;
            least = cosine;
            farthest = &triangle;
        }
        if (!farthest) break;
        seeds.push_back(farthest->normal);
    }
    std::vector<Face> faces(seeds.size());
    for (const PieceTriangle& triangle : triangles) {
        Face& face = faces[nearest_seed(triangle)];
        face.normal += triangle.angle * triangle.normal;
        face.inward += triangle.angle * triangle.inward;
    }
    for (Face& face : faces) face.normal = glm::normalize(face.normal);
    return faces;
}

// The cuts along the two sides of a border's gap, if it has exactly one gap: vectors into the piece, in the
// umbrella's plane.
std::array<glm::dvec3, 3> border_cuts(const PointSurface& surface, PointId point) {
    if (surface.label(point) != PointLabel::border) return {};
    const PointSurface::UmbrellaRange range = surface.umbrellas_of(point);
    const Umbrella umbrella = surface.umbrella(UmbrellaId{range.first});
    if (range.size() != 1 || std::popcount(umbrella.gaps) != 1) return {};
    const auto gap = static_cast<std::size_t>(std::countr_zero(umbrella.gaps));
    const auto direction = [&](std::size_t j) {
        const PointId q = umbrella.ring[j % umbrella.ring.size()];
        return surface.positions()[index(q)] - surface.positions()[index(point)];
    };
    // The triangles follow the ring from the end of the gap to its beginning.
    const glm::dvec3 first = glm::cross(umbrella.normal, direction(gap + 1));
    const glm::dvec3 last = glm::cross(direction(gap), umbrella.normal);
    const double lengths = glm::length(first) * glm::length(last);
    if (lengths == 0.0) return {};
    const bool is_convex =
        glm::dot(glm::cross(direction(gap + 1), direction(gap)), umbrella.normal) >= 0.0;
    if (is_convex) return {first, last};
    // Two cuts leave the intersection of both halves. That is too little if the gap is less than half a turn.
    if (glm::dot(first, last) < k_bent_cosine * lengths) return {};
    return {glm::normalize(first) + glm::normalize(last), glm::dvec3(0.0)};
}

}  // namespace

std::vector<DiscPiece> disc_pieces(const PointSurface& surface, PointId point) {
    const std::vector<Face> faces = faces_of(surface, point);
    if (faces.size() < 2) {
        if (faces.empty()) return {{surface.normal(point), {}}};
        return {{surface.normal(point), border_cuts(surface, point)}};
    }
    const std::vector<BorderSide> sides = border_sides(surface, point);
    std::vector<DiscPiece> pieces;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        DiscPiece piece{faces[f].normal, {}};
        std::size_t cut = 0;
        for (std::size_t other = 0; other < faces.size(); ++other) {
            if (other == f) continue;
            const double side = glm::dot(faces[f].inward, faces[other].normal);
            piece.cuts[cut++] = faces[other].normal * (side < 0.0 ? -1.0 : 1.0);
        }
        for (const BorderSide& side : sides) {
            const auto likeness = [&](const Face& face) {
                return glm::dot(face.normal, side.normal);
            };
            if (cut < piece.cuts.size() &&
                likeness(faces[f]) >= std::ranges::max(faces | std::views::transform(likeness)))
                piece.cuts[cut++] = side.inward;
        }
        pieces.push_back(piece);
    }
    return pieces;
}

}  // namespace rimline
