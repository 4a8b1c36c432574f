#pragma once

// The umbrellas of a point set in a Hough octree (thesis 5.3): what its silhouettes are found in.
//
// A point and the triangles of all its umbrellas are a patch. A spoke p-r with a triangle on either side, of
// one umbrella or of two that meet there, can be a silhouette edge; one at an open gap has one triangle and
// cannot. p is on the silhouette when one of its spokes is:
//
//       r2---r1          on(p-r)  =  the face bits of its two triangles differ, as seen from the point;
//      /  \ /  \         are equal, where both turn the same way about the spoke; and of three triangles
//    r3----p----r0       or more, that not all are equal.
//      \  / \  /
//       r4---r5          Which side is outside is not known and does not matter: patches are oriented each
//                        for itself.
//
// p-q is a consensus edge when the spoke p-q of p's patch and the spoke q-p of q's both are on the
// silhouette; the two are twins.
//
// The octree is over patches: each is a set of Hough points, one a triangle, and sixteen neighbors in octree
// order make a block, whose box holds all of theirs. Where a box lies certainly on the same side of two
// v-spheres (box_tree.h) no bit in it differs between the two, and no spoke. What boxes do not settle is
// decided by is_front from each triangle's own plane, so that results equal brute force bit for bit.
//
// A point takes about 165 bytes: planes 16 each and spokes 6 each, about six of both; 32 for its place in
// the order, its position and boxes. (docs/points.md has the estimate beside a mesh of six faces a point.)

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/hough/block_set.h"
#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/points/point_surface.h"

namespace rimline {

/// Immutable: any number of silhouettes may share one, across threads.
class UmbrellaIndex {
public:
    /// `surface` is not needed afterwards. O(umbrellas log umbrellas), on all threads; the same whatever
    /// their number. Throws Error{too_large} beyond 2^30 triangles, Error{cancelled}.
    explicit UmbrellaIndex(const PointSurface& surface, const LongCall& call = {});
    // Silhouettes know where it is.
    UmbrellaIndex(const UmbrellaIndex&) = delete;
    UmbrellaIndex& operator=(const UmbrellaIndex&) = delete;

    /// Patches are stored about the origin in a size near 1, in float: coordinates far from zero lose
    /// nothing, but points nearer to each other than 2^-20 of the whole do. These take points and
    /// directions there; a point must be finite, and is moved to 2^20 sizes away if it lies farther.
    HomogeneousPoint viewpoint(const glm::dvec3& point) const noexcept;
    HomogeneousPoint direction(const glm::dvec3& direction) const noexcept;
    /// Of a position, as viewpoint() has it.
    glm::vec3 to_index(const glm::dvec3& position) const noexcept {
        return glm::vec3((position - center_) * scale_);
    }
    /// A length there over the same length in positions; a power of two.
    double scale() const noexcept { return scale_; }

    /// Of the points that have umbrellas, by patch; the middle of their bounding box, and the greatest
    /// distance from there to one.
    std::span<const glm::vec3> positions() const noexcept { return positions_; }
    const glm::dvec3& center() const noexcept { return patch_center_; }
    double radius() const noexcept { return patch_radius_; }

    std::uint32_t point_count() const noexcept {
        return static_cast<std::uint32_t>(patch_of_.size());
    }
    /// Memory reserved.
    std::uint64_t size_bytes() const noexcept;

    // What silhouettes read. Patches have numbers in octree order, their spokes and planes likewise.

    std::uint32_t patch_count() const noexcept {
        return static_cast<std::uint32_t>(patches_.size()) - 1;
    }
    std::uint32_t block_count() const noexcept {
        return (patch_count() + k_block_size - 1) / k_block_size;
    }
    static constexpr std::uint32_t k_none = 0xffffffffu;
    /// k_none where the point has no umbrella.
    std::uint32_t patch_of(PointId point) const noexcept { return patch_of_[index(point)]; }
    PointId point_of(std::uint32_t patch) const noexcept { return patches_[patch].point; }
    std::uint32_t spoke_count() const noexcept {
        return static_cast<std::uint32_t>(targets_.size());
    }
    struct Range {
        std::uint32_t first, last;
    };
    Range spokes_of(std::uint32_t patch) const noexcept {
        return {patches_[patch].first_spoke, patches_[patch + 1].first_spoke};
    }
    Range planes_of(std::uint32_t patch) const noexcept {
        return {patches_[patch].first_plane, patches_[patch + 1].first_plane};
    }
    /// Of the patches of a block.
    Range patches_of(std::uint32_t block) const noexcept {
        const std::uint32_t first = block * k_block_size;
        return {first, std::min(first + k_block_size, patch_count())};
    }
    /// The patch that a spoke leads to; k_none where the point there has none.
    std::uint32_t target(std::uint32_t spoke) const noexcept { return targets_[spoke]; }
    /// The spoke of patch `from` that leads to patch `to`; k_none where there is none.
    std::uint32_t find_spoke(std::uint32_t from, std::uint32_t to) const noexcept;

    /// Room for the bits of any block, and to walk the tree, for one thread.
    std::uint32_t max_planes() const noexcept { return max_planes_; }
    BlockScratch make_scratch() const { return BlockScratch(block_count()); }

    /// The blocks in which a spoke may be on the silhouette from one of the two points and not from the
    /// other: the first so many of scratch.block. `counters` is added to.
    std::uint32_t find_changing(const HomogeneousPoint& from, const HomogeneousPoint& to,
                                BlockScratch& scratch, TraversalCounters& counters) const noexcept;
    /// The face bits of a block's planes, as bytes; returns how many.
    std::uint32_t evaluate(std::uint32_t block, const HomogeneousPoint& point,
                           std::span<std::uint8_t> front) const noexcept;
    /// What is known of how a patch's spokes lie between its planes.
    enum class Shape : std::uint8_t {
        fan,    ///< Closed, up to eight of each: spoke j between plane j and the one before.
        plain,  ///< None is on where all planes' bits are equal.
        odd,
    };
    Shape shape(std::uint32_t patch) const noexcept { return shapes_[patch]; }
    static constexpr std::uint32_t k_max_of_fan = 8;
    /// Whether a spoke is on the silhouette; `front` are the bits of its patch's planes.
    bool is_on(std::uint32_t spoke, const std::uint8_t* front) const noexcept {
        const Sides sides = sides_[spoke];
        if (sides.first == k_special) return is_special_on(spoke, front);
        return (front[sides.first & k_plane_bits] ^ front[sides.second] ^
                (sides.first & k_turn_the_same) >> 7) != 0;
    }

private:
    friend class UmbrellaIndexBuilder;

    // The planes on either side of a spoke, by their numbers in its patch: the same twice where it has one.
    struct Sides {
        std::uint8_t first;  // With the bit below where both turn the same way about the spoke.
        std::uint8_t second;
    };
    static constexpr std::uint8_t k_turn_the_same = 0x80;
    static constexpr std::uint8_t k_plane_bits = 0x7f;
    static constexpr std::uint8_t k_special = 0xff;
    static constexpr std::uint32_t k_max_planes_of_sides = 0x7f;  // Beyond, spokes are special.

    struct Patch {
        PointId point;
        std::uint32_t first_spoke;
        std::uint32_t first_plane;
    };
    // A spoke with more than two triangles, or of a patch with more than Sides can name.
    struct Special {
        std::uint32_t spoke;
        std::uint32_t first_plane;  // Of special_planes_; up to the next one's.
        bool turn_the_same;         // Of two.
    };
    bool is_special_on(std::uint32_t spoke, const std::uint8_t* front) const noexcept;

    glm::dvec3 center_{0.0};
    double scale_ = 1.0;  // A power of two.
    std::vector<glm::vec3> positions_;
    glm::dvec3 patch_center_{0.0};  // The origin of Hough space.
    double patch_radius_ = 0.0;
    std::vector<std::uint32_t> patch_of_;  // Of each point.
    std::vector<Patch> patches_;           // One more, for the ends.
    std::vector<Shape> shapes_;            // Of each patch.
    std::vector<std::uint32_t> targets_;   // Of each spoke, as sides_.
    std::vector<Sides> sides_;
    std::vector<Special> specials_;  // By spoke, and one more for the end.
    std::vector<std::uint32_t> special_planes_;
    // Block after block, of each all nx, all ny, all nz, all d.
    std::vector<float> planes_;
    std::uint32_t max_planes_ = 0;
    BoxTree tree_;
    std::vector<NodeFrames> frames_;  // The walk fetches them; nothing here is decided by them.
};

}  // namespace rimline
