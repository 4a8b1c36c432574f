#pragma once

// The umbrellas of a point set in a Hough octree (thesis 5.3), in which its silhouettes are found.
//
// A point and the triangles of all its umbrellas are a patch. A spoke p-r with a triangle on either side, of
// one umbrella or of two that meet there, can be a silhouette edge. A spoke at an open gap has one triangle
// and cannot. p is on the silhouette when one of its spokes is:
//
//       r2---r1          on(p-r)  =  the face bits of its two triangles differ. Where both traverse the spoke
//      /  \ /  \         in the same direction: the bits are equal. With three triangles or more: not all
//    r3----p----r0       bits are equal.
//      \  / \  /
//       r4---r5          It is not known which side is outside, and it does not matter: each patch has an
//                        orientation of its own.
//
// The spoke p-q of p's patch and the spoke q-p of q's patch are twins. p-q is a consensus edge when both are
// on the silhouette.
//
// The octree is over patches. A patch is a set of Hough points, one for each triangle. Sixteen neighbors in
// octree order make a block, whose box holds all their planes. Where a box lies certainly on the same side of
// two points (block_tree.h), no bit in it differs between the two, and no spoke. All other blocks are decided
// by is_front from the planes of their triangles. So results equal brute force bit for bit.
//
// A point takes about 165 bytes: about six planes of 16 bytes, six spokes of 6, and 32 for its place in the
// order, its position and boxes. (docs/results/points.md compares this with a mesh of six faces a point.)

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "silhouette/error.h"
#include "silhouette/hough/block_scratch.h"
#include "silhouette/hough/change_set.h"
#include "silhouette/mesh/homogeneous_point.h"
#include "silhouette/points/point_surface.h"

namespace rimline {

class BlockTree;

/// Immutable: any number of silhouettes may share one, across threads.
class UmbrellaIndex {
public:
    /// `surface` is not needed afterwards. O(umbrellas log umbrellas) on all threads; the result does not
    /// depend on their number. Throws Error{too_large} beyond 2^30 triangles, Error{cancelled}.
    explicit UmbrellaIndex(const PointSurface& surface, const LongCall& call = {});
    ~UmbrellaIndex();
    // Silhouettes refer to it by address.
    UmbrellaIndex(const UmbrellaIndex&) = delete;
    UmbrellaIndex& operator=(const UmbrellaIndex&) = delete;

    /// Patches are stored around the origin with a size near 1, in float. Coordinates far from zero lose no
    /// precision; points nearer to each other than 2^-20 of the whole do. These two functions transform
    /// points and directions to there. A point must be finite. One with a coordinate beyond 2^20
    /// sizes is moved nearer, until it has none.
    HomogeneousPoint viewpoint(const glm::dvec3& point) const noexcept;
    HomogeneousPoint direction(const glm::dvec3& direction) const noexcept;
    /// Transforms a position as viewpoint() does.
    glm::vec3 to_index(const glm::dvec3& position) const noexcept {
        return glm::vec3((position - center_) * scale_);
    }
    glm::dvec3 from_index(const glm::dvec3& position) const noexcept {
        return position / scale_ + center_;
    }
    /// A length in the index divided by the same length in positions; a power of two.
    double scale() const noexcept { return scale_; }
    /// The distance of neighboring floats at the border of the index, in positions: what is as small as some of these
    /// has no shape left, and its silhouette is that of roundings.
    double resolution() const noexcept { return 0x1p-24 / scale_; }

    /// The positions of the points that have umbrellas, by patch; the center of their bounding box; and the
    /// maximum distance from it to one.
    std::span<const glm::vec3> positions() const noexcept { return positions_; }
    const glm::dvec3& center() const noexcept { return patch_center_; }
    double radius() const noexcept { return patch_radius_; }

    std::uint32_t point_count() const noexcept {
        return static_cast<std::uint32_t>(patch_of_.size());
    }
    /// Memory reserved.
    std::uint64_t size_bytes() const noexcept;

    // For silhouettes. Patches are numbered in octree order, and so are their spokes and planes.

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
    /// The patches of a block.
    Range patches_of(std::uint32_t block) const noexcept {
        const std::uint32_t first = block * k_block_size;
        return {first, std::min(first + k_block_size, patch_count())};
    }
    /// The patch of a spoke's other point; k_none where that point has none.
    std::uint32_t target(std::uint32_t spoke) const noexcept { return targets_[spoke]; }
    /// The spoke of patch `from` to the point of patch `to`; k_none where there is none.
    std::uint32_t find_spoke(std::uint32_t from, std::uint32_t to) const noexcept;

    /// The maximum number of planes of a block, and working memory for one thread to traverse the tree.
    std::uint32_t max_planes() const noexcept { return max_planes_; }
    BlockScratch make_scratch() const { return BlockScratch(block_count()); }

    /// Writes to scratch.block the blocks in which a spoke may be on the silhouette from one of the two
    /// points and not from the other. Returns their number. Adds to `counters`.
    std::uint32_t find_changing(const HomogeneousPoint& from, const HomogeneousPoint& to,
                                BlockScratch& scratch, TraversalCounters& counters) const noexcept;
    /// Writes the face bits of a block's planes to `front`, as bytes. Returns their number.
    std::uint32_t evaluate(std::uint32_t block, const HomogeneousPoint& point,
                           std::span<std::uint8_t> front) const noexcept;
    /// How the spokes of a patch lie between its planes.
    enum class Shape : std::uint8_t {
        fan,    ///< Closed, at most eight of each: spoke j lies between planes j - 1 and j.
        plain,  ///< No spoke is on the silhouette where all bits are equal.
        odd,    ///< Any other.
    };
    Shape shape(std::uint32_t patch) const noexcept { return shapes_[patch]; }
    static constexpr std::uint32_t k_max_of_fan = 8;
    /// Whether a spoke is on the silhouette. `front`: the bits of its patch's planes.
    bool is_on(std::uint32_t spoke, const std::uint8_t* front) const noexcept {
        const Sides sides = sides_[spoke];
        if (sides.first == k_special) return is_special_on(spoke, front);
        return (front[sides.first & k_plane_bits] ^ front[sides.second] ^
                (sides.first & k_turn_the_same) >> 7) != 0;
    }

private:
    friend class UmbrellaIndexBuilder;

    // The planes on both sides of a spoke, by their numbers in its patch. Both are the same where it has one.
    struct Sides {
        std::uint8_t first;  // With k_turn_the_same where both traverse the spoke in one direction.
        std::uint8_t second;
    };
    static constexpr std::uint8_t k_turn_the_same = 0x80;
    static constexpr std::uint8_t k_plane_bits = 0x7f;
    static constexpr std::uint8_t k_special = 0xff;
    static constexpr std::uint32_t k_max_planes_of_sides = 0x7f;  // With more, spokes are special.

    struct Patch {
        PointId point;
        std::uint32_t first_spoke;
        std::uint32_t first_plane;
    };
    // A spoke with more than two triangles, or of a patch with more planes than Sides can number.
    struct Special {
        std::uint32_t spoke;
        std::uint32_t first_plane;  // In special_planes_; its end is the next one's first.
        bool turn_the_same;         // Where there are two.
    };
    bool is_special_on(std::uint32_t spoke, const std::uint8_t* front) const noexcept;

    glm::dvec3 center_{0.0};
    double scale_ = 1.0;  // A power of two.
    std::vector<glm::vec3> positions_;
    glm::dvec3 patch_center_{0.0};  // The origin of Hough space.
    double patch_radius_ = 0.0;
    std::vector<std::uint32_t> patch_of_;  // Of each point.
    std::vector<Patch> patches_;           // One more than there are, for the ends.
    std::vector<Shape> shapes_;            // Of each patch.
    std::vector<std::uint32_t> targets_;   // Of each spoke, as sides_.
    std::vector<Sides> sides_;
    std::vector<Special> specials_;  // By spoke; one more than there are.
    std::vector<std::uint32_t> special_planes_;
    // Block after block. Of each block all nx, all ny, all nz, all d.
    std::unique_ptr<float[]> planes_;
    std::uint32_t max_planes_ = 0;
    double max_distance_ = 1.0;  // At least the maximum |dO|.
    std::unique_ptr<const BlockTree> tree_;
};

}  // namespace rimline
