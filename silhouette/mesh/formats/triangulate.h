#pragma once

// Triangulates polygons.
//
// Any triangulation of the corners keeps the polygon's area vector, ½ Σ pᵢ × pᵢ₊₁, exactly. A fan does so
// for concave polygons, too, but its triangles overlap and some are reversed. This code clips ears in the
// plane perpendicular to the area vector (Newell's normal). It projects along the vector's largest axis,
// so the original float coordinates decide. The ear with the best shape is clipped first, because slivers
// have unreliable normals and a flat face would then show edges. A quad is split at its shorter inner
// diagonal. Ties are decided by positions: the same polygon from another corner on, or reversed, as on the back of a sheet,
// is cut along the same lines.
//
// Polygons that touch or cross themselves, or have no area, also give corners - 2 triangles and the same
// area vector.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

namespace rimline {

class Triangulator {
public:
    /// If `stop` is requested, triangulate() throws Error{cancelled} within some thousands of corners and
    /// tests. This applies to polygons with ear clipping. Some of the polygon's triangles may already be
    /// appended.
    explicit Triangulator(std::stop_token stop = {});
    ~Triangulator();
    Triangulator(Triangulator&&) noexcept;
    Triangulator& operator=(Triangulator&&) noexcept;

    /// Appends polygon.size() - 2 triangles to `triangles`, with the orientation of the polygon.
    /// `polygon` holds three or more indices into `positions`. About O(n log n) for usual polygons. There
    /// are at most about 2,000 corner tests per corner and about 2^27 in total. After that the rest is
    /// clipped by best shape without tests: the area vector stays exact, but triangles may be degenerate
    /// or overlap. For a comb of 300,002 corners with its tips on one straight line, nearly half are
    /// degenerate; with scattered tips none. Reuses its memory between calls.
    void triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> polygon,
                     std::vector<std::array<std::uint32_t, 3>>& triangles);

private:
    class EarClipper;
    std::unique_ptr<EarClipper> clipper_;
};

}  // namespace rimline
