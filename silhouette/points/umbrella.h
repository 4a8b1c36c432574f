#pragma once

// An umbrella: the ring of neighbors that surround a point on the surface, with a triangle between each two
// that follow each other (thesis 5.2). With it the options for finding umbrellas, and the label of a point.
//
// A sector of a ring without a triangle is a gap. Either the surface ends there, or it turns so sharply that
// one umbrella cannot follow. Umbrellas are unoriented: it is not known which side of them is outside.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>
#include <span>

#include "silhouette/points/point_ids.h"

namespace rimline {

enum class PointLabel : std::uint8_t {
    border,  ///< The surface ends here: one of its umbrellas has a gap that no other umbrella fills.
    interior,   ///< One umbrella, without gaps.
    feature,    ///< Partial umbrellas that fill each other's gaps: smooth patches meet in a crease.
    undecided,  ///< UndecidedReason says why.
};

enum class UndecidedReason : std::uint8_t {
    none,        ///< It is decided.
    alone,       ///< There is no other point.
    coincident,  ///< Nearer to another point than 2^-50 of the whole set's extent.
    isolated,    ///< None of its nearest neighbors counts it among their own.
    collinear,   ///< All its neighbors lie on one line with it.
    no_normal,   ///< No plane was found about which its neighbors form a triangle of the surface.
    outlier,     ///< It lies on no surface (PointSurfaceOptions::drops_outliers).
    /// It has a gap, but the chain of its gap, through the points that name each other, is no border: the
    /// chain is too short, or broken. Only with this reason an undecided point has an umbrella, and so a
    /// normal and a scale.
    unconfirmed_border,
};

/// A clause, such as "all its neighbors lie on one line with it". Empty for none.
const char* describe(UndecidedReason reason) noexcept;

struct PointSurfaceOptions {
    enum class Method : std::uint8_t {
        robust,  ///< Several normals for each point; gaps by the scale of their corners (docs/results/points.md).
        thesis,  ///< The passes of thesis 5.2, as written.
    };
    Method method = Method::robust;

    /// How many nearest neighbors of a point are used; 4 to 32. All others where there are fewer.
    std::uint32_t k = 16;

    /// Above 1. A sector may be a gap where the circle through its corners has a radius above gap_ratio times
    /// the maximum of its corners' scales. The limit is lower where its triangle turns away from the normal
    /// (Stars::excess in star_choice.h). Robust only.
    double gap_ratio = 2.75;

    /// Finds the umbrellas again without the points that lie on no surface (outliers.h): these are undecided. For
    /// scans; takes twice the time where there are any. A mesh's vertices have none, and in coarse meshes some are
    /// taken for such.
    bool drops_outliers = false;

    // Thesis only, angles in radians.
    double omega = std::numbers::pi / 6;  ///< Of a neighbor with the plane; in (0, π/2).
    double omega_t =
        std::numbers::pi / 18;  ///< Half the marginal band around omega; in [0, omega].
    double phi = std::numbers::pi * 5.0 / 6.0;  ///< A wider sector is a gap; in (0, π].
    double gamma = 2.0;  ///< Maximum circumradius over that of the Gabriel triangle; above 1.
};

/// One umbrella of a point. Sector j lies between ring[j] and the next, the last before the first. A ring
/// has 2 to 64 points and at least one triangle.
struct Umbrella {
    std::span<const PointId>
        ring;                ///< Counterclockwise, seen from the side that `normal` points to.
    std::uint64_t gaps = 0;  ///< Bit j: sector j is a gap.
    glm::dvec3 normal{
        0.0};  ///< Of length 1; the mean of its triangles', by their angles at the point.

    bool is_gap(std::size_t sector) const noexcept { return (gaps >> sector & 1u) != 0; }
    bool is_closed() const noexcept { return gaps == 0; }
    std::size_t triangle_count() const noexcept {
        return ring.size() - static_cast<std::size_t>(std::popcount(gaps));
    }
};

}  // namespace rimline
