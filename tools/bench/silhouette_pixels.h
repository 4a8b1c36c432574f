#pragma once

// Which pixels of a picture silhouettes pass through, by rays, and how well marked pixels agree with them.
//
// Edges are taken in places a quarter of a pixel apart. From each place one ray goes to the eye, past the faces
// of the edge itself (RayWay::own_faces). The pixel that contains a visible place is a true one.
//
//     found    a true pixel with a marked one among the nine around it: within one pixel
//     missed   a true pixel that is not found
//     extra    a marked pixel with no true one within two pixels, the width of the lines that are compared:
//              some draw it on one side of the edge. Of these, pixels within two pixels of a visible border or
//              crease count apart, because a technique may draw them on purpose.

#include <cstdint>
#include <vector>

#include "engine/camera.h"
#include "silhouette/mesh/mesh.h"
#include "tools/bench/piece_rays.h"

namespace rimline::tools {

/// The lines that are compared have this width.
constexpr int k_compared_width_px = 2;
/// The least bend of an edge that counts as a crease.
constexpr double k_counted_crease_degrees = 20.0;

/// A flag for each pixel, rows from the top.
struct PixelMask {
    std::uint32_t width, height;
    std::vector<std::uint8_t> at;

    PixelMask(std::uint32_t w, std::uint32_t h) : width(w), height(h), at(std::size_t{w} * h) {}
    std::uint64_t count() const;
    /// The pixels with a set one in the square of `reach` pixels to each side. O(pixels).
    PixelMask widened(int reach) const;
};

/// Pixels of visible edges.
struct TruePixels {
    PixelMask silhouettes, borders, creases;
    PixelMask near_silhouettes, near_borders, near_creases;  ///< Widened by the compared width.

    TruePixels(PixelMask of_silhouettes, PixelMask of_borders, PixelMask of_creases);
};

/// The camera is a perspective one, outside of the mesh, of which `rays` are. O(edges + places).
TruePixels find_true_pixels(const Mesh& mesh, const PieceRays& rays, const Camera& camera,
                            std::uint32_t width, std::uint32_t height);

/// Sums over pictures.
struct OutlineHits {
    std::uint64_t truth = 0;    ///< True pixels of silhouettes.
    std::uint64_t missed = 0;   ///< Of these.
    std::uint64_t marked = 0;   ///< Pixels that a technique drew.
    std::uint64_t borders = 0;  ///< Of these, at borders and at no silhouette.
    std::uint64_t creases = 0;  ///< At creases and at none of the others.
    std::uint64_t extra = 0;    ///< At none.

    /// Shares, 0 where the divisor is 0.
    double missed_share() const noexcept { return share(missed, truth); }
    double crease_share() const noexcept { return share(creases, marked); }
    double border_share() const noexcept { return share(borders, marked); }
    double extra_share() const noexcept { return share(extra, marked); }

    OutlineHits& operator+=(const OutlineHits& other) noexcept;

private:
    static double share(std::uint64_t part, std::uint64_t all) noexcept {
        return all == 0 ? 0.0 : double(part) / double(all);
    }
};

/// `marked` has the size of the true pixels.
OutlineHits count_hits(const TruePixels& truth, const PixelMask& marked);

}  // namespace rimline::tools
