#pragma once

// Polygons to triangles.
//
// Any triangulation that only joins corners keeps the polygon's area vector, ½ Σ pᵢ × pᵢ₊₁, exactly:
// the fan does it even for concave polygons, but with triangles that overlap and face backwards. Here
// ears are clipped in the plane of the polygon's area vector (Newell's normal), projected along its
// greatest axis so that the corners' own floats decide. The best-shaped ear goes first: slivers have
// unreliable normals, and a flat face would show edges. A quad takes its shorter inner diagonal.
//
// Polygons that touch or cross themselves, or have no area, still give corners - 2 triangles and the
// same area vector.

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
    /// Where `stop` is requested, triangulate() ends with Error{cancelled} for a polygon that is being cut
    /// by ears, within some thousands of corners and tests; a part of its triangles is then there.
    explicit Triangulator(std::stop_token stop = {});
    ~Triangulator();
    Triangulator(Triangulator&&) noexcept;
    Triangulator& operator=(Triangulator&&) noexcept;

    /// Appends polygon.size() - 2 triangles to `triangles`, whose corners run the same way round.
    /// `polygon` holds three or more indices into `positions`. About O(n log n) for polygons as they
    /// occur; never more than about 2,000 corner tests a corner nor than about 2^27 in all, after which
    /// what is left is clipped best shape first without them: the area vector still holds, but
    /// triangles may then be degenerate or overlap (of a comb of 300,002 corners whose tips lie in one
    /// straight line, nearly half are degenerate; with scattered tips none). Keeps its memory from call
    /// to call.
    void triangulate(std::span<const glm::vec3> positions, std::span<const std::uint32_t> polygon,
                     std::vector<std::array<std::uint32_t, 3>>& triangles);

private:
    class EarClipper;
    std::unique_ptr<EarClipper> clipper_;
};

}  // namespace rimline
